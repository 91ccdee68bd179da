#include "barycert/io/polygons/polygons.hpp"
#include "barycert/io/vtk/numbers.hpp"

namespace barycert::io {
namespace {

constexpr std::size_t header_bytes = 84;  // 80 bytes of text and a count
constexpr std::size_t record_bytes = 50;  // normal and three corners as floats, two bytes of padding

/// Corners of a triangle soup: those of equal coordinates are one point. A table of open addresses.
class Joined {
public:
    explicit Joined(std::size_t corners) : table_(std::bit_ceil(std::max<std::size_t>(16, corners)), -1) {}

    void add(std::array<double, 3> at) {
        for (double& x : at) x += 0.0;  // -0 and 0 are one place
        if (2 * (count_ + 1) > table_.size()) grow();
        Mesh::Index& entry = find(at);
        if (entry < 0) {
            entry = static_cast<Mesh::Index>(count_++);
            all.points.insert(all.points.end(), at.begin(), at.end());
        }
        all.rings.push_back(entry);
    }

    Polygons all;

private:
    Mesh::Index& find(std::span<const double, 3> at) {
        std::uint64_t hash = 0;
        for (const double x : at)
            hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15, hash ^= hash >> 29;
        for (std::size_t i = hash & (table_.size() - 1);; i = (i + 1) & (table_.size() - 1)) {
            Mesh::Index& entry = table_[i];
            if (entry < 0 || std::equal(at.begin(), at.end(), &all.points[3 * static_cast<std::size_t>(entry)]))
                return entry;
        }
    }
    void grow() {
        table_.assign(2 * table_.size(), -1);
        for (std::size_t i = 0; i < count_; ++i)
            find(std::span<const double, 3>(&all.points[3 * i], 3)) = static_cast<Mesh::Index>(i);
    }

    std::vector<Mesh::Index> table_;
    std::size_t count_ = 0;  // of points
};

template <class T>
T little_endian(std::string_view bytes, std::size_t at) {
    return number_at<T>(bytes.data() + at, std::endian::native == std::endian::big);
}

/// Some binary files begin with `solid` too; a text file has no zero byte.
bool is_binary(std::string_view bytes, std::size_t size, const std::string& path) {
    if (bytes.starts_with("solid") && bytes.find('\0') == std::string_view::npos) return false;
    const std::size_t count = bytes.size() < header_bytes ? 0 : little_endian<std::uint32_t>(bytes, 80);
    const std::size_t whole = header_bytes + record_bytes * count;
    if (size == whole) return true;
    refuse_file(path, "neither a text nor a whole binary .stl", "`solid`, or " + std::to_string(whole) + " bytes",
                std::to_string(size) + " bytes");
}

Polygons read_binary(const std::string& path, std::string_view bytes) {
    const std::size_t count = (bytes.size() - header_bytes) / record_bytes;
    Joined soup(count);
    soup.all.rings.reserve(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            std::array<double, 3> at{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::size_t byte = header_bytes + record_bytes * i + 12 * (corner + 1) + 4 * axis;
                at[axis] = static_cast<double>(little_endian<float>(bytes, byte));
                if (!std::isfinite(at[axis]))
                    refuse_file(path, "a coordinate of triangle " + std::to_string(i) + " is not finite");
            }
            soup.add(at);
        }
    }
    return std::move(soup.all);
}

std::string nodes_of(std::size_t count) {
    return count == 0 ? "none, as there are no nodes" : "0 to " + std::to_string(count - 1);
}

/// Text or binary. Corners of equal coordinates are one point, numbered as they first come.
Polygons read_stl(PlcText& in) {
    const std::string_view bytes = in.rest();
    if (is_binary(bytes, bytes.size(), in.path())) return read_binary(in.path(), bytes);
    Joined soup(1024);
    bool ended = false;
    std::size_t begin = 0;
    while (in.next_line()) {
        ended = in.word(0) == "endsolid";
        if (in.word(0) == "endloop" && soup.all.rings.size() - std::exchange(begin, soup.all.rings.size()) != 3)
            in.fail("cannot read", "a facet of three corners", in.line());
        if (in.word(0) != "vertex") continue;
        in.take("vertex");
        std::array<double, 3> corner{};
        for (double& x : corner) x = in.take_number("a coordinate");
        soup.add(corner);
    }
    if (!ended || soup.all.rings.size() % 3 != 0) in.fail("the file is truncated", "endsolid", "the end of the file");
    return std::move(soup.all);
}

/// Shape of the file: OFF, the counts of points, polygons and edges, then a line for each point and each polygon.
Polygons read_off(PlcText& in) {
    Polygons all;
    in.need_line("OFF");
    const std::string_view keyword = in.take("OFF");
    if (keyword != "OFF") in.fail("cannot read", "OFF", keyword);
    if (in.words_left() == 0) in.need_line("the counts of nodes and polygons");
    const std::size_t nodes = in.take_count("the number of nodes"), polygons = in.take_count("the number of polygons");
    for (std::size_t i = 0; i < nodes; ++i) {
        in.need_line("node", i, nodes);
        for (int axis = 0; axis < 3; ++axis) all.points.push_back(in.take_number("a coordinate"));
        if (in.words_left() > 0) in.fail("cannot read", "three coordinates", in.line());
    }
    for (std::size_t i = 0; i < polygons; ++i) {
        in.need_line("polygon", i, polygons);
        const std::size_t n = in.take_count("the number of a polygon's corners");
        if (n < 3) in.fail("cannot read", "a polygon of three or more corners", std::to_string(n));
        for (std::size_t k = 0; k < n; ++k) {
            all.rings.push_back(in.take_integer("a polygon's corner"));
            if (const Mesh::Index corner = all.rings.back(); corner < 0 || static_cast<std::size_t>(corner) > nodes)
                in.fail("no such node", nodes_of(nodes), std::to_string(corner));
        }
        all.counts.push_back(static_cast<std::uint32_t>(n));
    }
    if (in.next_line()) in.fail("more lines than the header announces", "the end of the file", in.line());
    check_corners(in, all);
    return all;
}

/// Wavefront: lines `v x y z` and `f a b c ...`, corners from 1, or from the last point back, with more behind a slash.
Polygons read_obj(PlcText& in) {
    Polygons all;
    all.index_base = 1;
    std::vector<std::string> others;
    while (in.next_line()) {
        const std::string_view key = in.take("a keyword");
        if (key == "v") {
            for (int axis = 0; axis < 3; ++axis) all.points.push_back(in.take_number("a coordinate"));
        } else if (key == "f") {
            const std::size_t n = in.words_left();
            if (n < 3) in.fail("cannot read", "a polygon of three or more corners", in.line());
            for (std::size_t k = 0; k < n; ++k) {
                const auto count = static_cast<std::int64_t>(all.point_count());
                const std::int64_t id = in.take_integer("a polygon's corner", '/');
                const std::int64_t at = id < 0 ? count + id : id - 1;
                if (id == 0 || at < 0 || at >= count)
                    in.fail("no such node", "1 to " + std::to_string(count), std::to_string(id));
                all.rings.push_back(static_cast<Mesh::Index>(at));
            }
            all.counts.push_back(static_cast<std::uint32_t>(n));
        } else if (std::ranges::find(others, key) == others.end()) {
            others.emplace_back(key);
        }
    }
    const std::string list = base::joined(others, " ", std::identity());
    if (!list.empty()) all.notes.push_back({Note::Kind::left_out, "lines other than v and f: " + list, in.path()});
    return all;
}

}  // namespace

bool is_binary_surface(std::string_view path, std::string_view beginning, std::size_t size) {
    if (has_suffix(path, ".stl")) return is_binary(beginning, size, std::string(path));
    return has_suffix(path, ".ply") && beginning.substr(0, 200).find("\nformat binary") != std::string_view::npos;
}

void check_corners(PlcText& in, Polygons& all) {
    if (all.rings.empty()) return;
    const auto [low, high] = std::ranges::minmax(all.rings);
    if (low >= 0 && static_cast<std::size_t>(high) < all.point_count()) return;
    // A file that never uses 0 and does use the count of its points numbers from 1.
    if (low < 1 || static_cast<std::size_t>(high) > all.point_count())
        in.fail("no such node", nodes_of(all.point_count()), std::to_string(low < 0 ? low : high));
    all.index_base = 1;
    for (Mesh::Index& corner : all.rings) --corner;
}

Polygons read_polygons(const std::string& path) {
    const auto read = [&](PlcText& in) {
        return has_suffix(path, ".off")   ? read_off(in)
               : has_suffix(path, ".obj") ? read_obj(in)
               : has_suffix(path, ".stl") ? read_stl(in)
                                          : read_ply(in);
    };
    const std::string text = read_surface_text(path, read);
    PlcText in(path, text, text.size());
    Polygons all = read(in);
    if (std::ranges::all_of(all.counts, [](std::uint32_t n) { return n == 3; })) all.counts.clear();
    return all;
}

}  // namespace barycert::io
