/// How bad a defect of a mesh or surface is.
///
///     const CheckReport report = check_mesh(mesh);
///     for (const Defect& d : report.defects)
///         if (severity(d) == Severity::error) std::cerr << defect_text(d.kind).name << '\n';
#pragma once

#include "barycert/check.hpp"
#include "barycert/severity.hpp"

namespace barycert {

/// Returns error for what breaks the certificate, warning for what does not and has a remedy, note for the rest.
constexpr Severity severity(const DefectText& text) {
    if (text.breaks) return Severity::error;
    return text.remedy.empty() ? Severity::note : Severity::warning;
}

/// The same of a defect that was found: one of a harmless kind is an error where it causes others that break the
/// certificate.
inline Severity severity(const Defect& defect) {
    return defect.breaks() ? Severity::error : severity(defect_text(defect.kind));
}

}  // namespace barycert
