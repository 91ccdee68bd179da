#include "barycert/table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

void WayCounts::add(const WayCounts& other) {
    using W = WayCounts;
    for (const auto count : {&W::no_cell_near, &W::walk, &W::contested, &W::candidates}) this->*count += other.*count;
}

void LocationCounts::add(Feature f, std::uint64_t count) {
    constexpr std::array<std::uint64_t LocationCounts::*, 4> inside{&LocationCounts::interior, &LocationCounts::face,
                                                                    &LocationCounts::edge, &LocationCounts::vertex};
    const auto which = static_cast<std::size_t>(f);
    this->*(which < inside.size() ? inside[which] : &LocationCounts::outside) += count;
}

void LocationCounts::add(const LocationCounts& other) {
    using L = LocationCounts;
    for (const auto count : {&L::interior, &L::face, &L::edge, &L::vertex, &L::outside, &L::not_finite})
        this->*count += other.*count;
    tests.add(other.tests);
    ways.add(other.ways);
}

void SampleCounts::add(const SampleCounts& other) {
    using S = SampleCounts;
    for (const auto count : {&S::snapped, &S::extrapolated, &S::without_value, &S::undecided, &S::unmapped})
        this->*count += other.*count;
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
