/// The result of a mesh check as a value that stays bound to the mesh it was made for; and how far the sides of
/// second-order cells are from the straight ones that it is said of.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert {

struct CheckReport;
struct CheckOptions;

enum class Verdict : std::uint8_t { not_checked, not_certified, certified };

constexpr std::string_view name(Verdict v) {
    return v == Verdict::certified ? "certified" : v == Verdict::not_certified ? "not certified" : "not checked";
}

/// Made by check_mesh; a default-constructed one is `not_checked`. It identifies its mesh by a hash of coordinates,
/// cells, neighbours and faces.
class Certificate {
public:
    Certificate() = default;

    Verdict verdict() const { return verdict_; }

    /// The verdict if `mesh` is the mesh that was checked, else not_checked. Reads the whole mesh.
    Verdict verdict_on(const Mesh& mesh) const;

    /// True if `mesh` is the mesh that was checked and is certified: P1 to P5 of check.hpp hold.
    bool covers(const Mesh& mesh) const { return verdict_on(mesh) == Verdict::certified; }

private:
    friend CheckReport check_mesh(const Mesh&, const CheckOptions&);
    Certificate(Verdict verdict, const Mesh& mesh);

    Verdict verdict_ = Verdict::not_checked;
    std::uint64_t fingerprint_ = 0;
};

/// Second-order cells whose sides are not straight. They are taken with straight sides everywhere: what is said of them
/// is exact for these, and for the file's own shapes only up to about `max_deviation`.
///
/// The deviation of a mid-edge node is its distance from the middle of the two ends, in parts of their distance. It is
///   nothing   up to 2^-49 of the largest coordinate of the ends, on each axis: a middle computed in double, or written
///             with 16 digits (derived in check/curved.cpp);
///   rounding  up to 1e-10 of the edge: what meshers and motions compute. Or up to one unit of the last place of the
///             mesh's coordinates, and 1/1000 of the edge, if all coordinates are single precision, or have at most 15
///             decimal digits: the unit is that of the last decimal place in the mesh or, in single precision and with
///             at least 5 digits, that of the largest coordinate of the ends;
///   a curve   else.
struct CurvedCells {
    std::uint64_t cells = 0;          ///< with a node off the middle by a curve
    double max_deviation = 0;         ///< of such nodes
    std::uint64_t rounded_cells = 0;  ///< of the others: with a node off the middle by rounding
    double max_rounded = 0;           ///< of such nodes
};

/// Cells with an index that is no node are left out, and so are coordinates that are not finite. `each`, if given: 1
/// for each curved cell, 0 for others; empty if none is curved.
CurvedCells curved_cells(const Mesh& mesh, std::vector<std::uint8_t>* each = nullptr);

/// In one sentence, empty if all sides are straight.
std::string message(const CurvedCells& curved);

/// What becomes of curved cells.
enum class Curved : std::uint8_t { straight, refuse };

/// Error, with Curved::refuse: there are curved cells. `file` is what the user calls the mesh.
Result<CurvedCells> take_as_straight(const Mesh& mesh, const std::string& file, Curved curved);

}  // namespace barycert
