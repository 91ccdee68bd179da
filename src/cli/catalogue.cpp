// barycert kernels, barycert families: list and explain.

#include <CLI/CLI.hpp>
#include <memory>

#include "audit_inputs.hpp"
#include "barycert/audit_report.hpp"
#include "command.hpp"
#include "options.hpp"
#include "reports.hpp"

namespace barycert::cli {
namespace {

struct ListArguments {
    KernelChoice kernels;
    std::vector<std::string> families;
    Reports reports;
};

constexpr const char* json_list = "Write the list as JSON; - is stdout";

}  // namespace

void add_catalogue(const Options& program) {
    const auto k = std::make_shared<ListArguments>(), f = std::make_shared<ListArguments>();
    const Options kernels =
        program.below("kernels", "List the kernels: formula, source, known failures", done_or_error);
    kernels.app().add_option("KERNEL|GLOB", k->kernels.names, "List only matching names");
    kernels.files("--kernel-library", k->kernels.libraries, "Also list the kernel of this shared library");
    k->reports.file(kernels, "--json", json_list);
    kernels.run([k] {
        return k->reports.end(chosen_kernels(k->kernels), [](const std::vector<Kernel>& all) {
            return Told{.files = {{"--json", [&] { return kernels_json(all); }}},
                        .text = [&](bool) { return kernels_text(all); }};
        });
    });
    const Options families =
        program.below("families", "List the families of cases: what each tests, and its recipe", done_or_error);
    families.app().add_option("FAMILY|GLOB", f->families, "List only matching names");
    f->reports.file(families, "--json", json_list);
    families.run([f] {
        return f->reports.end(choose_families(f->families), [](const std::vector<Family>& all) {
            return Told{.files = {{"--json", [&] { return families_json(all); }}},
                        .text = [&](bool) { return families_text(all); }};
        });
    });
}

}  // namespace barycert::cli
