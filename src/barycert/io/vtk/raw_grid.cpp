#include "barycert/io/vtk/raw_grid.hpp"

namespace barycert::io {

Error number_error(const std::string& path, std::size_t line, const std::string& what, std::uint64_t count,
                   const NumberFault& fault) {
    Error error{.what = what, .file = path, .line = line};
    const std::string number = "number " + std::to_string(fault.index) + " (from 0)";
    switch (fault.kind) {
        case NumberFault::Kind::too_few:
            error.expected = std::to_string(count) + " numbers";
            error.found = std::to_string(fault.index);
            error.remedy = "write the file again: it may be cut off";
            break;
        case NumberFault::Kind::no_number:
            error.what = number + " of " + what;
            error.expected = "a number of the type of the array";
            error.found = in_quotes(fault.text);
            break;
        default:
            error.what = number + " of " + what;
            error.expected = "a number that fits what it stands for";
            error.found = fault.text;
    }
    return error;
}

std::string inexact(const NumberFault& fault) {
    return "it holds " + fault.text + ", which is not exactly a double";
}

}  // namespace barycert::io
