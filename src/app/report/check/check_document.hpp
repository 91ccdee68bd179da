/// The report on a check of a mesh, for text, JSON and pages.
#pragma once

#include <string>

#include "app/report/common/document.hpp"
#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"

namespace barycert::report {

/// Arguments of a report, beside itself. Pages have pictures: they are drawn where they are given.
struct CheckSubject {
    const Mesh& mesh;
    const std::string& name;
    Environment environment = {};
    const FixedMesh* fixed = nullptr;
    Pictures exhibits = {}, histograms = {};  ///< of a mesh
    Pictures surface = {};                    ///< of a surface
};

Document check_document(const CheckReport& report, const CheckSubject& of);

}  // namespace barycert::report
