#include "barycert/locator.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "core/base/finite.hpp"
#include "core/grid_lanes.hpp"
#include "mesh/consistency.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/warped_sides.hpp"
#include "mesh/locate/batch.hpp"
#include "mesh/locate/finder.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/locate/locator_data.hpp"
#include "mesh/locate/preparation_policy.hpp"
#include "mesh/locate/sorted_points.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert {
Locator::Locator(std::unique_ptr<locate::LocatorData> data)
    : data_(data.release(), [](locate::LocatorData* d) { delete d; }) {}

Result<Locator> Locator::build(const Mesh& mesh, const BuildOptions& options) {
    const ExactEnvironment environment;
    const char* const wrong = mesh.is_listed() ? mesh::inconsistency_of_cells(mesh, mesh::FieldValues::any)
                                               : mesh::inconsistency_of_axes(mesh);
    if (wrong != nullptr)
        return Error{.code = "mesh.inconsistent", .what = std::string("the mesh is inconsistent: ") + wrong};
    std::unique_ptr<locate::LocatorData> data;
    base::in_arena(options.threads, mesh.cell_count(), [&] {
        const auto stage = [&](const char* name) {
            if (!options.progress) return;
            options.progress(name);
            ExactEnvironment::renew();
        };
        data = std::make_unique<locate::LocatorData>(mesh, options, stage);
        if (!locate::PreparationPolicy::proves_later(options.prove, mesh.cell_count())) data->parts.prove(stage);
    });
    return Locator(std::move(data));
}

Location locate::LocatorData::settle(const double* point, Location in_parts) const {
    if (!base::all_finite({point, index.dimension()})) return {};
    return mapped->owner(point, in_parts, [&](std::vector<Location>& all) {
        if (in_parts.cell < 0) return;
        const auto* const proved = parts.proved();
        const bool alone = proved != nullptr && proved->proof.partition && in_parts.feature == Feature::interior;
        if (alone) return all.push_back(in_parts);
        PointRecord record{};
        std::copy_n(point, index.dimension(), record.at.begin());
        LocationCounts ignored;
        Finder(*this, index.nodes.data(), 1)
            .find_all(&record, 1, ignored, [&](std::uint32_t, Mesh::Index cell, Feature feature) {
                all.push_back({cell, feature});
            });
        std::ranges::sort(all, {}, &Location::cell);
        const auto same = [&](const Location& a, const Location& b) {
            return mesh->cell_number(a.cell) == mesh->cell_number(b.cell);
        };
        if (index.inside != nullptr) all.erase(std::unique(all.begin(), all.end(), same), all.end());
    });
}

const Mesh& Locator::mesh() const {
    return *data_->mesh;
}

Method Locator::method() const {
    return data_->parts.method();
}

bool Locator::certified() const {
    const ExactEnvironment environment;
    return data_->parts.demand_proved().proof.partition;
}

std::uint64_t Locator::contested_cells() const {
    const ExactEnvironment environment;
    return data_->parts.demand_proved().proof.contested_count;
}

std::uint64_t Locator::degenerate_cells() const {
    const ExactEnvironment environment;
    return data_->parts.demand_proved().degenerate.size();
}

CellInterpolation Locator::interpolation() const {
    const bool products = data_->multilinear || (data_->mapped && data_->mapped->has_products());
    return products ? CellInterpolation::multilinear : CellInterpolation::linear;
}

bool Locator::has_curved_cells() const {
    return data_->mapped && data_->mapped->has_curves();
}

std::uint64_t Locator::unmapped_cells() const {
    return data_->mapped ? data_->mapped->unproved() : 0;
}

namespace {

std::string words_of_split_sides(const Locator& locator) {
    const auto& mapped = locate::LocatorData::of(locator).mapped;
    if (!mapped || mapped->split_sides().empty()) return {};
    const auto number = [&](Mesh::Index whole) {
        const Mesh& mesh = locator.mesh();
        return std::to_string(mesh.cell_number(mesh.shapes.parts[static_cast<std::size_t>(whole)]));
    };
    const mesh::SplitSide& first = mapped->split_sides().front();
    const std::size_t count = mapped->split_sides().size();
    return "the multilinear cells do not partition the domain: " +
           (count == 1 ? "1 side that is not flat has" : std::to_string(count) + " sides that are not flat have") +
           " another surface in the cell beyond, where cells overlap or leave gaps; first between cells " +
           number(first.whole) + " and " + number(first.beyond);
}

}  // namespace

Notes notes_of_maps(const Locator& locator, CellInterpolation asked, const std::string& file) {
    const std::uint64_t unmapped = locator.unmapped_cells();
    const std::string split = words_of_split_sides(locator);
    if (asked == CellInterpolation::multilinear && locator.interpolation() == CellInterpolation::linear)
        return {{Note::Kind::guessed, "no cell is a hexahedron or the like: multilinear interpolation is linear here",
                 file, true}};
    Notes notes;
    if (unmapped != 0)
        notes.push_back(
            {Note::Kind::guessed,
             std::to_string(unmapped) +
                 " cells are taken as straight or by their parts: it is not proved that their maps are injective",
             file, true});
    if (!split.empty()) notes.push_back({Note::Kind::guessed, split, file, true});
    return notes;
}

std::size_t Locator::bytes() const {
    return data_->bytes();
}

Status Locator::locate(std::span<const double> points, std::span<Mesh::Index> cells, std::span<Feature> features,
                       LocationCounts* counts, int threads, NonfinitePoints nonfinite) const {
    const ExactEnvironment environment;
    if (Status status = locate::check_size(points, data_->index.dimension()); !status) return status;
    const std::size_t count = points.size() / data_->index.dimension();
    if (cells.size() != count || features.size() != count)
        return Error{.code = "argument.size",
                     .what = "size of the output",
                     .expected = "one cell and one feature for each of " + std::to_string(count) + " points",
                     .found = std::to_string(cells.size()) + " and " + std::to_string(features.size())};
    LocationCounts all;
    struct Worker {
        const locate::CellIndex& index;
        std::unique_ptr<std::vector<Location>> found;
        std::unique_ptr<locate::MappedOwners> mapped;

        void operator()(const locate::PointRecord* records, std::size_t n, const locate::Place* owner,
                        const Feature* feature) {
            Location* const to = found->data() + records->number;
            for (std::size_t i = 0; i < n; ++i) {
                to[i] = {owner[i] < 0 ? -1 : index.original[owner[i]], feature[i]};
                if (mapped) mapped->push(records[i], to[i], owner + i, n - i);
            }
        }
    };
    const auto make = [&](std::size_t, std::size_t size) {
        Worker worker{data_->index, data_->locations.take(), nullptr};
        worker.found->resize(std::max(worker.found->size(), size + 1));
        if (data_->mapped) worker.mapped = std::make_unique<locate::MappedOwners>(*data_, worker.found->data());
        return worker;
    };  // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks): a unique_ptr owns it
    const auto write = [&](std::size_t first, const locate::SortedPoints& sorted, Worker& worker) {
        Location* const found = worker.found->data();
        const std::size_t last = sorted.size();
        found[last] = {};  // of those left out
        if (worker.mapped) worker.mapped->flush();
        sorted.for_each_in_callers_order([&](std::size_t place) { __builtin_prefetch(found + place); },
                                         [&](std::size_t i, std::size_t place) {
                                             if (place == last && worker.mapped)
                                                 worker.mapped->push(sorted.record(i, last), {}, nullptr, 0);
                                             cells[first + i] = found[place].cell;
                                             features[first + i] = found[place].feature;
                                         });
        data_->locations.put(std::move(worker.found));
    };
    bool finite = true;
    base::in_arena(threads, data_->index.cell_count() + cells.size(), [&] {
        if (data_->grid) {
            finite = base::all_finite(points);
            base::parallel_for(count, std::size_t{1} << 12, [&](std::size_t begin, std::size_t end) {
                const std::size_t d = data_->grid->dimension;
                const std::span<const double> some = points.subspan(d * begin, d * (end - begin));
                core::sample_grid(*data_->grid, {some, cells.data() + begin, features.data() + begin}, nullptr);
            });
        } else {
            finite = locate::for_chunks(*data_, data_->index.nodes.data(), points, all, make, write);
        }
        if (data_->grid || data_->mapped) locate::count_anew(features, all);
    });
    if (!finite) {
        if (nonfinite == NonfinitePoints::error) return locate::check_finite(points, data_->index.dimension());
        all.not_finite = locate::count_not_finite(points, data_->index.dimension());
    }
    if (counts != nullptr) counts->add(all);
    return Done{};
}

Result<Table> Locator::locate(std::span<const double> points, int threads, NonfinitePoints nonfinite) const {
    Table table;
    table.dimension = mesh().dimension;
    const std::size_t count = points.size() / data_->index.dimension();
    table.cells.resize(count);
    table.features.resize(count);
    Status done = locate(points, table.cells, table.features, &table.counts.locations, threads, nonfinite);
    if (!done) return done.error();
    return table;
}

Result<Table> Locator::locate_all(std::span<const double> points, int threads, NonfinitePoints nonfinite) const {
    const ExactEnvironment environment;
    if (data_->grid) return locate::not_listed("all cells of points");
    if (Status status = locate::check_size(points, data_->index.dimension()); !status) return status.error();
    struct OwnerOfPoint {
        std::size_t point;
        Location location;
    };
    const std::size_t d = data_->index.dimension(), count = points.size() / d;
    if (Status status = locate::check_finite(points, d); !status && nonfinite == NonfinitePoints::error)
        return status.error();
    constexpr std::size_t block = std::size_t{1} << 13;
    const std::size_t blocks = (count + block - 1) / block;
    std::vector<Table> parts(blocks);
    base::in_arena(threads, data_->index.cell_count() + count, [&] {
        data_->policy.prepare(count);
        base::parallel_for(blocks, [&](std::size_t b) {
            const std::size_t first = b * block, size = std::min(block, count - first);
            locate::SortedPoints sorted;
            sorted.sort(data_->index, data_->parts.occupancy(), points.subspan(d * first, d * size));
            locate::Finder finder(*data_, data_->index.nodes.data(), size);
            Table& part = parts[b];
            LocationCounts& counts = part.counts.locations;
            std::vector<OwnerOfPoint> found;
            std::array<locate::PointRecord, locate::chunk_size> records;
            for (std::size_t at = 0; at < sorted.size(); at += locate::chunk_size) {
                const std::size_t n = std::min(locate::chunk_size, sorted.size() - at);
                sorted.copy(at, n, records.data());
                finder.find_all(records.data(), n, counts, [&](std::uint32_t point, Mesh::Index cell, Feature feature) {
                    found.push_back({first + sorted.entries()[at + point].number, {cell, feature}});
                });
            }
            counts.ways.no_cell_near += sorted.left_out();
            std::ranges::sort(found, {}, [](const OwnerOfPoint& f) { return std::pair(f.point, f.location.cell); });
            const auto same = [&](const OwnerOfPoint& f, const OwnerOfPoint& g) {  // parts of one cell
                return f.point == g.point && mesh().cell_number(f.location.cell) == mesh().cell_number(g.location.cell);
            };
            found.erase(std::unique(found.begin(), found.end(), same), found.end());
            std::vector<Location> all;
            for (std::size_t i = first, at = 0; i < first + size; ++i) {
                const auto point = points.subspan(d * i, d);
                all.clear();
                for (; at < found.size() && found[at].point == i; ++at) all.push_back(found[at].location);
                if (data_->mapped && base::all_finite(point)) data_->mapped->all_owners(point.data(), all);
                if (all.empty()) all.emplace_back();
                counts.add(all.front().feature);
                for (const Location& own : all) {
                    part.points.insert(part.points.end(), point.begin(), point.end());
                    part.cells.push_back(own.cell);
                    part.features.push_back(own.feature);
                }
                part.point_begin.push_back(part.cells.size());
            }
        });
    });
    Table table;
    table.dimension = mesh().dimension;
    table.counts.locations.not_finite = locate::count_not_finite(points, d);
    table.point_begin.reserve(count + 1);
    table.point_begin.push_back(0);
    for (Table& part : parts) {
        for (const auto end : part.point_begin) table.point_begin.push_back(table.cells.size() + end);
        table.points.insert(table.points.end(), part.points.begin(), part.points.end());
        table.cells.insert(table.cells.end(), part.cells.begin(), part.cells.end());
        table.features.insert(table.features.end(), part.features.begin(), part.features.end());
        table.counts.locations.add(part.counts.locations);
        part = {};
    }
    return table;
}

}  // namespace barycert
