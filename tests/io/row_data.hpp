/// Rows for tests.
#pragma once

#include <bit>
#include <cmath>
#include <limits>

#include "core/base/random.hpp"
#include "tests/io/points_files.hpp"

namespace barycert::io::testing {

/// A field of one component for each name.
inline std::vector<TableField> fields_of(const std::vector<std::string>& names) {
    std::vector<TableField> fields;
    for (const std::string& name : names) fields.push_back({name});
    return fields;
}

/// The arrays at which a TableView looks.
struct RowData {
    TableFormat format;
    std::vector<double> points, values, distances;
    std::vector<std::int32_t> cells;
    std::vector<Feature> features;

    TableView rows(std::size_t first, std::size_t count) const {
        const auto d = static_cast<std::size_t>(format.dimension);
        const std::size_t c = format.fields.size();
        return {.dimension = format.dimension,
                .points = std::span(points).subspan(first * d, count * d),
                .cells = std::span(cells).subspan(first, count),
                .features = std::span(features).subspan(first, count),
                .values = std::span(values).subspan(first * c, count * c),
                .distances = format.distances ? std::span(distances).subspan(first, count) : std::span<const double>()};
    }
    TableView rows() const { return rows(0, cells.size()); }
};

/// Any finite double, every exponent as likely as the next; at times one at the ends of the range.
inline double any_finite(base::Random& random) {
    constexpr double limits[] = {
        0.0, -0.0, 5e-324, -5e-324, 0x1p-1022, 0x0.fffffffffffffp-1022, 1.7976931348623157e308, 1, 1e22, 123456789};
    if (random.below(8) == 0) return limits[random.below(std::size(limits))];
    while (true) {
        const double x = std::bit_cast<double>(random.bits());
        if (std::isfinite(x)) return x;
    }
}

inline RowData random_rows(std::size_t count, const TableFormat& format, std::uint64_t seed) {
    constexpr Feature all[] = {Feature::interior, Feature::face, Feature::edge, Feature::vertex, Feature::outside};
    constexpr double inf = std::numeric_limits<double>::infinity();
    base::Random random(seed);
    RowData data{.format = format, .points = {}, .values = {}, .distances = {}, .cells = {}, .features = {}};
    for (std::size_t row = 0; row < count; ++row) {
        for (int axis = 0; axis < format.dimension; ++axis) data.points.push_back(any_finite(random));
        for (std::size_t i = 0; i < format.fields.size(); ++i) {
            const std::uint64_t kind = random.below(20);
            data.values.push_back(kind == 0 ? std::nan("") : kind == 1 ? inf : kind == 2 ? -inf : any_finite(random));
        }
        data.distances.push_back(random.below(4) == 0 ? std::nan("") : random.unit());
        data.features.push_back(all[random.below(5)]);
        const auto cell = static_cast<std::int32_t>(random.below(std::uint64_t{1} << 31));
        data.cells.push_back(data.features.back() == Feature::outside ? -1 : cell);
    }
    return data;
}

/// Writes the rows, `block` at a time.
inline Status write_rows(const std::string& path, const RowData& data, std::size_t block) {
    Result<std::unique_ptr<TableSink>> sink = open_table(path, data.format);
    if (!sink) return sink.error();
    for (std::size_t row = 0; row < data.cells.size(); row += block) {
        const Status written = (*sink)->write(data.rows(row, std::min(block, data.cells.size() - row)));
        if (!written) return written;
    }
    return (*sink)->commit();
}

}  // namespace barycert::io::testing
