/// Compares results of any tool with the exact ones: which of its points, cells and values are wrong, and by how much.
///
/// Input: a mesh with fields, points in its unit, and for each point what a tool says of it: outside or not, the cell
/// that contains it, a value for each component of fields. Output: counts, distributions of errors, and the worst rows.
///
/// Laws: what counts as right (each is a test of that name in tests/verify):
///   R1  Inside: the point lies in a closed cell of non-zero volume, exactly. A row that says so is right, and so is a
///       row that says "outside" of any other point.
///   R2  Cell: any closed cell of non-zero volume that contains the point is right, not its owner alone.
///   R3  Value: the error is the distance to the exact interpolation in the owner, rounded once. If several cells
///       contain the point, it is the least error over these cells: their values may differ where cells overlap, and
///       for fields of cells.
///   R4  Nothing is silent: every row is in exactly one of Verdicts::right, missed, invented, wrong_cell, wrong_value.
///   D1  Counts depend on mesh, fields and rows alone: not on threads or blocks.
///
/// Example:
///
///     Mesh mesh{.dimension = 2, .points = {0, 0, 1, 0, 0, 1}, .cells = {0, 1, 2}};
///     mesh.point_fields = {{"T", 1, {20, 21, 22}}};
///     const Sampler sampler = Sampler::build(mesh).value();
///     const std::vector<double> points{0.2, 0.2}, values{20.6};
///     const Verdicts verdicts = Verifier(sampler, {}).verify({.points = points, .values = values}).value();
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/table.hpp"

namespace barycert {

/// A tool's claims about points. All parts have one entry a point, or are empty.
struct ClaimedRows {
    std::span<const double> points = {};        ///< coordinates, point after point
    std::span<const std::int64_t> cells = {};   ///< index in the mesh, from 0; below 0: outside
    std::span<const std::uint8_t> inside = {};  ///< 0: outside
    std::span<const double> values = {};        ///< a row of Sampler::columns(); NaN in all: outside, if neither
                                                ///< cells nor inside says so
    std::uint64_t first_row = 0;                ///< rows that came before
};

struct VerifyOptions {
    /// Largest error of a value that is right, in parts of the field's range; see RelativeTo.
    double tolerance = 1e-9;
    bool exact = false;  ///< right is what has the bits of the correctly rounded value; zeros of either sign are equal
    std::optional<double> outside_value = {};                   ///< a row of this number alone means outside
    std::size_t examples = 5;                                   ///< rows kept of each kind of error
    int threads = 0;                                            ///< 0: as many as the machine has
    NonfinitePoints nonfinite_points = NonfinitePoints::error;  ///< nan: they are outside
};

/// Unit of the relative errors of the values of a field's component.
enum class RelativeTo : std::uint8_t {
    range,      ///< max - min of its finite values in the mesh
    magnitude,  ///< of these values, where they are all the same: the range is 0
    one,        ///< where they are all 0, or none is finite: errors are absolute
};

constexpr std::string_view name(RelativeTo to) {
    return to == RelativeTo::range ? "range" : to == RelativeTo::magnitude ? "magnitude" : "one";
}

/// Verdict on a row: the first that applies.
enum class RowVerdict : std::uint8_t {
    right,
    missed,       ///< in a cell, and said to be outside
    invented,     ///< in no cell, and said to be inside
    wrong_cell,   ///< inside, and in a cell, but not in the one that is named
    wrong_value,  ///< a value is off by more than the tolerance, or NaN where the exact one is not
};

constexpr std::string_view name(RowVerdict v) {
    constexpr std::array<std::string_view, 5> names{"right", "missed", "invented", "wrong cell", "wrong value"};
    return names[static_cast<std::size_t>(v)];
}

/// The same as in JSON and in rules of --fail-on.
constexpr std::string_view handle(RowVerdict v) {
    return v == RowVerdict::wrong_cell ? "wrong_cell" : v == RowVerdict::wrong_value ? "wrong_value" : name(v);
}

/// Errors of the values of one column, of rows that are inside and say so.
struct ValueErrors {
    std::uint64_t values = 0;     ///< compared: both are numbers
    std::uint64_t identical = 0;  ///< bits of the correctly rounded value
    std::uint64_t over = 0;       ///< off by more than the tolerance
    std::uint64_t missing = 0;    ///< NaN where the exact value is a number
    std::uint64_t spurious = 0;   ///< a number where the exact value is NaN: a nodal value of the cell is not finite
    std::uint64_t floats = 0;     ///< numbers that are exactly a float32
    double max_ulps = 0;          ///< of the exact value; where that is 0 the error is counted in ulps of the range
    double max_relative = 0;      ///< error in parts of the range
    /// [0]: identical; [k]: 2^(k-2) <= ulps < 2^(k-1), from half an ulp on; the last: all larger ones.
    std::array<std::uint64_t, 66> by_ulps{};
    /// [0]: identical; [k]: 10^(k-19) <= relative < 10^(k-18), [1] smaller ones, the last all larger ones.
    std::array<std::uint64_t, 22> by_relative{};

    void add(const ValueErrors& other);
};

/// A row that is wrong.
struct WrongRow {
    RowVerdict verdict = RowVerdict::right;
    std::uint64_t row = 0;  ///< from 0
    std::array<double, 3> point{};
    std::int64_t claimed_cell = -1;  ///< -1: none, or outside
    Location exact;                  ///< owner and feature
    std::uint64_t cells = 0;         ///< how many contain the point
    std::size_t column = 0;          ///< of the value with the largest error, in parts of the range
    double claimed = 0, value = 0;   ///< of that column; NaN where there is none
    double ulps = 0, relative = 0;
    double distance = 0;  ///< of a row invented: from the point to the nearest cell; NaN if the point is not finite
    double severity = 0;  ///< what examples are chosen by: larger is worse
};

/// Points nearer to the mesh than that, in parts of the diagonal of its box, are outside by rounding or a tolerance.
inline constexpr double near_distance = 1e-9;

/// Distances take up to some hundred microseconds a row: no more than so many rows are measured.
inline constexpr std::size_t max_measured = 1000;

/// Results of a verification.
struct Verdicts {
    std::uint64_t rows = 0, right = 0, missed = 0, invented = 0, wrong_cell = 0, wrong_value = 0;
    std::uint64_t inside = 0, outside = 0;  ///< of all rows, exactly
    std::uint64_t not_finite = 0;           ///< of those outside: the point is not finite
    std::uint64_t on_boundary = 0;          ///< of all rows: on a face, an edge or a vertex of their owner
    std::uint64_t missed_on_boundary = 0;   ///< of those missed
    std::uint64_t invented_zero = 0;        ///< of those invented: every value is 0
    std::uint64_t invented_near = 0;      ///< of those measured: the mesh is nearer than near_distance of its diagonal
    double invented_distance = 0;         ///< of those measured: from the farthest point to the nearest cell
    std::uint64_t invented_measured = 0;  ///< of those invented: how far they lie outside is known, see measure()
    std::uint64_t several = 0;            ///< rows in more than one cell, as far as they were looked at
    std::uint64_t by_other_cell = 0;      ///< right by the value of a cell that is not the owner
    std::vector<ValueErrors> columns;     ///< as Sampler::columns()
    std::vector<WrongRow> examples;       ///< the worst of each kind, worst first, kinds in the order of RowVerdict
    std::vector<WrongRow> invented_rows;  ///< to be measured: all, or max_measured chosen by a hash of their numbers

    std::uint64_t wrong() const { return rows - right; }
    std::uint64_t of(RowVerdict v) const {
        return std::array{right, missed, invented, wrong_cell, wrong_value}[static_cast<std::size_t>(v)];
    }
    /// Adds the verdicts of rows that came after.
    void add(const Verdicts& other, std::size_t examples);
};

/// Thread-safe. The sampler, whose locator and fields are those of the mesh, must stay.
class Verifier {
public:
    Verifier(const Sampler& sampler, const VerifyOptions& options);

    /// Compares rows with the exact ones. Error: sizes that do not fit; a coordinate that is not finite, unless
    /// options().nonfinite_points makes such points outside.
    Result<Verdicts> verify(const ClaimedRows& rows) const;

    /// Measures how far invented rows lie outside, and makes the farthest of them examples. Call it once, after the
    /// verdicts of all parts of the rows were added.
    Status measure(Verdicts& verdicts) const;

    /// The numbers that errors are relative to, one a column.
    const std::vector<double>& ranges() const { return ranges_; }
    const std::vector<RelativeTo>& relative_to() const { return relative_to_; }
    const VerifyOptions& options() const { return options_; }

private:
    const Sampler& sampler_;
    VerifyOptions options_;
    std::vector<double> ranges_;
    std::vector<RelativeTo> relative_to_;
    double near_ = 0;
};

}  // namespace barycert
