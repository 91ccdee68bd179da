/// A certificate: what check_mesh has proved of a mesh, as a value that others can rely on.
#pragma once

#include <cstdint>
#include <string_view>

#include "barycert/mesh.hpp"

namespace barycert {

struct CheckReport;
struct CheckOptions;

enum class Verdict : std::uint8_t { not_checked, not_certified, certified };

constexpr std::string_view name(Verdict v) {
    return v == Verdict::certified ? "certified" : v == Verdict::not_certified ? "not certified" : "not checked";
}

/// Only check_mesh makes one that is not `not_checked`. It remembers which mesh it speaks of by a fingerprint of its
/// coordinates, cells, neighbours and faces.
class Certificate {
public:
    Certificate() = default;

    Verdict verdict() const { return verdict_; }

    /// The verdict if `mesh` is the mesh that was checked, else not_checked. Reads the whole mesh once.
    Verdict verdict_on(const Mesh& mesh) const;

    /// True if `mesh` is certified: it is the mesh that was checked, and P1 to P5 of check.hpp hold.
    bool covers(const Mesh& mesh) const { return verdict_on(mesh) == Verdict::certified; }

private:
    friend CheckReport check_mesh(const Mesh&, const CheckOptions&);
    Certificate(Verdict verdict, const Mesh& mesh);

    Verdict verdict_ = Verdict::not_checked;
    std::uint64_t fingerprint_ = 0;
};

}  // namespace barycert
