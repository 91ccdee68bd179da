#include <bit>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/io/npy/npy_header.hpp"
#include "barycert/io/tetgen/row_errors.hpp"

namespace barycert::io {
namespace {

struct Complaint {
    const char* what;
    std::string expected;
    std::string found;
    std::string remedy;
};

Error failure(const std::string& file, Complaint c) {
    return {.what = c.what,
            .file = file,
            .line = 0,
            .expected = std::move(c.expected),
            .found = std::move(c.found),
            .remedy = std::move(c.remedy)};
}

/// As Python writes it: (5, 3), (5,), ().
std::string as_tuple(const std::vector<std::uint64_t>& shape) {
    std::string text = "(";
    for (std::size_t i = 0; i < shape.size(); ++i) text += (i != 0 ? ", " : "") + std::to_string(shape[i]);
    return text + (shape.size() == 1 ? ",)" : ")");
}

Error type_error(const NpyHeader& header, std::size_t dimension, const std::string& file) {
    if (header.structured) {
        return failure(file, {"cannot read points of that type", "float64 or float32", "a structured array",
                              dimension == 2 ? "save numpy.stack([a['x'], a['y']], axis=1)"
                                             : "save numpy.stack([a['x'], a['y'], a['z']], axis=1)"});
    }
    return failure(file, {"cannot read points of that type", "float64 or float32: \"<f8\", \">f8\", \"<f4\" or \">f4\"",
                          base::quoted(header.descr), "save a.astype('f8')"});
}

Error shape_error(const std::vector<std::uint64_t>& shape, std::size_t dimension, const std::string& file) {
    const std::string d = std::to_string(dimension);
    std::string remedy = "save an array with a row of " + d + " coordinates for each point";
    if (shape.size() == 1) remedy = "if it holds the coordinates point after point, save a.reshape(-1, " + d + ")";
    if (shape.size() == 2 && shape[1] > dimension) {
        remedy = "if the first " + d + " columns are the coordinates, save a[:, :" + d + "]";
    }
    if (shape.size() == 2 && shape[0] == dimension) remedy = "if it has a column for each point, save a.T";
    return failure(file, {"an array of another shape", "(n, " + d + "), for the mesh is " + d + "-dimensional",
                          as_tuple(shape), std::move(remedy)});
}

}  // namespace

Result<NpyLayout> settle_npy_layout(const NpyHeader& header, std::size_t dimension, std::uint64_t room,
                                    const std::string& file) {
    const std::string& type = header.descr;
    if (type != "<f8" && type != ">f8" && type != "<f4" && type != ">f4") return type_error(header, dimension, file);
    if (header.shape.size() != 2 || header.shape[1] != dimension) return shape_error(header.shape, dimension, file);
    const NpyLayout layout{.count = header.shape[0],
                           .item = type[2] == '8' ? std::size_t{8} : std::size_t{4},
                           .swapped = (type[0] == '>') == (std::endian::native == std::endian::little),
                           .fortran_order = header.fortran_order};
    const std::uint64_t row = dimension * layout.item;
    if (layout.count > room / row) {
        return failure(
            file, {"the file ends too early",
                   std::to_string(layout.count) + " points of " + std::to_string(row) + " bytes, as its header tells",
                   std::to_string(room) + " bytes", "the file may be cut short: write it again"});
    }
    if (layout.count * row != room) {
        return failure(file, {"bytes after the array", std::to_string(layout.count * row) + ", as the header tells",
                              std::to_string(room), "save one array a file"});
    }
    return layout;
}

}  // namespace barycert::io
