/// Fields at points: the value of every field of a mesh at any point, correctly rounded.
///
/// Input: a mesh with fields of its nodes or cells, and points in the unit of the mesh. Output: a Table, with the
/// owner, the feature and a value for each component of each field at each point.
///
/// Laws (each is a test of that name in tests/sample):
///   V1  A value of a point field is the exact interpolation in the owner, linear, or quadratic on cells of second
///       order, rounded once to nearest, ties to even. A value of a cell field is that of the owner.
///   V2  Where cells meet in a proper mesh, point fields have the same bits from every cell that holds the point. A
///       nodal value that is NaN or infinite makes its component NaN, unless its weight is exactly zero.
///   D1  Rows depend on point, mesh and fields alone: not on threads, SIMD target, blocks, order, or the method that
///       found the owner; so a map that was saved gives the same bytes.
///   N3  Under the policy `nearest`, the value of a point field is that of the nearest cell, at the point of that cell
///       that is nearest to the query point; NaN as in V2. Each component lies between the cell's nodal values. On
///       cells of second order the weights of the nearest point are rounded first, and the value may exceed the nodal
///       values as far as the quadratic does in the cell. In cells with maps (Locator) the value is that of their own
///       function at the nearest point of their curved sides, rounded once.
///   E1  Nothing is silent: a point outside gets NaN unless the policy says otherwise, and SampleCounts has the numbers
///       of points inside, on boundaries and outside.
/// With Rounding::plain, owners and features are exact as well; values are computed in plain double.
///
/// Quantities: wherever a field is named, an expression of fields may stand instead. If the whole expression is the
/// name of a field, that field is taken. NAME may itself be an expression:
///   NAME.x, NAME.2  a component by its axis or number.
///   grad(NAME)      the gradient, in the owner, of the interpolated function of a field of nodes. It jumps where cells
///                   meet, and is that of the lowest cell there. Columns grad(NAME).0, .1, ...: the derivatives of
///                   component 0 by x, y, z, then of component 1. Each is the exact one rounded once, to nearest, ties
///                   to even; NaN at the apex of a pyramid, where there is none. At a point outside, under both
///                   policies, it is that of the nearest cell; on cells of second order, and in cells with maps,
///                   evaluated at the nearest point with rounded coordinates (nearest), or at the point itself
///                   (extrapolate).
///   |NAME|          the Euclidean length. For a field of nodes it is the length of the components at the point, after
///                   each was rounded. With up to nine components it differs from the exact length by less than 2 units
///                   in the last place (1.51 where the length is not subnormal); for a field of cells by less than 0.76
///                   (0.51).
///   mean(NAME)      a field of nodes made from a field of cells, and interpolated: the value at a node is the mean
///                   over all cells that have it, weighted by their volumes (areas; with straight sides), exact and
///                   rounded once. It is NaN where a value of a cell that is not degenerate is not finite.
/// With Rounding::plain, gradients and means are correctly rounded as well, except gradients on cells of second order
/// with straight sides.
///
/// Example:
///
///     Mesh mesh{.dimension = 2, .points = {0, 0, 1, 0, 0, 1}, .cells = {0, 1, 2}};
///     mesh.point_fields = {{"T", 1, {20, 21, 22}}};
///     const Sampler sampler = Sampler::build(mesh, {"T"}).value();
///     const Table rows = sampler.sample(std::vector<double>{0.2, 0.2}).value();  // rows.values[0] is T there
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "barycert/weights.hpp"

namespace barycert {

namespace sample {
struct SamplerData;
}

/// Values that a point outside every cell gets.
enum class Outside : std::uint8_t {
    nan,
    error,    ///< the call returns an Error that names the first such point
    fill,     ///< OutsidePolicy::fill
    nearest,  ///< point fields at the nearest point of the mesh, cell fields of its cell
    /// The function of the nearest cell, evaluated at the point. If the cell has a map (Locator), the inverse of the
    /// map is continued along the straight way from the nearest point to the point. Where no proof is found that it can
    /// be continued, the point gets the value of `nearest`, and is counted (SampleCounts::unmapped).
    extrapolate,
};

struct OutsidePolicy {
    Outside kind = Outside::nan;
    double fill = std::numeric_limits<double>::quiet_NaN();
    double limit = std::numeric_limits<double>::infinity();  ///< nearest: farther points get NaN
};

struct SampleOptions {
    Rounding rounding = Rounding::correct;
    OutsidePolicy outside = {};
    int threads = 0;  ///< 0: as many as the machine has
    NonfinitePoints nonfinite_points = NonfinitePoints::error;
};

/// A quantity made of a field.
struct QuantityStep {
    enum class Kind : std::uint8_t {
        component,  ///< one of its components
        length,     ///< the Euclidean length of the vector of its components
        gradient,   ///< of a field of nodes: a column for each axis, those of component 0 first
        mean,       ///< of a field of cells: at each node the mean over its cells, weighted by their volumes
    };
    Kind kind = Kind::component;
    int component = 0;

    friend bool operator==(const QuantityStep&, const QuantityStep&) = default;
};

/// A field to be sampled, or a quantity made of it.
struct FieldChoice {
    const Field* field = nullptr;
    bool of_cells = false;
    std::vector<QuantityStep> steps = {};  ///< one after the other, the innermost first
    std::string name = {};                 ///< of the columns; empty: that of the field
};

/// Returns the fields or quantities with these names, as Sampler::build chooses them. Reads only the mesh's fields,
/// which must stay, its dimension, and whether it has nodes at mid-edges. Error: no such field; a field chosen twice.
Result<std::vector<FieldChoice>> choose_fields(const Mesh& mesh, const std::vector<std::string>& names);

/// Thread-safe: any number of threads may sample at the same time.
class Sampler {
public:
    /// Builds a sampler of the fields or quantities with these names (empty: all fields as they are), with a locator of
    /// its own. The mesh must stay as it is and outlive the sampler. Error: an inconsistent mesh; no such field; a
    /// field that does not fit.
    static Result<Sampler> build(const Mesh& mesh, const std::vector<std::string>& fields = {},
                                 const BuildOptions& options = {});
    static Result<Sampler> build(Mesh&&, const std::vector<std::string>& = {}, const BuildOptions& = {}) = delete;

    /// The same on an existing locator. Locator and fields must stay and outlive the sampler, which copies what it
    /// needs of point fields, in the order in which it will read them. Error: a field that does not fit the mesh.
    static Result<Sampler> build(const Locator& locator, const std::vector<FieldChoice>& fields);

    const Locator& locator() const;

    /// The fields of a row: point fields first, then cell fields, then lengths of point fields and gradients on cells
    /// of second order.
    const std::vector<TableField>& fields() const;
    const std::vector<std::string>& columns() const;  ///< column_names(fields())

    /// Samples points: row i is for point i and has cells, features, values, distances, columns and counts. Error: a
    /// coordinate that is not finite (but see SampleOptions); a point outside under the policy `error`.
    Result<Table> sample(std::span<const double> points, const SampleOptions& options = {}) const;

    /// The same into a table that keeps its memory from call to call. Leaves the table's points alone; they may be
    /// `points`. `first_point`: the number from which messages count points. After an Error the rows are not to be
    /// used.
    Status sample(std::span<const double> points, const SampleOptions& options, Table& rows,
                  std::size_t first_point = 0) const;

    /// The same for rows whose owners are known: point i lies in rows.cells[i], or outside if that is -1, with the
    /// feature rows.features[i], as Locator::locate or locate_all give them. In a degenerate cell point fields are NaN,
    /// and counted. Error besides: a cell out of range; a cell for a point that is not finite.
    Status evaluate(std::span<const double> points, const SampleOptions& options, Table& rows,
                    std::size_t first_point = 0) const;

private:
    friend struct sample::SamplerData;
    explicit Sampler(std::unique_ptr<sample::SamplerData> data);
    std::unique_ptr<sample::SamplerData, void (*)(sample::SamplerData*)> data_;
};

// The weights that points have on the nodes of a mesh: a sparse matrix that gives values from any field, anywhere.

/// Entry k of row i, begin[i] <= k < begin[i + 1], is weights[k] on node nodes[k], nodes ascending.
struct NodeWeights {
    std::vector<std::size_t> begin;  ///< one more than there are rows
    std::vector<Mesh::Index> nodes;
    std::vector<double> weights;

    std::size_t row_count() const { return begin.empty() ? 0 : begin.size() - 1; }
};

/// Returns the weights of located points: rows.points[i] lies in cell rows.cells[i] of the locator's mesh, or outside
/// if that is -1, as locate() and locate_all() find them. On cells of second order they are the quadratic's, at corners
/// and mid-edge nodes. Each weight is the exact one rounded once, to nearest, ties to even; weights that round to zero
/// are left out. So they need not sum to 1, and their sum with nodal values, rounded in each step, is not the correctly
/// rounded value.
///
/// Points outside have no weights, unless they are finite and the policy is `nearest` or `extrapolate`. With `nearest`,
/// within its limit, they have those of the nearest point of the mesh (on cells of second order its barycentric weights
/// are rounded first); with `extrapolate`, those of the function of the nearest cell. Works on the calling thread.
/// Error: sizes that do not fit; a cell out of range or degenerate; a point in a cell that is not finite.
Result<NodeWeights> node_weights(const Locator& locator, const TableView& rows, const OutsidePolicy& outside = {});

}  // namespace barycert
