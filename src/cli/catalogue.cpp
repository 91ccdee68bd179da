// barycert kernels, barycert families: list and explain.

#include <CLI/CLI.hpp>
#include <memory>

#include "audit_inputs.hpp"
#include "barycert/audit_report.hpp"
#include "command.hpp"
#include "files.hpp"

namespace barycert::cli {
namespace {

struct ListArguments {
    std::vector<std::string> globs, libraries;
    std::string json;
};

int print(const ListArguments& a, const std::string& text, const std::string& json) {
    if (a.json != "-") {
        if (const Status written = write_output("-", text); !written) return fail(written.error());
    }
    if (!a.json.empty()) {
        if (const Status written = write_output(a.json, json); !written) return fail(written.error());
    }
    return exit_clean;
}

}  // namespace

void add_catalogue(CLI::App& app, int& exit_code) {
    const auto k = std::make_shared<ListArguments>();
    auto* kernels = app.add_subcommand("kernels", "List the kernels: formula, source, known failures");
    kernels->footer(done_or_error);
    kernels->add_option("KERNEL|GLOB", k->globs, "List only matching names");
    file_option(*kernels, "--kernel-library", k->libraries, "Also list the kernel of this shared library");
    file_option(*kernels, "--json", k->json, "Write the list as JSON; - is stdout");
    kernels->callback([k, &exit_code] {
        const auto chosen = select_kernels(k->globs, k->libraries, KernelRules{});
        exit_code = chosen ? print(*k, kernels_text(*chosen), kernels_json(*chosen)) : fail(chosen.error());
    });
    const auto f = std::make_shared<ListArguments>();
    auto* families = app.add_subcommand("families", "List the families of cases: what each tests, and its recipe");
    families->footer(done_or_error);
    families->add_option("FAMILY|GLOB", f->globs, "List only matching names");
    file_option(*families, "--json", f->json, "Write the list as JSON; - is stdout");
    families->callback([f, &exit_code] {
        const auto chosen = select_families(f->globs);
        exit_code = chosen ? print(*f, families_text(*chosen), families_json(*chosen)) : fail(chosen.error());
    });
}

}  // namespace barycert::cli
