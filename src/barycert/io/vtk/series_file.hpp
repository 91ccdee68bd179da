/// ParaView's series files: JSON that names the file of each step, NAME.vtu.series.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "barycert/io/vtk/collection.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// Whether the text can be one: it begins with an object of JSON.
bool is_series_file(std::string_view bytes);

/// The files that it names, with their times, in its order: {"files": [{"name": "a.vtu", "time": 0.5}, ...]}. Error: no
/// JSON, a member that is missing or of another kind, a time that is not finite, a file of more than 64 MiB.
Result<std::vector<CollectionFile>> series_files(std::string_view bytes, const std::string& path);

}  // namespace barycert::io
