/// Certificates: whether a mesh was checked, and is the one that was.
///
/// Example:
///
///     #include "barycert/check.hpp"
///     const Mesh mesh{.dimension = 2, .points = {0, 0, 1, 0, 0, 1}, .cells = {0, 1, 2}};
///     const Certificate certificate = check_mesh(mesh).certificate;
///     const bool still = certificate.covers(mesh);  // the same mesh, and certified
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "barycert/mesh.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface.hpp"

namespace barycert {

struct CheckReport;
struct CheckOptions;

enum class Verdict : std::uint8_t { not_checked, not_certified, certified };

constexpr std::string_view name(Verdict v) {
    return v == Verdict::certified ? "certified" : v == Verdict::not_certified ? "not certified" : "not checked";
}

/// Made by check_mesh; a default-constructed one is `not_checked`. It identifies its mesh by its fingerprint, a hash of
/// coordinates, cells, neighbours and faces.
class Certificate {
public:
    Certificate() = default;

    /// Returns the certificate of a mesh that check_mesh certified before: `certified` if its fingerprint is among
    /// these of such meshes, else not_checked. Reads the whole mesh.
    static Certificate known(const Mesh& mesh, std::span<const std::uint64_t> certified);

    /// Not for adversaries: it tells a mesh from one that was changed since. 0 if not checked.
    std::uint64_t fingerprint() const { return fingerprint_; }

    Verdict verdict() const { return verdict_; }

    /// The verdict if `mesh` is the mesh that was checked, else not_checked. Reads the whole mesh.
    Verdict verdict_on(const Mesh& mesh) const;

    /// True if `mesh` is the mesh that was checked and is certified: P1 to P5 of check.hpp hold.
    bool covers(const Mesh& mesh) const { return verdict_on(mesh) == Verdict::certified; }

private:
    friend CheckReport check_mesh(const Mesh&, const CheckOptions&);
    friend CheckReport check_surface(const Surface&, const CheckOptions&);
    friend CheckReport check_plc(const Plc&, const CheckOptions&);
    Certificate(Verdict verdict, const Mesh& mesh);
    explicit Certificate(Verdict verdict) : verdict_(verdict) {}

    Verdict verdict_ = Verdict::not_checked;
    std::uint64_t fingerprint_ = 0;
};

}  // namespace barycert
