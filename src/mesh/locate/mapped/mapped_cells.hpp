/// Cells that are images of their reference cells: who owns a point, and values there.
///
/// Products. Hexahedra, voxels, wedges, pyramids and quadrilaterals. Their edges are straight, and the sides through
/// four nodes that are not in one plane are pieces of hyperbolic paraboloids. The cell and the union of its parts
/// (mesh/pulling.hpp) differ only in the tetrahedra that the nodes of such sides span. A point in none of these
/// tetrahedra is in the cell if it is in one of the parts. A point in some of them is in the cell if it is on the inner
/// side of each of their paraboloids. A paraboloid has the points with a c = b d, where a, b, c, d are the weights of
/// the point in the tetrahedron. The tetrahedron meets a flat side only in an edge: its nodes beyond that edge are
/// joined to the flat side's nodes by edges, along which the Jacobian is positive at both ends. So its faces that
/// belong to parts alone lie inside the cell. If a cell cannot be cut into parts, the triangles of its sides decide for
/// points outside these tetrahedra: a point is in the cell if it is on a triangle, or if their winding number around it
/// is not 0.
///
/// Curved simplices of order 2 to 4. A point is in the cell if Newton's method finds it there, proved, and not if the
/// cell is proved to have it nowhere else (core/isoparametric). Facets whose edges are all straight are flat, and
/// orient3d decides on which side a point is. Mid-edge nodes that are off the middle by rounding alone count as amid; a
/// point at such a node, or any other, is at that node.
///
/// All of that holds where the map is injective, which is proved cell by cell (proved_orientation). A cell without that
/// proof is taken as its parts, or straight, and counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "core/base/random.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/isoparametric/lanes.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_maps.hpp"
#include "mesh/index/warped_sides.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/locate/lazy.hpp"

namespace barycert::locate {

class MapBoundary;
struct PointOnSide;

class MappedCells {
public:
    ~MappedCells();

    /// Sets all cells that hold a point, as straight simplices or by their parts.
    using AllInParts = std::function<void(std::vector<Location>&)>;

    /// nullptr if no cell has a map, and no node is off a middle. `products`: those of Mesh::shapes. `curved`: of
    /// simplices of a higher order. On the threads of the calling arena.
    static std::unique_ptr<MappedCells> make(const Mesh& mesh, const CellIndex& index, bool products, Curved curved);

    /// Cells that have no map, though others of their types have: it is not proved that it would be injective.
    std::uint64_t unproved() const { return unproved_; }
    /// Warped sides that have another surface in the cell beyond: cells overlap there, or leave a gap.
    const std::vector<mesh::SplitSide>& split_sides() const { return split_sides_; }
    /// Whether a point may be in two cells, or in none, at such a side.
    bool is_near_split(const double* point) const;
    bool has_products() const { return products_; }
    bool has_curves() const { return curves_; }
    std::size_t bytes() const;

    /// Where points outside have their nearest ones.
    const MapBoundary& boundary() const;
    /// The cell that stands for a whole one.
    Mesh::Index first_cell(Mesh::Index whole) const { return first_part(static_cast<std::size_t>(whole)); }

    bool is_mapped(Mesh::Index cell) const { return cell >= 0 && sign_[whole(cell)] != 0; }
    /// Whether evaluate() knows the values there: of a mapped cell, or at a node.
    bool evaluates(Mesh::Index cell, const double* point) const {
        return is_mapped(cell) || (cell >= 0 && curves_ && node_at(point) != nullptr);
    }

    /// The owner of a point, by what its location is in parts of cells; the first part stands for a mapped cell.
    Location owner(const double* point, Location in_parts, const AllInParts& all_in_parts) const;
    /// Likewise of all cells that hold it, ascending; `in_parts` has one entry a cell, and none outside.
    void all_owners(const double* point, std::vector<Location>& in_parts) const {
        settle_all(point, at_sides(point), in_parts);
    }

    /// The part of a mapped cell that holds the point, or the first.
    Mesh::Index part_at(Mesh::Index cell, const double* point) const;

    using Scratch = std::vector<double>;
    /// All components of fields of nodes, one field after the other, where evaluates(). NaN as in V2 of sampler.hpp.
    core::isoparametric::Evaluated evaluate(Mesh::Index cell, Feature feature, const double* point,
                                            const std::vector<const Field*>& fields, Scratch& scratch,
                                            double* out) const;
    /// Gradients of all components of a field of nodes in a mapped cell (core/isoparametric/gradient.hpp).
    core::isoparametric::Evaluated gradients(Mesh::Index cell, const double* point, const Field& field,
                                             double* out) const;
    /// Cases for core/isoparametric/lanes.hpp.
    struct Batch {
        static constexpr std::size_t max = core::isoparametric::max_lanes;
        core::isoparametric::LaneElement element{};
        std::size_t count = 0;
        std::array<double, 30 * max> places{};
        std::array<double, 18 * max> others{};
        std::array<double, 3 * max> point{};
        std::vector<double> values, out;
        std::array<std::uint32_t, max> numbers{};  ///< of the points' records
        std::array<Location, max> at{};
        std::array<Mesh::Index, max> first{};  ///< part of the cell
        std::array<bool, max> settled{};       ///< of MappedLanes::push()

        PointRecord record(std::size_t lane) const {
            return {{point[lane], point[max + lane], point[2 * max + lane]}, numbers[lane]};
        }
        core::isoparametric::LanesProved evaluate() {
            return core::isoparametric::evaluate_lanes({count, element, places.data(), others.data(), point.data(),
                                                        values.data(), out.size() / max, out.data()});
        }
    };

    /// Asks memory for what add() will read at a place, in calls some points apart: with step 0 first, then 1.
    void fetch(Place place, std::size_t step, const NodeRecord* nodes) const;
    static constexpr std::size_t fetch_steps = 2;
    /// Adds a case, which lies at a place of the index; false for cells of other elements, at a node, and where a value
    /// is not finite. `values`: of all components of the fields.
    bool add(const Location& at, const PointRecord& point, Place place, const std::vector<const Field*>& fields,
             const NodeValues& values, Batch& to) const;
    /// Nodes of a mapped cell, and its shape functions at the point, each rounded once; none if they are not found.
    mesh::CellMaps::Nodes weights(Mesh::Index cell, const double* point, double* out) const;

    // Values and weights at points outside whose nearest point is on a side (nearest_side.hpp).

    /// As evaluate(), at that point. NaN where a value at a node of the side is not finite.
    core::isoparametric::Evaluated evaluate_on_side(PointOnSide& on, const std::vector<const Field*>& fields,
                                                    Scratch& scratch, double* out) const;
    /// The function of the cell at the point itself, the inverse of its map continued from the nearest point
    /// (core/isoparametric/inverse.hpp).
    core::isoparametric::Evaluated evaluate_beyond(Mesh::Index cell, const PointOnSide& on, const double* point,
                                                   const std::vector<const Field*>& fields, Scratch& scratch,
                                                   double* out) const;
    /// Gradients there: with `beyond` at the point itself, or else, and where nothing is found, at the nearest point,
    /// its place in the reference cell rounded.
    core::isoparametric::Evaluated gradients_outside(Mesh::Index cell, const PointOnSide& on, const double* point,
                                                     bool beyond, const Field& field, double* out) const;
    /// The weights of both, each rounded once. Where nothing is found beyond, those on the side.
    mesh::CellMaps::Nodes weights_on_side(PointOnSide& on, double* out) const;
    mesh::CellMaps::Nodes weights_beyond(Mesh::Index cell, PointOnSide& on, const double* point, double* out) const;

private:
    /// Values of all components at nodes, one node after the other. Returns how many components there are.
    static std::size_t gather(std::span<const Mesh::Index> nodes, const std::vector<const Field*>& fields,
                              Scratch& scratch);
    struct Warped {
        Mesh::Index whole;
        std::uint8_t sides;  ///< a bit for each that is not flat
        bool uncut;          ///< no part of it holds a point
    };
    /// Where the sides of a mapped cell put a point: by a warped side, if the point is in the side's tetrahedron; for a
    /// cell without parts, if the point is in the cell.
    struct AtSides {
        std::size_t whole;
        bool outside;
        Feature feature;
    };
    MappedCells(const Mesh& mesh, bool products, Curved curved);
    bool has_shapes() const { return !mesh_.shapes.types.empty(); }
    std::size_t whole_count() const { return sign_.size(); }
    std::size_t whole(Mesh::Index cell) const {
        const auto c = static_cast<std::size_t>(cell);
        return has_shapes() ? static_cast<std::size_t>(whole_[c]) : c;
    }
    Mesh::Index first_part(std::size_t whole) const {
        return has_shapes() ? mesh_.shapes.parts[whole] : static_cast<Mesh::Index>(whole);
    }
    void arrange(const CellIndex& index);
    bool add_product(Place place, const NodeValues& values, Batch& to) const;
    bool add_tetrahedron(std::size_t whole, const PointRecord& point, const std::vector<const Field*>& fields,
                         Batch& to) const;
    base::PointBits bits_at(const double* point) const {
        return base::bits_of_point(point, static_cast<std::size_t>(mesh_.dimension));
    }
    const Location* node_at(const double* point) const;

    void find_curves();
    using NodeTable = std::unordered_map<base::PointBits, Location, base::HashOfBits>;
    NodeTable rounded_nodes() const;
    core::isoparametric::InSimplex in_curved(std::size_t whole, const double* point) const;
    void add_curved(const double* point, std::vector<Location>& found) const;
    /// One of order 2 that certainly has the point inside, among the first whose boxes hold it; or -1.
    Mesh::Index inside_on_lanes(const double* point) const;

    /// use(places of its nodes, bit of the side) for each side of four nodes.
    template <class Use>
    void for_sides(std::size_t whole, Use use) const;
    void find_sides();
    /// On which feature of a cell that has no parts a point lies that is in none of those tetrahedra.
    Feature feature_by_triangles(std::size_t whole, const double* point) const;
    std::vector<AtSides> at_sides(const double* point) const;
    /// As all_owners().
    void settle_all(const double* point, const std::vector<AtSides>& sides, std::vector<Location>& all) const;
    WeightSigns in_part(Mesh::Index cell, const double* point) const;
    std::uint64_t active_nodes(std::size_t whole, const double* point) const;

    const Mesh& mesh_;
    mesh::CellMaps maps_;
    bool products_, curves_ = false;
    std::vector<Mesh::Index> whole_;  ///< shape of each cell
    std::vector<std::int8_t> sign_;   ///< of each Jacobian; 0: no map
    // Cells on lanes that are no simplices, in the order of space: places of their nodes in the index. For each place
    // of a cell: twice its number among them, plus one if it is a wedge; -1 if it is none of them.
    struct alignas(32) LaneNodes {
        std::array<Place, 8> at;
    };
    Buffer<LaneNodes> lane_nodes_;
    std::vector<std::int32_t> lane_cell_;
    std::vector<std::uint8_t> lane_part_;  ///< which of its cell's parts is at that place
    std::vector<Warped> warped_;           ///< products with such sides, and those without parts
    std::unique_ptr<index::BoxTree> tree_;
    std::vector<mesh::SplitSide> split_sides_;
    std::unique_ptr<index::BoxTree> split_tree_;
    std::vector<Mesh::Index> curved_;  ///< wholes
    std::unique_ptr<index::BoxTree> curved_tree_;
    Lazy<NodeTable> nodes_;
    Lazy<MapBoundary> boundary_;
    std::uint64_t unproved_ = 0;
};

/// Cases on lanes: use(batch, lane, inside, proved) for each, when some are together.
template <class Use>
class MappedLanes {
public:
    MappedLanes(const MappedCells& cells, std::vector<const Field*> fields, const NodeValues& values, Use use)
        : cells_(cells), fields_(std::move(fields)), values_(values), use_(std::move(use)) {
        const std::size_t components = fields_.empty() ? 0 : values.components;
        for (std::size_t i = 0; i < batches_.size(); ++i) {
            batches_[i].element = static_cast<core::isoparametric::LaneElement>(i);
            batches_[i].values.assign(core::isoparametric::lane_nodes(batches_[i].element) * Batch::max * components,
                                      0);
            batches_[i].out.resize(Batch::max * components);
        }
    }
    /// False, and nothing done, for what is no such case. `settled`: that is its owner, not only that of a part.
    bool push(const Location& at, const PointRecord& point, Place place, bool settled) {
        if (!settled && cells_.is_near_split(point.at.data())) return false;
        for (Batch& batch : batches_) {
            batch.settled[batch.count] = settled;
            // On a side, or what would be one if the cell were straight.
            const bool curved = batch.element == core::isoparametric::LaneElement::tetrahedron;
            if (at.feature != Feature::interior && settled == curved) continue;
            if (!cells_.add(at, point, place, fields_, values_, batch)) continue;
            if (batch.count == Batch::max) flush(batch);
            return true;
        }
        return false;
    }
    void flush() {
        for (Batch& batch : batches_) flush(batch);
    }

private:
    using Batch = MappedCells::Batch;
    void flush(Batch& batch) {
        const core::isoparametric::LanesProved proved = batch.evaluate();
        const std::size_t count = std::exchange(batch.count, 0);
        for (std::size_t i = 0; i < count; ++i)
            use_(batch, i, (proved.inside >> i & 1U) != 0, (proved.values >> i & 1U) != 0);
    }

    const MappedCells& cells_;
    std::vector<const Field*> fields_;
    NodeValues values_;
    Use use_;
    std::array<Batch, 3> batches_;  ///< by element
};

}  // namespace barycert::locate
