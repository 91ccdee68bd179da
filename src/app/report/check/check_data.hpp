/// Data of a check for programs: those of its document.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/report/common/json.hpp"
#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/environment.hpp"
#include "barycert/measures.hpp"

namespace barycert::report {

/// Distributions of the absolute values of each of cell_measures, over all cells: computed once for people and
/// programs. Surfaces have none.
class MeasureDistributions {
public:
    explicit MeasureDistributions(const CheckReport& report);

    const Distribution& of(std::vector<double> CellMeasures::*measure) const;

private:
    std::array<Distribution, cell_measures.size()> all_{};
};

/// `fixed`: nullptr, or what was repaired.
Json check_data(const CheckReport& report, const MeasureDistributions& measures, const std::string& name,
                const Environment& environment, const FixedMesh* fixed);

}  // namespace barycert::report
