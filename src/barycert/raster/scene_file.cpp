#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>

#include "barycert/base/input_file.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/io.hpp"
#include "barycert/raster/draw.hpp"
#include "barycert/raster/scene_json.hpp"
#include "barycert/scene.hpp"

namespace barycert {
namespace raster {
namespace {

using Json = nlohmann::json;

/// What a scene file may have at most: read, it takes some ten times as much memory.
constexpr std::uint64_t longest_file = std::uint64_t{64} << 20;

Result<std::string> text_of_file(const std::string& path) {
    const Result<base::InputFile> file = base::InputFile::open(path);
    if (!file) return file.error();
    if (file->size() > longest_file)
        return file_error(path, "the scene file is too large", "at most " + std::to_string(longest_file) + " bytes",
                          std::to_string(file->size()), "draw large scenes through the library: scene.hpp");
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
            throw Exception(file_error(path, "a member occurs twice in one object", "",
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
        throw Exception({.what = "the scene is no JSON",
                         .file = path,
                         .line = 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + before, '\n')),
                         .found = behind(e.what(), ": "),  // [id] parse error at line L, column C: what
                         .remedy = "correct the file"});
    } catch (const Json::exception& e) {  // a number beyond the doubles
        throw Exception(file_error(path, "the scene cannot be read", "", behind(e.what(), "] "), "correct the file"));
    }
}

template <std::size_t n>
std::array<double, n> array(const SceneValue& value) {
    std::array<double, n> numbers;
    std::ranges::copy(value.numbers(n), numbers.begin());
    return numbers;
}

Matrix4 checked(const SceneValue& value, const Result<Matrix4>& m) {
    if (!m) value.fail(m.error());
    return *m;
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
        Result<Image> image = read_png((folder / value.member("image").text()).string());
        if (!image) value.member("image").fail(image.error());
        return std::move(*image);
    }
    enum class Pattern { four_colours, checkerboard };
    const auto pattern = value.member("pattern").choice<Pattern>(
        {{"four-colours", Pattern::four_colours}, {"checkerboard", Pattern::checkerboard}});
    if (pattern == Pattern::four_colours) {
        value.allow_only({"pattern", "wrap", "filter"});
        return four_colours();
    }
    const auto count = [&](const char* name) {
        return value.has(name) ? static_cast<std::int32_t>(value.member(name).integer(1, 8192)) : 8;
    };
    Result<Image> board = checkerboard(count("cells"), count("texels"));
    if (!board) value.fail(board.error());
    return std::move(*board);
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
    file.allow_only({"size", "background", "positions", "colours", "uv", "triangles", "model", "matrix", "camera",
                     "texture", "method", "interpolation", "rounding"});
    Scene scene;
    const SceneValue size = file.member("size");
    if (size.size() != 2) size.fail("width and height");
    scene.size = {static_cast<std::int32_t>(size.entry(0).integer(1, max_raster_side)),
                  static_cast<std::int32_t>(size.entry(1).integer(1, max_raster_side))};
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

Result<Scene> read_scene(const std::string& path) {
    const ExactEnvironment environment;
    const Result<std::string> text = raster::text_of_file(path);
    if (!text) return text.error();
    try {
        const raster::Json json = raster::parse(*text, path);
        return raster::scene_of({json, "", path}, std::filesystem::path(path).parent_path());
    } catch (const Exception& e) {
        return e.error();
    }
}

std::vector<std::string> scene_files(const std::string& path) {
    const Result<std::string> text = raster::text_of_file(path);
    if (!text) return {};
    const raster::Json json = raster::Json::parse(*text, nullptr, false);
    if (!json.is_object() || !json.contains("texture") || !json["texture"].is_object()) return {};
    const raster::Json& texture = json["texture"];
    if (!texture.contains("image") || !texture["image"].is_string()) return {};
    return {(std::filesystem::path(path).parent_path() / texture["image"].get<std::string>()).string()};
}

}  // namespace barycert
