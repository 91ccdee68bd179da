// Points from an NPY file.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "core/base/finite.hpp"
#include "core/base/text.hpp"
#include "io/errors.hpp"
#include "io/npy/npy.hpp"
#include "io/npy/npy_rows.hpp"
#include "io/parallel.hpp"
#include "io/streams.hpp"

namespace barycert::io {
namespace {

class NpySource final : public ColumnSource {
public:
    NpySource(const std::string& path, int dimension, const PointOptions& options)
        : ColumnSource(dimension),
          path_(path),
          file_(path),
          any_point_(options.nonfinite_points == NonfinitePoints::nan) {
        if (!file_.header().structured && options.columns.empty()) check_shape();
        const NpyTable& table = file_.make_table();
        rows_ = table.rows;
        const TableColumns all{base::names_of(table.columns), file_.header().structured, path_};
        PointColumns columns = choose_columns(all, dimension, options);
        notes_ = std::move(columns.notes);
        std::vector<std::size_t> places = columns.axes;
        if (columns.zero) places.push_back(*columns.zero);
        std::string widened;
        for (const std::size_t place : places) {
            const NpyColumn& column = table.columns[place];
            if (!column.type.is_number())
                refuse_file("column.type", path_, "cannot read points of that type",
                            "integers or floating-point numbers of at most 64 bits", base::quoted(column.type.text),
                            "save a.astype('f8')");
            if (!column.type.is_double()) widened = column.type.text;
            axes_.push_back(column);
        }
        if (!widened.empty())
            notes_.push_back({Note::Kind::converted, "coordinates of type " + widened + " to double, exactly", path_});
        for (PointColumns::Kept& kept : columns.kept) keep(table.columns[kept.column], std::move(kept.name));
        const NpyType& type = axes_.front().type;
        as_in_memory_ = !all.named && !table.by_columns && kept_.empty() && type.is_double() && !type.swapped &&
                        table.columns.size() == dimension_;
        for (std::size_t i = 0; i < places.size(); ++i) as_in_memory_ = as_in_memory_ && places[i] == i;
    }

    std::optional<std::uint64_t> count() const override { return rows_; }

private:
    /// Refuses an array without names, all of whose columns are coordinates, if its shape is another one.
    void check_shape() const {
        const std::vector<std::uint64_t>& shape = file_.header().shape;
        if (shape.size() == 2 && shape[1] == dimension_) return;
        const std::string d = std::to_string(dimension_);
        std::string remedy = "save an array with a row of " + d + " coordinates for each point";
        if (shape.size() == 1) remedy = "if it holds the coordinates point after point, save a.reshape(-1, " + d + ")";
        if (shape.size() == 2 && shape[1] > dimension_)
            remedy = "say which columns are the coordinates, such as options.columns 1,2" +
                     std::string(dimension_ == 3 ? ",3" : "");
        if (shape.size() == 2 && shape[0] == dimension_ && shape[1] != dimension_ + 1)
            remedy = "if it has a column for each point, save a.T";
        throw Exception(about("options.columns", file_error("point.dimension", path_, "an array of another shape",
                                                            "(n, " + d + "), for the mesh is " + d + "-dimensional",
                                                            as_tuple(shape), std::move(remedy))));
    }

    void keep(const NpyColumn& column, std::string name) {
        const NpyType& type = column.type;
        ColumnFormat format{std::move(name), Column::Type::text};
        if (type.is_integer()) format.type = Column::Type::integer;
        if (type.kind == 'f') format.type = Column::Type::number;
        if (type.is_number() && (type.size != 8 || type.kind == 'u'))
            notes_.push_back({Note::Kind::converted,
                              "column " + column.name + " of type " + type.text +
                                  (type.kind == 'f' ? " to double, exactly" : " to int64, exactly"),
                              path_});
        if (type.is_text()) format.max_bytes = type.size;
        if (type.kind == 'U') format.max_characters = std::max<std::size_t>(1, type.size / 4);
        if (!type.is_number() && !type.is_text())
            throw Exception(about(
                "options.keep",
                file_error("column.type", path_, "column " + base::quoted(column.name) + " cannot be carried through",
                           "integers, floating-point numbers or texts", base::quoted(type.text),
                           "leave it out of options.keep, or save it as another type")));
        kept_.push_back(column);
        formats_.push_back(std::move(format));
    }

    void read_rows(std::span<double> points) {
        const auto name = [](const NpyColumn& column) { return "column " + base::quoted(column.name); };
        const std::size_t at_once = file_.rows_at_once(), taken = points.size() / dimension_;
        for (std::size_t done = 0, size = 0; done < taken; done += size) {
            size = std::min(at_once, taken - done);
            file_.go_to(next_ + done, size);
            const std::span<double> some = points.subspan(done * dimension_, size * dimension_);
            for (std::size_t axis = 0; axis < dimension_; ++axis)
                file_.numbers(axes_[axis], name(axes_[axis]), some.data() + axis, dimension_);
            // Beside a mesh in the plane. A point that is not finite anyway may lie anywhere.
            if (axes_.size() > dimension_) {
                heights_.resize(size);
                file_.numbers(axes_.back(), name(axes_.back()), heights_.data(), 1);
            }
            for (std::size_t i = 0; i < heights_.size(); ++i) {
                if (heights_[i] != 0 && base::all_finite(some.subspan(dimension_ * i, dimension_)))
                    refuse_off_plane(path_, "row " + std::to_string(next_ + done + i) + ", counted from 0",
                                     base::shortest(heights_[i]));
            }
            for (std::size_t k = 0; k < kept_.size(); ++k) file_.values(kept_[k], name(kept_[k]), carried_[k]);
        }
    }

    std::size_t next(std::size_t max, std::vector<double>& out) override {
        const std::size_t taken = std::min<std::uint64_t>(max, rows_ - next_), before = out.size();
        grow(out, taken * dimension_);
        const std::span<double> points = std::span(out).subspan(before);
        try {
            if (as_in_memory_ && taken != 0) {
                file_.read(next_ * dimension_ * sizeof(double),
                           {reinterpret_cast<char*>(points.data()), points.size_bytes()});
            } else {
                read_rows(points);
            }
            const bool good = any_point_ || base::all_finite(points);
            if (const std::size_t i = good ? points.size() : base::first_not_finite(points); i != points.size())
                throw Exception(about(
                    nonfinite_points,
                    file_error("point.not-finite", path_, "a point that is not finite", "finite coordinates",
                               base::shortest(points[i]) + " at [" + std::to_string(next_ + i / dimension_) + ", " +
                                   std::to_string(i % dimension_) + "]",
                               std::string("remove the point: a[numpy.isfinite(a).all(axis=1)]") + or_nan_for_it)));
        } catch (const Exception&) {
            out.resize(before);
            throw;
        }
        next_ += taken;
        return taken;
    }

    std::string path_;
    NpyFile file_;
    std::uint64_t rows_ = 0;
    bool as_in_memory_ = false;    // the array is what is asked for, number by number
    std::vector<NpyColumn> axes_;  // and perhaps a z that must be 0
    std::vector<NpyColumn> kept_;
    std::vector<double> heights_;
    bool any_point_;  // those that are not finite, too
    std::uint64_t next_ = 0;
};

}  // namespace

std::unique_ptr<PointSource> open_npy_source(const std::string& path, int dimension, const PointOptions& options) {
    return std::make_unique<NpySource>(path, dimension, options);
}

}  // namespace barycert::io
