#include "barycert/io/vti/appended.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "barycert/io/vti/xml_name.hpp"

namespace barycert::io {
namespace {

struct TypeName {
    std::string_view name;
    std::uint64_t bytes;
};
constexpr std::array<TypeName, 7> type_names{
    {{"Int8", 1}, {"UInt8", 1}, {"Int32", 4}, {"Int64", 8}, {"Float32", 4}, {"Float64", 8}, {"String", 1}}};

}  // namespace

Error wrong_in_memory(const std::string& path, std::string what, std::string expected, std::string found) {
    return {.what = std::move(what),
            .file = path,
            .line = 0,
            .expected = std::move(expected),
            .found = std::move(found),
            .remedy = "correct what is to be written, or its arrays, in memory"};
}

std::string vtk_file_head(std::string_view data_set, std::string_view compressor) {
    const bool big = std::endian::native == std::endian::big;
    return "<VTKFile type=\"" + std::string(data_set) + "\" version=\"1.0\" byte_order=\"" +
           (big ? "BigEndian" : "LittleEndian") + "\" header_type=\"UInt64\"" +
           (compressor.empty() ? "" : " compressor=\"" + std::string(compressor) + '"') + ">\n";
}

std::uint64_t number_size(VtiType type) {
    return type_names[static_cast<std::size_t>(type)].bytes;
}

std::string array_begin(const VtiArray& array) {
    const bool text = array.type == VtiType::text;
    std::string element = std::string("        <") + (text ? "Array" : "DataArray") + " type=\"" +
                          std::string(type_names[static_cast<std::size_t>(array.type)].name) + "\" Name=\"" +
                          *xml_attribute(array.name) + "\"";
    if (array.components != 1) element += " NumberOfComponents=\"" + std::to_string(array.components) + "\"";
    return element;
}

std::string array_element(const VtiArray& array, std::uint64_t offset) {
    return array_begin(array) + " format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
}

Status check_arrays(const std::string& path, const std::vector<VtiArray>& arrays) {
    std::vector<std::string> names;
    for (const VtiArray& array : arrays) {
        if (array.name.empty()) return wrong_in_memory(path, "the name of an array", "one", "none");
        if (!xml_attribute(array.name)) {
            return wrong_in_memory(path, "the name of an array", "text in UTF-8 without control characters",
                                   '"' + array.name + '"');
        }
        if (array.components < 1) {
            return wrong_in_memory(path, "the components of array \"" + array.name + '"', "1 or more",
                                   std::to_string(array.components));
        }
        names.push_back(array.name);
    }
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end())
        return wrong_in_memory(path, "the names of arrays", "different ones", '"' + *twice + "\" twice");
    return Done{};
}

}  // namespace barycert::io
