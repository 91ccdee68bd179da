#include "barycert/locate/cell_index.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "barycert/locate/open_facets.hpp"
#include "barycert/locate/radix_sort.hpp"

namespace barycert::locate {
namespace {

/// The box of the nodes that cells have: others may lie anywhere.
void find_box(const Mesh& mesh, CellIndex& index) {
    const std::size_t d = index.dimension();
    std::vector<std::uint8_t> used(mesh.point_count(), 0);
    for (const Mesh::Index node : mesh.cells) used[static_cast<std::size_t>(node)] = 1;
    for (std::size_t k = 0; k < d; ++k) {
        index.low[k] = std::numeric_limits<double>::infinity();
        index.high[k] = -index.low[k];
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (used[i] == 0) continue;
        for (std::size_t k = 0; k < d; ++k) {
            index.low[k] = std::min(index.low[k], mesh.points[d * i + k]);
            index.high[k] = std::max(index.high[k], mesh.points[d * i + k]);
        }
    }
}

/// The bin of each cell: that of the middle of its corners, in whole numbers of the quantizer.
template <std::size_t d>
void find_bins(const Mesh& mesh, const Bins& bins, Buffer<KeyedPlace>& cells) {
    Buffer<std::array<std::int32_t, d>> nodes(mesh.point_count());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (std::size_t k = 0; k < d; ++k) nodes[i][k] = bins.quantizer().at(k, mesh.points[d * i + k]);
    }
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const Mesh::Index* const corner = mesh.cells.data() + (d + 1) * c;
        std::array<std::int64_t, d> sum{};
        for (std::size_t i = 0; i <= d; ++i) {
            const auto& node = nodes[static_cast<std::size_t>(corner[i])];
            for (std::size_t k = 0; k < d; ++k) sum[k] += node[k];
        }
        for (std::size_t k = 0; k < d; ++k) sum[k] /= static_cast<std::int64_t>(d + 1);
        cells[c] = {bins.of_quantized(sum), static_cast<Place>(c)};
    }
}

/// Numbers nodes in the order in which cells come by, and copies their coordinates.
class NodeNumbers {
public:
    NodeNumbers(const Mesh& mesh, CellIndex& index)
        : mesh_(mesh), index_(index), place_(mesh.point_count(), -1), d_(index.dimension()) {
        index.nodes = Buffer<NodeRecord>(mesh.point_count());
        index.original_node.reserve(mesh.point_count());
    }

    Place of(Mesh::Index node) {
        Place& place = place_[static_cast<std::size_t>(node)];
        if (place < 0) {
            place = static_cast<Place>(index_.original_node.size());
            index_.original_node.push_back(node);
            NodeRecord& record = index_.nodes[static_cast<std::size_t>(place)];
            record = {};
            for (std::size_t k = 0; k < d_; ++k) record.at[k] = mesh_.points[d_ * static_cast<std::size_t>(node) + k];
        }
        return place;
    }

    /// Asks for what of() will read, of the corners of a cell soon to come.
    void fetch(const Mesh::Index* corner) const {
        for (std::size_t i = 0; i <= d_; ++i) __builtin_prefetch(&place_[static_cast<std::size_t>(corner[i])]);
    }
    void fetch_new(const Mesh::Index* corner) const {
        for (std::size_t i = 0; i <= d_; ++i) {
            const auto node = static_cast<std::size_t>(corner[i]);
            if (place_[node] < 0) __builtin_prefetch(&mesh_.points[d_ * node]);
        }
    }

private:
    const Mesh& mesh_;
    CellIndex& index_;
    std::vector<Place> place_;
    std::size_t d_;
};

template <std::size_t d>
void place_cells(const Mesh& mesh, bool link, const Buffer<KeyedPlace>& order, CellIndex& index) {
    NodeNumbers numbers(mesh, index);
    OpenFacets<d> open(link ? mesh.point_count() : 0);
    // Cells and nodes that are near in space are anywhere in the file: each is asked for some cells ahead.
    constexpr std::size_t corners_ahead = 48, nodes_ahead = 32, coordinates_ahead = 16;
    const auto corners_at = [&](std::size_t place) {
        return mesh.cells.data() + (d + 1) * static_cast<std::size_t>(order[place].place);
    };
    std::size_t bin = 0;
    for (std::size_t place = 0; place < order.size(); ++place) {
        if (place + corners_ahead < order.size()) {
            __builtin_prefetch(corners_at(place + corners_ahead));
            numbers.fetch(corners_at(place + nodes_ahead));
            numbers.fetch_new(corners_at(place + coordinates_ahead));
        }
        while (bin <= order[place].key >> CellIndex::part_bits) index.first[bin++] = static_cast<Place>(place);
        const Mesh::Index* const corner = corners_at(place);
        CellRecord& record = index.cells[place];
        for (std::size_t i = 0; i <= d; ++i) record.node[i] = numbers.of(corner[i]);
        if constexpr (d == 2) record.node[3] = record.node[0];
        record.next = {-1, -1, -1, -1};
        index.original[place] = static_cast<Mesh::Index>(order[place].place);
        if (link) open.add(static_cast<Place>(place), index.cells.data());
    }
    while (bin < index.first.size()) index.first[bin++] = static_cast<Place>(order.size());
}

template <std::size_t d>
void build(const Mesh& mesh, bool link, CellIndex& index) {
    Buffer<KeyedPlace> cells(mesh.cell_count());
    find_bins<d>(mesh, index.bins, cells);
    sort_by_key(cells, index.bins.bits());
    place_cells<d>(mesh, link, cells, index);
}

}  // namespace

std::size_t CellIndex::bytes() const {
    return cells.bytes() + original.bytes() + nodes.bytes() + original_node.size() * sizeof(Mesh::Index) +
           first.size() * sizeof(Place);
}

std::array<double, 12> vertices_of(const CellIndex& index, Place cell) {
    std::array<double, 12> vertices{};
    const CellRecord& record = index.cells[static_cast<std::size_t>(cell)];
    const std::size_t d = index.dimension();
    for (std::size_t i = 0; i <= d; ++i) {
        const auto& at = index.nodes[static_cast<std::size_t>(record.node[i])].at;
        for (std::size_t k = 0; k < d; ++k) vertices[d * i + k] = at[k];
    }
    return vertices;
}

CellIndex make_cell_index(const Mesh& mesh, bool link) {
    CellIndex index;
    index.simplex = mesh.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron;
    index.linked = link;
    find_box(mesh, index);
    index.cells = Buffer<CellRecord>(mesh.cell_count());
    index.original = Buffer<Mesh::Index>(mesh.cell_count());
    if (mesh.cell_count() == 0) {
        index.first.assign(2, 0);
        return index;
    }
    index.bins =
        Bins(index.dimension(), index.low.data(), index.high.data(), mesh.cell_count() << CellIndex::part_bits);
    index.first.resize((index.bins.count() >> CellIndex::part_bits) + 2);
    mesh.dimension == 2 ? build<2>(mesh, link, index) : build<3>(mesh, link, index);
    return index;
}

}  // namespace barycert::locate
