#include "barycert/io/vtk/xml_writer.hpp"

#include <array>
#include <cstring>
#include <utility>

#include "barycert/io/vti/appended.hpp"
#include "barycert/io/vtk/codec.hpp"

namespace barycert::io {
namespace {

/// Bytes of a block before it is compressed: a multiple of every number's size.
constexpr std::size_t block_size = std::size_t{1} << 17;
constexpr std::size_t offset_width = 20;

Compressor compressor_of(VtkData data) {
    return data == VtkData::zlib   ? Compressor::zlib
           : data == VtkData::lz4  ? Compressor::lz4
           : data == VtkData::lzma ? Compressor::lzma
                                   : Compressor::none;
}

std::string_view name_of_compressor(Compressor compressor) {
    constexpr std::array<std::string_view, 4> names{"", "vtkZLibDataCompressor", "vtkLZ4DataCompressor",
                                                    "vtkLZMADataCompressor"};
    return names[static_cast<std::size_t>(compressor)];
}

template <class T>
std::string_view bytes_of_words(const std::vector<T>& words) {
    return {reinterpret_cast<const char*>(words.data()), words.size() * sizeof(T)};
}

/// A file whose bytes can be replaced; on a pipe it is kept in memory up to the end.
class PatchedFile {
public:
    explicit PatchedFile(base::OutputFile& file) : file_(file), direct_(file.can_replace()) {}

    std::uint64_t size() const { return size_; }
    void write(std::string_view bytes) {
        size_ += bytes.size();
        direct_ ? file_.write(bytes) : static_cast<void>(memory_.append(bytes));
    }
    void replace(std::uint64_t at, std::string_view bytes) {
        if (direct_) {
            file_.replace(at, bytes);
        } else {
            memory_.replace(static_cast<std::size_t>(at), bytes.size(), bytes);
        }
    }
    void finish() { file_.write(memory_); }

private:
    base::OutputFile& file_;
    bool direct_;
    std::uint64_t size_ = 0;
    std::string memory_;
};

std::string open_elements(const OutFile& f) {
    return "  <" + f.data_set + f.attributes + ">\n    <Piece" + f.piece + ">\n";
}

std::string close_elements(const OutFile& f) {
    return "    </Piece>\n  </" + f.data_set + ">\n";
}

void write_raw(const OutFile& f, base::OutputFile& file) {
    std::string head = vtk_file_head(f.data_set) + open_elements(f);
    std::uint64_t offset = 0;
    for (const OutSection& section : f.sections) {
        head += "      <" + section.element + ">\n";
        for (const OutArray& a : section.arrays) {
            head += array_element(a.array, offset);
            offset += appended_header + a.size();
        }
        head += "      </" + section.element + ">\n";
    }
    file.write(head + close_elements(f) + std::string(appended_begin));
    for (const OutSection& section : f.sections) {
        for (const OutArray& a : section.arrays) {
            const std::uint64_t size = a.size();
            char header[appended_header];
            std::memcpy(header, &size, appended_header);
            file.write({header, appended_header});
            if (a.bytes != nullptr) {
                file.write({a.bytes, static_cast<std::size_t>(size)});
            } else {
                write_parts(
                    a, block_size, [](std::size_t, std::size_t, std::string&) {},
                    [&](std::string_view bytes) { file.write(bytes); });
            }
        }
    }
    file.write(appended_tail);
}

/// Header (number of blocks, their size, that of the last if it is shorter, their compressed sizes), then the blocks.
bool write_blocks(const OutArray& a, Compressor compressor, PatchedFile& file) {
    const std::size_t part = block_size / number_size(a.array.type);
    const std::uint64_t blocks = (a.size() + block_size - 1) / block_size;
    std::vector<std::uint64_t> header{blocks, blocks == 0 ? 0 : block_size, a.size() % block_size};
    const std::uint64_t begin = file.size();
    header.resize(3 + blocks);
    file.write(bytes_of_words(header));
    std::size_t next = 3;
    bool good = true;
    write_parts(
        a, part, [&](std::size_t, std::size_t, std::string& bytes) { bytes = pack(compressor, bytes); },
        [&](std::string_view packed) {
            good = good && !packed.empty();
            header[next++] = packed.size();
            file.write(packed);
        });
    file.replace(begin, bytes_of_words(header));
    return good;
}

/// Offsets are known last: there is room for them, and for the quote behind. (Blanks before the quote, as VTK has them,
/// keep meshio 5 from reading the file.)
bool write_compressed(const OutFile& f, Compressor compressor, base::OutputFile& target) {
    PatchedFile file(target);
    std::vector<std::uint64_t> places;
    file.write(vtk_file_head(f.data_set, name_of_compressor(compressor)) + open_elements(f));
    for (const OutSection& section : f.sections) {
        file.write("      <" + section.element + ">\n");
        for (const OutArray& a : section.arrays) {
            file.write(array_begin(a.array) + " format=\"appended\" offset=\"");
            places.push_back(file.size());
            file.write(std::string(offset_width + 1, ' ') + "/>\n");
        }
        file.write("      </" + section.element + ">\n");
    }
    file.write(close_elements(f) + std::string(appended_begin));
    const std::uint64_t data = file.size();
    std::size_t array = 0;
    bool good = true;
    for (const OutSection& section : f.sections) {
        for (const OutArray& a : section.arrays) {
            file.replace(places[array++], std::to_string(file.size() - data) + '"');
            good = write_blocks(a, compressor, file) && good;
        }
    }
    file.write(appended_tail);
    file.finish();
    return good;
}

void write_text(const OutFile& f, base::OutputFile& file) {
    constexpr std::size_t numbers_a_line = 12;
    file.write(vtk_file_head(f.data_set) + open_elements(f));
    for (const OutSection& section : f.sections) {
        file.write("      <" + section.element + ">\n");
        for (const OutArray& a : section.arrays) {
            file.write(array_begin(a.array) + " format=\"ascii\">\n");
            const auto components = static_cast<std::size_t>(a.array.components);
            write_as_text(a, components > 1 ? components : numbers_a_line,
                          [&](std::string_view text) { file.write(text); });
            file.write(a.array.type == VtiType::text ? "        </Array>\n" : "        </DataArray>\n");
        }
        file.write("      </" + section.element + ">\n");
    }
    file.write(close_elements(f) + "</VTKFile>\n");
}

}  // namespace

Status write_xml(const OutFile& f, const std::string& path, VtkData data) {
    base::OutputFile file(path);
    if (Status good = file.status(); !good) return good;
    if (data == VtkData::raw) {
        write_raw(f, file);
    } else if (data == VtkData::ascii) {
        write_text(f, file);
    } else if (!write_compressed(f, compressor_of(data), file)) {
        return Error{.what = "too little memory to compress the data", .file = path, .remedy = "free some memory"};
    }
    return file.commit();
}

}  // namespace barycert::io
