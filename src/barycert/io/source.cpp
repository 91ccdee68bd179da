#include "barycert/io.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/io/formats.hpp"

namespace barycert::points {
namespace {

struct Suffix {
    std::string_view text;
    Format format;
};

constexpr std::array<Suffix, 4> suffixes{
    {{".csv", Format::csv}, {".npy", Format::npy}, {".node", Format::node}, {".vtu", Format::vtu}}};

class MemorySource final : public Source {
public:
    MemorySource(std::vector<double> points, int dimension)
        : points_(std::move(points)),
          dimension_(dimension),
          count_(points_.size() / static_cast<std::size_t>(dimension)) {}

    int dimension() const override { return dimension_; }
    std::optional<std::uint64_t> count() const override { return count_; }

    Result<std::size_t> read(std::size_t most, std::vector<double>& out) override {
        const std::size_t taken = std::min(most, count_ - next_);
        const auto size = static_cast<std::size_t>(dimension_);
        const double* const first = points_.data() + next_ * size;
        out.insert(out.end(), first, first + taken * size);
        next_ += taken;
        return taken;
    }

private:
    std::vector<double> points_;
    int dimension_;
    std::size_t count_;
    std::size_t next_ = 0;
};

}  // namespace

Source::~Source() = default;

Result<Format> format_of(const std::string& path) {
    if (path == "-") return Format::csv;
    std::string lower = path;
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const Suffix& suffix : suffixes) {
        if (lower.ends_with(suffix.text)) return suffix.format;
    }
    const std::size_t dot = lower.find_last_of("./");
    const bool has_suffix = dot != std::string::npos && lower[dot] == '.';
    return Error{.what = "a format that is not known by its suffix",
                 .file = path,
                 .expected = ".csv, .npy, .node or .vtu, or - for CSV from standard input or on standard output",
                 .found = has_suffix ? "'" + path.substr(dot) + "'" : "no suffix",
                 .remedy = "rename the file, or convert it"};
}

Result<std::unique_ptr<Source>> open_source(const std::string& path, int dimension) {
    const ExactEnvironment environment;
    if (dimension != 2 && dimension != 3) {
        return Error{.what = "points of an impossible dimension",
                     .file = path,
                     .expected = "2 or 3",
                     .found = std::to_string(dimension),
                     .remedy = {}};
    }
    const Result<Format> format = format_of(path);
    if (!format) return format.error();
    switch (*format) {
        case Format::csv:
            return open_csv_source(path, dimension);
        case Format::npy:
            return open_npy_source(path, dimension);
        case Format::node:
            return open_node_source(path, dimension);
        default:
            return Error{.what = "cannot read points from a VTU file here",
                         .file = path,
                         .expected = "a .csv, .npy or .node file",
                         .found = {},
                         .remedy = "build barycert with VTK, or save the points as CSV, as ParaView can"};
    }
}

std::unique_ptr<Source> memory_source(std::vector<double> points, int dimension) {
    return std::make_unique<MemorySource>(std::move(points), dimension);
}

}  // namespace barycert::points
