/// Points with the columns that are carried through, for tests.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/text.hpp"
#include "mesh/columns.hpp"
#include "tests/io/points_files.hpp"

namespace barycert::io::testing {

struct CarriedPoints {
    std::vector<double> points;
    std::vector<ColumnFormat> formats;
    std::vector<Column> columns;
    Notes notes;

    /// "name:i 1 2", "name:n 0.5", "name:t a|b"
    std::string text(std::size_t k) const {
        const Column& column = columns.at(k);
        std::string out = column.name + (column.type() == Column::Type::integer  ? ":i"
                                         : column.type() == Column::Type::number ? ":n"
                                                                                 : ":t");
        const auto add = [&](const std::string& value) { out += (out.ends_with(":t") ? " " : "|") + value; };
        if (const auto* const integers = std::get_if<std::vector<std::int64_t>>(&column.values))
            for (const std::int64_t i : *integers) out += " " + std::to_string(i);
        if (const auto* const numbers = std::get_if<std::vector<double>>(&column.values))
            for (const double x : *numbers) out += " " + base::shortest(x);
        if (const auto* const texts = std::get_if<std::vector<std::string>>(&column.values))
            for (const std::string& t : *texts) add(t);
        return out;
    }
    std::string note_texts() const {
        std::string out;
        for (const Note& note : notes) out += std::string(name(note.kind)) + ": " + note.text + "\n";
        return out;
    }
};

/// All of it, `block` points at a time.
inline Result<CarriedPoints> read_carried(const std::string& path, int dimension, const PointOptions& options,
                                          std::size_t block = 3) {
    Result<std::unique_ptr<PointSource>> source = open_points(path, dimension, options);
    if (!source) return source.error();
    CarriedPoints out;
    out.formats = (*source)->carried();
    out.notes = (*source)->notes();
    for (const ColumnFormat& format : out.formats) out.columns.push_back(empty_column(format));
    std::vector<Column> some;
    while (true) {
        const Result<std::size_t> taken = (*source)->read(block, out.points);
        if (!taken) return taken.error();
        (*source)->take_carried(some);
        EXPECT_EQ(some.size(), out.columns.size());
        for (std::size_t k = 0; k < some.size(); ++k) {
            EXPECT_EQ(some[k].size(), *taken);
            EXPECT_EQ(some[k].name, out.formats[k].name);
            EXPECT_EQ(some[k].type(), out.formats[k].type);
            mesh::move_values(some[k], 0, some[k].size(), out.columns[k]);
        }
        if (*taken == 0) return out;
    }
}

inline Result<CarriedPoints> read_carried_bytes(const std::string& name, const std::string& bytes, int dimension,
                                                const PointOptions& options, std::size_t block = 3) {
    const TemporaryFolder folder;
    put(folder / name, bytes);
    return read_carried(folder / name, dimension, options, block);
}

}  // namespace barycert::io::testing
