/// Which cell holds a point? Exactly, on any mesh.
///
/// Enters: a Mesh of tetrahedra or triangles (those of second order are taken with straight sides) and points in its
/// unit. Leaves: for each point the owner, the cell of lowest index among all closed cells that hold it, and the
/// feature of that cell on which it lies.
///
/// What holds (each law is a test of that name in tests/locate):
///   L1  A point in the union of the closed cells of non-zero volume is always found, and its owner is the lowest cell
///       index among all cells that hold it: cells of any orientation, overlapping ones too. `locate_all` names all.
///   L2  The feature is exact: interior, face, edge or vertex.
///   L3  A degenerate cell owns nothing.
///   D1  Answers depend on the points and the mesh alone, not on threads, SIMD target, order of points, or the method.
///   N1  `nearest` is exact for all finite doubles, near and far: no point of a cell of non-zero volume is nearer than
///       the one it tells, and its cell is the lowest index among all that have a point as near.
///   N2  It looks at about as many cells for a point 1e300 sizes of the mesh away as for one ten sizes away.
///
/// How. With a certificate (check.hpp) cells are a simplicial complex, and one cell that holds a point tells all
/// others: points are sorted along a space-filling curve, each starts at a cell of its bin and walks, on SIMD lanes, to
/// the cell of which it is certainly inside; where the filter of signs leaves doubt, integers decide, and a point on a
/// face, edge or vertex is told all cells there by the mesh's own connections. Where a walk ends at the boundary, and
/// for meshes without a certificate, every cell whose box holds the point is asked. The first is several times faster;
/// both give the same answers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"

namespace barycert {

namespace locate {
struct LocatorData;
}

enum class Method : std::uint8_t {
    walk,        ///< the mesh is certified
    candidates,  ///< every cell whose box holds the point
};

constexpr std::string_view name(Method m) {
    return m == Method::walk ? "walk" : "candidates";
}

struct Location {
    Mesh::Index cell = -1;  ///< the owner; -1 outside
    Feature feature = Feature::outside;

    friend bool operator==(const Location&, const Location&) = default;
};

/// The point of the mesh that is nearest to a given one.
struct Nearest {
    Mesh::Index cell = -1;  ///< of lowest index among those that have a point as near; -1: none within the limit
    double distance = 0;    ///< the exact one rounded to nearest; infinite where no double holds it
    /// The vertex, edge or face of the cell in whose relative interior its nearest point lies: nodes of the mesh,
    /// ascending; unused ones are -1. The nearest point is the orthogonal projection to what they span, so its weights
    /// there are positive. All are -1 if the given point is inside the cell.
    std::array<Mesh::Index, 3> nodes{-1, -1, -1};
};

/// How an index is built.
struct BuildOptions {
    bool prove = true;  ///< check whether the cells partition a domain: takes longer, finds points several times faster
    int threads = 0;    ///< 0: as many as the machine has
    std::function<void(const char* stage)> progress = {};  ///< called as each stage begins
};

/// Thread-safe: any number of threads may ask at once.
class Locator {
public:
    /// Proves the mesh while it indexes it (`options.prove`), so that points can be found by walks. The mesh must stay
    /// as it is and outlive the locator. Returns an Error if the mesh is inconsistent: indices out of range,
    /// coordinates that are not finite, sizes that do not fit.
    static Result<Locator> build(const Mesh& mesh, const BuildOptions& options = {});
    static Result<Locator> build(Mesh&&, const BuildOptions& = {}) = delete;

    /// The same with a certificate of check_mesh on this very mesh. Without a certificate, or with one of another mesh,
    /// every candidate is asked. Time O(cells), one thread.
    static Result<Locator> build(const Mesh& mesh, const Certificate& certificate);

    Locator(Locator&&) noexcept;
    Locator& operator=(Locator&&) noexcept;
    ~Locator();

    const Mesh& mesh() const;
    Method method() const;

    /// Bytes besides the mesh, with what has been made on first need until now, but for buffers of points (up to 36 MiB
    /// a thread).
    std::size_t bytes() const;

    /// One point of mesh().dimension coordinates. `hint`: a cell thought to be near, such as that of the last point of
    /// a moving particle; -1: none. Error: a coordinate is not finite.
    Result<Location> locate(const double* point, Mesh::Index hint = -1) const;

    /// Many points: cells[i] and features[i] are the answer for point i. `threads`: 0 for as many as the machine has.
    /// Errors: sizes that do not fit; a coordinate that is not finite (it names the point). The output is then not to
    /// be used.
    Status locate(std::span<const double> points, std::span<Mesh::Index> cells, std::span<Feature> features,
                  LocationCounts* counts = nullptr, int threads = 0) const;

    /// The same as a table: cells, features and counts.
    Result<Table> locate(std::span<const double> points, int threads = 0) const;

    /// Every cell that holds each point: a row for each, ascending, or one row with cell -1 for a point outside. Sets
    /// points, cells, features, point_begin, and counts.locations: one a point, by its owner. Errors as above.
    Result<Table> locate_all(std::span<const double> points, int threads = 0) const;

    /// The nearest point of all cells that are not degenerate. Only what is at most as far as `limit` counts, distances
    /// taken as they are told, rounded; none if it is negative or NaN. Takes some microseconds to some hundred,
    /// and more where many cells are as near up to 1e-13 of the size of the mesh, for these are compared in integers.
    /// Error: a coordinate is not finite.
    Result<Nearest> nearest(const double* point, double limit) const;

    /// For the library's own use.
    const locate::LocatorData& data() const { return *data_; }

private:
    explicit Locator(std::unique_ptr<locate::LocatorData> data);
    std::unique_ptr<locate::LocatorData> data_;
};

}  // namespace barycert
