#include <array>
#include <utility>

#include "barycert/base/input_file.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/csv/csv_fields.hpp"
#include "barycert/io/csv/csv_layout.hpp"
#include "barycert/io/csv/line_reader.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/tetgen/scanner.hpp"

namespace barycert::io {
namespace {

class CsvSource final : public PointSource {
public:
    CsvSource(LineReader lines, int dimension) : lines_(std::move(lines)), dimension_(dimension) {}

    /// Reads up to the header or over the first point.
    Status begin();

    int dimension() const override { return dimension_; }
    std::optional<std::uint64_t> count() const override { return std::nullopt; }
    Result<std::size_t> read(std::size_t max, std::vector<double>& out) override;

private:
    bool parse(std::string_view line, std::array<double, 3>& point);
    Error row_error(std::string_view line) const;
    LinePlace place() const { return {lines_.name(), lines_.number()}; }
    void append(const std::array<double, 3>& point, std::vector<double>& out) const;

    LineReader lines_;
    int dimension_;
    CsvLayout layout_;
    bool cut_ = false;                            // the last row parsed ended with the file, and within a coordinate
    std::optional<std::array<double, 3>> first_;  // of a file without header, until it is read
    Error error_;
};

Status CsvSource::begin() {
    for (std::string_view line; lines_.next(line);) {
        if (!holds_fields(line, ' ')) continue;
        Result<CsvLayout> layout = settle_csv_layout(line, dimension_, place());
        if (!layout) return layout.error();
        layout_ = std::move(*layout);
        if (layout_.header) return Done{};
        if (!parse(line, first_.emplace())) return row_error(line);
        return Done{};
    }
    if (lines_.failed()) return lines_.error();
    return Error{.what = "the file is empty",
                 .file = lines_.name(),
                 .expected = "a header line or a point",
                 .found = lines_.number() == 0 ? "nothing" : "blank lines and comments",
                 .remedy = "write the file again; a file with a header only is a file without points"};
}

/// False if the line is no point, or may be the beginning of another one: 0.2 of 0.25.
bool CsvSource::parse(std::string_view line, std::array<double, 3>& point) {
    FieldCutter cutter(line, layout_.separator);
    const char* const cut = lines_.line_ended() ? nullptr : line.data() + line.size();
    bool at_cut = false;
    cut_ = false;
    const std::size_t fields = layout_.axis_of.size();
    std::size_t i = 0;
    for (std::string_view field; cutter.next(field); ++i) {
        if (i == fields) return false;
        const int axis = layout_.axis_of[i];
        if (axis < 0) continue;
        const char* const end = field.data() + field.size();
        double value = 0;
        if (barycert::io::scan_real(field.data(), end, value) != end) return false;
        point[static_cast<std::size_t>(axis)] = value;
        at_cut = end == cut;
    }
    if (i != fields || cutter.malformed()) return false;
    cut_ = at_cut;
    return !cut_;
}

Error CsvSource::row_error(std::string_view line) const {
    return cut_ ? base::unended_number(lines_.name(), lines_.number()) : csv_row_error(line, layout_, place());
}

void CsvSource::append(const std::array<double, 3>& point, std::vector<double>& out) const {
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension_); ++axis) out.push_back(point[axis]);
}

Result<std::size_t> CsvSource::read(std::size_t max, std::vector<double>& out) {
    const ExactEnvironment environment;
    if (!error_.what.empty()) return error_;
    std::size_t taken = 0;
    if (first_ && max != 0) {
        append(*first_, out);
        first_.reset();
        ++taken;
    }
    std::array<double, 3> point{};
    for (std::string_view line; taken != max && lines_.next(line);) {
        if (!holds_fields(line, layout_.separator)) continue;
        if (!parse(line, point)) {
            error_ = row_error(line);
            return error_;
        }
        append(point, out);
        ++taken;
    }
    if (lines_.failed()) return lines_.error();
    return taken;
}

}  // namespace

Result<std::unique_ptr<PointSource>> open_csv_source(const std::string& path, int dimension) {
    Result<LineReader> lines = LineReader::open(path);
    if (!lines) return lines.error();
    auto source = std::make_unique<CsvSource>(std::move(*lines), dimension);
    if (Status begun = source->begin(); !begun) return begun.error();
    return std::unique_ptr<PointSource>(std::move(source));
}

}  // namespace barycert::io
