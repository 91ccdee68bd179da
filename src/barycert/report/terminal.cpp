#include "barycert/report/terminal.hpp"

#include <algorithm>
#include <map>

#include "barycert/report/terminal_text.hpp"

namespace barycert::report {
namespace {

using audit::Finding;
using audit::KernelResult;
using audit::Report;
using audit::Statistics;

std::uint64_t count_of(const Statistics& s, Finding f) {
    return s.counts[static_cast<std::size_t>(f)];
}

std::string kernel_table(const Report& report, const Colours& paint) {
    std::size_t width = 6;
    for (const KernelResult& k : report.kernels) width = std::max(width, k.kernel.name.size());
    const auto row = [&](const auto&... cells) {
        return fmt::format("{:<{}} {:>5} {:>6} {:>5} {:>5} {:>5} {:>6} {:>6} {:>7} {:>6} {:>6} {:>9} {:>9} {:>8} {:>5}",
                           cells...);
    };
    std::string out;
    out += paint.bold(row("kernel", width, "cases", "wrong", "opp.", "false", "false", "not", "false", "false", "false",
                          "missed", "ulps", "ulps", "worst", "ns")) +
           "\n";
    out += paint.bold(row("", width, "", "%", "sign", "zero", "non-0", "finite", "inside", "outside", "degen.",
                          "degen.", "99.9%", "worst", "|sum-1|", "")) +
           "\n";
    for (const KernelResult& k : report.kernels) {
        const Statistics& s = k.total;
        const auto n = [&](Finding f) { return brief_count(count_of(s, f)); };
        const std::string line =
            row(k.kernel.name, width, brief_count(s.cases), percent(s.wrong_cases, s.cases), n(Finding::opposite_sign),
                n(Finding::false_zero), n(Finding::false_nonzero), n(Finding::not_finite), n(Finding::false_inside),
                n(Finding::false_outside), n(Finding::false_declaration), n(Finding::missed_degenerate),
                brief(s.weight_ulps.quantile(0.999)), brief(s.weight_ulp.value), brief(s.partition_residual.value),
                fmt::format("{:.1f}", k.ns));
        const std::uint64_t broken = count_of(s, Finding::false_certificate);
        out += (s.wrong_cases == 0 ? paint.good(line) : line) + "\n";
        if (broken != 0)
            out += paint.bad(fmt::format("    certifies its answers, and {} of them are wrong", broken)) + "\n";
    }
    out += paint.dim(
        "wrong %: cases with any finding. Signs, zeros and not finite count weights; inside, outside and degenerate "
        "count cases.\n"
        "ulps: error of a weight in units of the last place of the correctly rounded one. ns: median time of one "
        "evaluation.\n");
    return out;
}

std::string family_table(const Report& report, const Colours& paint) {
    struct Row {
        std::uint64_t cases = 0;
        std::size_t clean = 0;
        std::vector<std::pair<std::uint64_t, std::string>> wrong;  ///< wrong cases and kernel
    };
    std::map<std::pair<std::size_t, Simplex>, Row> rows;
    std::size_t width = 6;
    for (const KernelResult& k : report.kernels) {
        for (const audit::FamilyResult& f : k.families) {
            Row& row = rows[{f.family, k.kernel.simplex}];
            row.cases = f.statistics.cases;
            row.clean += f.statistics.wrong_cases == 0 ? 1 : 0;
            row.wrong.emplace_back(f.statistics.wrong_cases, k.kernel.name.substr(k.kernel.name.find('.') + 1));
            width = std::max(width, report.families[f.family].name.size());
        }
    }
    const auto line = [&](const auto&... cells) {
        return fmt::format("{:<{}}  {:<11} {:>7} {:>7} {:>9} {:>8}  {}", cells...);
    };
    std::string out =
        paint.bold(line("family", width, "simplex", "cases", "clean", "median %", "worst %", "worst kernel")) + "\n";
    for (auto& [key, row] : rows) {
        std::stable_sort(row.wrong.begin(), row.wrong.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        const auto& [worst, kernel] = row.wrong.back();
        out += line(report.families[key.first].name, width, name(key.second), brief_count(row.cases),
                    fmt::format("{}/{}", row.clean, row.wrong.size()),
                    percent(row.wrong[row.wrong.size() / 2].first, row.cases), percent(worst, row.cases),
                    worst == 0 ? std::string("-") : kernel) +
               "\n";
    }
    return out +
           paint.dim(
               "clean: kernels without a finding, of all. median, worst: share of wrong cases over the kernels.\n");
}

std::string replay_command(const Report& report, const KernelResult& k, const audit::Witness& w,
                           const TerminalStyle& style) {
    std::string libraries;
    for (const std::string& library : style.library_arguments) libraries += " --kernel-library " + shell_word(library);
    if (!style.witness_path.empty()) {
        return fmt::format("barycert replay {}{} --kernel {} --reason {}", shell_word(style.witness_path), libraries,
                           shell_word(k.kernel.name), w.reason);
    }
    std::string command = "barycert replay" + libraries;
    const auto family =
        std::find_if(report.families.begin(), report.families.end(), [&](const auto& f) { return f.name == w.family; });
    if (family != report.families.end() && family->needs_mesh) {
        for (const std::string& mesh : style.mesh_arguments) command += " --mesh " + shell_word(mesh);
    }
    return command + fmt::format(" --kernel {} --family {} --case {} --seed {}", shell_word(k.kernel.name),
                                 shell_word(w.family), w.index, w.seed);
}

std::string witness_list(const Report& report, const TerminalStyle& style, const Colours& paint) {
    std::string out;
    for (const KernelResult& k : report.kernels) {
        const audit::Witness* w = audit::worst_witness(k);
        if (w == nullptr) continue;
        const bool ulps = w->reason == "worst_weight_ulp";
        const std::string magnitude = ulps                          ? brief(w->magnitude) + " ulps"
                                      : std::isfinite(w->magnitude) ? "a weight off by " + brief(w->magnitude)
                                                                    : "no finite weight";
        out += fmt::format("{}: {} in {}, case {} ({})\n    {}\n", paint.bold(k.kernel.name), w->reason, w->family,
                           w->index, magnitude, replay_command(report, k, *w, style));
    }
    return out;
}

}  // namespace

std::string environment_line(const Environment& e) {
    return fmt::format("barycert {}, {}, rounding {}, {}{}, contraction {}, subnormals {}", e.version, e.compiler,
                       e.rounding, e.simd, e.fma ? "+FMA" : "", e.contraction ? "ON" : "off",
                       e.flush_to_zero ? "FLUSHED" : "kept");
}

std::string terminal_report(const Report& report, const TerminalStyle& style) {
    const Colours paint(style.colour);
    std::string out = environment_line(report.environment) + "\n";
    out += fmt::format(
        "seed {}, {} cases per family and simplex, {} in all, {} kernels, {} families, {} threads, {:.1f} s\n",
        report.seed, report.count, report.cases, report.kernels.size(), report.families.size(), report.threads,
        report.seconds);
    std::string meshes;
    for (const std::string& m : report.meshes) meshes += (meshes.empty() ? "" : ", ") + m;
    out += "meshes: " + (meshes.empty() ? std::string("none") : meshes) + "\n\n";
    out += kernel_table(report, paint) + "\n" + family_table(report, paint) + "\n";
    out += paint.bold("Worst witness of each kernel, and the command that replays it:") + "\n" +
           witness_list(report, style, paint);
    return out;
}

}  // namespace barycert::report
