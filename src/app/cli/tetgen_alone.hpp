/// Programs that read meshes of TetGen and Triangle alone.
#pragma once

#include <string>

namespace barycert::cli {

/// Throws an Exception if the file is another one, which `program` does not read; what does is told.
void refuse_other_formats(const std::string& path, const std::string& program);

}  // namespace barycert::cli
