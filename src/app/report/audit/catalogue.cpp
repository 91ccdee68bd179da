// Lists of kernels and families, for people and programs.

#include <string>
#include <vector>

#include "app/report/audit/audit_words.hpp"
#include "app/report/common/document.hpp"
#include "app/report/common/json.hpp"
#include "app/report/common/terminal_text.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/family.hpp"
#include "barycert/kernels.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

using namespace report;

Json report::kernel_json(const Kernel& k) {
    Json j = record(MEMBERS(k, name, simplex, perspective, formula, source, fails, declares_degenerate, certifies),
                    "contained", k.host != nullptr, "region_rule",
                    k.rule == RegionRule::sign  ? "sign"
                    : k.rule == RegionRule::own ? "own"
                                                : "tolerant");
    if (k.rule == RegionRule::tolerant) put(j, MEMBERS(k, tolerance));
    return j;
}

Json report::family_json(const Family& f) {
    return record(MEMBERS(f, name), "after", f.tests, MEMBERS(f, parameters, needs_mesh), "simplices",
                  list(f.simplices, [](Simplex s) { return name(s); }), MEMBERS(f, perspective));
}

namespace {

Document kernels_document(const std::vector<Kernel>& kernels) {
    Document d;
    for (const Kernel& k : kernels) {
        std::string promises = k.certifies ? "certifies every answer" : "no certificate";
        promises += k.declares_degenerate ? "; declares degenerate simplices" : "; never declares a simplex degenerate";
        if (k.rule == RegionRule::tolerant) promises += fmt::format("; inside if every weight >= -{}", k.tolerance);
        if (k.rule == RegionRule::own) promises += "; inside by a rule of its own";
        d.add(Item{.text = k.name,
                   .lines = {{"formula  " + k.formula},
                             {"source   " + k.source},
                             {"fails    " + k.fails},
                             {"promise  " + promises}}});
    }
    d.data = record("schema", audit_schema, "kernels", list(kernels, kernel_json));
    return d;
}

Document families_document(const std::vector<Family>& families) {
    Document d;
    for (const Family& f : families) {
        std::string simplices = joined(f.simplices, ", ", [](Simplex simplex) { return name(simplex); });
        if (f.needs_mesh) simplices += " of a mesh";
        if (f.perspective) simplices += " with a depth at each vertex";
        d.add(Item{.text = f.name,
                   .lines = {{"tests    " + f.tests}, {"recipe   " + f.parameters}, {"for      " + simplices}}});
    }
    d.data = record("schema", audit_schema, "families", list(families, family_json));
    return d;
}

}  // namespace

std::string kernels_text(const std::vector<Kernel>& kernels) {
    return written_text([&] { return kernels_document(kernels); }, false);
}

std::string kernels_json(const std::vector<Kernel>& kernels) {
    return written_json([&] { return kernels_document(kernels); }, 1);
}

std::string families_text(const std::vector<Family>& families) {
    return written_text([&] { return families_document(families); }, false);
}

std::string families_json(const std::vector<Family>& families) {
    return written_json([&] { return families_document(families); }, 1);
}

}  // namespace barycert
