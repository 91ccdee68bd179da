#include "barycert/table.hpp"

#include <algorithm>
#include <bit>

namespace barycert {

namespace {

template <class Counts, class... Member>
void add_members(Counts& to, const Counts& from, Member... member) {
    ((to.*member += from.*member), ...);
}

}  // namespace

void WayCounts::add(const WayCounts& other) {
    add_members(*this, other, &WayCounts::no_cell_near, &WayCounts::walk, &WayCounts::contested,
                &WayCounts::candidates);
}

void LocationCounts::add(Feature f, std::uint64_t count) {
    constexpr std::array<std::uint64_t LocationCounts::*, 4> inside{&LocationCounts::interior, &LocationCounts::face,
                                                                    &LocationCounts::edge, &LocationCounts::vertex};
    const auto which = static_cast<std::size_t>(f);
    this->*(which < inside.size() ? inside[which] : &LocationCounts::outside) += count;
}

void LocationCounts::add(const LocationCounts& other) {
    add_members(*this, other, &LocationCounts::interior, &LocationCounts::face, &LocationCounts::edge,
                &LocationCounts::vertex, &LocationCounts::outside, &LocationCounts::not_finite);
    tests.add(other.tests);
    ways.add(other.ways);
}

void SampleCounts::add(const SampleCounts& other) {
    add_members(*this, other, &SampleCounts::snapped, &SampleCounts::extrapolated, &SampleCounts::without_value,
                &SampleCounts::undecided, &SampleCounts::unmapped);
    locations.add(other.locations);
    values.add(other.values);
    // Bits of numbers that are not negative compare as they do, whatever the environment does to subnormal ones.
    const auto larger = [](double a, double b) {
        return std::bit_cast<double>(std::max(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)));
    };
    farthest = larger(farthest, other.farthest);
    max_off = larger(max_off, other.max_off);
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
