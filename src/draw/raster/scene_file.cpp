#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/scene.hpp"
#include "barycert/weights.hpp"
#include "core/base/text.hpp"
#include "draw/raster/colour_bytes.hpp"
#include "files/input_file.hpp"

namespace barycert {
namespace raster {
namespace {

using Json = nlohmann::json;

// The members of a scene file, each read with its place: a JSON pointer such as /camera/eye/1 (RFC 6901).

/// The value there, in a few words.
std::string brief(const Json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    return text.size() <= 40 ? text : text.substr(0, 40) + "...";
}

/// A value of the file and where it stands. Functions that find something else than they ask for throw Exception.
class SceneValue {
public:
    SceneValue(const Json& value, std::string place, const std::string& path)
        : value_(value), place_(std::move(place)), path_(path) {}

    /// Every member is one of these.
    void allow_only(std::initializer_list<const char*> names) const {
        if (!value_.is_object()) fail("an object");
        for (const auto& [name, value] : value_.items()) {
            if (std::ranges::find(names, name) != names.end()) continue;
            refuse((Json::json_pointer(place_) / name).to_string(),
                   "one of the members " + base::joined(names, ", ", std::identity()), base::quoted(name));
        }
    }

    bool has(const char* name) const { return value_.contains(name); }
    SceneValue member(const char* name) const {
        if (!has(name)) refuse(place(), std::string("a member \"") + name + '"', "none");
        return {value_.at(name), place_ + '/' + name, path_};
    }
    SceneValue entry(std::size_t i) const { return {value_.at(i), place_ + '/' + std::to_string(i), path_}; }

    /// The number of entries of an array.
    std::size_t size() const {
        if (!value_.is_array()) fail("an array");
        return value_.size();
    }
    bool is_array() const { return value_.is_array(); }

    /// A finite number; also as text, in decimal or hexadecimal.
    double number() const {
        const std::optional<double> x = value_.is_string()   ? base::parse_double(value_.get<std::string>())
                                        : value_.is_number() ? std::optional<double>(value_.get<double>())
                                                             : std::nullopt;
        if (!x || !std::isfinite(*x)) fail("a finite number");
        return *x;
    }
    std::int64_t integer(std::int64_t low, std::int64_t high) const {
        if (value_.is_number_integer()) {  // with or without a sign
            const bool fits = !value_.is_number_unsigned() || std::in_range<std::int64_t>(value_.get<std::uint64_t>());
            const auto number = value_.get<std::int64_t>();
            if (fits && number >= low && number <= high) return number;
        }
        fail("an integer from " + std::to_string(low) + " to " + std::to_string(high));
    }
    std::string text() const {
        if (!value_.is_string()) fail("text");
        return value_.get<std::string>();
    }

    std::vector<double> numbers(std::size_t count) const {
        if (!value_.is_array() || value_.size() != count) fail("an array of " + std::to_string(count) + " numbers");
        std::vector<double> all;
        for (std::size_t i = 0; i < count; ++i) all.push_back(entry(i).number());
        return all;
    }

    /// One of a few words, into `to`, if there is that member.
    template <class T>
    void choose(const char* name, const std::map<std::string, T>& words, T& to) const {
        if (!has(name)) return;
        const Json& chosen = value_.at(name);
        const auto word = chosen.is_string() ? words.find(chosen.get<std::string>()) : words.end();
        if (word == words.end())
            member(name).fail("one of " + base::joined(words, ", ", [](const auto& w) { return '"' + w.first + '"'; }));
        to = word->second;
    }

    [[noreturn]] void fail(const std::string& expected) const { refuse(place(), expected, brief(value_)); }

    /// An Error of what was made of this value.
    [[noreturn]] void fail(Error error) const {
        if (error.file.empty()) {
            error.file = path_;
            error.what = place_ + ": " + error.what;
        }
        throw Exception(std::move(error));
    }

private:
    std::string place() const { return place_.empty() ? "the scene" : place_; }

    [[noreturn]] void refuse(std::string what, std::string expected, std::string found) const {
        throw Exception({"scene.member", std::move(what), path_, 0, std::move(expected), std::move(found),
                         "doc/rendering.md describes scene files"});
    }

    const Json& value_;
    std::string place_;
    const std::string& path_;
};

// The scene.

/// The most that a scene file may have: read, it takes some ten times as much memory.
constexpr std::uint64_t longest_file = std::uint64_t{64} << 20;

Result<std::string> text_of_file(const std::string& path) {
    const Result<base::InputFile> file = base::InputFile::open(path);
    if (!file) return file.error();
    if (file->size() > longest_file)
        return file_error("file.too-large", path, "the scene file is too large",
                          "at most " + std::to_string(longest_file) + " bytes", std::to_string(file->size()),
                          "draw large scenes through the library: scene.hpp");
    std::string text(file->size(), '\0');
    const Result<std::size_t> read = file->read_at(0, text, path);
    if (!read) return read.error();
    text.resize(*read);
    return text;
}

/// The text as JSON, in which no object has two members of one name. Throws Exception.
Json parse(const std::string& text, const std::string& path) {
    std::vector<std::set<std::string>> names;  // of the objects that are open
    const Json::parser_callback_t on_event = [&](int, Json::parse_event_t event, Json& parsed) {
        if (event == Json::parse_event_t::object_start) names.emplace_back();
        if (event == Json::parse_event_t::object_end) names.pop_back();
        if (event == Json::parse_event_t::key && !names.back().insert(parsed.get<std::string>()).second)
            throw Exception(file_error("file.duplicate", path, "a member occurs twice in one object", "",
                                       base::quoted(parsed.get<std::string>()), "leave one out"));
        return true;
    };
    const auto behind = [](const std::string& all, const char* mark) {
        const std::size_t at = all.find(mark);
        return at == std::string::npos ? all : all.substr(at + 2);
    };
    try {
        return Json::parse(text, on_event);
    } catch (const Json::parse_error& e) {
        const auto before = static_cast<std::ptrdiff_t>(std::min(e.byte == 0 ? 0 : e.byte - 1, text.size()));
        throw Exception({.code = "file.syntax",
                         .what = "the scene is no JSON",
                         .file = path,
                         .line = 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + before, '\n')),
                         .found = behind(e.what(), ": "),  // [id] parse error at line L, column C: what
                         .remedy = "correct the file"});
    } catch (const Json::exception& e) {  // a number beyond the doubles
        throw Exception(file_error("file.syntax", path, "the scene cannot be read", "", behind(e.what(), "] "),
                                   "correct the file"));
    }
}

template <std::size_t n>
std::array<double, n> array(const SceneValue& value) {
    std::array<double, n> numbers;
    std::ranges::copy(value.numbers(n), numbers.begin());
    return numbers;
}

template <class T>
T checked(const SceneValue& value, Result<T> made) {
    if (!made) value.fail(made.error());
    return std::move(*made);
}

Matrix4 camera(const SceneValue& value, RasterSize size) {
    value.allow_only({"eye", "centre", "up", "perspective", "orthographic"});
    Matrix4 view;
    if (value.has("eye") || value.has("centre") || value.has("up")) {
        const Vector3 up = value.has("up") ? array<3>(value.member("up")) : Vector3{0, 1, 0};
        view = checked(value, look_at(array<3>(value.member("eye")), array<3>(value.member("centre")), up));
    }
    if (value.has("perspective") == value.has("orthographic")) value.fail("either \"perspective\" or \"orthographic\"");
    if (value.has("perspective")) {
        const SceneValue p = value.member("perspective");
        p.allow_only({"fovy", "aspect", "near", "far"});
        const double aspect = p.has("aspect") ? p.member("aspect").number() : 1.0 * size.width / size.height;
        return checked(p, perspective(p.member("fovy").number(), aspect, p.member("near").number(),
                                      p.member("far").number())) *
               view;
    }
    const SceneValue o = value.member("orthographic");
    o.allow_only({"left", "right", "bottom", "top", "near", "far"});
    const auto at = [&](const char* name) { return o.member(name).number(); };
    return checked(o, orthographic(at("left"), at("right"), at("bottom"), at("top"), at("near"), at("far"))) * view;
}

Image picture(const SceneValue& value, const std::filesystem::path& folder) {
    if (value.has("image") == value.has("pattern")) value.fail("either \"image\" or \"pattern\"");
    if (value.has("image")) {
        const SceneValue image = value.member("image");
        return checked(image, read_png((folder / image.text()).string()));
    }
    bool squares = false;
    value.choose("pattern", {{"four-colours", false}, {"checkerboard", true}}, squares);
    if (!squares) {
        value.allow_only({"pattern", "wrap", "filter"});
        return four_colours();
    }
    const auto count = [&](const char* name) {
        return value.has(name) ? static_cast<std::int32_t>(value.member(name).integer(1, 8192)) : 8;
    };
    return checked(value, checkerboard(count("cells"), count("texels")));
}

Texture texture(const SceneValue& value, const std::filesystem::path& folder) {
    value.allow_only({"image", "pattern", "cells", "texels", "wrap", "filter"});
    Texture t;
    t.image = picture(value, folder);
    value.choose("wrap", {{"clamp", Wrap::clamp}, {"repeat", Wrap::repeat}, {"mirror", Wrap::mirror}}, t.wrap);
    value.choose("filter", {{"nearest", Filter::nearest}, {"bilinear", Filter::bilinear}}, t.filter);
    return t;
}

/// The numbers of an array of arrays with `count` numbers each; of positions, x, y, z or x, y, z, w.
std::vector<double> rows(const SceneValue& value, std::size_t count) {
    std::vector<double> all;
    const std::size_t n = value.size();
    all.reserve(count * n);
    for (std::size_t i = 0; i < n; ++i) {
        const SceneValue row = value.entry(i);
        const bool point = count == 4 && row.is_array() && row.size() == 3;
        if (count == 4 && !point && (!row.is_array() || row.size() != 4)) row.fail("x, y, z or x, y, z, w");
        for (const double x : row.numbers(point ? 3 : count)) all.push_back(x);
        if (point) all.push_back(1);
    }
    return all;
}

void read_triangles(const SceneValue& file, Scene& scene) {
    const auto vertices = static_cast<std::int64_t>(scene.positions.size() / 4);
    if (!file.has("triangles")) {
        if (vertices % 3 != 0) file.member("positions").fail("three vertices a triangle, or a member /triangles");
        for (std::int32_t i = 0; i < vertices; ++i) scene.triangles.push_back(i);
        return;
    }
    const SceneValue all = file.member("triangles");
    for (std::size_t i = 0, n = all.size(); i < n; ++i) {
        const SceneValue triangle = all.entry(i);
        if (triangle.size() != 3) triangle.fail("an array of 3 vertices");
        for (std::size_t k = 0; k < 3; ++k)
            scene.triangles.push_back(static_cast<std::int32_t>(triangle.entry(k).integer(0, vertices - 1)));
    }
}

void read_attributes(const SceneValue& file, Scene& scene) {
    const std::size_t vertices = scene.positions.size() / 4;
    const auto read = [&](const char* name, std::size_t count, std::vector<double>& to) {
        if (!file.has(name)) return;
        const SceneValue value = file.member(name);
        if (value.size() != vertices) value.fail("an entry for each of " + std::to_string(vertices) + " vertices");
        to = rows(value, count);
    };
    read("colours", 3, scene.colours);
    read("uv", 2, scene.texture_coordinates);
}

void read_choices(const SceneValue& file, Scene& scene) {
    file.choose("method",
                {{"barycentric", FillMethod::barycentric},
                 {"scanline", FillMethod::scanline},
                 {"bilinear", FillMethod::bilinear}},
                scene.method);
    file.choose("interpolation",
                {{"perspective", Interpolation::perspective},
                 {"affine", Interpolation::affine},
                 {"projected-z", Interpolation::projected_z}},
                scene.interpolation);
    file.choose("rounding", {{"plain", Rounding::plain}, {"correct", Rounding::correct}}, scene.rounding);
}

Rgba background(const SceneValue& value) {
    if (value.size() != 3 && value.size() != 4) value.fail("red, green, blue and perhaps opacity, each from 0 to 1");
    Rgba colour{0, 0, 0, 255};
    for (std::size_t k = 0; k < value.size(); ++k) {
        const double x = value.entry(k).number();
        if (!(x >= 0 && x <= 1)) value.entry(k).fail("a number from 0 to 1");
        colour[k] = component_byte(x);
    }
    return colour;
}

Scene scene_of(const SceneValue& file, const std::filesystem::path& folder) {
    file.allow_only({"size", "samples", "background", "positions", "colours", "uv", "triangles", "model", "matrix",
                     "camera", "texture", "method", "interpolation", "rounding"});
    Scene scene;
    const SceneValue size = file.member("size");
    if (size.size() != 2) size.fail("width and height");
    scene.size = {static_cast<std::int32_t>(size.entry(0).integer(1, max_raster_side)),
                  static_cast<std::int32_t>(size.entry(1).integer(1, max_raster_side))};
    if (file.has("samples")) scene.samples = static_cast<int>(file.member("samples").integer(1, max_samples));
    if (file.has("background")) scene.background = background(file.member("background"));
    if (file.has("matrix") && file.has("camera")) file.fail("either \"matrix\" or \"camera\", not both");
    if (file.has("matrix")) scene.to_clip = Matrix4{array<16>(file.member("matrix"))};
    if (file.has("camera")) scene.to_clip = camera(file.member("camera"), scene.size);
    if (file.has("model")) scene.to_clip = scene.to_clip * Matrix4{array<16>(file.member("model"))};
    scene.positions = rows(file.member("positions"), 4);
    read_triangles(file, scene);
    read_attributes(file, scene);
    read_choices(file, scene);
    if (file.has("texture")) {
        if (scene.texture_coordinates.empty() && !scene.positions.empty())
            file.member("texture").fail("a member /uv beside it, with texture coordinates of the vertices");
        scene.texture = texture(file.member("texture"), folder);
    }
    return scene;
}

}  // namespace
}  // namespace raster

Result<Scene> read_scene(const std::string& path) try {
    const ExactEnvironment environment;
    const raster::Json json = raster::parse(raster::text_of_file(path).value(), path);
    return raster::scene_of({json, "", path}, std::filesystem::path(path).parent_path());
} catch (const Exception& e) {
    return e.error();
}

std::vector<std::string> scene_files(const std::string& path) {
    const Result<std::string> text = raster::text_of_file(path);
    if (!text) return {};
    const raster::Json json = raster::Json::parse(*text, nullptr, false);
    const raster::Json::json_pointer image("/texture/image");
    if (!json.contains(image) || !json.at(image).is_string()) return {};
    return {(std::filesystem::path(path).parent_path() / json.at(image).get<std::string>()).string()};
}

}  // namespace barycert
