/// Exact point location on any mesh.
///
/// Input: a Mesh of tetrahedra or triangles, or of cells that are cut into these, and points in its unit. Output: for
/// each point its owner, which is the cell of lowest index among all closed cells that contain it, and the feature of
/// that cell on which it lies.
///
/// Curved cells (BuildOptions::curved) are the images of their reference cells under the isoparametric map, if that is
/// proved to be injective. A point is in the cell whose map takes a point of the reference cell there. No node of such
/// a mesh is outside, even if rounding moved it off the middle of a straight edge. Points on curved faces are
/// recognised by enclosures of 250 bits and rational numbers. Nothing proves that curved cells do not overlap: if a
/// point is inside a cell whose straight simplex contains it, no other cell is tried.
///
/// Laws (each is a test of that name in tests/locate):
///   L1  A point in the union of the closed cells of non-zero volume is always found, and its owner is the lowest cell
///       index among all cells that contain it, whatever their orientation, overlapping cells included. `locate_all`
///       returns all of them.
///   L2  The feature is exact: interior, face, edge or vertex.
///   L3  A degenerate cell owns nothing.
///   D1  Results depend on the points and the mesh alone, not on threads, SIMD target, order of points, or the method.
///   N1  `nearest` is exact for all finite doubles, near and far: no point of a cell of non-zero volume is nearer than
///       the one returned, and its cell has the lowest index among all that have a point as near. If cells have curved
///       sides, it is the nearest point of these sides: 250 bits or rational numbers tell which of two is nearer. Where
///       no proof is found that a point is the nearest, none is nearer by more than the bound that samplers count
///       (SampleCounts::max_off).
///   N2  Its cost does not grow with the distance: a point 1e300 mesh sizes away visits about as many cells as one ten
///       sizes away.
///
/// Method. While the index is made, or later (Prove), it proves, for each cell for which this is true, that all other
/// cells meet it in common faces or not at all (doc/theorem.md). Points are sorted along a space-filling curve and
/// walk, on SIMD lanes, to a cell that certainly contains them. Integers decide what the filter leaves open;
/// connectivity gives the cells around a face, edge or vertex. If a walk ends at the boundary, or in a cell without
/// that proof, every cell whose box contains the point is tested. Points where no cell is near are outside at once.
///
/// Example:
///
///     const Mesh mesh{.dimension = 2, .points = {0, 0, 1, 0, 0, 1}, .cells = {0, 1, 2}};
///     const Locator locator = Locator::build(mesh).value();
///     const double point[] = {0.2, 0.2};
///     const Mesh::Index cell = locator.locate(point).value().cell;  // -1 outside
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"

namespace barycert {

namespace locate {
struct LocatorData;
}

enum class Method : std::uint8_t {
    walk,        ///< walk from cell to cell; where cells may overlap, test candidates
    candidates,  ///< test every cell whose box contains the point
};

constexpr std::string_view name(Method m) {
    return m == Method::walk ? "walk" : "candidates";
}

struct Location {
    Mesh::Index cell = -1;  ///< the owner; -1 outside
    Feature feature = Feature::outside;

    friend bool operator==(const Location&, const Location&) = default;
};

/// The point of the mesh that is nearest to a query point.
struct Nearest {
    Mesh::Index cell = -1;  ///< the lowest index among those that have a point as near; -1: none within the limit
    double distance = 0;    ///< the exact distance rounded to nearest; infinite if it exceeds the doubles
    /// The vertex, edge or face of the cell in whose relative interior its nearest point lies: nodes of the mesh,
    /// ascending; unused entries are -1. The nearest point is the orthogonal projection onto what they span, where its
    /// weights are positive. In a cell taken by a map they are corners of the edge or face, three of a face with four,
    /// and the nearest point is that of the curved side. All entries are -1 if the query point is inside the cell.
    std::array<Mesh::Index, 3> nodes{-1, -1, -1};
};

/// When to prove where walks find points. The proof takes longer than ordering the cells.
enum class Prove : std::uint8_t {
    at_once,
    /// Meshes of up to 100,000 cells: once 50,000 points have been located by candidates, or when certified(),
    /// contested_cells() or degenerate_cells() is asked. Larger ones: at once.
    when_it_pays,
    never,  ///< find no neighbours, and test candidates everywhere
};

/// Interpolating function of cells that are no simplices (Mesh::shapes). It decides, too, where their sides are.
enum class CellInterpolation : std::uint8_t {
    linear,  ///< linear on each part: continuous, with flat triangles for sides
    /// Voxels, pixels, hexahedra, wedges, pyramids and quadrilaterals: that of the isoparametric map, products of
    /// linear functions of its coordinates. Sides of four nodes that are not in one plane are curved. Other cells, and
    /// those whose map is not proved to be injective, stay linear: see Locator::unmapped_cells.
    multilinear,
};

constexpr std::string_view name(CellInterpolation i) {
    return i == CellInterpolation::linear ? "linear" : "multilinear";
}

/// How an index is built.
struct BuildOptions {
    Prove prove = Prove::at_once;
    CellInterpolation interpolation = CellInterpolation::linear;
    /// How to take second-order cells whose mid-edge nodes are off the middle (CurvedCells), and simplices of order 3
    /// and 4. `straight`: with straight sides; then cells of order 3 and 4, and of order 2 beside cells of other
    /// shapes, are linear. `refuse` is as isoparametric: see measure_curved().
    Curved curved = Curved::isoparametric;
    int threads = 0;  ///< 0: as many as the machine has; the index is the same for any number
    std::function<void(const char* stage)> progress = {};  ///< called as each stage begins
};

/// Thread-safe: any number of threads may locate at the same time.
class Locator {
public:
    /// Builds the index and, unless `options.prove` says later or never, proves where walks find points. The mesh must
    /// stay as it is and outlive the locator. Time O(n log n); see CheckOptions for what thin cells may cost. Error: an
    /// inconsistent mesh.
    static Result<Locator> build(const Mesh& mesh, const BuildOptions& options = {});
    static Result<Locator> build(Mesh&&, const BuildOptions& = {}) = delete;

    const Mesh& mesh() const;
    /// Method::candidates after Prove::never; otherwise Method::walk, also before the proof.
    Method method() const;

    /// True if it is proved that the cells partition their domain: P1 to P4 of check.hpp hold.
    bool certified() const;

    /// Number of cells that may meet others beside common faces; 0 if certified. In these every candidate is tested;
    /// elsewhere walks are enough. The number is never too small; where cells overlap or touch, it counts some more.
    std::uint64_t contested_cells() const;

    /// Cells of volume exactly zero; 0 if the index was built with Prove::never.
    std::uint64_t degenerate_cells() const;

    CellInterpolation interpolation() const;
    bool has_curved_cells() const;  ///< some are taken as the isoparametric images that they are
    /// Number of cells of a type that has a map which are taken as their parts, because the map is not proved to be
    /// injective.
    std::uint64_t unmapped_cells() const;

    /// Bytes of memory besides the mesh, without buffers of points (up to 20 MiB a thread). Grows as parts of the index
    /// are built on first use.
    std::size_t bytes() const;

    /// Locates one point of mesh().dimension coordinates. `hint`: a cell that may be near, such as the last cell of a
    /// moving particle; -1: none. Returns an Error if a coordinate is not finite.
    Result<Location> locate(const double* point, Mesh::Index hint = -1) const;

    /// Locates many points: sets cells[i] and features[i] for point i. `threads`: 0 for as many as the machine has.
    /// Error: sizes that do not fit; a coordinate that is not finite, unless `nonfinite` makes such points outside.
    /// After an Error the output is unspecified.
    Status locate(std::span<const double> points, std::span<Mesh::Index> cells, std::span<Feature> features,
                  LocationCounts* counts = nullptr, int threads = 0,
                  NonfinitePoints nonfinite = NonfinitePoints::error) const;

    /// The same as a table: cells, features and counts.
    Result<Table> locate(std::span<const double> points, int threads = 0,
                         NonfinitePoints nonfinite = NonfinitePoints::error) const;

    /// Finds every cell that contains each point: one row for each cell, ascending, or one row with cell -1 for a point
    /// outside. Sets points, cells, features, point_begin, and counts.locations (one count a point, by its owner).
    /// Errors as above.
    Result<Table> locate_all(std::span<const double> points, int threads = 0,
                             NonfinitePoints nonfinite = NonfinitePoints::error) const;

    /// Returns the nearest point of all cells that are not degenerate, if its rounded distance is at most `limit`;
    /// otherwise cell -1, also if the limit is negative or NaN. Takes some microseconds to some hundred, beside curved
    /// sides a millisecond; more if many cells are equally near up to 1e-13 of the size of the mesh, because integers
    /// compare these. Error: a coordinate that is not finite.
    Result<Nearest> nearest(const double* point, double limit) const;

private:
    friend struct locate::LocatorData;
    explicit Locator(std::unique_ptr<locate::LocatorData> data);
    std::unique_ptr<locate::LocatorData, void (*)(locate::LocatorData*)> data_;
};

/// Notes which cells are taken as straight or linear although their maps are asked for. `file`: what the user calls the
/// mesh.
Notes notes_of_maps(const Locator& locator, CellInterpolation asked, const std::string& file);

}  // namespace barycert
