#include "barycert/table.hpp"

#include <algorithm>
#include <bit>

namespace barycert {

void WayCounts::add(const WayCounts& other) {
    no_cell_near += other.no_cell_near;
    walk += other.walk;
    contested += other.contested;
    candidates += other.candidates;
}

void LocationCounts::add(Feature f, std::uint64_t count) {
    switch (f) {
        case Feature::interior:
            interior += count;
            break;
        case Feature::face:
            face += count;
            break;
        case Feature::edge:
            edge += count;
            break;
        case Feature::vertex:
            vertex += count;
            break;
        default:
            outside += count;
            break;
    }
}

void LocationCounts::add(const LocationCounts& other) {
    interior += other.interior;
    face += other.face;
    edge += other.edge;
    vertex += other.vertex;
    outside += other.outside;
    not_finite += other.not_finite;
    tests.add(other.tests);
    ways.add(other.ways);
}

void SampleCounts::add(const SampleCounts& other) {
    locations.add(other.locations);
    values.add(other.values);
    snapped += other.snapped;
    extrapolated += other.extrapolated;
    without_value += other.without_value;
    // Bits of numbers that are not negative compare as they do, whatever the environment does to subnormal ones.
    farthest = std::bit_cast<double>(
        std::max(std::bit_cast<std::uint64_t>(farthest), std::bit_cast<std::uint64_t>(other.farthest)));
}

std::vector<std::string> column_names(const std::vector<TableField>& fields) {
    std::vector<std::string> names;
    for (const TableField& field : fields) {
        for (int c = 0; c < field.components; ++c)
            names.push_back(field.components == 1 ? field.name : field.name + "." + std::to_string(c));
    }
    return names;
}

void append_rows(const TableView& rows, std::vector<Field>& fields) {
    const double* at = rows.values.data();
    for (std::size_t i = 0; i < rows.row_count(); ++i) {
        for (Field& field : fields) {
            field.data.insert(field.data.end(), at, at + field.components);
            at += field.components;
        }
    }
}

}  // namespace barycert
