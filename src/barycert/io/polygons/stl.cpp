#include "barycert/io/formats.hpp"
#include "barycert/io/polygons/polygons.hpp"
#include "barycert/io/vtk/numbers.hpp"

namespace barycert::io {
namespace {

constexpr std::size_t header_bytes = 84;  // 80 bytes of text and a count
constexpr std::size_t record_bytes = 50;  // normal and three corners as floats, two bytes of padding

/// Corners of a triangle soup: those of equal coordinates are one point. A table of open addresses: the next free place
/// is taken.
class Joined {
public:
    explicit Joined(std::size_t corners) : table_(std::bit_ceil(std::max<std::size_t>(16, corners)), -1) {}

    void add(std::array<double, 3> at) {
        for (double& x : at) x += 0.0;  // -0 and 0 are one place
        if (2 * (all.point_count() + 1) > table_.size()) grow();
        Mesh::Index& entry = find(at);
        if (entry < 0) {
            entry = static_cast<Mesh::Index>(all.point_count());
            all.points.insert(all.points.end(), at.begin(), at.end());
        }
        all.corners.push_back(entry);
    }

    Polygons all;

private:
    Mesh::Index& find(const std::array<double, 3>& at) {
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
        for (std::size_t i = 0; i < all.point_count(); ++i) {
            std::array<double, 3> at{};
            std::copy_n(&all.points[3 * i], 3, at.begin());
            find(at) = static_cast<Mesh::Index>(i);
        }
    }

    std::vector<Mesh::Index> table_;
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
    soup.all.corners.reserve(3 * count);
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

}  // namespace

bool is_binary_surface(std::string_view path, std::string_view beginning, std::size_t size) {
    if (has_suffix(path, ".stl")) return is_binary(beginning, size, std::string(path));
    return has_suffix(path, ".ply") && beginning.substr(0, 200).find("\nformat binary") != std::string_view::npos;
}

Polygons read_stl(PlcText& in) {
    const std::string_view bytes = in.rest();
    if (is_binary(bytes, bytes.size(), in.path())) return read_binary(in.path(), bytes);
    Joined soup(1024);
    bool ended = false;
    while (in.next_line()) {
        ended = in.word(0) == "endsolid";
        if (in.word(0) != "vertex") continue;
        in.take("vertex");
        std::array<double, 3> corner{};
        for (double& x : corner) x = in.take_number("a coordinate");
        soup.add(corner);
    }
    if (!ended || soup.all.corners.size() % 3 != 0) in.fail("the file is truncated", "endsolid", "the end of the file");
    return std::move(soup.all);
}

}  // namespace barycert::io
