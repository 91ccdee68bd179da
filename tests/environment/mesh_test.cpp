// Public entries that take a mesh: check, locate, sample, resample, files, reports, audit. A mesh of ordinary size and
// one of subnormal numbers, with fields of both; in every floating-point environment, on one thread and on two.
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "barycert/audit.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/contour_job.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/figure.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/gaps.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/grid.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/job.hpp"
#include "barycert/kernels.hpp"
#include "barycert/locator.hpp"
#include "barycert/map.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/mutants.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/render_job.hpp"
#include "barycert/report.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/sampler.hpp"
#include "barycert/series.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_locator.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/threshold.hpp"
#include "barycert/verify.hpp"
#include "barycert/verify_job.hpp"
#include "barycert/vtk_files.hpp"
#include "barycert/witness.hpp"
#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "io/vti/vti.hpp"
#include "tests/core/same_everywhere.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/curved_mesh.hpp"

namespace barycert::testing {
namespace {

using testing_environments::Answers;
using testing_environments::expect_same_everywhere;

constexpr double unit = 0x1p-1074;

struct Subject {
    std::string name;
    Mesh mesh;
    double scale = 1;  ///< of a lattice cell
};

/// Fields of ordinary and of subnormal numbers at nodes and cells; a lattice whose nodes are moved a little, in units
/// of the smallest double or of 1/16; and a copy of it with a cell turned over and a node moved too far.
std::vector<Subject> subjects() {
    std::vector<Subject> all;
    for (const int d : {2, 3}) {
        for (const double scale : {unit, 0x1p-1026, 1.0}) {
            base::Random random(static_cast<std::uint64_t>(d));
            Mesh mesh = box(d, {4, 3, 3});
            for (double& x : mesh.points) {
                const double moved = 16 * x + random.integer(-3, 3);
                x = moved * scale;
            }
            Field one{"one", 1, {}}, two{"two", 2, {}}, cell{"cell", 1, {}};
            for (std::size_t i = 0; i < mesh.point_count(); ++i) {
                one.data.push_back(random.integer(-9, 9) * unit);
                two.data.push_back(random.uniform(-1, 1));
                two.data.push_back(random.integer(-9, 9) * 0x1p-1030);
            }
            for (std::size_t i = 0; i < mesh.cell_count(); ++i) cell.data.push_back(random.integer(-9, 9) * unit);
            mesh.point_fields = {one, two};
            mesh.cell_fields = {cell};
            const std::string name = std::to_string(d) + "D, " + base::hexadecimal(scale);
            all.push_back({name, mesh, scale});
            mesh.points[0] = 40 * scale;
            all.push_back({name + ", folded", mesh, scale});
        }
    }
    return all;
}

/// Lattice points, in and around the mesh: many on faces, edges and nodes.
std::vector<double> points_around(const Subject& s, std::size_t count) {
    base::Random random(17);
    std::vector<double> points;
    for (std::size_t i = 0; i < count * static_cast<std::size_t>(s.mesh.dimension); ++i)
        points.push_back(random.integer(-8, 72) * s.scale);
    return points;
}

void add(Answers& out, const TierCounts& t) {
    for (const std::uint64_t n : {t.filter, t.double_double, t.exact, t.degenerate, t.not_finite}) out.add(n);
}

void add(Answers& out, const LocationCounts& n) {
    for (const std::uint64_t x : {n.interior, n.face, n.edge, n.vertex, n.outside}) out.add(x);
    add(out, n.tests);
}

void add(Answers& out, const SampleCounts& n) {
    add(out, n.locations);
    add(out, n.values);
    for (const std::uint64_t x : {n.snapped, n.extrapolated, n.without_value}) out.add(x);
    out.add(n.farthest);
}

void add(Answers& out, const CheckReport& r) {
    out.add(static_cast<int>(r.certificate.verdict()));
    for (const Defect& f : r.defects) {
        out.add(static_cast<int>(f.kind));
        out.add(f.count);
        for (const DefectPlace& p : f.places) {
            for (const Mesh::Index c : p.cells) out.add(c);
            for (const Mesh::Index n : p.nodes) out.add(n);
            out.add(std::string_view(p.detail));
        }
    }
    for (const std::uint64_t n : {r.positive, r.negative, r.degenerate, r.parts}) out.add(n);
    out.add(r.volume.cells);
    out.add(r.volume.boundary);
    out.add(r.volume.equal);
    for (const auto* m : {&r.measures.volume, &r.measures.condition, &r.measures.radius_edge, &r.measures.aspect,
                          &r.measures.min_angle, &r.measures.max_angle}) {
        out.add_all(*m);
        const Distribution d = distribution(*m);
        for (const double x : {d.min, d.median, d.max}) out.add(x);
    }
    for (const CellContact& c : r.contacts) {
        out.add(c.dimension);
        out.add(c.common.exact);
        for (std::size_t k = 0; k < static_cast<std::size_t>(r.dimension); ++k) {
            out.add(c.common.point[k]);
            out.add(std::string_view(c.common.fraction[k]));
        }
    }
    if (r.delaunay) {
        for (const std::uint64_t n : {r.delaunay->facets, r.delaunay->violations, r.delaunay->cospherical}) out.add(n);
        out.add(r.delaunay->worst_depth);
    }
}

TEST(EveryEnvironment, CurvedCells) {
    for (const double scale : {unit, 0x1p-1026, 1.0, 0x1p+1000}) {
        Mesh mesh = testing::curved_ball(3);
        for (std::size_t i = 0; i < mesh.points.size(); ++i)
            mesh.points[i] = scale * std::round(64 * mesh.points[i] + static_cast<double>(i % 2));
        EXPECT_GT(curved_cells(mesh).cells, 0U) << scale;
        expect_same_everywhere("curved cells", [&](Answers& out) {
            std::vector<std::uint8_t> each;
            const CurvedCells curved = curved_cells(mesh, &each);
            for (const std::uint64_t n : {curved.cells, curved.rounded_cells}) out.add(n);
            for (const double x : {curved.max_deviation, curved.max_rounded}) out.add(x);
            for (const std::uint8_t one : each) out.add(std::uint64_t{one});
            const auto straight = measure_curved(mesh, "mesh", Curved::refuse);
            out.add(std::string_view(straight ? "" : straight.error().message()));
            out.add(std::string_view(message(curved)));
        });
    }
}

TEST(EveryEnvironment, Check) {
    for (const Subject& s : subjects()) {
        for (const int threads : {1, 2}) {
            expect_same_everywhere("check of " + s.name, [&](Answers& out) {
                CheckOptions options;
                options.threads = threads;
                options.delaunay = true;
                CheckReport report = check_mesh(s.mesh, options);
                add(out, report);
                report.seconds = 0;
                report.threads = 1;
                out.add(std::string_view(check_json(report, "mesh", {})));
                out.add(std::string_view(check_text(report, s.mesh, "mesh", {})));
                out.add(std::string_view(check_html(report, s.mesh, "mesh")));
                const CiReport ci = check_outcomes(report, s.mesh, "mesh", "", {});
                for (const auto& text : {ci_junit(ci), ci_sarif(ci), ci_annotations(ci)})
                    out.add(std::string_view(text));
            });
        }
    }
    const std::vector<Subject> all = subjects();
    EXPECT_TRUE(check_mesh(all[0].mesh).certified()) << all[0].name;
    EXPECT_FALSE(check_mesh(all[1].mesh).certified()) << all[1].name;
}

TEST(EveryEnvironment, Locate) {
    for (const Subject& s : subjects()) {
        const std::vector<double> points = points_around(s, 20000);
        const auto d = static_cast<std::size_t>(s.mesh.dimension);
        for (const int threads : {1, 2}) {
            expect_same_everywhere("locate in " + s.name, [&](Answers& out) {
                const auto locator = Locator::build(s.mesh);
                std::vector<Mesh::Index> cells(points.size() / d);
                std::vector<Feature> features(cells.size());
                LocationCounts counts;
                out.add(locator->locate(points, cells, features, &counts, threads).has_value());
                out.add_all(cells);
                for (const Feature f : features) out.add(static_cast<int>(f));
                add(out, counts);
                const auto all = locator->locate_all(std::span(points).first(200 * d), threads);
                out.add_all(all->cells);
                add(out, all->counts.locations);
                for (std::size_t i = 0; i < 40; ++i) {
                    const Location one = *locator->locate(&points[d * i]), hinted = *locator->locate(&points[d * i], 3);
                    out.add(one.cell);
                    out.add(hinted.cell);
                    const Nearest near = *locator->nearest(&points[d * i], HUGE_VAL);
                    out.add(near.cell);
                    out.add(near.distance);
                    for (const Mesh::Index node : near.nodes) out.add(node);
                }
            });
        }
    }
}

std::vector<FieldChoice> fields_of(const Mesh& mesh) {
    return {{&mesh.point_fields[0], false}, {&mesh.point_fields[1], false}, {&mesh.cell_fields[0], true}};
}

void add(Answers& out, const Table& s) {
    out.add_all(s.cells);
    for (const Feature f : s.features) out.add(static_cast<int>(f));
    for (const double x : s.values) out.add(x);
    for (const double x : s.distances) out.add(x);
}

TEST(EveryEnvironment, SampleAndResample) {
    for (const Subject& s : subjects()) {
        const std::vector<double> points = points_around(s, 8500);
        const double low = -3 * s.scale, high = 61 * s.scale, step = 16 * s.scale;
        for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
            for (const Outside outside : {Outside::nan, Outside::nearest, Outside::extrapolate}) {
                expect_same_everywhere("samples of " + s.name, [&](Answers& out) {
                    SampleOptions options;
                    options.rounding = rounding;
                    options.outside.kind = outside;
                    options.threads = 2;
                    const auto locator = Locator::build(s.mesh, {.prove = Prove::never});
                    const auto sampler = Sampler::build(*locator, fields_of(s.mesh));
                    Table samples;
                    SampleCounts counts;
                    const std::size_t some = outside == Outside::nan ? points.size() : 60;
                    out.add(sampler->sample(std::span(points).first(some), options, samples).has_value());
                    add(out, samples);
                    Table again = samples;
                    again.values.assign(again.values.size(), 0);
                    out.add(sampler->evaluate(std::span(points).first(some), options, again).has_value());
                    add(out, again);
                    counts.add(samples.counts);
                    counts.add(again.counts);
                    const auto over = grid_over(s.mesh.dimension, {5, 4, 4}, {low, low, low}, {high, high, high});
                    const auto spaced =
                        grid_spaced(s.mesh.dimension, {step, step, step}, {low, low, low}, {high, high, high});
                    for (const auto& grid : {over, spaced}) {
                        out.add(grid.has_value());
                        if (!grid) continue;
                        for (std::int64_t i = 0; i < grid->counts[0]; ++i) out.add(grid->coordinate(0, i));
                        out.add(as_in_vti(*grid).last[0]);
                        const auto sink = [&](const TableView& block) -> Status {
                            out.add_all(block.cells);
                            for (const double x : block.values) out.add(x);
                            for (const double x : block.distances) out.add(x);
                            return Done{};
                        };
                        const auto of_grid = resample(*sampler, *grid, options, sink);
                        out.add(of_grid.has_value());
                        if (of_grid) counts.add(*of_grid);
                    }
                    const Bounds3 bounds = bounds_of_cells(s.mesh);
                    for (const double x : bounds.low) out.add(x);
                    for (const double x : bounds.high) out.add(x);
                    add(out, counts);
                });
            }
        }
    }
}

/// The same cells with nodes in the middles of their edges, each cell with its own.
Mesh second_order(const Mesh& mesh) {
    Mesh out = mesh;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const std::vector<std::array<std::size_t, 2>> edges =
        d == 2 ? std::vector<std::array<std::size_t, 2>>{{0, 1}, {1, 2}, {0, 2}}
               : std::vector<std::array<std::size_t, 2>>{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        for (const auto& [i, j] : edges) {
            const auto a = static_cast<std::size_t>(mesh.cells[(d + 1) * cell + i]),
                       b = static_cast<std::size_t>(mesh.cells[(d + 1) * cell + j]);
            out.mid_nodes.push_back(static_cast<Mesh::Index>(out.point_count()));
            for (std::size_t k = 0; k < d; ++k) out.points.push_back(mesh.points[d * a + k]);
            for (Field& field : out.point_fields) {
                const auto n = static_cast<std::size_t>(field.components);
                for (std::size_t c = 0; c < n; ++c) field.data.push_back(field.data[n * b + c]);
            }
        }
    }
    out.mid_edge_order = MidEdgeOrder::vtk;
    out.point_markers.clear();
    return out;
}

TEST(EveryEnvironment, QuantitiesAndWeights) {
    for (const Subject& s : subjects()) {
        for (const Mesh& mesh : {s.mesh, second_order(s.mesh)}) {
            const std::vector<double> points = points_around(s, 60);
            for (const Outside outside : {Outside::nan, Outside::nearest, Outside::extrapolate}) {
                expect_same_everywhere("quantities of " + s.name, [&](Answers& out) {
                    const auto locator = Locator::build(mesh, {.prove = Prove::never});
                    Table rows = *locator->locate(points);
                    rows.points = points;
                    const auto weights = node_weights(*locator, rows.view(), {.kind = outside});
                    out.add(weights.has_value());
                    out.add_all(weights->nodes);
                    out.add_all(weights->weights);
                    for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
                        const auto sampler =
                            Sampler::build(mesh, {"grad(one)", "|two|", "two.y", "mean(cell)", "|cell|", "|grad(two)|"},
                                           {.prove = Prove::never, .curved = Curved::straight});
                        const auto curved =
                            Sampler::build(mesh, {"one", "|two|", "two.y", "cell"}, {.prove = Prove::never});
                        for (const auto* each : {&sampler, &curved}) {
                            ASSERT_TRUE(*each);
                            const auto table = (*each)->sample(
                                points, {.rounding = rounding, .outside = {.kind = outside}, .threads = 2});
                            out.add(table.has_value());
                            for (const double x : table->values) out.add(x);
                        }
                    }
                });
            }
        }
    }
}

/// A folder for one test, and the bytes of its files.
class Folder {
public:
    Folder() : path_(std::filesystem::temp_directory_path() / ("barycert-environment-" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(path_);
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    std::string path(const std::string& name) const { return (path_ / name).string(); }
    void put(const std::string& name, const std::string& text) const {
        std::ofstream(path(name), std::ios::binary) << text;
    }
    std::string bytes(const std::string& name) const {
        std::ifstream in(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

private:
    std::filesystem::path path_;
};

void add(Answers& out, const Mesh& mesh) {
    out.add_all(mesh.points);
    out.add_all(mesh.cells);
    for (const auto* fields : {&mesh.point_fields, &mesh.cell_fields}) {
        for (const Field& f : *fields) out.add_all(f.data);
    }
}

TEST(EveryEnvironment, Files) {
    const Folder folder;
    for (const Subject& s : subjects()) {
        const std::vector<double> points = points_around(s, 300);
        const auto d = static_cast<std::size_t>(s.mesh.dimension);
        std::string csv = d == 2 ? "x,y\n" : "x,y,z\n";
        for (std::size_t i = 0; i < points.size(); ++i)
            csv += base::shortest(points[i]) + ((i + 1) % d == 0 ? '\n' : ',');
        folder.put("points.csv", csv);
        expect_same_everywhere("files of " + s.name, [&](Answers& out) {
            out.add(write_tetgen(s.mesh, folder.path("mesh")).has_value());
            out.add(std::string_view(folder.bytes("mesh.node")));
            out.add(std::string_view(folder.bytes("mesh.ele")));
            add(out, *read_tetgen(folder.path("mesh.node")));
            for (const char* const name : {"points.csv", "mesh.node"}) {
                std::vector<double> read;
                const auto source = open_points(folder.path(name), s.mesh.dimension);
                out.add((*source)->read(1000, read).has_value());
                out.add_all(read);
            }
            const std::vector<Mesh::Index> cells(points.size() / d, 0);
            const std::vector<Feature> features(cells.size(), Feature::interior);
            const TableFormat format{
                s.mesh.dimension,
                d == 2 ? std::vector<TableField>{{"a"}, {"b"}} : std::vector<TableField>{{"a"}, {"b"}, {"c"}}, false};
            for (const char* const name : {"rows.csv", "rows.npy"}) {
                const auto sink = open_table(folder.path(name), format);
                out.add((*sink)->write({s.mesh.dimension, 0, points, cells, features, points, {}}).has_value());
                out.add((*sink)->commit().has_value());
                out.add(std::string_view(folder.bytes(name)));
            }
            for (const bool binary : {true, false}) {
                out.add(write_gmsh(s.mesh, folder.path("mesh.msh"), {.binary = binary}).has_value());
                out.add(std::string_view(folder.bytes("mesh.msh")));
                add(out, *read_gmsh(folder.path("mesh.msh")));
                out.add_all(*read_gmsh_points(folder.path("mesh.msh"), s.mesh.dimension));
            }
            out.add(mesh_fingerprint(s.mesh));
            io::VtiGrid grid;
            grid.origin = {-unit, 0.1, 3 * unit};
            grid.spacing = {unit, 0x1p-1024, 0.3};
            const auto vti = io::VtiWriter::open(folder.path("grid.vti"), grid, {{"a", 1, io::NumberType::float64}});
            out.add(vti.has_value());
            if (vti) {
                const double value[1] = {unit};
                out.add((*vti)->write(0, std::as_bytes(std::span(value))).has_value());
                out.add((*vti)->commit().has_value());
                out.add(std::string_view(folder.bytes("grid.vti")));
            }
            for (const char* const name : {"mesh.vtu", "mesh.vtk"}) {
                out.add(write_vtk(s.mesh, folder.path(name)).has_value());
                out.add(std::string_view(folder.bytes(name)));
                add(out, *read_vtk(folder.path(name)));
            }
        });
    }
}

// float32 in, as subnormal doubles never are but subnormal floats are: the conversion itself is arithmetic.
TEST(EveryEnvironment, Float32) {
    const Folder folder;
    std::string npy("\x93NUMPY\x01\x00", 8);
    std::string head = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }";
    head.resize(117, ' ');
    head += '\n';
    npy += static_cast<char>(head.size());
    npy += '\0';
    npy += head;
    const float numbers[6] = {0x1p-149F, -0x3p-140F, 1.5F, 0x1p-126F, 0.1F, -0.0F};
    npy.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
    folder.put("floats.npy", npy);
    expect_same_everywhere("float32", [&](Answers& out) {
        std::vector<double> read;
        const auto source = open_points(folder.path("floats.npy"), 3);
        out.add(source.has_value());
        if (source) out.add((*source)->read(10, read).has_value());
        out.add_all(read);
    });
}

TEST(EveryEnvironment, Pictures) {
    const Folder folder;
    std::vector<double> values;
    for (int i = -20; i < 28; ++i) values.push_back(i * unit);
    expect_same_everywhere("picture", [&](Answers& out) {
        Figure figure{.dimension = 2, .grid = FigureGrid{.width = 8, .height = 6, .values = values}};
        figure.options.title = "values";
        FigureCounts counts;
        for (const char* name : {"grid.png", "grid.svg", "grid.pdf"}) {
            out.add(write_figure(folder.path(name), figure, &counts).has_value());
            out.add(std::string_view(folder.bytes(name)));
        }
        out.add(counts.low);
        out.add(counts.high);
    });
}

void add(Answers& out, const Surface& s) {
    for (const double x : s.points) out.add(x);
    out.add_all(s.cells);
    out.add_all(s.mesh_cells);
    out.add_all(s.mesh_edges);
    for (const auto* fields : {&s.point_fields, &s.cell_fields}) {
        for (const Field& f : *fields) {
            for (const double x : f.data) out.add(x);
        }
    }
}

void add(Answers& out, const Result<Cut>& cut) {
    out.add(cut.has_value());
    if (!cut) return;
    add(out, cut->surface);
    const CutCounts& n = cut->counts;
    for (const std::uint64_t x : {n.cells, n.not_finite, n.degenerate, n.second_order, n.at_nodes, n.on_edges})
        out.add(x);
    add(out, n.tiers);
}

TEST(EveryEnvironment, Surfaces) {
    const Folder folder;
    for (const Subject& s : subjects()) {
        const std::array<double, 3> point{10 * s.scale, 3 * s.scale, 7 * s.scale};
        const double level = 16 * s.scale, twice = 2 * unit;
        for (const int threads : {1, 2}) {
            expect_same_everywhere("surfaces in " + s.name, [&](Answers& out) {
                CutOptions options;
                options.threads = threads;
                options.point_fields = {&s.mesh.point_fields[0], &s.mesh.point_fields[1]};
                options.cell_fields = {&s.mesh.cell_fields[0]};
                const Field &one = s.mesh.point_fields[0], &two = s.mesh.point_fields[1];
                if (s.mesh.dimension == 2) {
                    for (const double value : {0.0, twice}) add(out, isoline(s.mesh, one, value, options));
                    add(out, isoline(s.mesh, two, 0.1, options));
                } else {
                    for (const double value : {0.0, twice}) add(out, isosurface(s.mesh, one, value, options));
                    add(out, isosurface(s.mesh, two, 0x1p-1030, options, 1));
                    const Plane through = plane_through(point, {1.0 / 3, 0x1p-300, -0.7});
                    out.add(through.offset);
                    add(out, slice(s.mesh, through, options));
                    add(out, slice(s.mesh, {{1, 0, 0}, level}, options));
                }
                const auto rim = boundary(s.mesh, options);
                out.add(rim.has_value());
                if (!rim) return;
                add(out, *rim);
                for (const char* const name : {"s.vtp", "s.ply", "s.off"}) {
                    const bool written = write_surface(*rim, folder.path(name)).has_value();
                    out.add(written);
                    if (written) out.add(std::string_view(folder.bytes(name)));
                }
            });
        }
    }
}

TEST(EveryEnvironment, Contours) {
    const Folder folder;
    const Subject s = subjects()[10];
    ASSERT_EQ(s.mesh.dimension, 3);
    ASSERT_TRUE(write_tetgen(s.mesh, folder.path("mesh")));
    ContourJob job;
    job.mesh = folder.path("mesh");
    job.field = "attribute1";
    job.threads = 2;
    expect_same_everywhere("contours", [&](Answers& out) {
        for (const std::string name : {"c.vtp", "c.png", "i.png"}) {
            job.output = folder.path(name);
            job.value.reset();
            job.plane.reset();
            job.colours = name[0] == 'i' ? "attribute2" : "";
            if (name != "c.png") {
                job.value = 0.1;
                job.figure.size = {60, 40};
            } else {
                job.plane = Plane{{0.3, 0.5, 1.0 / 3}, 24};
                job.width = 60;
            }
            auto summary = contour_files(job);
            out.add(summary.has_value());
            if (!summary) continue;
            out.add(std::string_view(folder.bytes(name)));
            summary->seconds = {};
            out.add(std::string_view(contour_text(*summary, false)));
            out.add(std::string_view(contour_json(*summary, {})));
            if (!summary->pixels) continue;
            for (const double x : summary->pixels->middle(5, 7)) out.add(x);
        }
    });
}

TEST(EveryEnvironment, SurfacesInSpace) {
    for (const double scale : {1.0, 0x1p-1040}) {
        // The faces of two tetrahedra that meet, one of them open.
        Surface s;
        for (const double x : {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 1, 1, 1, 9, 1, 1, 1, 9, 1, 1, 1, 9})
            s.points.push_back(x * scale);
        s.cells = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3, 4, 6, 5, 4, 5, 7, 5, 6, 7};
        s.point_fields.push_back({"u", 1, {1, 2, 3, .1, .2, .3, .4, .5}});
        std::vector<double> points;
        base::Random random(9);
        for (int i = 0; i < 900; ++i) points.push_back(random.integer(-8, 80) * 0.125 * scale);
        expect_same_everywhere("surface", [&](Answers& out) {
            CheckReport report = check_surface(s, {.threads = 1});
            report.seconds = 0;
            out.add(std::string_view(check_json(report, "surface", {})));
            out.add(std::string_view(check_html(report, s, "surface")));
            const auto image = draw_checked(report, s);
            out.add(image.has_value());
            for (std::size_t i = 0; image && i < image->data.size(); i += 97) out.add(static_cast<int>(image->data[i]));
            out.add(mesh_fingerprint(s));
            const auto locator = SurfaceLocator::build(s);
            std::vector<SurfaceNearest> near(points.size() / 3), again(near.size());
            std::vector<SurfaceLocation> places(near.size());
            std::vector<double> values(near.size());
            out.add(locator->nearest(points, HUGE_VAL, near).has_value());
            out.add(locator->locate(points, places).has_value());
            out.add(locator->values(s.point_fields[0], false, points, near, values).has_value());
            std::vector<Mesh::Index> triangles;
            for (const SurfaceNearest& n : near) triangles.push_back(n.cell);
            out.add(locator->nearest_on(triangles, points, again).has_value());
            for (const auto& all : {near, again}) {
                for (const SurfaceNearest& n : all) {
                    out.add(n.cell);
                    for (const double x : {n.distance, n.point[0], n.point[1], n.point[2], n.weights[0], n.weights[1]})
                        out.add(x);
                }
            }
            for (std::size_t i = 0; i < near.size(); ++i) {
                out.add(places[i].winding);
                out.add(values[i]);
                if (i + 1 == near.size()) break;
                const auto hits = locator->hits(&points[3 * i], &points[3 * i + 3]);
                for (std::size_t k = 0; hits && k < hits->size(); ++k) out.add((*hits)[k].parameter);
            }
        });
    }
    expect_same_everywhere("audit of surfaces", [&](Answers& out) {
        SurfaceAudit audit{.count = 12, .threads = 2};
        audit_surfaces(audit);
        out.add(std::string_view(surfaces_json(audit)));
        out.add(std::string_view(surfaces_text(audit, {})));
        out.add(std::string_view(surfaces_html(audit)));
        for (const SurfaceFamily& family : surface_families()) {
            const SurfaceCase c = make_surface_case(family, 1, 3);
            for (const double x : c.triangles[0]) out.add(x);
            out.add(oracle_distance(c.triangles[0], c.point.data()));
            out.add(oracle_meet(c.triangles[0], c.triangles.back()));
            out.add(oracle_side(c.triangles, c.point.data()));
        }
    });
    expect_same_everywhere("audit of inverse maps", [&](Answers& out) {
        InverseAudit audit{.count = 6, .threads = 2};
        audit_inverses(audit);
        out.add(std::string_view(inverses_json(audit)));
        out.add(std::string_view(inverses_text(audit, {})));
        out.add(std::string_view(inverses_html(audit)));
        const InverseCase c = make_inverse_case(inverse_families()[1], 12, 1, 1);
        out.add_all(c.nodes);
        const ExactInverse exact = exact_inverse(c);
        out.add_all(exact.x);
        out.add(exact.value);
        InverseTally tally;
        tally.add({true, true, {0.1, 0.2, 0.3}, 0.4}, exact, c, 0);
        out.add(tally.value_ulp.value);
    });
}

TEST(EveryEnvironment, Audit) {
    MeshSource meshes;
    const Subject tiny = subjects()[6], plain = subjects()[10];
    meshes.add("tiny", tiny.mesh);
    meshes.add("plain", plain.mesh);
    const std::vector<Kernel> kernels = kernels_matching("*");
    const Folder folder;
    expect_same_everywhere("audit", [&](Answers& out) {
        AuditOptions options;
        // Kernels in doubles answer by what the processor has; the library's environment is what they are asked in.
        options.kernels = kernels;
        options.families = families_matching("*");
        options.count = 40;
        options.threads = 2;
        auto report = run_audit(options, meshes);
        out.add(report.has_value());
        if (!report) return;
        report->seconds = 0;
        for (KernelResult& k : report->kernels) k.ns = 0;
        out.add(std::string_view(audit_json(*report)));
        out.add(std::string_view(audit_text(*report, {})));
        out.add(std::string_view(audit_text(*report, {.wide = true})));
        const auto signs = sign_pictures(kernels_matching("*.signed-*"));
        for (const SignPicture& p : signs) out.add(static_cast<double>(p.wrong));
        const auto maps = mesh_maps(kernels_matching("*.signed-*"), meshes, 1, 2);
        for (const MeshMap& map : maps) {
            for (const std::int32_t pixel : map.pixels) out.add(static_cast<double>(pixel));
            for (const double error : map.kernels.at(0).errors) out.add(error);
        }
        folder.put("others.json",
                   R"({"schema": 1, "command": "systems", "seed": 1, "count": 2, "systems": [{"name": "a",
            "version": "1", "dimension": 3, "total": {"points": 3, "inside": 2, "outside": 1, "inside_called_outside": 1,
            "outside_called_inside": 1, "owner_does_not_contain": 0, "max_value_error": 0.1}, "ns_a_random_point": 0.3,
            "failures": []}]})");
        const auto others = read_other_results(folder.path("others.json"));
        out.add(others.has_value());
        out.add(std::string_view(audit_html(*report, {.signs = signs, .maps = maps, .others = {*others}}).value()));
        ErrorSizes sizes;
        for (const double error : {0.0, 5e-324, 0.1, 1e300}) sizes.add(error, 0);
        for (const double share : {0.25, 0.5, 0.99}) out.add(sizes.within(share));
        out.add(std::string_view(condition_plot(*report)));
        folder.put("witnesses.json", witnesses_json(*report));
        const auto witnesses = read_witnesses(folder.path("witnesses.json"));
        out.add(witnesses.has_value());
        for (std::size_t i = 0; i < witnesses->size(); i += 7) {
            const Replay again = replay_witness((*witnesses)[i], kernels);
            out.add(std::string_view(again.not_reproduced));
            out.add(std::string_view(witness_text(again, {})));
            out.add(partition_residual(again.exact.weights));
            const OracleAnswer by_cgal = ask_cgal((*witnesses)[i].c);
            out.add(by_cgal.value);
            out.add(same_answer(by_cgal, again.exact));
        }
        for (std::uint64_t i = 0; i < 20; ++i) {
            const Family& family = options.families[i % options.families.size()];
            if (!family.applies_to(Simplex::triangle) || (family.needs_mesh && !meshes.supplies(Simplex::triangle)))
                continue;
            const Case c = make_case(family, Simplex::triangle, 3, i, meshes);
            for (const double x : c.vertices) out.add(x);
        }
        GapsOptions gaps;
        gaps.kernels = kernels;
        gaps.count = 30;
        gaps.threads = 2;
        auto found = find_gaps(gaps, plain.mesh, "plain", Verdict::not_checked);
        out.add(found.has_value());
        if (!found) return;
        found->seconds = 0;
        out.add(std::string_view(gaps_json(*found)));
        out.add(std::string_view(gaps_text(*found, {})));
    });
}

TEST(EveryEnvironment, SearchMutantsAndReportsForCi) {
    const Folder folder;
    expect_same_everywhere("search", [&](Answers& out) {
        AuditOptions options;
        options.kernels = kernels_matching("t*.signed-*");
        options.families = families_matching("*-facet*");
        options.count = 40;
        options.threads = 2;
        AuditReport report = run_audit(options, {}).value();
        report.seconds = 0;
        const CiReport ci = audit_outcomes(report, {parse_threshold("any").value()}, nullptr, {});
        for (const auto& text : {ci_junit(ci), ci_sarif(ci), ci_annotations(ci)}) out.add(std::string_view(text));
        folder.put("baseline.json", audit_json(report));
        const auto compared = compare_with_baseline(report, read_baseline(folder.path("baseline.json")).value());
        out.add(compared.has_value());
        if (compared) out.add(std::string_view(baseline_text(*compared, "b")));
        MutantReport score = audit_mutants(options, {}).value();
        score.seconds = 0;
        out.add(std::string_view(mutants_json(score)));
        out.add(std::string_view(mutants_text(score, {})));
        SearchOptions searching;
        searching.kernel = kernels_matching("tetrahedron.signed-volume").at(0);
        searching.steps = 4000;
        searching.threads = 2;
        SearchReport found = search_worst_case(searching).value();
        found.seconds = 0;
        out.add(std::string_view(search_json(found)));
        out.add(std::string_view(search_text(found, {})));
        out.add(std::string_view(witnesses_json(found)));
    });
}

TEST(EveryEnvironment, VerifiedResults) {
    const Folder folder;
    folder.put("two.node", "5 3 1 0\n0 0 0 0 1\n1 1 0 0 3\n2 0 1 0 5\n3 0 0 1 9.1\n4 1 1 1 15\n");
    folder.put("two.ele", "2 4 0\n0 0 1 2 3\n1 1 2 3 4\n");
    folder.put("rows.csv",
               "x,y,z,cell,attribute0\n.1,.2,.3,0,4.2\n.5,.5,.5,-1,nan\n.1,.1,.1,1,2.4\n2,2,2,1,0\n"
               ".3,.3,.3,0,5.230000000000001\n1e-320,.1,.1,0,2.21\n");
    expect_same_everywhere("verified results", [&](Answers& out) {
        VerifyJob job;
        job.mesh = folder.path("two");
        job.results = folder.path("rows.csv");
        job.options.threads = 2;
        Result<VerifyReport> summary = verify_files(job);
        out.add(summary.has_value());
        if (!summary) return;
        EXPECT_GT(summary->verdicts.wrong(), 2U);
        summary->seconds = {};
        out.add(std::string_view(verify_json(*summary, {})));
        out.add(std::string_view(verify_text(*summary, false)));
        out.add(std::string_view(verify_html(*summary, {})));
        summary->limits = {parse_verify_limit("missed>1").value(), parse_verify_limit("wrong_value").value()};
        const CiReport ci = verify_outcomes(*summary, {});
        for (const auto& text : {ci_junit(ci), ci_sarif(ci), ci_annotations(ci)}) out.add(std::string_view(text));
    });
}

// A callback's changes to the environment end with it.
TEST(EveryEnvironment, CallbacksThatChangeIt) {
    const Subject s = subjects()[6];
    const auto locator = Locator::build(s.mesh, {.prove = Prove::never});
    const auto sampler = Sampler::build(*locator, fields_of(s.mesh));
    const auto grid = grid_over(3, {9, 7, 9}, {0, 0, 0}, {61 * s.scale, 61 * s.scale, 61 * s.scale});
    std::vector<double> right, got;
    Answers checked, checked_right;
    std::size_t calls = 0;
    for (const bool rude : {false, true}) {
        const auto meddle = [&] {
            ++calls;
            if (!rude) return;
            std::fesetround(FE_DOWNWARD);
#ifdef __SSE2__
            _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
        };
        SampleOptions options;
        options.threads = 1;
        options.rounding = Rounding::plain;
        const auto sink = [&](const TableView& block) -> Status {
            (rude ? got : right).insert((rude ? got : right).end(), block.values.begin(), block.values.end());
            meddle();
            return Done{};
        };
        ASSERT_TRUE(resample(*sampler, *grid, options, sink));
        EXPECT_TRUE(rounds_correctly());
        CheckOptions how;
        how.threads = 1;
        how.progress = [&](const char*) { meddle(); };
        add(rude ? checked : checked_right, check_mesh(s.mesh, how));
        EXPECT_TRUE(rounds_correctly());
    }
    EXPECT_GT(calls, 4U);
    ASSERT_EQ(got.size(), right.size());
    EXPECT_EQ(std::memcmp(got.data(), right.data(), got.size() * sizeof(double)), 0);
    EXPECT_EQ(checked.words(), checked_right.words());
}

}  // namespace
}  // namespace barycert::testing
