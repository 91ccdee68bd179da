#include "job_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>

#include "barycert/gmsh_files.hpp"
#include "barycert/grid.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "job_process.hpp"
#include "sample_subject.hpp"

namespace barycert::bench {
namespace {

namespace fs = std::filesystem;

std::string read_all(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    require(file.good(), "cannot read " + path);
    std::ostringstream text;
    text << file.rdbuf();
    return std::move(text).str();
}

void write_all(const std::string& path, const std::string& bytes) {
    std::ofstream file(path, std::ios::binary);
    file << bytes;
    require(file.flush().good(), "cannot write " + path);
}

std::string as_bytes(const std::vector<double>& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double)};
}

std::string npy_of(const std::vector<double>& points) {
    std::string text =
        "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(points.size() / 3) + ", 3), }";
    text.resize(128 - 10, ' ');
    text.back() = '\n';
    std::string head = "\x93NUMPY";
    head += {'\1', '\0', static_cast<char>(text.size()), '\0'};
    return head + text + as_bytes(points);
}

std::string csv_of(const std::vector<double>& points) {
    std::string text = "x,y,z\n";
    for (std::size_t i = 0; i < points.size(); ++i) text += base::shortest(points[i]) + (i % 3 == 2 ? '\n' : ',');
    return text;
}

/// x, y, z float64, cell int64, feature of 8 bytes, attribute0 float64.
ReadRows npy_rows(const std::string& path) {
    const std::string bytes = read_all(path);
    const auto low = static_cast<unsigned char>(bytes[8]), high = static_cast<unsigned char>(bytes[9]);
    const std::size_t begin = 10U + low + 256U * high, size = 48;
    require(bytes.find("('attribute0', '<f8')]") < begin && (bytes.size() - begin) % size == 0,
            "other columns than expected in " + path);
    ReadRows rows;
    for (std::size_t at = begin; at < bytes.size(); at += size) {
        std::array<double, 3> point{};
        std::int64_t cell = 0;
        double value = 0;
        std::memcpy(point.data(), &bytes[at], 24);
        std::memcpy(&cell, &bytes[at + 24], 8);
        std::memcpy(&value, &bytes[at + 40], 8);
        require((cell < 0) == std::isnan(value), "a cell without a value in " + path);
        rows.points.insert(rows.points.end(), point.begin(), point.end());
        rows.values.push_back(value);
    }
    return rows;
}

std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream text(line);
    for (std::string field; std::getline(text, field, ',');) {
        std::erase_if(field, [](char c) { return c == '"' || c == '\r'; });
        fields.push_back(field);
    }
    return fields;
}

ReadRows csv_rows(const std::string& path) {
    std::istringstream text(read_all(path));
    std::string line;
    std::getline(text, line);
    const std::vector<std::string> names = fields_of(line);
    const auto column = [&](const char* name) {
        return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    };
    const std::array axes{column("x"), column("y"), column("z")};
    const std::size_t value = column("attribute0"), mask = column("vtkValidPointMask");
    ReadRows rows;
    while (std::getline(text, line)) {
        const std::vector<std::string> fields = fields_of(line);
        require(fields.size() == names.size() && value < fields.size(), "other columns than expected in " + path);
        for (const std::size_t axis : axes) rows.points.push_back(std::strtod(fields[axis].c_str(), nullptr));
        // VTK writes the mask as a character: that of code 1, or none.
        const bool inside = mask == fields.size() || fields[mask] == "\1";
        rows.values.push_back(inside ? std::strtod(fields[value].c_str(), nullptr)
                                     : std::numeric_limits<double>::quiet_NaN());
    }
    return rows;
}

}  // namespace

double field_at(const double* point) {
    return point[0] * 1.5 + point[1] * 2.5 - point[2];
}

void make_mesh_files(const JobFiles& files, Mesh mesh) {
    mesh.point_fields = {{"attribute0", 1, {}}};
    mesh.cell_fields.clear();
    mesh.point_markers.clear();
    for (std::size_t i = 0; i < mesh.point_count(); ++i)
        mesh.point_fields.front().data.push_back(field_at(mesh.points.data() + 3 * i));
    if (mesh.shapes.types.empty() && !fs::exists(files.stem + ".ele")) demand_done(write_tetgen(mesh, files.stem));
    if (!fs::exists(files.vtu())) demand_done(write_vtu(mesh, files.vtu()));
}

void make_point_files(const JobFiles& files, const Mesh& mesh, std::size_t count) {
    const std::string npy = files.points(count, ".npy"), csv = files.points(count, ".csv");
    const std::string vtp = files.points(count, ".vtp");
    if (fs::exists(npy) && fs::exists(csv) && (!with_vtk() || fs::exists(vtp))) return;
    const Bounds3 box = bounds_of_cells(mesh);
    base::Random random(20);
    std::vector<double> points(3 * count);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = random.uniform(box.low[i % 3], box.high[i % 3]);
    write_all(csv, csv_of(points));
    if (with_vtk()) {
        const std::string raw = files.points(count, ".raw");
        write_doubles(raw, points);
        run_process(vtk(1, "tree", {"pack", raw, vtp}));
        fs::remove(raw);
    }
    write_all(npy, npy_of(points));
}

Mesh with_bad_cells(Mesh mesh) {
    const Bounds3 box = bounds_of_cells(mesh);
    const auto inside = [&](Mesh::Index node) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double x = mesh.points[3 * static_cast<std::size_t>(node) + k];
            if (!(x > box.low[k] && x < box.high[k])) return false;
        }
        return true;
    };
    std::size_t cell = mesh.cell_count() / 2;
    const Mesh::Index* corner = nullptr;
    do {
        corner = mesh.cells.data() + 4 * cell++;
    } while (!std::all_of(corner, corner + 4, inside));
    for (std::size_t k = 0; k < 3; ++k) {
        const auto at = [&](std::size_t i) -> double& {
            return mesh.points[3 * static_cast<std::size_t>(corner[i]) + k];
        };
        at(0) = 2 * (at(1) + at(2) + at(3)) / 3 - at(0);
    }
    return mesh;
}

void write_doubles(const std::string& path, const std::vector<double>& numbers) {
    write_all(path, as_bytes(numbers));
}

std::vector<double> read_doubles(const std::string& path) {
    const std::string bytes = read_all(path);
    std::vector<double> numbers(bytes.size() / sizeof(double));
    std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
    return numbers;
}

ReadRows read_rows(const std::string& path) {
    return path.ends_with(".npy") ? npy_rows(path) : csv_rows(path);
}

bool with_vtk() {
#ifdef BARYCERT_JOB_VTK
    return true;
#else
    return false;
#endif
}

std::vector<std::string> vtk(int threads, const std::string& locator, const std::vector<std::string>& more) {
#ifdef BARYCERT_JOB_VTK
    std::vector<std::string> words{BARYCERT_JOB_VTK, std::to_string(threads), locator};
    words.insert(words.end(), more.begin(), more.end());
    return words;
#else
    static_cast<void>(threads + static_cast<int>(locator.size() + more.size()));
    return {};
#endif
}

}  // namespace barycert::bench
