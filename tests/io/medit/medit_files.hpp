/// Medit's files of tests: made here, number by number, in every version, as text and in both byte orders.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/io/gmsh/msh_files.hpp"

namespace barycert::testing {

struct MeditPart {
    std::string keyword;
    int code;
    std::size_t reals;                      ///< the first numbers of each row
    std::vector<std::vector<double>> rows;  ///< integers behind them
    std::vector<int> types = {};            ///< of fields
};

struct Medit {
    int dimension = 3;
    std::vector<MeditPart> parts;
};

/// The file as text (version only told) or binary.
inline std::string medit_bytes(const Medit& file, int version, Form form) {
    std::string out;
    const auto raw = [&](std::uint64_t word, int size) {
        for (int i = 0; i < size; ++i) out += static_cast<char>(word >> (8 * (form == Form::big ? size - 1 - i : i)));
    };
    const auto put_int = [&](std::int64_t x, int size) { raw(static_cast<std::uint64_t>(x), size); };
    const int place = version >= 3 ? 8 : 4, index = version == 4 ? 8 : 4;
    if (form == Form::text) {
        out =
            "MeshVersionFormatted " + std::to_string(version) + "\nDimension " + std::to_string(file.dimension) + "\n";
        for (const MeditPart& part : file.parts) {
            out += "\n" + part.keyword + "\n" + std::to_string(part.rows.size()) + "\n";
            if (!part.types.empty()) out += std::to_string(part.types.size());
            for (const int type : part.types) out += " " + std::to_string(type);
            if (!part.types.empty()) out += "\n";
            for (const std::vector<double>& row : part.rows) {
                for (std::size_t i = 0; i < row.size(); ++i)
                    out += (i == 0 ? "" : " ") + (i < part.reals ? base::shortest(row[i])
                                                                 : std::to_string(static_cast<std::int64_t>(row[i])));
                out += "\n";
            }
        }
        return out + "\nEnd\n";
    }
    put_int(1, 4);
    put_int(version, 4);
    put_int(3, 4);
    put_int(12 + place + 4, place);
    put_int(file.dimension, 4);
    for (const MeditPart& part : file.parts) {
        std::string body;
        std::swap(out, body);
        put_int(static_cast<std::int64_t>(part.rows.size()), index);
        if (!part.types.empty()) put_int(static_cast<std::int64_t>(part.types.size()), 4);
        for (const int type : part.types) put_int(type, 4);
        for (const std::vector<double>& row : part.rows) {
            for (std::size_t i = 0; i < row.size(); ++i) {
                if (i >= part.reals) {
                    put_int(static_cast<std::int64_t>(row[i]), index);
                } else if (version == 1) {
                    raw(std::bit_cast<std::uint32_t>(static_cast<float>(row[i])), 4);
                } else {
                    raw(std::bit_cast<std::uint64_t>(row[i]), 8);
                }
            }
        }
        std::swap(out, body);
        put_int(part.code, 4);
        put_int(static_cast<std::int64_t>(out.size() + static_cast<std::size_t>(place) + body.size()), place);
        out += body;
    }
    put_int(54, 4);
    put_int(0, place);
    return out;
}

struct MeditForm {
    int version;
    Form form;
};
inline constexpr std::array<MeditForm, 12> medit_forms{{{1, Form::text},
                                                        {2, Form::text},
                                                        {3, Form::text},
                                                        {4, Form::text},
                                                        {1, Form::little},
                                                        {2, Form::little},
                                                        {3, Form::little},
                                                        {4, Form::little},
                                                        {1, Form::big},
                                                        {2, Form::big},
                                                        {3, Form::big},
                                                        {4, Form::big}}};

inline std::string name_of(const MeditForm& form) {
    return name_of(MshKind{form.version, form.form});
}

/// Two tetrahedra with a common face and references of their own, two of their triangles, an edge, and a node of no
/// cell. All coordinates are floats.
inline Medit two_of_medit() {
    return {3,
            {{"Vertices",
              4,
              3,
              {{0, 0, 0, 7}, {1, 0, 0, 0}, {0, 0.125, 0, -3}, {0, 0, 1.25, 0}, {1, 1, 1, 9}, {9, 9, 9, 0}}},
             {"Edges", 5, 0, {{1, 2, 4}}},
             {"Ridges", 14, 0, {{1}}},
             {"Triangles", 6, 0, {{1, 2, 3, 10}, {2, 3, 5, 20}}},
             {"Tetrahedra", 8, 0, {{1, 2, 3, 4, 1}, {2, 3, 4, 5, 2}}}}};
}

inline Result<Mesh> read_medit_bytes(const std::string& bytes, const ReadOptions& options = {}) {
    const TemporaryFolder folder;
    put(folder / "m.mesh", bytes);
    return read_mesh(folder / "m.mesh", options);
}

}  // namespace barycert::testing
