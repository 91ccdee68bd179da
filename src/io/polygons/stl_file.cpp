// STL, text and binary (3D Systems, 1989).
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "io/errors.hpp"
#include "io/number_word.hpp"
#include "io/other_formats.hpp"
#include "io/paths.hpp"
#include "io/polygons/polygons.hpp"
#include "io/vtk/numbers.hpp"
#include "io/words.hpp"

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

/// As its count says.
std::size_t binary_size(std::string_view bytes) {
    const std::size_t count = bytes.size() < header_bytes ? 0 : little_endian<std::uint32_t>(bytes, 80);
    return header_bytes + record_bytes * count;
}

/// Reads a file of at least binary_size() bytes; leaves out what follows.
Polygons read_binary(PlcText& in) {
    const std::string_view bytes = in.rest();
    const std::size_t count = (binary_size(bytes) - header_bytes) / record_bytes;
    Joined soup(count);
    soup.all.rings.reserve(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            std::array<double, 3> at{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::size_t byte = header_bytes + record_bytes * i + 12 * (corner + 1) + 4 * axis;
                at[axis] = static_cast<double>(little_endian<float>(bytes, byte));
                if (!std::isfinite(at[axis]))
                    refuse_file("mesh.coordinate", in.path(),
                                "a coordinate of triangle " + std::to_string(i) + " is not finite");
            }
            soup.add(at);
        }
    }
    if (const std::size_t behind = bytes.size() - binary_size(bytes); behind != 0)
        soup.all.notes.push_back({Note::Kind::left_out,
                                  std::to_string(behind) + " bytes behind the last of the " + std::to_string(count) +
                                      " triangles that the file announces",
                                  in.path(), true});
    return std::move(soup.all);
}

/// A line is: solid NAME; facet normal X Y Z; outer loop; vertex X Y Z, thrice; endloop; endfacet; endsolid NAME. All
/// in any case, and with a blank in `end loop` and the like. A facet's normal may be missing: its corners tell it.
class StlText {
public:
    explicit StlText(PlcText& in) : in_(in) {}

    Polygons read() {
        bool any = false;
        while (in_.next_line()) {
            any = true;
            take_line();
        }
        if (!any || place_ != Place::outside)
            in_.fail("file.truncated", "the file is truncated", "endsolid", "the end of the file");
        if (!others_.empty())
            soup_.all.notes.push_back({Note::Kind::left_out,
                                       "lines that no .stl has: " + base::joined(others_, " ", std::identity()),
                                       in_.path(), true});
        return std::move(soup_.all);
    }

private:
    enum class Place : std::uint8_t { outside, solid, facet, loop, behind_loop };

    void take_line() {
        const std::string word = take_keyword();
        if (word == "solid" && place_ == Place::outside) {
            place_ = Place::solid;  // any name follows
        } else if (word == "endsolid" && place_ == Place::solid) {
            place_ = Place::outside;
        } else if (word == "facet" && place_ == Place::solid) {
            take_normal();
            place_ = Place::facet;
        } else if (word == "outer" && place_ == Place::facet && lower(in_.take("outer loop")) == "loop") {
            in_.need_end("outer loop");
            place_ = Place::loop;
            corners_ = 0;
        } else if (word == "vertex" && place_ == Place::loop) {
            take_corner();
        } else if (word == "endloop" && place_ == Place::loop) {
            if (corners_ != 3) in_.fail("file.syntax", "cannot read", "a facet of three corners", in_.line());
            in_.need_end("endloop");
            place_ = Place::behind_loop;
        } else if (word == "endfacet" && place_ == Place::behind_loop) {
            in_.need_end("endfacet");
            place_ = Place::solid;
        } else if (place_ > Place::solid || is_known(word)) {
            constexpr std::array<const char*, 5> expected{"solid", "facet normal, or endsolid", "outer loop",
                                                          "vertex, or endloop", "endfacet"};
            in_.fail("file.syntax", "cannot read", expected[static_cast<std::size_t>(place_)], in_.line());
        } else if (std::ranges::find(others_, word) == others_.end()) {
            others_.push_back(word);  // colours, for one
        }
    }

    static bool is_known(std::string_view word) {
        return has_word("solid facet outer vertex endloop endfacet endsolid", word);
    }

    std::string take_keyword() {
        std::string word = lower(in_.take("a keyword"));
        return word == "end" && in_.words_left() != 0 ? word + lower(in_.take("a keyword")) : word;
    }

    /// It is not used; degenerate triangles have normals like nan and -1.#IND.
    void take_normal() {
        if (in_.words_left() == 0) return;
        if (lower(in_.take("normal")) != "normal") in_.fail("file.syntax", "cannot read", "facet normal", in_.line());
        for (int axis = 0; axis < 3; ++axis) {
            const std::string word = lower(in_.take("a component of a normal"));
            const bool none = word.find("nan") != std::string::npos || word.find('#') != std::string::npos;
            if (!none && !real_of_word(word, false))
                in_.fail("file.syntax", "cannot read", "a normal of three numbers", in_.line(),
                         remedy_for_number(word));
        }
        in_.need_end("facet normal and three numbers");
    }

    void take_corner() {
        std::array<double, 3> corner{};
        for (double& x : corner) x = in_.take_number("a coordinate");
        in_.need_end("vertex and three coordinates");
        if (++corners_ > 3) in_.fail("file.syntax", "cannot read", "a facet of three corners", in_.line());
        soup_.add(corner);
    }

    PlcText& in_;
    Joined soup_{1024};
    Place place_ = Place::outside;
    int corners_ = 0;
    std::vector<std::string> others_;
};

}  // namespace

bool is_binary_stl(std::string_view beginning, std::size_t size, const std::string& path) {
    std::string_view text = beginning;
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    // Some binary files begin with `solid` too; a text file has no zero byte.
    if (lower(first_word(text, '\0').substr(0, 5)) == "solid" && text.find('\0') == std::string_view::npos)
        return false;
    const std::size_t whole = binary_size(beginning);
    if (size == whole || (size > whole && whole != header_bytes)) return true;
    refuse_file("file.format", path, "neither a text nor a whole binary .stl",
                "`solid`, or " + std::to_string(whole) + " bytes", std::to_string(size) + " bytes");
}

Polygons read_stl(PlcText& in) {
    return is_binary_stl(in.rest(), in.rest().size(), in.path()) ? read_binary(in) : StlText(in).read();
}

}  // namespace barycert::io
