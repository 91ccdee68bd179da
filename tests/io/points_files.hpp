/// Files of points and rows for tests.
#pragma once

#include <unistd.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/io/tetgen/mesh_files.hpp"

namespace barycert::io::testing {

using barycert::testing::bits_of;
using barycert::testing::get;
using barycert::testing::put;
using barycert::testing::TemporaryFolder;

/// All points, `block` at a time.
inline Result<std::vector<double>> read_all(PointSource& source, std::size_t block = 3) {
    std::vector<double> points;
    while (true) {
        const std::size_t before = points.size();
        Result<std::size_t> taken = source.read(block, points);
        if (!taken) return taken.error();
        EXPECT_EQ(points.size() - before, *taken * static_cast<std::size_t>(source.dimension()));
        EXPECT_LE(*taken, block);
        if (*taken == 0) return points;
    }
}

inline Result<std::vector<double>> read_file(const std::string& path, int dimension, std::size_t block = 3) {
    Result<std::unique_ptr<PointSource>> source = open_points(path, dimension);
    if (!source) return source.error();
    EXPECT_EQ((*source)->dimension(), dimension);
    return read_all(**source, block);
}

/// Reads `bytes` as a file of that name.
inline Result<std::vector<double>> read_bytes(const std::string& name, const std::string& bytes, int dimension,
                                              std::size_t block = 3) {
    const TemporaryFolder folder;
    put(folder / name, bytes);
    return read_file(folder / name, dimension, block);
}

/// An error's parts, but for the file; a part that is nullptr is not checked, and of the remedy only a part.
struct Expected {
    std::size_t line;
    const char* what;
    const char* expected;
    const char* found;
    const char* remedy_part;
};

template <class T>
void expect_error(const Result<T>& result, const std::string& file_end, const Expected& e) {
    ASSERT_FALSE(result) << "no error, but '" << e.what << "' was to be told";
    const Error& error = result.error();
    SCOPED_TRACE(error.message());
    EXPECT_TRUE(error.file.ends_with(file_end));
    EXPECT_EQ(error.line, e.line);
    EXPECT_EQ(error.what, e.what);
    if (e.expected != nullptr) {
        EXPECT_EQ(error.expected, e.expected);
    }
    if (e.found != nullptr) {
        EXPECT_EQ(error.found, e.found);
    }
    if (e.remedy_part != nullptr) {
        EXPECT_NE(error.remedy.find(e.remedy_part), std::string::npos);
    }
}

/// An NPY file of that version: head, text of the header padded as NumPy does, data.
inline std::string npy_bytes(const std::string& dictionary, const std::string& data, int version = 1) {
    const std::size_t head = version == 1 ? 10 : 12;
    std::string text = dictionary;
    while ((head + text.size() + 1) % 64 != 0) text += ' ';
    text += '\n';
    std::string bytes = "\x93NUMPY";
    bytes += {static_cast<char>(version), '\0'};
    for (std::size_t i = 8; i < head; ++i) bytes += static_cast<char>(text.size() >> 8 * (i - 8) & 0xFF);
    return bytes + text + data;
}

inline std::string npy_dictionary(const std::string& type, const std::string& shape, bool fortran = false) {
    return "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': " + shape + ", }";
}

/// Resident memory now, in MiB.
inline double resident_mib() {
    std::ifstream statm("/proc/self/statm");
    double whole = 0, resident = 0;
    statm >> whole >> resident;
    return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// Points the standard input or output elsewhere until the end of the scope. The descriptor is taken over.
class Redirected {
public:
    Redirected(int standard, int descriptor) : standard_(standard), before_(::dup(standard)) {
        ::dup2(descriptor, standard_);
        ::close(descriptor);
    }
    ~Redirected() {
        ::dup2(before_, standard_);
        ::close(before_);
    }
    Redirected(const Redirected&) = delete;
    Redirected& operator=(const Redirected&) = delete;

private:
    int standard_;
    int before_;
};

}  // namespace barycert::io::testing
