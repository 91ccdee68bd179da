// Hashes of results, one a line: the same on every processor, compiler and number of threads, or D1 is broken. Numbers
// are made by seed, from small integers to both ends of the range of doubles; meshes are read from the folder named.

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/grid.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/predicates.hpp"
#include "barycert/sampler.hpp"
#include "barycert/series.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "barycert/weights.hpp"
#include "core/base/random.hpp"

namespace barycert {
namespace {

class Hash {
public:
    void add(std::uint64_t word) { state_ = base::mix64(state_ ^ word) + 0x9e3779b97f4a7c15ULL; }
    void add(double x) {
        add(std::isnan(x) ? ~std::uint64_t{0} : std::bit_cast<std::uint64_t>(x));
    }  // NaN has many bit patterns
    void print(const std::string& name) const {
        std::printf("%-24s %016llx\n", name.c_str(), static_cast<unsigned long long>(state_));
    }

private:
    std::uint64_t state_ = 0;
};

using base::Random;

/// A number of one of five kinds; a whole case has the same kind.
double number(Random& random, std::uint64_t kind) {
    switch (kind) {
        case 0:
            return random.integer(-3, 3);
        case 1:
            return random.uniform(-1, 1);
        case 2:
            return 0.5 + random.integer(-2, 2) * 0x1p-53;
        case 3:
            return random.scaled(-1, 1, -1060, -900);
        default:
            return random.scaled(-1, 1, -40, 300);
    }
}

constexpr std::uint64_t cases = 4000;

template <class Work>
void for_cases(std::uint64_t stream, const Work& work) {
    for (std::uint64_t i = 0; i < cases; ++i) {
        Random random = Random::stream(1, stream, i);
        double x[32];
        for (double& one : x) one = number(random, i % 5);
        work(x, random);
    }
}

void predicates() {
    Hash hash;
    for_cases(1, [&](const double* x, Random&) {
        for (const Sign sign : {orient2d(x, x + 2, x + 4), orient3d(x, x + 3, x + 6, x + 9),
                                incircle(x, x + 2, x + 4, x + 6), insphere(x, x + 3, x + 6, x + 9, x + 12)})
            hash.add(static_cast<std::uint64_t>(static_cast<int>(sign) + 1));
    });
    hash.print("predicates");
}

/// One case at a time, and the same cases as a batch on SIMD lanes.
void weights(Simplex simplex, const std::string& name) {
    const auto n = static_cast<std::size_t>(vertex_count(simplex)),
               d = static_cast<std::size_t>(space_dimension(simplex));
    Hash single, batch;
    std::vector<double> nodes, points, values;
    std::vector<std::int32_t> corners, cells;
    for_cases(2, [&](double* x, Random& random) {
        double* const point = x + n * d;
        if (random.coin()) {  // on a boundary, or nearly
            for (std::size_t k = 0; k < d; ++k) point[k] = (x[k] + x[d + k]) / 2;
        }
        single.add(static_cast<std::uint64_t>(weight_signs(simplex, x, point).degenerate()));
        const Weights w = barycentric_weights(simplex, x, point).value();
        for (std::size_t i = 0; i < n; ++i) single.add(w.weights[i]);
        single.add(interpolate(simplex, x, point, x + 20).value().value);
        for (std::size_t i = 0; i < n; ++i) {
            corners.push_back(static_cast<std::int32_t>(corners.size()));
            values.push_back(x[20 + i]);
        }
        cells.push_back(static_cast<std::int32_t>(cells.size()));
        nodes.insert(nodes.end(), x, x + n * d);
        points.insert(points.end(), point, point + d);
    });
    single.print(name + ".single");
    const MeshQueries queries{simplex, nodes, corners, cells, points};
    std::vector<double> out(n * cases);
    barycentric_weights(queries, out).value();
    for (const double x : out) batch.add(x);
    out.resize(cases);
    interpolate(queries, NodalValues<double>{values}, out).value();
    for (const double x : out) batch.add(x);
    if (simplex == Simplex::triangle || simplex == Simplex::tetrahedron) {
        out.resize(d * cases);
        gradients(simplex, nodes, corners, {values}, out).value();
        for (const double x : out) batch.add(x);
    }
    batch.print(name + ".batch");
}

void add_rows(Hash& hash, const Table& rows) {
    for (const auto cell : rows.cells) hash.add(static_cast<std::uint64_t>(cell));
    for (const Feature feature : rows.features) hash.add(static_cast<std::uint64_t>(feature));
    for (const double x : rows.values) hash.add(x);
    for (const double x : rows.distances) hash.add(x);
}

/// Hashes answers at nodes of a mesh, at middles of two of them and elsewhere on their lines; and on a grid that
/// reaches beyond the mesh, cell by cell.
void mesh(const std::string& folder, const std::string& name) {
    Mesh mesh = read_mesh(folder + "/meshes/" + name).value();
    Hash hash, grid_hash;
    hash.add(static_cast<std::uint64_t>(check_mesh(mesh).certified()));
    // A field of its own, so that every mesh has one, of numbers that are hard to sum.
    Field field;
    field.name = "f";
    for (std::size_t i = 0; i < mesh.point_count(); ++i) {
        Random random = Random::stream(2, 0, i);
        field.data.push_back(random.scaled(-1, 1, -8, 8));
    }
    mesh.point_fields = {field};
    const Sampler sampler = Sampler::build(mesh, {"f", "grad(f)"}).value();
    std::vector<double> points;
    for (std::uint64_t i = 0; i < 600; ++i) {
        Random random = Random::stream(3, 0, i);
        const auto d = static_cast<std::size_t>(mesh.dimension);
        const std::size_t a = random.below(mesh.point_count()), b = random.below(mesh.point_count());
        for (std::size_t k = 0; k < d; ++k) {
            const double x = mesh.points[d * a + k], y = mesh.points[d * b + k];
            points.push_back(i % 3 == 0 ? x : i % 3 == 1 ? (x + y) / 2 : x + (y - x) * random.uniform(-0.2, 1.2));
        }
    }
    const Table rows = sampler.sample(points, {.outside = {.kind = Outside::nearest}}).value();
    add_rows(hash, rows);
    hash.print("mesh." + name);

    Bounds3 box = bounds_of_cells(mesh);
    for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] -= (box.high[k] - box.low[k]) / 16;
        box.high[k] += (box.high[k] - box.low[k]) / 32;
    }
    const Grid grid = grid_over(mesh.dimension, {27, 19, 17}, box.low, box.high).value();
    add_rows(grid_hash, resample(sampler, grid).value());
    grid_hash.print("grid." + name);
}

}  // namespace
}  // namespace barycert

int main(int argc, char** argv) {
    using namespace barycert;
    if (argc < 2 || argc > 3 || (argc == 3 && !use_simd_target(argv[2]))) {
        std::fprintf(stderr, "usage: %s FOLDER [TARGET]\nFOLDER has barycert's data; targets here:", argv[0]);
        for (const std::string& target : simd_targets()) std::fprintf(stderr, " %s", target.c_str());
        std::fprintf(stderr, "\n");
        return 2;
    }
    std::setvbuf(stdout, nullptr, _IOLBF, 4096);
    const Environment environment = measure_environment();
    std::fprintf(stderr, "SIMD %s\n", environment.simd.c_str());
    predicates();
    weights(Simplex::segment, "segment");
    weights(Simplex::triangle, "triangle");
    weights(Simplex::triangle3d, "triangle3d");
    weights(Simplex::tetrahedron, "tetrahedron");
    for (const char* name : {"plate", "cube-hole", "lattice-eighths", "needle-slit", "torus"}) mesh(argv[1], name);
}
