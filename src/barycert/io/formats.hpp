/// The sources and sinks by format.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "barycert/io.hpp"

namespace barycert::io {

enum class FileFormat : std::uint8_t { csv, npy, node, vtu };

/// By the suffix, in any case: .csv .npy .node .vtu; "-" is CSV. Returns an Error that lists them for another suffix.
Result<FileFormat> format_of(const std::string& path);

/// The same for points: .txt .dat .xyz .tsv are CSV, and so is a pipe or device of any name; a file without a suffix is
/// told by its first bytes.
Result<FileFormat> format_of_points(const std::string& path);

/// file_error of a line.
inline Error line_error(std::string file, std::size_t line, std::string what, std::string expected = {},
                        std::string found = {}, std::string remedy = {}) {
    return {std::move(what), std::move(file), line, std::move(expected), std::move(found), std::move(remedy)};
}

/// The line of a text in which `at` lies, from 1.
inline std::size_t line_of(std::string_view text, const char* at) {
    return static_cast<std::size_t>(std::count(text.data(), at, '\n')) + 1;
}

/// The path without .gz at its end: readers unpack such files, and no writer makes one.
std::string_view without_gz(std::string_view path);

/// The path, or with .gz at its end where there is only such a file.
std::string plain_or_packed(const std::string& path);

/// True if the path, but for .gz, ends so, in any case. `suffix` is in lower case.
bool has_suffix(std::string_view path, std::string_view suffix);

/// True if the path ends as those of VTK's files with meshes do: .vtu .vtk .vtp, .pvtu .pvtp .vtm .vtpd .vtpc .pvd.
bool is_vtk_file(std::string_view path);

/// True for these and grids, whose points can be read: .vti .vtr .vts.
bool is_vtk_points_file(std::string_view path);

// `path`, `options` and `format` are as for open_points and open_table.
Result<std::unique_ptr<PointSource>> open_csv_source(const std::string& path, int dimension,
                                                     const PointOptions& options);
Result<std::unique_ptr<PointSource>> open_npy_source(const std::string& path, int dimension,
                                                     const PointOptions& options);
Result<std::unique_ptr<PointSource>> open_node_source(const std::string& path, int dimension,
                                                      const PointOptions& options);

Result<std::unique_ptr<TableSink>> open_csv_sink(const std::string& path, const TableFormat& format);
Result<std::unique_ptr<TableSink>> open_npy_sink(const std::string& path, const TableFormat& format);

/// Refuses rows whose spans and columns do not fit together and the format, and the feature degenerate.
Status check_rows(const TableView& rows, const TableFormat& format, const std::string& path);

}  // namespace barycert::io
