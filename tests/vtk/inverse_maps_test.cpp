// The rules that barycert audit --inverse-maps ascribes to VTK, held against VTK's cells.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include <vtkHexahedron.h>
#include <vtkPoints.h>
#include <vtkPyramid.h>
#include <vtkQuad.h>
#include <vtkSmartPointer.h>
#include <vtkWedge.h>

#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/threshold.hpp"
#include "barycert/witness.hpp"

namespace barycert::testing {
namespace {

TEST(InverseMaps, RulesAnswerAsVtksCells) {
    const std::map<std::string, vtkSmartPointer<vtkCell>> cells{
        {"hexahedron.newton-1e-5", vtkSmartPointer<vtkHexahedron>::New()},
        {"wedge.newton-1e-3", vtkSmartPointer<vtkWedge>::New()},
        {"pyramid.newton-1e-3", vtkSmartPointer<vtkPyramid>::New()},
        {"quadrilateral.newton-1e-4", vtkSmartPointer<vtkQuad>::New()},
    };
    std::size_t rules = 0;
    std::map<int, int> told;
    for (const InverseRule& rule : inverse_rules()) {
        const auto found = cells.find(rule.name);
        if (found == cells.end()) continue;
        ++rules;
        vtkCell* const cell = found->second;
        for (const InverseFamily& family : inverse_families()) {
            int apart = 0;
            for (std::uint64_t i = 0; i < 300; ++i) {
                const InverseCase c = make_inverse_case(family, rule.type, 11, i);
                const std::size_t d = c.point.size();
                for (std::size_t node = 0; node < c.values.size(); ++node) {
                    std::array<double, 3> at{};
                    std::copy_n(&c.nodes[d * node], d, at.begin());
                    cell->GetPoints()->SetPoint(static_cast<vtkIdType>(node), at.data());
                }
                std::array<double, 3> point{}, nearest{}, x{};
                std::copy_n(c.point.begin(), d, point.begin());
                std::array<double, 8> weights{};
                int sub_id = 0;
                double distance = 0;
                const int status =
                    cell->EvaluatePosition(point.data(), nearest.data(), sub_id, x.data(), distance, weights.data());
                const InverseAnswer answer = rule.answer(c);
                // Sums of another order may turn what hangs by a rounding.
                const bool same = status == (answer.found ? (answer.inside ? 1 : 0) : -1);
                apart += same ? 0 : 1;
                ++told[status];
                if (!same || status != 1) continue;
                double value = 0;
                for (std::size_t node = 0; node < c.values.size(); ++node) value += weights[node] * c.values[node];
                ASSERT_NEAR(answer.value, value, family.name == "moved" ? 1e-8 : 1e-10)
                    << rule.name << family.name << i;
            }
            EXPECT_LE(apart, 2) << rule.name << ' ' << family.name;
        }
    }
    EXPECT_EQ(rules, cells.size());
    EXPECT_TRUE(told[-1] > 500 && told[0] > 500 && told[1] > 5000) << told[-1] << ' ' << told[0] << ' ' << told[1];
}

}  // namespace
}  // namespace barycert::testing
