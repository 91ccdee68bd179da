// Audits whose meshes are files.

#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/asking.hpp"
#include "barycert/audit_job.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/choices.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/gaps.hpp"
#include "barycert/kernels.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/witness.hpp"
#include "core/base/text.hpp"

namespace barycert {

using audit::names_of;
using audit::unknown_name;

namespace {

/// A mesh whose cells are taken with straight sides, as far as they may. Throws an Exception.
Mesh cells_of(const std::string& path, int threads, Curved curved, const MeshReader& read, Notes& notes) {
    Mesh mesh = read(path, {.faces = false, .neighbours = false, .threads = threads}).value();
    if (curved == Curved::refuse) measure_curved(mesh, path, curved).value();
    notes.insert(notes.end(), mesh.notes.begin(), mesh.notes.end());
    return mesh;
}

/// Throws an Exception.
MeshSource source_of(const std::vector<NamedMesh>& meshes, const MeshCertifier& certify, int threads, Curved curved,
                     const MeshReader& read, Notes& notes) {
    MeshSource source;
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    for (const NamedMesh& named : meshes) {
        Mesh mesh = cells_of(named.path, threads, curved, read, notes);
        if (mesh.cell_count() == 0)
            throw Exception({.code = "mesh.empty", .what = "the mesh has no cells", .file = named.path});
        const Certificate certificate = certify ? certify(mesh, threads) : Certificate();
        arena.execute([&] { source.add(named.name, std::move(mesh), certificate); });
    }
    return source;
}

}  // namespace

Result<PreparedAudit> prepare_audit(const AuditJob& job, const MeshReader& read, const MeshCertifier& certify) try {
    PreparedAudit out{.options = job.options, .meshes = {}, .baseline = {}, .libraries = {}, .notes = {}};
    out.options.kernels = choose_kernels(job.kernels).value();
    out.options.families = choose_families(job.families).value();
    const bool wanted = std::ranges::any_of(out.options.families, &Family::needs_mesh);
    if (wanted || job.meshes_asked)
        out.meshes = source_of(job.meshes, job.check ? certify : MeshCertifier(), job.options.threads, job.curved, read,
                               out.notes);
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

Result<Witness> make_witness(const CaseJob& job, const std::vector<Kernel>& kernels, const MeshReader& read) try {
    if (!job.reason.empty() && !finding_named(job.reason))
        return about("job.reason",
                     unknown_name("option.value", "job.reason of a case that is generated", "a class of finding",
                                  job.reason, {}, "leave it out to see the answer whatever it is"));
    const std::vector<Family> families = choose_families({job.family}).value();
    if (families.size() != 1 || families.front().name != job.family)
        return about("job.family", unknown_name("family.unknown", "job.family must name one family", "", job.family,
                                                names_of(all_families()), "`barycert families` lists them"));
    const Family& family = families.front();
    std::optional<Simplex> simplex = simplex_named(job.simplex);
    if (!job.simplex.empty() && !simplex)
        return about("job.simplex",
                     unknown_name("option.value", "unknown simplex", "segment, triangle, triangle3d or tetrahedron",
                                  job.simplex, {"segment", "triangle", "triangle3d", "tetrahedron"}));
    Witness w;
    if (!job.kernel.empty()) {
        const auto k = std::ranges::find_if(kernels, [&](const Kernel& x) {
            return x.perspective == family.perspective && (!simplex || x.simplex == *simplex) &&
                   base::glob_match(job.kernel, x.name);
        });
        if (k == kernels.end())
            return about("job.kernel",
                         unknown_name("kernel.unknown", "no kernel of that name for the cases of that family", "",
                                      job.kernel, names_of(catalogue()), "`barycert kernels` lists them"));
        simplex = k->simplex;
        w.kernel = k->name;
    }
    if (!simplex && family.simplices.size() == 1) simplex = family.simplices.front();
    if (!simplex || !family.applies_to(*simplex))
        return Error{.code = "option.missing",
                     .what = "the simplex is not determined: the family applies to several, or not to the one given",
                     .remedy = "add job.simplex NAME or job.kernel NAME",
                     .subject = "job.simplex"};
    MeshSource meshes;
    if (family.needs_mesh) {
        Notes notes;
        meshes = source_of(job.meshes, {}, 0, Curved::straight, read, notes);
        if (!meshes.supplies(*simplex))
            return Error{.code = "witness.mesh",
                         .what = "no mesh supplies a " + std::string(name(*simplex)),
                         .remedy = "name one with job.mesh",
                         .subject = "job.mesh"};
    }
    w.reason = job.reason;
    make_case(family, *simplex, job.seed, job.index, meshes, &w);
    return w;
} catch (const Exception& e) {
    return e.error();
}

Result<GapsReport> gaps_file(const GapsJob& job, const MeshReader& read, const MeshCertifier& certify) try {
    Notes notes;
    const Mesh mesh = cells_of(job.mesh, job.options.threads, job.curved, read, notes);
    const Verdict verdict = job.check ? certify(mesh, job.options.threads).verdict_on(mesh) : Verdict::not_checked;
    GapsReport report = find_gaps(job.options, mesh, job.mesh, verdict).value();
    report.notes = std::move(notes);
    return report;
} catch (const Exception& e) {
    return e.error();
}

}  // namespace barycert
