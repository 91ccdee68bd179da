// Against NumPy itself, where there is one.
#include <cstdlib>

#include "mesh/columns.hpp"
#include "tests/io/row_data.hpp"

namespace barycert::io::testing {
namespace {

/// The first python3 of the path that has NumPy, or Debian's; empty: there is none.
const std::string& python_with_numpy() {
    static const std::string found = [] {
        for (const char* const python : {"python3", "/usr/bin/python3"})
            if (std::system((std::string(python) + " -c 'import numpy' >/dev/null 2>&1").c_str()) == 0)
                return std::string(python);
        return std::string();
    }();
    return found;
}

bool python(const TemporaryFolder& folder, const std::string& script) {
    put(folder / "script.py", script);
    return std::system(("cd '" + folder / "." + "' && " + python_with_numpy() + " script.py").c_str()) == 0;
}

TEST(NumPy, ReadsWhatIsWritten) {
    if (python_with_numpy().empty()) GTEST_SKIP() << "no python3 with numpy";
    const TemporaryFolder folder;
    const RowData data =
        random_rows(5000, {.dimension = 3, .fields = {{"p"}, {"it's \\ \n"}, {"\xC3\xA4"}}, .distances = true}, 21);
    ASSERT_TRUE(write_rows(folder / "r.npy", data, 700));
    put(folder / "points", bits_of(data.points));
    put(folder / "values", bits_of(data.values));
    put(folder / "distances", bits_of(data.distances));
    put(folder / "cells", {reinterpret_cast<const char*>(data.cells.data()), 4 * data.cells.size()});
    std::string features;
    for (const Feature f : data.features) features += std::string(name(f)) + "\n";
    put(folder / "features", features);
    EXPECT_TRUE(python(folder, R"(
import numpy as np
a = np.load('r.npy')
assert a.shape == (5000,), a.shape
assert a.dtype.names == ('x', 'y', 'z', 'cell', 'feature', 'p', "it's \\ \n", '\u00e4', 'distance'), a.dtype
assert a.dtype['cell'] == 'i8' and a.dtype['feature'] == 'S8'
def bits(names): return np.stack([a[n] for n in names], axis=1).tobytes()
assert bits('xyz') == open('points', 'rb').read()
assert bits(a.dtype.names[5:8]) == open('values', 'rb').read()
assert bits(['distance']) == open('distances', 'rb').read()
assert (a['cell'] == np.fromfile('cells', dtype='<i4')).all()
assert b''.join(f + b'\n' for f in a['feature']) == open('features', 'rb').read()
)"));
}

TEST(NumPy, WritesWhatIsRead) {
    if (python_with_numpy().empty()) GTEST_SKIP() << "no python3 with numpy";
    const TemporaryFolder folder;
    const std::vector<double> points = random_rows(3000, {.dimension = 3}, 22).points;
    put(folder / "points", bits_of(points));
    ASSERT_TRUE(python(folder, R"(
import numpy as np
a = np.fromfile('points').reshape(-1, 3)
np.save('c.npy', a)
np.save('fortran.npy', np.asfortranarray(a))
np.save('big.npy', a.astype('>f8'))
np.save('bigfortran.npy', np.asfortranarray(a.astype('>f8')))
for v in [(2, 0), (3, 0)]:
    with open('v%d.npy' % v[0], 'wb') as f: np.lib.format.write_array(f, a, v)
np.save('empty.npy', a[:0])
np.seterr(over='ignore')
np.save('single.npy', a.astype('f4')[np.isfinite(a.astype('f4')).all(axis=1)])
np.load('single.npy').astype('f8').tofile('singles')
np.save('plane.npy', a[:, :2])
a[:, :2].tofile('plane')
np.save('int.npy', np.zeros((2, 3), dtype=int))
np.save('row.npy', a[0])
np.savez('zip.npz', a)
import os; os.rename('zip.npz', 'zip.npy')
np.savetxt('t.csv', a, delimiter=',', header='x,y,z', comments='')
np.savetxt('blanks.csv', a)
)"));
    for (const char* file : {"c.npy", "fortran.npy", "big.npy", "bigfortran.npy", "v2.npy", "v3.npy"}) {
        SCOPED_TRACE(file);
        const Result<std::vector<double>> read = read_file(folder / file, 3, 1000);
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(bits_of(*read), bits_of(points));
    }
    EXPECT_TRUE(read_file(folder / "empty.npy", 3).value().empty());
    EXPECT_EQ(bits_of(read_file(folder / "single.npy", 3).value()), get(folder / "singles"));
    EXPECT_EQ(bits_of(read_file(folder / "plane.npy", 2).value()), get(folder / "plane"));
    EXPECT_EQ(read_file(folder / "int.npy", 3).value(), std::vector<double>(6));
    EXPECT_FALSE(read_file(folder / "row.npy", 3));
    expect_error(read_file(folder / "zip.npy", 3), "zip.npy",
                 {0, "cannot read the header of the NPY file", "one array", nullptr, nullptr});
    // 19 digits: enough for every double.
    EXPECT_EQ(bits_of(read_file(folder / "t.csv", 3, 1000).value()), bits_of(points));
    EXPECT_EQ(bits_of(read_file(folder / "blanks.csv", 3, 1000).value()), bits_of(points));
}

TEST(NumPy, ColumnsAreCarriedThroughAsTheyAre) {
    if (python_with_numpy().empty()) GTEST_SKIP() << "no python3 with numpy";
    const TemporaryFolder folder;
    ASSERT_TRUE(python(folder, R"(
import numpy as np
n = 500
rng = np.random.default_rng(5)
names = np.array(['', 'steel', 'Stahl \u00e4\u20ac', '\U0001f600 x', "it's, \"b\""])
types = {'x': '>f4', 'y': 'i2', 'z': 'f2', 'b': '?', 'i1': 'i1', 'u1': 'u1', 'i8': '>i8', 'u8': 'u8', 'f8': 'f8',
         'f2': '>f2', 'S': 'S7', 'U': 'U9', 'V': '>U9', 'pos': ('f8', (2,)), 'a "b"\n': 'i4', 'ä': 'u4'}
a = np.zeros(n, dtype=np.dtype([(k, t) if not isinstance(t, tuple) else (k,) + t for k, t in types.items()], align=True))
for k in a.dtype.names:
    t = a.dtype[k]
    if t.kind == 'b': a[k] = rng.integers(0, 2, n)
    elif t.kind in 'iu':
        i = np.iinfo(t)
        a[k] = rng.integers(i.min, min(i.max, 2**63 - 1), n, dtype=t.newbyteorder('='), endpoint=True)
    elif t.kind == 'f': a[k] = rng.standard_normal(n)
    elif t.kind == 'S': a[k] = rng.choice(np.array([b'', b'\xff\x00a', b'steel']), n)
    elif t.kind == 'U': a[k] = rng.choice(names, n)
a['pos'] = rng.standard_normal((n, 2))
a['f8'][:3] = [np.nan, np.inf, -0.0]
np.save('a.npy', a)
np.save('part.npy', a[['x', 'y', 'z', 'U']])   # with holes
)"));
    PointOptions options;
    options.keep = {"all"};
    for (const char* name : {"a.npy", "part.npy"}) {
        auto source = open_points(folder / name, 3, options);
        ASSERT_TRUE(source) << source.error().message();
        Table rows;
        rows.dimension = 3;
        std::vector<Column> some;
        while ((*source)->read(170, rows.points).value() != 0) {
            (*source)->take_carried(some);
            if (rows.carried.empty())
                rows.carried = some;
            else
                for (std::size_t k = 0; k < some.size(); ++k)
                    mesh::move_values(some[k], 0, some[k].size(), rows.carried[k]);
        }
        rows.cells.assign(500, 3);
        rows.features.assign(500, Feature::edge);
        TableFormat format{.dimension = 3};
        format.carried = (*source)->carried();
        auto sink = open_table(folder / (std::string("out-") + name), format);
        ASSERT_TRUE(sink) << sink.error().message();
        const Status written = (*sink)->write(rows.view());
        ASSERT_TRUE(written) << written.error().message();
        ASSERT_TRUE((*sink)->commit());
    }
    EXPECT_TRUE(python(folder, R"(
import numpy as np
for name in ['a.npy', 'part.npy']:
    a, b = np.load(name), np.load('out-' + name)
    assert len(b) == 500
    for k in a.dtype.names:
        t, want = a.dtype[k], a[k]
        if k == 'pos':
            assert (np.stack([b['pos.0'], b['pos.1']], axis=1) == want).all()
            continue
        got = b[k]
        kind = 'f' if k in 'xyz' else 'i' if t.kind in 'iub' else t.kind
        assert got.dtype.kind == kind, (k, got.dtype)
        assert kind in 'SU' or got.dtype.itemsize == 8
        assert np.array_equal(got, want.astype(got.dtype), equal_nan=kind == 'f'), k
        if kind == 'U': assert got.dtype == np.dtype('<U9')
assert (np.signbit(np.load('out-a.npy')['f8'][:3]) == [False, False, True]).all()
)"));
}

}  // namespace
}  // namespace barycert::io::testing
