#include "barycert/mesh.hpp"
#include "core/base/lists.hpp"
#include "core/integer.hpp"
#include "mesh/sample/quantity/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "barycert/environment.hpp"
#include "core/numerators-inl.hpp"
#include "core/scaled_double.hpp"
#include "mesh/sample/quantity/mean_lanes.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::sample {
namespace {

using core::Integer;
using core::Unit;

// A determinant has 3 * 2099 + 3 bits (see core/integer.hpp), a product with a value 2098 more, and there are less than
// 2^32 cells.
static_assert(64 * (Integer::capacity - 2) >= 3 * 2099 + 3 + 2098 + 32);

/// use(node, cell) for the cells of each node, of shapes all parts.
template <class Use>
void for_cells_of_nodes(const Mesh& mesh, const Use& use) {
    const Mesh::Shapes& shapes = mesh.shapes;
    std::vector<Mesh::Index> nodes;
    for (std::size_t i = 0; i < shapes.count(); ++i) {
        const std::span all = shapes.nodes_of(i);
        nodes.assign(all.begin(), all.end());
        std::ranges::sort(nodes);
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        for (Mesh::Index cell = shapes.parts[i]; cell < shapes.parts[i + 1]; ++cell) {
            for (const Mesh::Index node : nodes) use(static_cast<std::size_t>(node), cell);
        }
    }
    if (shapes.count() != 0) return;
    for (const std::span<const Mesh::Index> list : {std::span(mesh.cells), std::span(mesh.mid_nodes)}) {
        const std::size_t per_cell = list.empty() ? 1 : list.size() / mesh.cell_count();
        for (std::size_t i = 0; i < list.size(); ++i)
            use(static_cast<std::size_t>(list[i]), static_cast<Mesh::Index>(i / per_cell));
    }
}

/// The mean at one node, in integers: where the filter is not certain. Kept from node to node, for its memory.
class MeanAtNode {
public:
    MeanAtNode(const Mesh& mesh, const Field& field) : mesh_(mesh), field_(field) {}

    void operator()(std::span<const Mesh::Index> cells, double* out) {
        Unit units[3];
        values_.assign(components_, {});
        for (const Mesh::Index cell : cells) {
            for (std::size_t i = 0; i <= d_; ++i) {
                for (std::size_t k = 0; k < d_; ++k) units[k].add(corner(cell, i)[k]);
            }
            for (std::size_t c = 0; c < components_; ++c) {
                if (std::isfinite(value(cell, c))) values_[c].add(value(cell, c));
            }
        }
        total_ = Integer();
        sums_.assign(components_, Integer());
        finite_.assign(components_, 1);
        // Widths as in mesh/index/exact_volumes.cpp.
        core::with_integers<3>(core::max_bits(units), [&]<class T>() {
            for (const Mesh::Index cell : cells) add<T>(units, cell);
            return 0;
        });
        for (std::size_t c = 0; c < components_; ++c) {
            const bool some = total_.sign() != 0 && finite_[c] != 0;
            // The units of the coordinates cancel.
            out[c] = some ? core::round_quotient(sums_[c], total_, values_[c].power())
                          : std::numeric_limits<double>::quiet_NaN();
        }
    }

private:
    const double* corner(Mesh::Index cell, std::size_t i) const {
        return mesh_.point(mesh_.cells[(d_ + 1) * static_cast<std::size_t>(cell) + i]);
    }
    double value(Mesh::Index cell, std::size_t c) const {
        return field_.data[components_ * static_cast<std::size_t>(cell) + c];
    }

    template <class T>
    void add(const Unit (&units)[3], Mesh::Index cell) {
        const Integer volume = d_ == 2 ? determinant<T, 2>(units, cell) : determinant<T, 3>(units, cell);
        if (volume.sign() == 0) return;
        const Integer weight = volume.sign() < 0 ? Integer() - volume : volume;
        total_ = total_ + weight;
        for (std::size_t c = 0; c < components_; ++c) {
            if (std::isfinite(value(cell, c)))
                sums_[c] = sums_[c] + weight * values_[c].integer(value(cell, c));
            else
                finite_[c] = 0;
        }
    }

    template <class T, int d>
    Integer determinant(const Unit (&units)[3], Mesh::Index cell) const {
        T edge[d][d];
        for (int k = 0; k < d; ++k) {
            const auto at = [&](int i) {
                return units[k].template multiple<T>(core::scaled(corner(cell, static_cast<std::size_t>(i))[k]));
            };
            for (int i = 0; i < d; ++i) edge[i][k] = at(i + 1) - at(0);
        }
        return core::as_integer(core::HWY_NAMESPACE::determinant(edge));
    }

    const Mesh& mesh_;
    const Field& field_;
    std::size_t d_ = static_cast<std::size_t>(mesh_.dimension);
    std::size_t components_ = static_cast<std::size_t>(field_.components);
    std::vector<Unit> values_;
    Integer total_;
    std::vector<Integer> sums_;
    std::vector<std::uint8_t> finite_;
};

}  // namespace

Field nodal_mean(const Mesh& mesh, const Field& of_cells) {
    const auto components = static_cast<std::size_t>(of_cells.components);
    Field field{{}, of_cells.components, std::vector<double>(components * mesh.point_count())};
    const base::Lists<Mesh::Index> cells(mesh.point_count(), [&](const auto& add) { for_cells_of_nodes(mesh, add); });
    constexpr std::size_t cells_of_task = 4096, nodes_of_task = 512;
    std::vector<CellVolume> volumes(mesh.cell_count());
    base::parallel_for(volumes.size(), cells_of_task, [&](std::size_t begin, std::size_t end) {
        const ExactEnvironment environment;  // of a thread that may be the caller's
        volume_lanes(mesh, begin, end - begin, volumes.data() + begin);
    });
    const MeanInput input{cells, volumes, of_cells.data, components};
    base::parallel_for(mesh.point_count(), nodes_of_task, [&](std::size_t begin, std::size_t end) {
        const ExactEnvironment environment;
        std::vector<std::uint32_t> undecided(end - begin);
        double* const out = field.data.data() + components * begin;
        undecided.resize(mean_lanes(input, begin, end - begin, out, undecided.data()));
        if (undecided.empty()) return;
        MeanAtNode mean(mesh, of_cells);
        for (const std::uint32_t i : undecided) {
            const std::size_t node = begin + i;
            mean(cells[node], out + components * i);
        }
    });
    return field;
}

}  // namespace barycert::sample
