/// The cells of a mesh in the order of a space-filling curve, ready to be walked through.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"
#include "core/base/large_pages.hpp"
#include "mesh/index/bins.hpp"

namespace barycert::index {

/// A large array without a first value: `size` objects of a plain type that hold anything until they are written. Cache
/// lines are not shared with other objects, and large arrays ask for large pages: indexes are read at random.
template <class T>
class Buffer {
public:
    Buffer() = default;
    explicit Buffer(std::size_t size)
        : data_(static_cast<T*>(::operator new(size == 0 ? 1 : size * sizeof(T), alignment(size)))), size_(size) {
        base::ask_for_large_pages(data_.get(), size * sizeof(T));
        data_.get_deleter().alignment = alignment(size);
    }

    T* data() { return data_.get(); }
    const T* data() const { return data_.get(); }
    std::size_t size() const { return size_; }
    std::size_t bytes() const { return size_ * sizeof(T); }
    T& operator[](std::integral auto i) { return data_.get()[static_cast<std::size_t>(i)]; }
    const T& operator[](std::integral auto i) const { return data_.get()[static_cast<std::size_t>(i)]; }
    operator std::span<const T>() const { return {data(), size_}; }

private:
    static std::align_val_t alignment(std::size_t size) {
        return std::align_val_t{size * sizeof(T) >= base::large_page ? base::large_page : 64};
    }
    struct Delete {
        std::align_val_t alignment{64};
        void operator()(T* data) const { ::operator delete(data, alignment); }
    };
    std::unique_ptr<T, Delete> data_;
    std::size_t size_ = 0;
};

/// A cell or node as it is numbered here: what lies near in space mostly has near numbers, so that points in the same
/// order find what they need in cache.
using Place = std::int32_t;

/// Data of a cell that a step of a walk reads: half of a cache line. The last corner of a triangle repeats the first
/// one.
struct alignas(32) CellRecord {
    std::array<Place, 4> node;
    std::array<Place, 4> next;  ///< the cell across the facet opposite to each corner, -1 where there is none
};

/// One aligned load: coordinates (2D: z = 0), and room for a value.
struct alignas(32) NodeRecord {
    std::array<double, 3> at;
    double value;
};

struct CellIndex {
    Simplex simplex = Simplex::tetrahedron;
    std::array<double, 3> low{}, high{};  ///< the box of all cells, exactly
    Bins bins;                            ///< one to two a cell; of surfaces 64 to 128
    Buffer<CellRecord> cells;
    Buffer<Mesh::Index> original;  ///< cell of the mesh by place
    Buffer<NodeRecord> nodes;
    std::vector<Mesh::Index> original_node;  ///< node of the mesh by place; those of no cell have none
    /// By bin: a cell with its middle there, or in a bin near by; 0 if there is no cell. Empty of surfaces.
    Buffer<Place> start;
    const std::uint16_t* inside = nullptr;  ///< Mesh::Shapes::inside, where cells of the mesh are parts of others

    std::size_t dimension() const { return static_cast<std::size_t>(space_dimension(simplex)); }
    std::size_t corners() const { return static_cast<std::size_t>(vertex_count(simplex)); }
    std::size_t cell_count() const { return cells.size(); }
    std::size_t bytes() const;

    /// Where the corners of a cell stand.
    std::array<const double*, 4> corner_points(Place cell) const {
        std::array<const double*, 4> at{};
        const auto& node = cells[static_cast<std::size_t>(cell)].node;
        for (std::size_t i = 0; i < corners(); ++i) at[i] = nodes[static_cast<std::size_t>(node[i])].at.data();
        return at;
    }

    bool box_holds(const double* p) const {
        for (std::size_t k = 0; k < dimension(); ++k) {
            if (!(low[k] <= p[k] && p[k] <= high[k])) return false;
        }
        return true;
    }
};

/// The vertices of a cell, vertex after vertex (see Case).
std::array<double, 12> vertices_of(const CellIndex& index, Place cell);

/// Without neighbours, see link_facets. Requires: the mesh is consistent. Time O(cells), on the threads of the
/// calling arena, which do not change the outcome.
CellIndex make_cell_index(const Mesh& mesh);

/// The same of cells without a mesh, or triangles in space. Requires: their corners are points, and these are
/// finite. `wholes`: as Mesh::Shapes::parts, or empty.
CellIndex make_cell_index(Simplex simplex, std::span<const double> points, std::span<const Mesh::Index> cells,
                          std::span<const Mesh::Index> wholes = {});

}  // namespace barycert::index
