/// Parts that the sources of barycert._core share. barycert/*.py makes from them what Python users see: it checks and
/// converts arguments; these functions take arrays as they are.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <type_traits>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/sampler.hpp"
#include "barycert/series.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"

namespace barycert::python {

namespace py = pybind11;

void bind_mesh(py::module_& module);
void bind_points(py::module_& module);
void bind_check(py::module_& module);
void bind_simplex(py::module_& module);
void bind_surface(py::module_& module);
void bind_figure(py::module_& module);
void bind_audit(py::module_& module);

/// Arguments that are words in Python; any other word is an Error. Entries without a word do not count.
template <class T>
struct Words {
    const char* what;
    std::array<std::pair<std::string_view, T>, 5> all;

    T at(std::string_view word) const {
        std::string expected;
        for (std::size_t i = 0; i < all.size() && !all[i].first.empty(); ++i) {
            if (all[i].first == word) return all[i].second;
            const bool last = i + 1 == all.size() || all[i + 1].first.empty();
            expected.append(i == 0 ? "" : last ? " or " : ", ").append(all[i].first);
        }
        throw Exception(
            {.code = "option.value", .what = what, .expected = std::move(expected), .found = std::string(word)});
    }
};
template <class T>
inline constexpr Words<T> words{};
/// The words are the values' names.
template <class T, class... More>
constexpr Words<T> named(const char* what, T first, More... more) {
    return {what, {{{name(first), first}, {name(more), more}...}}};
}

template <>
inline constexpr Words<Outside> words<Outside>{"what points outside get (outside=)",
                                               {{{"nan", Outside::nan},
                                                 {"raise", Outside::error},
                                                 {"fill", Outside::fill},
                                                 {"nearest", Outside::nearest},
                                                 {"extrapolate", Outside::extrapolate}}}};
template <>
inline constexpr Words<NonfinitePoints> words<NonfinitePoints>{
    "what points that are not finite get (nonfinite_points=)",
    {{{"error", NonfinitePoints::error}, {"nan", NonfinitePoints::nan}}}};
template <>
inline constexpr Words<Rounding> words<Rounding>{"rounding of values (rounding=)",
                                                 {{{"correct", Rounding::correct}, {"plain", Rounding::plain}}}};

// Arrays of NumPy as spans, and vectors as arrays of NumPy, without copies.

template <class T>
using Array = py::array_t<T, py::array::c_style>;

/// An array that the Python part hands over: contiguous and of this type; any other array is a TypeError, never a
/// hidden copy.
template <class T>
struct Given : Array<T> {
    using Array<T>::Array;

    std::size_t rows() const { return static_cast<std::size_t>(this->shape(0)); }
    std::size_t columns() const { return this->ndim() < 2 ? 1 : static_cast<std::size_t>(this->shape(1)); }
    std::span<const T> all() const { return {this->data(), static_cast<std::size_t>(this->size())}; }
    std::vector<T> copy() const { return {all().begin(), all().end()}; }
    /// Rows [first, first + n).
    std::span<const T> part(std::size_t first, std::size_t n) const {
        return all().subspan(columns() * first, columns() * n);
    }
};

using Shape = std::vector<std::size_t>;

/// Keeps a thing alive as long as an array that looks at it.
template <class T>
py::capsule keeper(T&& thing) {
    auto keep = std::make_unique<T>(std::move(thing));
    py::capsule owner(keep.get(), [](void* p) { delete static_cast<T*>(p); });
    (void)keep.release();
    return owner;
}

/// The shape of rows of so many columns; 0: one axis.
inline Shape shape_of(std::size_t size, std::size_t columns) {
    return columns == 0 ? Shape{size} : Shape{size / columns, columns};
}

/// An array that owns the vector. Features become their numbers.
template <class T>
py::array owned(std::vector<T>&& numbers, std::size_t columns = 0) {
    using Number = std::conditional_t<std::is_enum_v<T>, std::uint8_t, T>;
    static_assert(sizeof(Number) == sizeof(T));
    Shape shape = shape_of(numbers.size(), columns);
    const auto* const data = reinterpret_cast<const Number*>(numbers.data());
    return Array<Number>(std::move(shape), data, keeper(std::move(numbers)));
}

/// An array that looks at memory which `owner` keeps; it cannot be written to.
template <class T>
py::array view(const std::vector<T>& numbers, std::shared_ptr<const void> owner, std::size_t columns = 0) {
    Array<T> array(shape_of(numbers.size(), columns), numbers.data(), keeper(std::move(owner)));
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

/// The first n of all.
template <class All>
py::tuple tuple_of(const All& all, std::size_t n) {
    py::tuple tuple(n);
    for (std::size_t i = 0; i < n; ++i) tuple[i] = all[i];
    return tuple;
}

/// make(item) of each.
template <class Items, class Make>
py::list list_of(const Items& items, const Make& make) {
    py::list list;
    for (const auto& item : items) list.append(make(item));
    return list;
}

// Long work: without the interpreter's lock, with Ctrl-C and progress between blocks.

/// Who is told of progress: None, or a callable of (stage, done, total); total 0: not counted.
using Progress = std::optional<py::function>;

/// To be called without the lock. Throws what a signal handler or the callable raised.
inline void tell(const Progress& progress, std::string_view stage, std::size_t done, std::size_t total) {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress) (*progress)(py::str(stage.data(), stage.size()), done, total);
}

/// Returns work(), called without the interpreter's lock.
template <class Work>
auto unlocked(const Work& work) {
    const py::gil_scoped_release released;
    return work();
}

/// All begins with few.
constexpr std::size_t few = 4096;

/// Many points that cost next to nothing begin with so many that sorting them pays.
inline std::size_t first_block(const Locator& locator, std::size_t points) {
    constexpr std::size_t many = 50000;
    return points >= many && locator.certified() ? std::size_t{1} << 20 : few;
}

/// body(first, count) for parts of [0, total), without the lock. Parts grow and shrink such that one takes some tenths
/// of a second, after which Ctrl-C is noticed; none but the only one is smaller than `least`. A Status that a body
/// returns counts points from the first of the part: an Error is asked for again of all points up to there.
template <class Body>
void in_blocks(const Progress& progress, std::string_view stage, std::size_t total, const Body& body,
               std::size_t size = few, std::size_t least = 64) {
    using Clock = std::chrono::steady_clock;
    using std::chrono_literals::operator""ms;
    const py::gil_scoped_release unlocked;
    for (std::size_t first = 0; first < total;) {
        const std::size_t rest = total - first, count = rest < size + least ? rest : size;
        const Clock::time_point begin = Clock::now();
        if constexpr (std::is_void_v<decltype(body(first, count))>) {
            body(first, count);
        } else if (!body(first, count)) {
            body(0, first + count).value();
        }
        const Clock::duration taken = Clock::now() - begin;
        first += count;
        tell(progress, stage, first, total);
        if (taken < 50ms) size *= 4;
        if (taken > 400ms) size = std::max(size / 4, least);
    }
}

// A mesh as Python holds it: its geometry, shared and never changed; its locator, made when it is first needed; and its
// fields, of which every sampler keeps those that it was made with.

/// A mesh without fields, or a surface.
template <class Data, class Locator>
struct Located {
    Data data;
    BuildOptions options{.prove = Prove::when_it_pays, .progress = {}};  ///< of the locator, before it is made

    explicit Located(Data all = {}) : data(std::move(all)) {}

    /// Made once, by the thread that asks first; the others wait.
    const Locator& locator(const Progress& progress) {
        const py::gil_scoped_release unlocked;
        const std::lock_guard once(making_);
        if (!locator_) {
            BuildOptions told = options;
            told.progress = [&](const char* stage) { tell(progress, stage, 0, 0); };
            locator_ = Locator::build(data, told).value();
        }
        return *locator_;
    }

private:
    std::mutex making_;
    std::optional<Locator> locator_;
};
using Geometry = Located<Mesh, Locator>;

/// A report with the mesh that it is of, which is empty if it is of a surface.
struct BoundReport {
    std::shared_ptr<Geometry> geometry;
    CheckReport report;
};

/// A sampler with all that it refers to.
struct BoundSampler {
    std::shared_ptr<Geometry> geometry;
    std::shared_ptr<const Mesh> fields;
    Sampler sampler;
};

class MeshObject {
public:
    explicit MeshObject(Mesh mesh);

    const std::shared_ptr<Geometry>& geometry() const { return geometry_; }
    const Mesh& mesh() const { return geometry_->data; }
    std::size_t dimension() const { return static_cast<std::size_t>(mesh().dimension); }
    Simplex simplex() const { return mesh().dimension == 2 ? Simplex::triangle : Simplex::tetrahedron; }
    const Locator& locator(const Progress& progress) const { return geometry_->locator(progress); }

    /// A mesh that has the fields alone, and what names of quantities need to know.
    std::shared_ptr<const Mesh> fields() const { return fields_; }
    /// To be changed.
    std::vector<Field>& fields(bool of_cells);

    /// The mesh with its fields: a copy.
    Mesh whole() const {
        Mesh all = mesh();
        all.point_fields = fields_->point_fields;
        all.cell_fields = fields_->cell_fields;
        return all;
    }

    /// Returns the sampler of the fields with these names, or of all; keeps the last one.
    std::shared_ptr<BoundSampler> sampler(const std::vector<std::string>& names, const Progress& progress);
    /// Returns the sampler of values at the nodes that are no field of the mesh; or of none.
    std::shared_ptr<BoundSampler> sampler_of(const std::optional<Given<double>>& values,
                                             const Progress& progress) const;

private:
    std::shared_ptr<Geometry> geometry_;
    std::shared_ptr<Mesh> fields_;
    std::vector<std::string> last_names_;
    std::shared_ptr<BoundSampler> last_;
};

}  // namespace barycert::python

namespace pybind11::detail {

template <class T>
struct pyobject_caster<barycert::python::Given<T>> {
    PYBIND11_TYPE_CASTER(barycert::python::Given<T>, const_name("numpy.ndarray"));
    bool load(handle from, bool) {
        if (!barycert::python::Array<T>::check_(from)) return false;
        value = reinterpret_borrow<barycert::python::Given<T>>(from);
        return true;
    }
};

template <class T>
requires(std::is_enum_v<T> && !barycert::python::words<T>.all[0].first.empty()) struct type_caster<T> {
    PYBIND11_TYPE_CASTER(T, const_name("str"));
    bool load(handle from, bool convert) {
        make_caster<std::string> word;
        if (!word.load(from, convert)) return false;
        value = barycert::python::words<T>.at(cast_op<std::string&>(word));
        return true;
    }
};

}  // namespace pybind11::detail
