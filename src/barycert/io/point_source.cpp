#include "barycert/io.hpp"

#include <algorithm>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/vtk.hpp"

namespace barycert {
namespace {

class MemorySource final : public PointSource {
public:
    MemorySource(std::vector<double> points, int dimension)
        : points_(std::move(points)),
          dimension_(dimension),
          count_(points_.size() / static_cast<std::size_t>(dimension)) {}

    int dimension() const override { return dimension_; }
    std::optional<std::uint64_t> count() const override { return count_; }

    Result<std::size_t> read(std::size_t max_points, std::vector<double>& out) override {
        const std::size_t taken = std::min(max_points, count_ - next_);
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

PointSource::~PointSource() = default;

Result<std::unique_ptr<PointSource>> open_points(const std::string& path, int dimension) {
    const ExactEnvironment environment;
    if (dimension != 2 && dimension != 3) {
        return Error{.what = "points of an impossible dimension",
                     .file = path,
                     .expected = "2 or 3",
                     .found = std::to_string(dimension),
                     .remedy = {}};
    }
    if (io::is_vtk_points_file(path)) {
        Result<std::vector<double>> all = read_vtk_points(path, dimension);
        if (!all) return all.error();
        return memory_points(std::move(*all), dimension);
    }
    const Result<io::FileFormat> format = io::format_of(path);
    if (!format) return format.error();
    switch (*format) {
        case io::FileFormat::csv:
            return io::open_csv_source(path, dimension);
        case io::FileFormat::npy:
            return io::open_npy_source(path, dimension);
        default:
            return io::open_node_source(path, dimension);
    }
}

std::unique_ptr<PointSource> memory_points(std::vector<double> points, int dimension) {
    return std::make_unique<MemorySource>(std::move(points), dimension);
}

}  // namespace barycert
