#include <cstdint>
#include <memory>
#include <utility>

#include "barycert/io/vtk/point_rows.hpp"
#include "barycert/io/vtk_files.hpp"
#include "barycert/vtk.hpp"

namespace barycert {
namespace io {
namespace {

class VtuSink final : public TableSink {
public:
    VtuSink(std::string path, const TableFormat& format)
        : path_(std::move(path)), dimension_(format.dimension), distances_(format.distances) {
        for (const TableField& field : format.fields) fields_.push_back({field.name, field.components, {}});
    }

    Status write(const TableView& rows) override {
        points_.insert(points_.end(), rows.points.begin(), rows.points.end());
        cells_.insert(cells_.end(), rows.cells.begin(), rows.cells.end());
        features_.insert(features_.end(), rows.features.begin(), rows.features.end());
        away_.insert(away_.end(), rows.distances.begin(), rows.distances.end());
        for (const Mesh::Index cell : rows.cells) inside_.push_back(cell >= 0 ? 1 : 0);
        append_rows(rows, fields_);
        return Done{};
    }

    Status commit() override {
        PointRows rows{.dimension = dimension_,
                       .points = points_,
                       .cells = cells_,
                       .features = features_,
                       .inside = inside_,
                       .fields = std::move(fields_),
                       .distances = {}};
        if (distances_) rows.distances = away_;
        return write_vtk_points(path_, rows);
    }

private:
    std::string path_;
    int dimension_;
    bool distances_;
    std::vector<double> points_, away_;
    std::vector<Mesh::Index> cells_;
    std::vector<Feature> features_;
    std::vector<std::uint8_t> inside_;
    std::vector<Field> fields_;
};

Result<Mesh> read_vtk_mesh(const std::string& path) {
    return read_vtk(path);
}

}  // namespace

Result<std::unique_ptr<TableSink>> open_vtu_sink(const std::string& path, const TableFormat& format) {
    return std::unique_ptr<TableSink>(std::make_unique<VtuSink>(path, format));
}

}  // namespace io

void use_vtk_files() {
    static constexpr io::VtkFiles files{io::read_vtk_mesh, write_vtk, read_vtk_points, io::open_vtu_sink};
    io::set_vtk_files(&files);
}

}  // namespace barycert
