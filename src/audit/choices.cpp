// What an audit is made of, by names: kernels, families, files of meshes.

#include <tbb/task_arena.h>

#include "audit/asking.hpp"
#include "barycert/audit_search.hpp"
#include "core/base/finite.hpp"
#include "core/base/nearest_name.hpp"

namespace barycert {

using audit::names_of;

namespace {

/// That `word` is none of these names.
Error unknown(std::string what, std::string expected, const std::string& word, const std::vector<std::string>& names,
              std::string_view lists = {}) {
    return file_error({}, std::move(what), std::move(expected), '"' + word + '"',
                      base::did_you_mean(word, names, lists));
}

/// Items that match one of the globs, in the order of the catalogue.
template <class Item>
Result<std::vector<Item>> chosen(const std::vector<std::string>& globs, std::vector<Item> items,
                                 const std::string& what, std::string_view lists) {
    if (globs.empty()) return items;
    for (const std::string& glob : globs) {
        if (std::ranges::none_of(items, [&](const Item& i) { return base::glob_match(glob, i.name); }))
            return unknown("no " + what + " of that name", "", glob, names_of(items), lists);
    }
    std::erase_if(items, [&](const Item& item) {
        return std::ranges::none_of(globs, [&](const std::string& glob) { return base::glob_match(glob, item.name); });
    });
    return items;
}

/// A mesh whose cells are taken with straight sides, as far as they may. Throws an Exception.
Mesh cells_of(const std::string& path, int threads, Curved curved, Notes& notes) {
    Mesh mesh = read_mesh(path, {.faces = false, .neighbours = false, .threads = threads}).value();
    if (curved == Curved::refuse) measure_curved(mesh, path, curved).value();
    notes.insert(notes.end(), mesh.notes.begin(), mesh.notes.end());
    return mesh;
}

Certificate certificate_of(const Mesh& mesh, int threads) {
    return check_mesh(mesh, {.threads = threads, .verdict_only = true}).certificate;
}

/// Throws an Exception.
MeshSource source_of(const std::vector<NamedMesh>& meshes, bool certify, int threads, Curved curved, Notes& notes) {
    MeshSource source;
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    for (const NamedMesh& named : meshes) {
        Mesh mesh = cells_of(named.path, threads, curved, notes);
        if (mesh.cell_count() == 0) throw Exception({.what = "the mesh has no cells", .file = named.path});
        const Certificate certificate = certify ? certificate_of(mesh, threads) : Certificate();
        arena.execute([&] { source.add(named.name, std::move(mesh), certificate); });
    }
    return source;
}

/// What a rule is held against; nothing if a search has no such figure.
std::optional<double> figure(const SearchReport& report, const std::string& name) {
    if (name == "any" || name == "wrong_cases") return static_cast<double>(report.wrong_cases);
    const bool finding = finding_named(name).has_value();
    if (!finding && name != "worst_weight_ulp" && name != "worst_value_ulp") return std::nullopt;
    bool mute = report.given_up;
    for (const SearchFind& f : report.finds) {
        if (f.reason == name) return finding ? static_cast<double>(f.cases) : f.found.magnitude;
        mute = mute ||
               std::ranges::any_of(audit::mute_findings, [&](Finding of) { return f.reason == barycert::name(of); });
    }
    // A kernel that gave no weights where there are some has no error to measure: it is worse than any.
    return finding || !mute ? 0 : std::numeric_limits<double>::infinity();
}

}  // namespace

Result<std::vector<Kernel>> choose_kernels(const KernelChoice& choice) {
    Result<std::vector<Kernel>> all = std::vector<Kernel>{};
    // With a library named and no glob, only the library's kernels are meant.
    if (!choice.names.empty() || choice.libraries.empty()) {
        all = chosen(choice.names, catalogue(), "kernel", "`barycert kernels` lists them; * and ? are wildcards");
        if (!all) return all;
    }
    for (const std::string& path : choice.libraries) {
        Result<Kernel> kernel =
            choice.in_process ? load_kernel_library(path) : load_contained_kernel(path, choice.seconds);
        if (!kernel) return kernel.error();
        if (std::ranges::find(*all, kernel->name, &Kernel::name) != all->end())
            return file_error(path, "two kernel libraries have the same name", "", kernel->name,
                              "set another info->name in one of them");
        all->push_back(std::move(*kernel));
    }
    for (Kernel& kernel : *all) {
        if (!choice.class_tolerance || kernel.rule != RegionRule::sign || kernel.certifies) continue;
        kernel.rule = RegionRule::tolerant;
        kernel.tolerance = *choice.class_tolerance;
    }
    return all;
}

Result<Kernel> choose_kernel(const KernelChoice& choice) {
    if (choice.names.empty() == choice.libraries.empty())
        return file_error({}, "which kernel", "the name of one kernel, or job.kernel_library FILE",
                          choice.names.empty() ? "neither" : "both", "`barycert kernels` lists the names");
    if (!choice.libraries.empty()) {
        const Result<std::vector<Kernel>> one = choose_kernels(choice);
        return one ? one->front() : Result<Kernel>(one.error());
    }
    const std::string& name = choice.names.front();
    const std::vector<Kernel> kernels = kernels_matching(name);
    if (kernels.size() == 1) return kernels.front();
    Error error = unknown("which kernel", "the name of one kernel", name, names_of(catalogue()),
                          "`barycert kernels` lists the names");
    if (!kernels.empty()) error.found = std::to_string(kernels.size()) + " of them";
    return error;
}

Result<std::vector<Family>> choose_families(const std::vector<std::string>& names) {
    return chosen(names, all_families(), "family", "`barycert families` lists them; * and ? are wildcards");
}

Result<PreparedAudit> prepare_audit(const AuditJob& job) try {
    PreparedAudit out{.options = job.options, .meshes = {}, .baseline = {}, .libraries = {}, .notes = {}};
    out.options.kernels = choose_kernels(job.kernels).value();
    out.options.families = choose_families(job.families).value();
    const bool wanted = std::ranges::any_of(out.options.families, &Family::needs_mesh);
    if (wanted || job.meshes_asked)
        out.meshes = source_of(job.meshes, job.check, job.options.threads, job.curved, out.notes);
    if (!job.baseline.empty()) {
        out.baseline = read_baseline(job.baseline).value();
        check_comparable(*out.baseline, out.options, out.meshes).value();
    }
    // Libraries' kernels stand behind those of the catalogue, in their order.
    const std::vector<std::string>& libraries = job.kernels.libraries;
    for (std::size_t i = 0; i < libraries.size(); ++i)
        out.libraries[out.options.kernels[out.options.kernels.size() - libraries.size() + i].name] = libraries[i];
    return out;
} catch (const Exception& e) {
    return e.error();
}

Result<Witness> make_witness(const CaseJob& job, const std::vector<Kernel>& kernels) try {
    if (!job.reason.empty() && !finding_named(job.reason))
        return unknown("job.reason of a case that is generated", "a class of finding", job.reason, {},
                       "leave it out to see the answer whatever it is");
    const std::vector<Family> families = choose_families({job.family}).value();
    if (families.size() != 1 || families.front().name != job.family)
        return unknown("job.family must name one family", "", job.family, names_of(all_families()),
                       "`barycert families` lists them");
    const Family& family = families.front();
    std::optional<Simplex> simplex = simplex_named(job.simplex);
    if (!job.simplex.empty() && !simplex)
        return unknown("unknown simplex", "segment, triangle, triangle3d or tetrahedron", job.simplex,
                       {"segment", "triangle", "triangle3d", "tetrahedron"});
    Witness w;
    if (!job.kernel.empty()) {
        const auto k = std::ranges::find_if(kernels, [&](const Kernel& x) {
            return x.perspective == family.perspective && (!simplex || x.simplex == *simplex) &&
                   base::glob_match(job.kernel, x.name);
        });
        if (k == kernels.end())
            return unknown("no kernel of that name for the cases of that family", "", job.kernel, names_of(catalogue()),
                           "`barycert kernels` lists them");
        simplex = k->simplex;
        w.kernel = k->name;
    }
    if (!simplex && family.simplices.size() == 1) simplex = family.simplices.front();
    if (!simplex || !family.applies_to(*simplex))
        return Error{.what = "the simplex is not determined: the family applies to several, or not to the one given",
                     .remedy = "add job.simplex NAME or job.kernel NAME"};
    MeshSource meshes;
    if (family.needs_mesh) {
        Notes notes;
        meshes = source_of(job.meshes, false, 0, Curved::straight, notes);
        if (!meshes.supplies(*simplex))
            return Error{.what = "no mesh supplies a " + std::string(name(*simplex)),
                         .remedy = "name one with job.mesh"};
    }
    w.reason = job.reason;
    make_case(family, *simplex, job.seed, job.index, meshes, &w);
    return w;
} catch (const Exception& e) {
    return e.error();
}

Status check_search_rules(const std::vector<Threshold>& rules) {
    for (const Threshold& rule : rules) {
        if (!figure({}, rule.name))
            return file_error({}, "a rule on a figure that a search does not measure",
                              "any, a class of finding, worst_weight_ulp or worst_value_ulp", rule.name);
    }
    return Done{};
}

std::vector<Violation> violations(const SearchReport& report, const std::vector<Threshold>& rules) {
    std::vector<Violation> all;
    for (const Threshold& rule : rules) {
        const double value = figure(report, rule.name).value_or(0);
        if (value > rule.limit) all.push_back({report.kernel.name, rule.name, value, rule.limit});
    }
    return all;
}

Result<GapsReport> gaps_file(const GapsJob& job) try {
    Notes notes;
    const Mesh mesh = cells_of(job.mesh, job.options.threads, job.curved, notes);
    const Verdict verdict =
        job.check ? certificate_of(mesh, job.options.threads).verdict_on(mesh) : Verdict::not_checked;
    GapsReport report = find_gaps(job.options, mesh, job.mesh, verdict).value();
    report.notes = std::move(notes);
    return report;
} catch (const Exception& e) {
    return e.error();
}

Result<GapsLimit> parse_gaps_limit(std::string_view text) {
    const base::NamedLimit limit = base::named_limit(text);
    std::vector<std::string> names;
    for (std::size_t f = 0; f < claim_fault_count; ++f) names.emplace_back(name(static_cast<ClaimFault>(f)));
    const auto fault = std::ranges::find(names, limit.name) - names.begin();
    if (fault != std::ssize(names) && limit.most) return GapsLimit{static_cast<ClaimFault>(fault), *limit.most};
    return file_error({}, "unknown rule", "gaps, several, wrong, wrong_first or outside_claimed, perhaps >NUMBER",
                      '"' + std::string(text) + '"', base::did_you_mean(limit.name, names));
}

}  // namespace barycert
