// Fields of a grid whose cells are not listed (Mesh::axes).
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "barycert/weights.hpp"
#include "core/base/finite.hpp"
#include "core/grid_lanes.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/shape_functions.hpp"
#include "core/vtk_cell.hpp"
#include "mesh/locate/batch.hpp"
#include "mesh/sample/points/chunk_sampler.hpp"
#include "mesh/sample/points/sampler_data.hpp"

namespace barycert::sample {
namespace {

namespace iso = core::isoparametric;

class GridSampler {
public:
    GridSampler(const SamplerData& data, const SampleOptions& options)
        : data_(data), options_(options), grid_(*data.located().grid), d_(grid_.dimension) {
        for (const Field* field : data.point_fields) {
            const auto step = static_cast<std::size_t>(field->components);
            for (std::size_t c = 0; c < step; ++c) fields_.push_back({field->data.data() + c, step});
        }
    }

    SampleCounts sample(std::span<const double> points, const BlockRows& rows) const {
        const std::size_t count = points.size() / d_;
        std::vector<std::uint32_t> undecided(count);
        const bool multilinear = data_.located().multilinear;
        const core::GridPoints all{points, rows.cells, rows.features, fields_, multilinear, rows.values, data_.width};
        undecided.resize(core::sample_grid(grid_, all, undecided.data()));
        SampleCounts counts;
        for (const std::uint32_t i : undecided) {
            const double* const point = &points[d_ * i];
            const auto cell = static_cast<std::size_t>(rows.cells[i]);
            double* const row = rows.values + data_.width * i;
            multilinear ? set_product(point, cell, row) : set_in_part(point, cell, row);
            counts.values.not_finite += base::all_finite({row, fields_.size()}) ? 0 : 1;
        }
        counts.values.add(Tier::exact, undecided.size());
        const double outside =
            options_.outside.kind == Outside::fill ? options_.outside.fill : std::numeric_limits<double>::quiet_NaN();
        std::size_t inside = 0;
        std::array<std::uint64_t, 6> features{};
        for (std::size_t i = 0; i < count; ++i) {
            ++features[static_cast<std::size_t>(rows.features[i])];
            double* const row = rows.values + data_.width * i;
            if (rows.cells[i] < 0) {
                std::fill_n(row, data_.width, outside);
                continue;
            }
            ++inside;
            if (data_.has_rest()) set_rest_of_row(data_, options_, {rows.cells[i], &points[d_ * i]}, row, counts);
        }
        for (std::size_t f = 0; f < features.size(); ++f) counts.locations.add(static_cast<Feature>(f), features[f]);
        counts.without_value = count - inside;
        if (!fields_.empty()) counts.values.add(Tier::double_double, inside - undecided.size());
        return counts;
    }

private:
    /// Where a corner of a cell is, by the bits of its number, and its node.
    struct Corner {
        std::array<double, 3> at{};
        std::size_t node;
    };
    Corner corner(std::size_t cell, unsigned bits) const {
        Corner out{.node = grid_.node_of(cell)};
        for (std::size_t k = 0, rest = cell; k < d_; ++k) {
            const std::size_t high = bits >> k & 1U;
            out.at[k] = grid_.planes[k][rest % grid_.cells[k] + high];
            out.node += high * grid_.node_step[k];
            rest /= grid_.cells[k];
        }
        return out;
    }

    void set_product(const double* point, std::size_t cell, double* row) const {
        const iso::Reference& reference = *iso::linear_reference(d_ == 3 ? vtk_hexahedron : vtk_quad);
        std::array<Corner, 8> corners;
        iso::Places places;
        std::uint64_t active = 0;
        std::vector<double> values;
        for (unsigned i = 0; i < reference.nodes; ++i) {
            const unsigned bits = i ^ (i >> 1U & 1U);  // VTK goes round each layer
            const Corner opposite = corner(cell, ~bits);
            corners[i] = corner(cell, bits);
            places.at[i] = corners[i].at.data();
            bool weighs = true;
            for (std::size_t k = 0; k < d_; ++k) weighs = weighs && point[k] != opposite.at[k];
            active |= weighs ? std::uint64_t{1} << i : 0U;
            for (const core::NodeComponent& field : fields_) values.push_back(field.data[field.step * corners[i].node]);
        }
        // A box is an affine image of the cube: all is rational, and so proved.
        iso::evaluate(reference, places, point, active, values.data(), fields_.size(), row);
    }

    /// Parts go from the lowest corner to the highest along the axes in any order.
    void set_in_part(const double* point, std::size_t cell, double* row) const {
        const Simplex simplex = d_ == 3 ? Simplex::tetrahedron : Simplex::triangle;
        std::array<std::size_t, 3> order{0, 1, 2};
        std::array<double, 12> vertices;
        std::array<std::size_t, 4> nodes;
        do {
            unsigned bits = 0;
            for (std::size_t i = 0; i <= d_; ++i) {
                const Corner own = corner(cell, bits);
                std::copy_n(own.at.begin(), d_, &vertices[d_ * i]);
                nodes[i] = own.node;
                bits |= i < d_ ? 1U << order[i] : 0U;
            }
        } while (!weight_signs(simplex, vertices.data(), point).contains() &&
                 std::next_permutation(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(d_)));
        for (std::size_t c = 0; c < fields_.size(); ++c) {
            std::array<double, 4> f{};
            for (std::size_t i = 0; i <= d_; ++i) f[i] = fields_[c].data[fields_[c].step * nodes[i]];
            row[c] = interpolate(simplex, vertices.data(), point, f.data())->value;
        }
    }

    const SamplerData& data_;
    const SampleOptions& options_;
    const core::AxisGrid& grid_;
    const std::size_t d_;
    std::vector<core::NodeComponent> fields_;
};

}  // namespace

Status sample_on_grid(const SamplerData& data, std::span<const double> points, const SampleOptions& options,
                      Table& out) {
    if (gives_distances(options.outside)) return locate::not_listed("the nearest cell");
    if (options.rounding == Rounding::plain) return locate::not_listed("values in plain double");
    const std::size_t d = data.index().dimension();
    constexpr std::size_t grain = std::size_t{1} << 12;
    const GridSampler sampler(data, options);
    const auto sample = [&](std::size_t begin, std::size_t end, SampleCounts& counts) {
        counts = sampler.sample(
            points.subspan(d * begin, d * (end - begin)),
            {out.cells.data() + begin, out.features.data() + begin, out.values.data() + data.width * begin, nullptr});
    };
    out.counts = set_values(data, options.threads, grain, out, sample);
    return Done{};
}

}  // namespace barycert::sample
