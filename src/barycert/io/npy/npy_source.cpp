// Points from an NPY file.

#include <algorithm>
#include <cmath>
#include <utility>

#include "barycert/base/finite.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/npy/npy_file.hpp"
#include "barycert/io/point_columns.hpp"
#include "barycert/io/streams.hpp"

namespace barycert::io {
namespace {

class NpySource final : public ColumnSource {
public:
    NpySource(std::string path, int dimension) : ColumnSource(dimension), path_(std::move(path)) {}

    Status begin(const PointOptions& options);

    std::optional<std::uint64_t> count() const override { return table_.rows; }

private:
    Result<std::size_t> next(std::size_t max, std::vector<double>& out) override;
    Status choose(const PointOptions& options);
    Status keep(const NpyColumn& column, std::string name);
    Error shape_error(const std::vector<std::uint64_t>& shape) const;
    Status check_heights(std::uint64_t first, const double* points) const;
    Status read_rows(std::size_t taken, double* points);

    std::string path_;
    NpyFile file_;
    NpyTable table_;
    bool as_in_memory_ = false;    // the array is what is asked for, number by number
    std::vector<NpyColumn> axes_;  // and perhaps a z that must be 0
    std::vector<NpyColumn> kept_;
    std::vector<double> heights_;
    bool any_point_ = false;  // those that are not finite, too
    std::uint64_t next_ = 0;
};

Error NpySource::shape_error(const std::vector<std::uint64_t>& shape) const {
    const std::string d = std::to_string(dimension_);
    std::string remedy = "save an array with a row of " + d + " coordinates for each point";
    if (shape.size() == 1) remedy = "if it holds the coordinates point after point, save a.reshape(-1, " + d + ")";
    if (shape.size() == 2 && shape[1] > dimension_)
        remedy = "say which columns are the coordinates, such as options.columns 1,2" +
                 std::string(dimension_ == 3 ? ",3" : "");
    if (shape.size() == 2 && shape[0] == dimension_ && shape[1] != dimension_ + 1)
        remedy = "if it has a column for each point, save a.T";
    return file_error(path_, "an array of another shape", "(n, " + d + "), for the mesh is " + d + "-dimensional",
                      as_tuple(shape), std::move(remedy));
}

Status NpySource::begin(const PointOptions& options) {
    Result<NpyFile> file = NpyFile::open(path_);
    if (!file) return file.error();
    file_ = std::move(*file);
    any_point_ = options.nonfinite_points == NonfinitePoints::nan;
    const NpyHeader& header = file_.header();
    const bool asked = header.structured || !options.columns.empty();
    Result<NpyTable> table = file_.table();
    if (!asked && (header.shape.size() != 2 || header.shape[1] != dimension_)) return shape_error(header.shape);
    if (!table) return table.error();
    table_ = std::move(*table);
    return choose(options);
}

/// Which columns are what.
Status NpySource::choose(const PointOptions& options) {
    TableColumns all{.names = {}, .named = table_.structured, .file = path_};
    for (const NpyColumn& column : table_.columns) all.names.push_back(column.name);
    Result<PointColumns> columns = choose_columns(all, dimension(), options);
    if (!columns) return columns.error();
    notes_ = std::move(columns->notes);
    std::vector<std::size_t> places = columns->axes;
    if (columns->zero) places.push_back(*columns->zero);
    std::string widened;
    for (const std::size_t place : places) {
        const NpyColumn& column = table_.columns[place];
        if (!column.type.is_number())
            return file_error(path_, "cannot read points of that type",
                              "integers or floating-point numbers of at most 64 bits", base::quoted(column.type.text),
                              "save a.astype('f8')");
        if (column.type.kind != 'f' || column.type.size != 8) widened = column.type.text;
        axes_.push_back(column);
    }
    if (!widened.empty())
        notes_.push_back({Note::Kind::converted, "coordinates of type " + widened + " to double, exactly", path_});
    for (PointColumns::Kept& kept : columns->kept) {
        if (Status can = keep(table_.columns[kept.column], std::move(kept.name)); !can) return can;
    }
    const NpyType& type = axes_.front().type;
    as_in_memory_ = !table_.structured && !table_.by_columns && kept_.empty() && type.kind == 'f' && type.size == 8 &&
                    !type.swapped && table_.columns.size() == dimension_;
    for (std::size_t i = 0; i < places.size(); ++i) as_in_memory_ = as_in_memory_ && places[i] == i;
    return Done{};
}

Status NpySource::keep(const NpyColumn& column, std::string name) {
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
        return file_error(path_, "column " + base::quoted(column.name) + " cannot be carried through",
                          "integers, floating-point numbers or texts", base::quoted(type.text),
                          "leave it out of options.keep, or save it as another type");
    kept_.push_back(column);
    formats_.push_back(std::move(format));
    return Done{};
}

/// Beside a mesh in the plane. A point that is not finite anyway may lie anywhere.
Status NpySource::check_heights(std::uint64_t first, const double* points) const {
    for (std::size_t i = 0; i < heights_.size(); ++i) {
        if (heights_[i] != 0 && base::all_finite({points + dimension_ * i, dimension_}))
            return off_plane(path_, 0, "row " + std::to_string(first + i) + ", counted from 0",
                             base::shortest(heights_[i]));
    }
    return Done{};
}

/// The next `taken` points, and what is carried through with them.
Status NpySource::read_rows(std::size_t taken, double* points) {
    const std::size_t at_once = NpyFile::rows_at_once(table_);
    for (std::size_t done = 0; done < taken;) {
        const std::size_t size = std::min(at_once, taken - done);
        Status read = file_.go_to(table_, next_ + done, size);
        for (std::size_t axis = 0; axis < dimension_ && read; ++axis)
            read = file_.numbers(axes_[axis], "column " + base::quoted(axes_[axis].name),
                                 points + done * dimension_ + axis, dimension_);
        if (axes_.size() > dimension_ && read) {
            heights_.resize(size);
            read = file_.numbers(axes_.back(), "column " + base::quoted(axes_.back().name), heights_.data(), 1);
            if (read) read = check_heights(next_ + done, points + done * dimension_);
        }
        for (std::size_t k = 0; k < kept_.size() && read; ++k)
            read = file_.values(kept_[k], "column " + base::quoted(kept_[k].name), carried_[k]);
        if (!read) return read;
        done += size;
    }
    return Done{};
}

Result<std::size_t> NpySource::next(std::size_t max, std::vector<double>& out) {
    const std::size_t taken = std::min<std::uint64_t>(max, table_.rows - next_);
    const std::size_t before = out.size();
    out.resize(before + taken * dimension_);
    double* const points = out.data() + before;
    Status read = Done{};
    if (as_in_memory_ && taken != 0) {
        read = file_.read(next_ * dimension_ * sizeof(double),
                          {reinterpret_cast<char*>(points), taken * dimension_ * sizeof(double)});
    } else {
        read = read_rows(taken, points);
    }
    const bool finite = any_point_ || (read && base::all_finite({points, taken * dimension_}));
    for (std::size_t i = 0; i < taken * dimension_ && read && !finite; ++i) {
        if (std::isfinite(points[i])) continue;
        read = file_error(path_, "a point that is not finite", "finite coordinates",
                          base::shortest(points[i]) + " at [" + std::to_string(next_ + i / dimension_) + ", " +
                              std::to_string(i % dimension_) + "]",
                          std::string("remove the point: a[numpy.isfinite(a).all(axis=1)]") + or_nan_for_it);
    }
    if (!read) {
        out.resize(before);
        return read.error();
    }
    next_ += taken;
    return taken;
}

}  // namespace

Result<std::unique_ptr<PointSource>> open_npy_source(const std::string& path, int dimension,
                                                     const PointOptions& options) {
    return begun<PointSource>(std::make_unique<NpySource>(path, dimension), options);
}

}  // namespace barycert::io
