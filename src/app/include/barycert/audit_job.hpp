/// Audits of files: a job names meshes and an earlier audit by their paths. A program that uses the default arguments
/// read_mesh and certify_mesh must also link barycert::io and barycert::check.
///
/// Example:
///
///     const AuditJob job{.meshes = {{"hole", "data/meshes/cube-hole"}}, .kernels = {.names = {"tetrahedron.*"}}};
///     const PreparedAudit audit = prepare_audit(job).value();
///     const AuditReport report = run_audit(audit.options, audit.meshes).value();
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/choices.hpp"
#include "barycert/family.hpp"
#include "barycert/gaps.hpp"
#include "barycert/kernels.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"
#include "barycert/witness.hpp"

namespace barycert {

/// Reads the mesh of a path: read_mesh() all formats, read_tetgen() those of TetGen and Triangle alone.
using MeshReader = std::function<Result<Mesh>(const std::string& path, const ReadOptions& options)>;

/// Returns the certificate of a mesh: certify_mesh() checks it.
using MeshCertifier = std::function<Certificate(const Mesh& mesh, int threads)>;
inline Certificate certify_mesh(const Mesh& mesh, int threads) {
    return check_mesh(mesh, {.threads = threads, .verdict_only = true}).certificate;
}

struct NamedMesh {
    std::string name, path;  ///< as for the reader
};

struct AuditJob {
    std::vector<NamedMesh> meshes;  ///< not read where no family draws from meshes, unless they are asked for
    bool meshes_asked = false;
    bool check = true;  ///< whether the meshes are partitions
    Curved curved = Curved::isoparametric;
    KernelChoice kernels = {};
    std::vector<std::string> families = {};  ///< see choose_families
    std::string baseline;                    ///< what an earlier audit wrote as JSON; empty: none
    AuditOptions options = {};               ///< but for kernels and families
};

/// Arguments of run_audit() and audit_mutants().
struct PreparedAudit {
    AuditOptions options;
    MeshSource meshes;
    std::optional<Baseline> baseline;
    std::map<std::string, std::string> libraries;  ///< by the names of their kernels
    Notes notes;                                   ///< of the meshes
};

/// Errors: those of the choices, of the reader and read_baseline; a mesh without cells; a baseline of other cases.
Result<PreparedAudit> prepare_audit(const AuditJob& job, const MeshReader& read = read_mesh,
                                    const MeshCertifier& certify = certify_mesh);

/// A case that a family makes, as a witness.
struct CaseJob {
    std::string family;
    std::uint64_t seed = 1, index = 0;
    std::string simplex, kernel, reason;  ///< empty: any; what family and kernel leave open, the simplex decides
    std::vector<NamedMesh> meshes;        ///< for families that draw from meshes
};
Result<Witness> make_witness(const CaseJob& job, const std::vector<Kernel>& kernels,
                             const MeshReader& read = read_mesh);

/// Points of a mesh that a kernel loses between cells: find_gaps() of a file.
struct GapsJob {
    std::string mesh;  ///< as for the reader
    Curved curved = Curved::isoparametric;
    bool check = true;  ///< whether the mesh is a partition
    GapsOptions options = {};
};
Result<GapsReport> gaps_file(const GapsJob& job, const MeshReader& read = read_mesh,
                             const MeshCertifier& certify = certify_mesh);

}  // namespace barycert
