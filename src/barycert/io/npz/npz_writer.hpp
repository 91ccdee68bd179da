/// NPZ files: a ZIP archive of NPY files, as numpy.savez writes it. Format of ZIP: APPNOTE.TXT 6.3 of PKWARE.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/base/output_file.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// Arrays one after the other, stored without compression; of any size, by ZIP64 where it takes that. The file appears
/// whole at commit(), or not at all.
class NpzWriter {
public:
    /// Error: the file cannot be written, or is a pipe or device: sizes are known only at the end of an array.
    static Result<std::unique_ptr<NpzWriter>> open(const std::string& path);

    /// Begins the array NAME.npy. `descr`: NumPy's name of the type, such as <f8.
    void begin(const std::string& name, const std::string& descr);
    void write(std::string_view bytes);
    /// `shape`: as many numbers as were written.
    void end(const std::vector<std::uint64_t>& shape);

    Status commit();

private:
    struct Member {
        std::string name, descr;
        std::uint64_t offset = 0, size = 0;
        std::uint32_t checksum = 0;
    };
    explicit NpzWriter(const std::string& path) : file_(path) {}
    void put(std::string_view bytes);
    std::string local_header(const Member& member) const;
    std::string central_header(const Member& member) const;

    base::OutputFile file_;
    std::uint64_t size_ = 0;
    std::vector<Member> members_;
    std::uint32_t numbers_ = 0;  ///< CRC-32 of the numbers of the array that was begun
};

}  // namespace barycert::io
