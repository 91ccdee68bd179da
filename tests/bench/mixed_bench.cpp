// Cells of other shapes, curved cells and images as meshes: random points found and interpolated by barycert on one
// thread, beside VTK's locators (FindCell, and the sum of its weights times the nodal values) and, in an image,
// vtkProbeFilter.
//
// Before anything is timed:
//   points made in cells that are known, by shape functions written for the tests, must be found there, with the value
//   that those functions give;
//   at all points that are timed, a linear field must be what it is, up to the rounding of its nodal values;
//   two threads give the bits of one.
// VTK's answers at points that it is timed on are held against barycert's by Verifier, in the cells' own maps, which
// VTK's cells have, too; what is wrong is counted and told.
//
//     bench_mixed [--quick] [--repetitions N] [--image SIDE] [hexahedra] [warped] [mixed] [curved] [image]
//
// Medians of the processor's time, taken in turn; each demand as met or not, and one table. --image: nodes along each
// edge of the image. --quick: small meshes and few points, to see that all of it works.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "barycert/environment.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/grid.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/verify.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "generated_mesh.hpp"
#include "peak_memory.hpp"
#include "sample_contest.hpp"
#include "sample_peers.hpp"
#include "sample_subject.hpp"
#include "sample_table.hpp"
#include "tests/mesh/whole_cells.hpp"

namespace {

using namespace barycert;
using namespace barycert::bench;
using Which = VtkPeer::Which;

struct Arguments {
    bool quick = false;
    int repetitions = 5, image = 128;
    std::set<std::string> chosen;

    bool wants(const char* name) const { return chosen.empty() || chosen.count(name) != 0; }
    std::size_t points() const { return quick ? 20'000 : 1'000'000; }
    /// VTK's time a point does not depend on how many there are.
    std::size_t vtk_points() const { return points() / 5; }
};

[[noreturn]] void usage() {
    std::fprintf(stderr,
                 "usage: bench_mixed [--quick] [--repetitions N] [--image SIDE] [hexahedra] [warped] [mixed] [curved] "
                 "[image]\n");
    std::exit(2);
}

Arguments parse(int count, char** text) {
    Arguments out;
    const std::set<std::string> names{"hexahedra", "warped", "mixed", "curved", "image"};
    for (int i = 1; i < count; ++i) {
        const std::string word = text[i];
        if (word == "--quick") {
            out.quick = true;
        } else if ((word == "--repetitions" || word == "--image") && i + 1 < count) {
            (word == "--image" ? out.image : out.repetitions) =
                std::max(word == "--image" ? 2 : 1, std::atoi(text[++i]));
        } else if (names.count(word) != 0) {
            out.chosen.insert(word);
        } else {
            usage();
        }
    }
    return out;
}

/// One definition of cells and values, what is asked of it, and how many times VTK's time.
struct Way {
    std::string name;
    BuildOptions how;
    double most_ns, least_times;  ///< infinite and 0: nothing is asked
    bool listed = true;           ///< the cells of an image, see ReadOptions
};

double linear_at(const double* x) {
    return x[0] * 1.5 + x[1] * 2.5 - x[2];
}

double smooth_at(const double* x) {
    return std::sin(5 * x[0]) + std::cos(3 * x[1]) * x[2];
}

Field field_of(const Mesh& mesh, const char* name, double (*at)(const double*)) {
    Field field{name, 1, {}};
    base::resize_large(field.data, mesh.point_count());  // as readers have it
    for (std::size_t i = 0; i < mesh.point_count(); ++i) field.data[i] = at(mesh.points.data() + 3 * i);
    return field;
}

/// Reads a file of image data, which holds nothing but the geometry.
Mesh image_mesh(const Grid& grid, bool listed) {
    const std::string path = (std::filesystem::temp_directory_path() / "barycert-bench-image.vti").string();
    std::ofstream file(path);
    std::string extent, spacing;
    for (std::size_t k = 0; k < 3; ++k) {
        extent += " 0 " + std::to_string(grid.counts[k] - 1);
        spacing += ' ' + base::shortest(grid.spacing[k]);
    }
    file << "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\"><ImageData WholeExtent=\""
         << extent << "\" Origin=\"0 0 0\" Spacing=\"" << spacing << "\"><Piece Extent=\"" << extent
         << "\"/></ImageData></VTKFile>\n";
    file.close();
    Mesh mesh = demand_value(read_mesh(path, {.list_grids = listed}));
    std::filesystem::remove(path);
    return mesh;
}

std::vector<double> random_points(std::size_t count) {
    base::Random random(20);
    std::vector<double> points(3 * count);
    for (double& x : points) x = random.uniform(0, 1);
    return points;
}

/// A mesh of the unit cube, a sampler for each way, and points that they are right at.
class Trial {
public:
    /// `unlisted`: the same, without lists of cells.
    Trial(std::string name, Mesh mesh, std::vector<Way> ways, const Arguments& arguments, Mesh unlisted = {})
        : name_(name + ", " + in_thousands(mesh.whole_count()) + " cells"),
          arguments_(arguments),
          mesh_(std::move(mesh)),
          unlisted_(std::move(unlisted)),
          ways_(std::move(ways)),
          smooth_(field_of(mesh_, "smooth", smooth_at)),
          linear_(field_of(mesh_, "linear", linear_at)),
          points_(random_points(arguments.points())) {
        std::printf("%s, %zu simplices\n", name_.c_str(), mesh_.cell_count());
        for (const Way& way : ways_) {
            const Seconds built = time(
                [&] { locators_.push_back(demand_value(Locator::build(way.listed ? mesh_ : unlisted_, way.how))); });
            const Locator& locator = locators_.back();
            require(locator.unmapped_cells() == 0, "cells of " + name_ + " have no map");
            require(locator.certified(), name_ + " is not certified");
            std::printf("  %s: built in %.2f s, %.1f bytes a cell\n", way.name.c_str(), built.wall,
                        static_cast<double>(locator.bytes()) / static_cast<double>(mesh_.whole_count()));
        }
        for (const Locator& locator : locators_)
            samplers_.push_back(demand_value(Sampler::build(locator, {{.field = &smooth_}})));
        for (std::size_t i = 0; i < ways_.size(); ++i) verify(i);
    }
    Trial(const Trial&) = delete;
    Trial& operator=(const Trial&) = delete;

    /// Beside VTK's locators.
    void run(SampleTable& table) {
        std::vector<Peer> peers;
#ifdef BARYCERT_WITH_VTK
        const std::shared_ptr<VtkPeer> vtk = make_vtk_peer(mesh_, smooth_.data, asked(), {});
        for (const Which which : {Which::static_locator, Which::cell_tree}) {
            vtk->build(which);
            std::vector<Mesh::Index> cells;
            std::vector<double> values;
            vtk->find(which, cells);
            vtk->interpolate(which, values);
            const char* const who = which == Which::cell_tree ? "vtkCellTreeLocator" : "vtkStaticCellLocator";
            judge(who, cells, values);
            peers.push_back({who, [vtk, which, values]() mutable { vtk->interpolate(which, values); }});
        }
#endif
        contest(peers, table);
    }

    /// Beside vtkProbeFilter in an image with the same nodes.
    void run(const Grid& image, SampleTable& table) {
        std::vector<Peer> peers;
#ifdef BARYCERT_WITH_VTK
        static const std::vector<double> none;
        const std::shared_ptr<VtkPeer> vtk = make_vtk_peer({}, none, asked(), image);
        vtk->set_image(smooth_.data);
        vtk->probe_in_image();
        judge("vtkProbeFilter", {}, vtk->probed());
        peers.push_back({"vtkProbeFilter", [vtk] { vtk->probe_in_image(); }});
#else
        static_cast<void>(image);
#endif
        contest(peers, table);
    }

private:
    struct Peer {
        std::string name;
        std::function<void()> work;
    };

    std::span<const double> asked() const {
        return std::span(points_).first(3 * arguments_.vtk_points());
    }

    /// Demands are about the first peer.
    void contest(const std::vector<Peer>& peers, SampleTable& table) const {
        Table rows;
        Contest contest;
        for (std::size_t i = 0; i < ways_.size(); ++i)
            contest.add(ways_[i].name, [&, i] { demand_done(samplers_[i].sample(points_, options(1), rows)); });
        for (const Peer& peer : peers) contest.add(peer.name, peer.work);
        contest.run(arguments_.repetitions);
        const double share = static_cast<double>(arguments_.points()) / static_cast<double>(arguments_.vtk_points());
        const auto ns = [&](const std::string& who, double times) {
            return 1e9 * times * contest.cpu(who) / static_cast<double>(arguments_.points());
        };
        for (const Way& way : ways_) {
            const std::string what = name_ + ": " + way.name;
            SampleTable::Line line{.what = what, .ours = with_unit(ns(way.name, 1), "ns")};
            for (const Peer& peer : peers) {
                const char* const comma = line.vtk.empty() ? "" : ", ";
                line.vtk += comma + peer.name + ' ' + with_unit(ns(peer.name, share), "ns");
                line.ratio += comma + with_unit(share * contest.cpu_ratio(peer.name, way.name), "x");
            }
            table.add(line);
            if (way.least_times == 0) continue;
            table.demand(what, ns(way.name, 1), way.most_ns, true, {}, "ns");
            const std::string first = peers.empty() ? "VTK" : peers.front().name;
            table.demand(what + ", " + first, share * contest.cpu_ratio(first, way.name), way.least_times);
        }
    }

    static bool by_parts(const Way& way, const Mesh& mesh) {
        return !mesh.shapes.types.empty() && way.how.interpolation == CellInterpolation::linear;
    }

    /// Points in known cells, well inside, by shape functions. Their coordinates are rounded, by 2^-54 at most each;
    /// the interpolation changes by no more than four times what the field does, 9 times the sum of these; both values,
    /// up to 2, are rounded.
    void verify_known_cells(std::size_t way) const {
        const bool parts = by_parts(ways_[way], mesh_);
        const test::CellArrays cells = parts ? test::simplices_of(mesh_) : test::whole_cells(mesh_);
        base::Random random(3);
        std::vector<double> points, values;
        std::vector<Mesh::Index> owners;
        for (int i = 0; i < 20'000; ++i) {
            const std::size_t cell = random.below(cells.count());
            const std::uint8_t type = cells.types[cell];
            test::ReferencePlace place{};
            const auto corners = test::reference_corners(type);
            std::vector<double> weights;
            double sum = 0;
            for (std::size_t k = 0; k < corners.size(); ++k) sum += weights.emplace_back(random.uniform(0.01, 1));
            for (std::size_t k = 0; k < corners.size(); ++k) {
                for (std::size_t axis = 0; axis < 3; ++axis) place[axis] += weights[k] / sum * corners[k][axis];
            }
            const auto point = test::at_place<3>(type, cells.of(cell), place, mesh_.points);
            points.insert(points.end(), point.begin(), point.end());
            values.push_back(test::at_place<1>(type, cells.of(cell), place, smooth_.data)[0]);
            const auto number = static_cast<Mesh::Index>(cell);
            owners.push_back(parts ? mesh_.cell_number(number) : number);
        }
        const Table rows = demand_value(samplers_[way].sample(points));
        for (std::size_t i = 0; i < owners.size(); ++i) {
            require(locators_[way].mesh().cell_number(rows.cells[i]) == owners[i],
                    "the cell of a made point of " + name_);
            require(std::abs(rows.values[i] - values[i]) <= 64 * 0x1p-53, "the value at a made point of " + name_);
        }
    }

    /// With u = 2^-53: products and sums of a nodal value are off by 12 u, so is the formula at the point, and what is
    /// interpolated by 4 u more. In cells of second order absolute values of shape functions add up to 2 at most.
    void verify(std::size_t way) const {
        verify_known_cells(way);
        const Sampler linear = demand_value(Sampler::build(locators_[way], {{.field = &linear_}}));
        const Table values = demand_value(linear.sample(points_, options(2)));
        for (std::size_t i = 0; i < values.row_count(); ++i)
            require(std::abs(values.values[i] - linear_at(points_.data() + 3 * i)) <= 40 * 0x1p-53,
                    "the linear field at point " + std::to_string(i) + " of " + name_);
        const Table one = demand_value(samplers_[way].sample(points_, options(1)));
        const Table two = demand_value(samplers_[way].sample(points_, options(2)));
        require(one.cells == two.cells && one.values == two.values && one.cells == values.cells,
                "two threads differ from one on " + name_);
    }

    /// By the last way, which has the maps that VTK's cells have.
    void judge(const char* who, const std::vector<Mesh::Index>& cells, const std::vector<double>& values) const {
        std::vector<std::int64_t> claimed(cells.begin(), cells.end());
        for (std::int64_t& cell : claimed) {
            if (cell >= 0 && !mesh_.shapes.types.empty()) cell = mesh_.shapes.parts[static_cast<std::size_t>(cell)];
        }
        ClaimedRows rows;
        rows.points = asked();
        rows.cells = claimed;
        rows.values = values;
        const Verdicts v = demand_value(Verifier(samplers_.back(), {}).verify(rows));
        std::printf(
            "  %s, of %llu points: %llu missed, %llu in a cell that does not hold them, %llu values off by more "
            "than 1e-9 of the range, at most %.2g\n",
            who, static_cast<unsigned long long>(v.rows), static_cast<unsigned long long>(v.missed),
            static_cast<unsigned long long>(v.wrong_cell), static_cast<unsigned long long>(v.columns[0].over),
            v.columns[0].max_relative);
        require(100 * (v.missed + v.wrong_cell) <= v.rows, "VTK was asked something else");
    }

    std::string name_;
    const Arguments& arguments_;
    Mesh mesh_, unlisted_;
    std::vector<Way> ways_;
    Field smooth_, linear_;
    std::vector<double> points_;
    std::vector<Locator> locators_;
    std::vector<Sampler> samplers_;
};

}  // namespace

int main(int count, char** text) {
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // what is known so far shows in a file, too
    const Arguments arguments = parse(count, text);
    SampleTable table;
    table.cgal = true;
#ifdef BARYCERT_WITH_VTK
    table.vtk = true;
#endif
    std::printf("SIMD %s\n", simd_target().c_str());
    const bool quick = arguments.quick;
    const Way pulled{"pulling", {}, 90, 60};
    const Way multilinear{"multilinear", {.interpolation = CellInterpolation::multilinear, .progress = {}}, 350, 15};
    const auto run = [&](const char* name, const std::function<Mesh()>& mesh, std::vector<Way> ways) {
        if (arguments.wants(name)) Trial(name, mesh(), std::move(ways), arguments).run(table);
    };
    const int side = quick ? 10 : 100;
    run("hexahedra", [&] { return shaped_cube(CubeCells::hexahedra, side, 0, true, 1); }, {pulled, multilinear});
    run("warped", [&] { return shaped_cube(CubeCells::hexahedra, side, 0.15, true, 1); }, {pulled, multilinear});
    run("mixed", [&] { return shaped_cube(CubeCells::mixed, quick ? 8 : 60, 0.15, true, 1); }, {pulled, multilinear});
    const int nodes = quick ? 12 : arguments.image;
    if (arguments.wants("image")) {
        const Grid grid = demand_value(grid_over(3, {nodes, nodes, nodes}, {0, 0, 0}, {1, 1, 1}));
        const std::vector<Way> ways{{"trilinear", multilinear.how, 25, 4, false},
                                    {"pulling", pulled.how, 25, 4, false},
                                    {"trilinear, cells listed", multilinear.how, HUGE_VAL, 0}};
        Trial("image", image_mesh(grid, true), ways, arguments, image_mesh(grid, false)).run(grid, table);
    }
    run("curved", [&] { return curved_cube(quick ? 6 : 26, 0.07, 1); }, {{"curved", {}, 1500, 10}});
    std::printf("peak of memory: %.0f MiB\n\n", peak_mib());
    table.print_demands();
    if (quick) std::printf("(a quick run: these times and ratios say nothing)\n");
    std::printf("\n");
    table.print();
    return 0;
}
