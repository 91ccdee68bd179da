#include "barycert/io/gmsh/rows.hpp"

namespace barycert::io {

std::vector<RunPart> cut_runs(const MshFile& file, std::span<const Run> runs) {
    constexpr std::size_t part_bytes = std::size_t{1} << 18;
    std::vector<RunPart> parts;
    for (const Run& run : runs) {
        if (file.layout() == MshLayout::lines) {
            for (const LineIndex::Part& part : file.lines().cut(run.place, run.count)) {
                parts.push_back({&run, part.first, part.last, part.at});
            }
            continue;
        }
        const std::size_t step = std::max<std::size_t>(1, part_bytes / run.row_bytes);
        for (std::size_t i = 0; i < run.count; i += step) {
            parts.push_back({&run, i, std::min(i + step, run.count), run.place.at + i * run.row_bytes});
        }
    }
    return parts;
}

Error row_error(const MshFile& file, const char* section, const char* at, const RowFault& fault, std::size_t row) {
    const char* const end = file.data().bytes().data() + file.data().bytes().size();
    const bool text = file.layout() != MshLayout::binary;
    while (text && at != end && (is_blank(*at) || *at == '\r' || *at == '\n') && !fault.has_number) ++at;
    std::string what = std::string(fault.what) + " in $" + section;
    if (!text) what += ", row " + std::to_string(row) + " from 0";
    const std::string found = fault.has_number ? std::to_string(fault.number) : text ? word_at(at, end) : "another one";
    return file.error_at(at, what, fault.expected, found, fault.remedy);
}

}  // namespace barycert::io
