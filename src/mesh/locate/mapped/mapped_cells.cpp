#include "mesh/locate/mapped/mapped_cells.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "core/base/finite.hpp"
#include "core/isoparametric/gradient.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/isoparametric/lanes.hpp"
#include "core/shape_functions.hpp"
#include "core/vtk_cell.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_maps.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/locate/lazy.hpp"
#include "mesh/locate/mapped/boundary.hpp"
#include "mesh/mid_edges.hpp"
#include "mesh/pulling.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::locate {

namespace iso = core::isoparametric;

std::unique_ptr<MappedCells> MappedCells::make(const Mesh& mesh, const CellIndex& index, bool products, Curved curved) {
    auto cells = std::unique_ptr<MappedCells>(new MappedCells(mesh, products, curved));
    const bool none = std::ranges::all_of(cells->sign_, [](std::int8_t s) { return s == 0; });
    if (none && cells->unproved_ == 0) return nullptr;
    if (cells->products_) cells->arrange(index);
    return cells;
}

MappedCells::MappedCells(const Mesh& mesh, bool products, Curved curved)
    : mesh_(mesh), maps_(mesh, products, curved), products_(products) {
    if (has_shapes()) whole_ = mesh::whole_of_parts(mesh);
    sign_.assign(mesh.whole_count(), 0);
    std::atomic<std::uint64_t> unproved = 0, of_products = 0;
    base::parallel_for_each(whole_count(), 1024, [&](std::size_t whole) {
        const iso::Reference* const reference = maps_.reference(whole);
        if (reference == nullptr) return;
        sign_[whole] = static_cast<std::int8_t>(iso::proved_orientation(*reference, maps_.places(whole)));
        if (sign_[whole] == 0) return static_cast<void>(unproved.fetch_add(1, std::memory_order_relaxed));
        if (!reference->is_simplex()) of_products.fetch_add(1, std::memory_order_relaxed);
    });
    unproved_ = unproved;
    products_ = of_products != 0;
    if (products_) find_sides();
    find_curves();
    curves_ = !curved_.empty();
}

MappedCells::~MappedCells() = default;

const MapBoundary& MappedCells::boundary() const {
    return boundary_.get([&] { return MapBoundary(mesh_, maps_, sign_); });
}

std::size_t MappedCells::bytes() const {
    return (whole_.size() + lane_cell_.size()) * sizeof(Mesh::Index) + sign_.size() + lane_nodes_.bytes() +
           lane_part_.size() + warped_.size() * (sizeof(Warped) + 2 * sizeof(index::Box)) +
           curved_.size() * (sizeof(Mesh::Index) + 2 * sizeof(index::Box)) + bytes_of(boundary_);
}

// Curved simplices.

/// Mid-edge nodes of the boundary that are off the middle by rounding: they may be outside.
MappedCells::NodeTable MappedCells::rounded_nodes() const {
    NodeTable table;
    if (mesh_.mid_nodes.empty()) return table;
    const auto edges = mesh::edges_of(mesh_.dimension);
    const std::size_t corners = mesh_.corners();
    for (const std::int64_t facet : mesh::hull_facets(mesh_, mesh::compute_neighbours(mesh_))) {
        const auto cell = static_cast<std::size_t>(facet) / corners, corner = static_cast<std::size_t>(facet) % corners;
        for (std::size_t e = 0; e < edges.size(); ++e) {
            if (edges[e][0] == corner || edges[e][1] == corner || (maps_.curved_edges(cell) >> e & 1U) != 0) continue;
            const Mesh::Index node = mesh_.mid_nodes[cell * edges.size() + e];
            const auto [at, first] =
                table.try_emplace(bits_at(mesh_.point(node)), Location{static_cast<Mesh::Index>(cell), Feature::edge});
            at->second.cell = std::min(at->second.cell, static_cast<Mesh::Index>(cell));
        }
    }
    return table;
}

const Location* MappedCells::node_at(const double* point) const {
    const NodeTable& table = nodes_.get([&] { return rounded_nodes(); });
    const auto found = table.find(bits_at(point));
    return found == table.end() ? nullptr : &found->second;
}

void MappedCells::find_curves() {
    for (std::size_t whole = 0; whole < whole_count(); ++whole) {
        if (sign_[whole] != 0 && maps_.reference(whole)->is_simplex())
            curved_.push_back(static_cast<Mesh::Index>(whole));
    }
    if (curved_.empty()) return;
    std::vector<index::Box> boxes(curved_.size());
    base::parallel_for_each(boxes.size(), 1024, [&](std::size_t i) {
        const auto whole = static_cast<std::size_t>(curved_[i]);
        const auto hull = iso::hull_box(*maps_.reference(whole), maps_.places(whole));
        std::copy_n(hull.begin(), mesh_.dimension, boxes[i].low.begin());
        std::copy_n(hull.begin() + 3, mesh_.dimension, boxes[i].high.begin());
    });
    curved_tree_ = std::make_unique<index::BoxTree>(std::move(boxes));
}

iso::InSimplex MappedCells::in_curved(std::size_t whole, const double* point) const {
    const mesh::CellMaps::Nodes nodes = maps_.nodes(whole);
    const iso::Reference& reference = *maps_.reference(whole);
    for (std::size_t i = 0; i < nodes.count; ++i) {
        if (!std::equal(point, point + mesh_.dimension, mesh_.point(nodes.at[i]))) continue;
        if (maps_.places(whole).other[i] != nullptr) continue;  // it is off its straight edge
        iso::InSimplex in{.inside = true, .proved = true};
        for (std::size_t c = 0; c < mesh_.corners(); ++c) in.zeros |= reference.indices[i][c] == 0 ? 1U << c : 0U;
        return in;
    }
    unsigned flat = 0;
    std::array<int, 4> beyond{};
    const auto edges = mesh::edges_of(mesh_.dimension);
    const WeightSigns signs = in_part(first_part(whole), point);
    for (std::size_t c = 0; c < mesh_.corners(); ++c) {
        bool straight = !has_shapes() && !signs.degenerate();
        for (std::size_t e = 0; e < edges.size(); ++e)
            straight = straight && (edges[e][0] == c || edges[e][1] == c || (maps_.curved_edges(whole) >> e & 1U) == 0);
        flat |= straight ? 1U << c : 0U;
        beyond[c] = static_cast<int>(signs.sign(static_cast<int>(c)));
    }
    return iso::locate_in_simplex(reference, maps_.places(whole), point, flat, beyond);
}

void MappedCells::add_curved(const double* point, std::vector<Location>& found) const {
    if (curved_tree_ == nullptr) return;
    const index::Box box = index::box_of(mesh_.dimension, &point, 1);
    curved_tree_->for_each(box, [&](std::uint32_t i) {
        const auto whole = static_cast<std::size_t>(curved_[i]);
        const iso::InSimplex in = in_curved(whole, point);
        constexpr std::uint16_t inside = 0;  // the cell is one part: nothing of its boundary
        if (in.inside) found.push_back({first_part(whole), mesh::feature_of_whole(inside, in.zeros, mesh_.dimension)});
        return true;
    });
}

WeightSigns MappedCells::in_part(Mesh::Index cell, const double* point) const {
    std::array<double, 12> vertices{};
    double* to = vertices.data();
    for (const Mesh::Index node : mesh_.corners_of(static_cast<std::size_t>(cell)))
        to = std::copy_n(mesh_.point(node), mesh_.dimension, to);
    return weight_signs(mesh_.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron, vertices.data(), point);
}

Location MappedCells::owner(const double* point, Location in_parts, const AllInParts& all_in_parts) const {
    const std::vector<AtSides> sides = at_sides(point);
    bool near = !sides.empty();
    // Inside a straight cell, or a curved one, and not on its sides, it is nowhere else.
    const bool straight = in_parts.feature == Feature::interior && maps_.reference(whole(in_parts.cell)) == nullptr;
    if (curved_tree_ != nullptr && !near && !straight) {
        if (const Mesh::Index cell = inside_on_lanes(point); cell >= 0) return {cell, Feature::interior};
        if (const std::size_t own = is_mapped(in_parts.cell) ? whole(in_parts.cell) : 0;
            is_mapped(in_parts.cell) && maps_.reference(own)->is_simplex()) {
            const iso::InSimplex in = in_curved(own, point);
            if (in.inside && in.zeros == 0 && in.proved) return {first_part(own), Feature::interior};
            near = true;
        }
        const index::Box box = index::box_of(mesh_.dimension, &point, 1);
        if (!near) curved_tree_->for_each(box, [&](std::uint32_t) { return near = true, false; });
    }
    if (near) {
        std::vector<Location> all;
        all_in_parts(all);
        settle_all(point, sides, all);
        // In a gap between a cell with a map and one without the parts decide.
        const bool gap = all.empty() && in_parts.cell >= 0 && unproved_ != 0;
        if (!all.empty()) return all.front();
        if (!gap) in_parts = {};
    }
    if (in_parts.cell < 0 && curves_) {
        if (const Location* const at_node = node_at(point)) return *at_node;
    }
    if (is_mapped(in_parts.cell)) in_parts.cell = first_part(whole(in_parts.cell));
    return in_parts;
}

Mesh::Index MappedCells::inside_on_lanes(const double* point) const {
    if (mesh_.dimension != 3) return -1;
    Batch batch;
    batch.element = iso::LaneElement::tetrahedron;
    const PointRecord record{{point[0], point[1], point[2]}, 0};
    curved_tree_->for_each(index::box_of(3, &point, 1), [&](std::uint32_t i) {
        add({first_part(static_cast<std::size_t>(curved_[i])), Feature::interior}, record, -1, {}, {}, batch);
        return batch.count < Batch::max;
    });
    const iso::LanesProved proved = batch.evaluate();
    return proved.inside == 0 ? -1 : batch.at[static_cast<std::size_t>(std::countr_zero(proved.inside))].cell;
}

void MappedCells::settle_all(const double* point, const std::vector<AtSides>& sides, std::vector<Location>& all) const {
    std::vector<Location> found;
    for (const AtSides& at : sides) {
        if (!at.outside) found.push_back({first_part(at.whole), at.feature});
    }
    for (const Location& own : all) {
        const std::size_t of = whole(own.cell);
        if (sign_[of] == 0) {
            found.push_back(own);
        } else if (!maps_.reference(of)->is_simplex() && std::ranges::find(sides, of, &AtSides::whole) == sides.end()) {
            found.push_back({first_part(of), own.feature});
        }
    }
    add_curved(point, found);
    std::ranges::sort(found, {}, &Location::cell);
    all = std::move(found);
}

Mesh::Index MappedCells::part_at(Mesh::Index cell, const double* point) const {
    const std::size_t own = whole(cell);
    for (auto part = first_part(own); has_shapes() && part < first_part(own + 1); ++part) {
        if (in_part(part, point).contains()) return part;
    }
    return first_part(own);
}

iso::Evaluated MappedCells::evaluate(Mesh::Index cell, Feature feature, const double* point,
                                     const std::vector<const Field*>& fields, Scratch& scratch, double* out) const {
    const mesh::CellMaps::Nodes nodes = maps_.nodes(whole(cell));
    const auto d = static_cast<std::size_t>(mesh_.dimension);
    std::size_t at_node = nodes.count;
    const std::size_t components = gather(nodes.all(), fields, scratch);
    const iso::Reference* const reference = maps_.reference(whole(cell));
    const bool may_be_node = feature == Feature::vertex || reference == nullptr || reference->is_simplex();
    for (std::size_t i = 0; may_be_node && i < nodes.count; ++i) {
        if (std::equal(point, point + d, mesh_.point(nodes.at[i]))) at_node = i;
    }
    if (at_node != nodes.count) {
        for (std::size_t c = 0; c < components; ++c) {
            const double x = scratch[at_node * components + c];
            out[c] = std::isfinite(x) ? x + 0.0 : std::numeric_limits<double>::quiet_NaN();
        }
        return {iso::Certainty::proved, Tier::filter};
    }
    const std::uint64_t active = base::all_finite(scratch) ? ~std::uint64_t{0} : active_nodes(whole(cell), point);
    // NOLINTNEXTLINE(clang-analyzer-core.NonNullParamChecker): without a map the point was at a node
    return iso::evaluate(*reference, maps_.places(whole(cell)), point, active, scratch.data(), components, out);
}

iso::Evaluated MappedCells::gradients(Mesh::Index cell, const double* point, const Field& field, double* out) const {
    Scratch values;
    const std::size_t own = whole(cell), components = gather(maps_.nodes(own).all(), {&field}, values);
    return iso::evaluate_gradients(*maps_.reference(own), maps_.places(own), point, values.data(), components, out);
}

// On lanes.

void MappedCells::arrange(const CellIndex& index) {
    /// Corners, in the order of lanes, of voxels, hexahedra, wedges and pyramids.
    constexpr std::array<std::array<std::uint8_t, 8>, 4> corners{
        {{0, 1, 3, 2, 4, 5, 7, 6}, {0, 1, 2, 3, 4, 5, 6, 7}, {0, 1, 2, 0, 3, 4, 5, 3}, {0, 1, 2, 3, 4, 4, 4, 4}}};
    const auto is_on_lanes = [&](std::size_t whole) {
        return sign_[whole] != 0 && mesh_.shapes.types[whole] >= vtk_voxel && mesh_.shapes.types[whole] <= vtk_pyramid;
    };
    std::size_t count = 0;
    for (std::size_t whole = 0; whole < whole_count(); ++whole) count += is_on_lanes(whole) ? 1 : 0;
    std::vector<Place> place_of_node(mesh_.point_count(), -1);
    for (std::size_t place = 0; place < index.original_node.size(); ++place)
        place_of_node[static_cast<std::size_t>(index.original_node[place])] = static_cast<Place>(place);
    lane_nodes_ = Buffer<LaneNodes>(count);
    lane_cell_.assign(index.cell_count(), -1);
    lane_part_.assign(index.cell_count(), 0);
    std::vector<std::int32_t> number(whole_count(), -1);
    std::int32_t next = 0;
    for (std::size_t place = 0; place < lane_cell_.size(); ++place) {
        const std::size_t own = whole(index.original[place]);
        if (number[own] < 0 && is_on_lanes(own)) {
            const std::uint8_t type = mesh_.shapes.types[own];
            for (std::size_t i = 0; i < 8; ++i)
                lane_nodes_[static_cast<std::size_t>(next)].at[i] =
                    place_of_node[static_cast<std::size_t>(mesh_.shapes.nodes_of(own)[corners[type - 11U][i]])];
            number[own] = 2 * next++ + (type == vtk_wedge ? 1 : 0);
        }
        lane_cell_[place] = number[own];
        lane_part_[place] = static_cast<std::uint8_t>(index.original[place] - first_part(own));
    }
}

void MappedCells::fetch(Place place, std::size_t step, const NodeRecord* nodes) const {
    if (lane_cell_.empty() || lane_cell_[static_cast<std::size_t>(place)] < 0) return;
    const LaneNodes& own = lane_nodes_[static_cast<std::size_t>(lane_cell_[static_cast<std::size_t>(place)] / 2)];
    if (step == 0) return __builtin_prefetch(&own);
    for (const Place node : own.at) __builtin_prefetch(&nodes[node]);
}

bool MappedCells::add(const Location& at, const PointRecord& point, Place place,
                      const std::vector<const Field*>& fields, const NodeValues& values, Batch& to) const {
    if (at.feature == Feature::vertex || at.cell < 0) return false;
    const bool curved = to.element == iso::LaneElement::tetrahedron;
    if (curved ? !is_mapped(at.cell) || !add_tetrahedron(whole(at.cell), point, fields, to)
               : !add_product(place, values, to))
        return false;
    for (std::size_t k = 0; k < 3; ++k) to.point[k * Batch::max + to.count] = point.at[k];
    to.first[to.count] = curved ? first_part(whole(at.cell)) : at.cell - lane_part_[static_cast<std::size_t>(place)];
    to.numbers[to.count] = point.number;
    to.at[to.count++] = at;
    return true;
}

bool MappedCells::add_product(Place place, const NodeValues& values, Batch& to) const {
    const std::int32_t own = lane_cell_.empty() ? -1 : lane_cell_[static_cast<std::size_t>(place)];
    if (own < 0 || (own % 2 == 1) != (to.element == iso::LaneElement::wedge)) return false;
    const std::size_t components = to.out.size() / Batch::max;
    for (std::size_t i = 0; i < 8; ++i) {
        const auto node = static_cast<std::size_t>(lane_nodes_[static_cast<std::size_t>(own / 2)].at[i]);
        const NodeRecord& record = values.first[node];
        for (std::size_t k = 0; k < 3; ++k) to.places[(3 * i + k) * Batch::max + to.count] = record.at[k];
        for (std::size_t c = 0; c < components; ++c) {
            const double x = values.at(node, c);
            if (!std::isfinite(x)) return false;
            to.values[(8 * c + i) * Batch::max + to.count] = x;
        }
    }
    return true;
}

bool MappedCells::add_tetrahedron(std::size_t own, const PointRecord& point, const std::vector<const Field*>& fields,
                                  Batch& to) const {
    constexpr std::size_t count = 10;
    const iso::Reference& reference = *maps_.reference(own);
    if (reference.element != iso::Element::tetrahedron || reference.nodes != count) return false;
    const auto nodes = maps_.nodes(own).at;
    for (std::size_t i = 0; i < count; ++i) {
        const double *place = mesh_.point(nodes[i]), *other = place;
        if (std::equal(place, place + 3, point.at.begin())) return false;
        if (i >= 4 && !has_shapes() && (maps_.curved_edges(own) >> (i - 4) & 1U) == 0) {
            const auto& edge = mesh::edges_of(3)[i - 4];
            place = mesh_.point(nodes[edge[0]]);
            other = mesh_.point(nodes[edge[1]]);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            to.places[(3 * i + k) * Batch::max + to.count] = place[k];
            if (i >= 4) to.others[(3 * (i - 4) + k) * Batch::max + to.count] = other[k];
        }
        std::size_t c = i;
        for (const Field* const field : fields) {
            const auto width = static_cast<std::size_t>(field->components);
            for (std::size_t w = 0; w < width; ++w, c += count) {
                const double x = field->data[static_cast<std::size_t>(nodes[i]) * width + w];
                if (!std::isfinite(x)) return false;
                to.values[c * Batch::max + to.count] = x;
            }
        }
    }
    return true;
}

mesh::CellMaps::Nodes MappedCells::weights(Mesh::Index cell, const double* point, double* out) const {
    const mesh::CellMaps::Nodes nodes = maps_.nodes(whole(cell));
    std::fill_n(out, nodes.count, 0.0);
    for (std::size_t i = 0; i < nodes.count; ++i) {
        if (!std::equal(point, point + mesh_.dimension, mesh_.point(nodes.at[i]))) continue;
        out[i] = 1;
        return nodes;
    }
    std::vector<double> units(nodes.count * nodes.count);
    for (std::size_t i = 0; i < nodes.count; ++i) units[i * nodes.count + i] = 1;
    const iso::Evaluated found = iso::evaluate(*maps_.reference(whole(cell)), maps_.places(whole(cell)), point,
                                               ~std::uint64_t{0}, units.data(), nodes.count, out);
    return found.certainty == iso::Certainty::not_found ? mesh::CellMaps::Nodes() : nodes;
}

}  // namespace barycert::locate
