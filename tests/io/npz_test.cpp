// Weights in NPZ files, as NumPy and SciPy read them.
#include <cstdlib>
#include <filesystem>
#include <numeric>

#include "io/npz/weights_file.hpp"
#include "tests/io/row_data.hpp"

namespace barycert::io::testing {
namespace {

/// A Python that has the module; empty if there is none.
std::string python_with(const std::string& module) {
    for (const char* const python : {"python3", "/usr/bin/python3"}) {
        if (std::system((std::string(python) + " -c 'import " + module + "' >/dev/null 2>&1").c_str()) == 0)
            return python;
    }
    return {};
}

bool runs(const std::string& python, const TemporaryFolder& folder, const std::string& script) {
    put(folder / "script.py", script);
    return std::system(("cd '" + folder / "." + "' && " + python + " script.py").c_str()) == 0;
}

/// Rows of 0 to 10 entries, in blocks of odd sizes; and the same as plain numbers in files.
void write_weights(const TemporaryFolder& folder, std::size_t rows, std::uint64_t nodes) {
    auto file = WeightsFile::open(folder / "w.npz", nodes);
    ASSERT_TRUE(file) << file.error().message();
    base::Random random(rows);
    std::vector<std::uint8_t> counts;
    std::vector<Mesh::Index> indices, cells;
    std::vector<double> data;
    for (std::size_t first = 0; first < rows;) {
        const std::size_t begin = data.size(), size = std::min<std::size_t>(rows - first, 1 + random.below(777));
        for (std::size_t i = 0; i < size; ++i) {
            counts.push_back(static_cast<std::uint8_t>(random.below(11)));
            cells.push_back(counts.back() == 0 ? -1 : static_cast<Mesh::Index>(random.below(1u << 30)));
            for (std::uint64_t k = 0, node = 0; k < counts.back(); ++k) {
                node += 1 + random.below(nodes / 12);
                indices.push_back(static_cast<Mesh::Index>(node));
                data.push_back(random.uniform(-1, 2));
            }
        }
        ASSERT_TRUE((*file)->write(std::span(counts).subspan(first), std::span(indices).subspan(begin),
                                   std::span(data).subspan(begin), std::span(cells).subspan(first)));
        first += size;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "w.npz"));
    ASSERT_TRUE((*file)->commit());
    put(folder / "data", bits_of(data));
    put(folder / "indices", {reinterpret_cast<const char*>(indices.data()), 4 * indices.size()});
    put(folder / "counts", {reinterpret_cast<const char*>(counts.data()), counts.size()});
    put(folder / "cells", {reinterpret_cast<const char*>(cells.data()), 4 * cells.size()});
}

constexpr const char* as_numpy = R"(
import numpy as np
z = np.load('w.npz')
assert sorted(z.files) == ['cell', 'data', 'format', 'indices', 'indptr', 'shape'], z.files
data, indices = np.fromfile('data'), np.fromfile('indices', dtype='<i4')
counts, cells = np.fromfile('counts', dtype='u1'), np.fromfile('cells', dtype='<i4')
indptr = np.concatenate([[0], np.cumsum(counts, dtype='i8')])
assert z['data'].dtype == 'f8' and z['data'].tobytes() == data.tobytes()
assert z['indices'].dtype == 'i4' and (z['indices'] == indices).all()
assert z['indptr'].dtype == 'i4' and (z['indptr'] == indptr).all()
assert z['cell'].dtype == 'i8' and (z['cell'] == cells).all()
)";

TEST(NpzWeights, AreWhatNumpyReads) {
    const std::string python = python_with("numpy");
    if (python.empty()) GTEST_SKIP() << "python3 has no numpy";
    for (const std::size_t rows : {0, 1, 100000}) {
        const TemporaryFolder folder;
        write_weights(folder, rows, 1000000);
        EXPECT_TRUE(runs(python, folder, as_numpy)) << rows;
        EXPECT_TRUE(runs(python, folder, "import zipfile\nassert zipfile.ZipFile('w.npz').testzip() is None\n"));
    }
}

TEST(NpzWeights, AreWhatScipyReads) {
    const std::string python = python_with("scipy.sparse");
    if (python.empty()) GTEST_SKIP() << "python3 has no scipy";
    for (const std::size_t rows : {0, 1, 3000}) {
        const TemporaryFolder folder;
        write_weights(folder, rows, 5000);
        EXPECT_TRUE(runs(python, folder, std::string(as_numpy) + R"(
import scipy.sparse
W = scipy.sparse.load_npz('w.npz')
assert W.format == 'csr' and W.shape == (len(counts), 5000) and W.nnz == len(data), W
assert W.indices.dtype == 'i4' and W.has_sorted_indices and W.has_canonical_format
row = np.repeat(np.arange(len(counts)), counts)
M = scipy.sparse.coo_matrix((data, (row, indices)), shape=W.shape)
assert (W != M.tocsr()).nnz == 0
)")) << rows;
    }
}

// Sizes beyond 4 GiB, and more entries than 32 bits count, stand in other fields; no test writes so much. The headers
// of small files must satisfy a strict reader.
TEST(NpzWeights, AreAZipArchive) {
    const TemporaryFolder folder;
    write_weights(folder, 10, 1000);
    const std::string bytes = get(folder / "w.npz");
    EXPECT_TRUE(bytes.starts_with("PK\x03\x04"));
    EXPECT_EQ(bytes.substr(bytes.size() - 22, 4), "PK\x05\x06");
    const TemporaryFolder again;
    write_weights(again, 10, 1000);
    EXPECT_EQ(get(again / "w.npz"), bytes) << "no dates, no names of users";
}

TEST(NpzWeights, AppearWholeOrNotAtAll) {
    const TemporaryFolder folder;
    {
        auto file = WeightsFile::open(folder / "w.npz", 10);
        ASSERT_TRUE(file);
        const std::vector<std::uint8_t> counts{1};
        const std::vector<Mesh::Index> nodes{3}, cells{0};
        const std::vector<double> weights{1};
        ASSERT_TRUE((*file)->write(counts, nodes, weights, cells));
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder / "."));
    const auto device = WeightsFile::open("/dev/null", 10);
    ASSERT_FALSE(device);
    EXPECT_NE(device.error().message().find("cannot write NPZ to a pipe or device"), std::string::npos);
    EXPECT_FALSE(WeightsFile::open(folder / "no/such/w.npz", 10));
}

}  // namespace
}  // namespace barycert::io::testing
