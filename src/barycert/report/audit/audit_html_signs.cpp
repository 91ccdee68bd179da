// The pictures of signs, on the audit's HTML page.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "barycert/io/png/indexed_png.hpp"
#include "barycert/report/audit/audit_html_parts.hpp"
#include "barycert/report/common/html_text.hpp"
#include "barycert/report/common/page.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert::report {
namespace {

struct SignColour {
    io::Colour colour;
    std::string_view text;
};
/// Of the signs -1, 0, 1 and of no answer.
constexpr std::array<SignColour, 4> sign_colours{{{{0xe6, 0x9f, 0x00}, "negative"},
                                                  {{0xff, 0xff, 0xff}, "zero"},
                                                  {{0x00, 0x72, 0xb2}, "positive"},
                                                  {{0x20, 0x20, 0x20}, "no answer"}}};

/// PNG; y grows upwards.
Result<std::string> png_of(const SignPicture& p) {
    constexpr std::size_t side = SignPicture::side;
    std::vector<std::uint8_t> pixels(side * side);
    for (std::size_t row = 0; row < side; ++row) {
        for (std::size_t i = 0; i < side; ++i)
            pixels[row * side + i] = static_cast<std::uint8_t>(p.signs[(side - 1 - row) * side + i] + 1);
    }
    std::array<io::Colour, sign_colours.size()> colours{};
    std::transform(sign_colours.begin(), sign_colours.end(), colours.begin(), [](const auto& c) { return c.colour; });
    return io::indexed_png(side, pixels, colours);
}

/// Pictures that are the same, in the order of the first.
struct SameSigns {
    const SignPicture* picture = nullptr;
    std::vector<std::string> kernels;  ///< without the exact picture's empty name
};

std::vector<SameSigns> grouped_pictures(const std::vector<const SignPicture*>& pictures) {
    std::vector<SameSigns> groups;
    for (const SignPicture* p : pictures) {
        auto same = std::find_if(groups.begin(), groups.end(),
                                 [&](const SameSigns& g) { return g.picture->signs == p->signs; });
        if (same == groups.end()) same = groups.insert(groups.end(), {p, {}});
        if (!p->kernel.empty()) same->kernels.push_back(p->kernel);
    }
    return groups;
}

Result<std::string> figure_of_signs(const SameSigns& group) {
    const Result<std::string> png = png_of(*group.picture);
    if (!png) return png.error();
    const bool exact = group.picture->kernel.empty();
    const std::string names = html_escaped(fmt::format("{}", fmt::join(group.kernels, ", ")));
    const auto all = static_cast<std::uint64_t>(SignPicture::side) * SignPicture::side;
    const std::string caption =
        exact ? "<b>exact</b>" + (names.empty() ? "" : "; the same: " + names)
              : fmt::format("{}<br/><b>{} %</b> wrong", names, percent(group.picture->wrong, all));
    return fmt::format(
        "<figure{}><img alt=\"Signs on the grid: {}, {} of {} points wrong\" src=\"{}\" width=\"256\" "
        "height=\"256\"/><figcaption>{}</figcaption></figure>\n",
        exact ? " class=\"exact\"" : "", exact ? "exact" : names, group.picture->wrong, all,
        data_uri("image/png", *png), caption);
}

}  // namespace

Result<std::string> signs_html(const std::vector<SignPicture>& pictures) {
    if (pictures.empty()) return std::string();
    std::string out =
        "<h2>Pictures of signs</h2>\n<p class=\"small\">What a kernel says of 256 × 256 neighbouring points beside a "
        "side on the diagonal: the sign of one weight, at points 2⁻⁵³ apart around (1/2, 1/2), the side from 12 to 24 "
        "(after Kettner, Mehlhorn, Pion, Schirra and Yap, 2008).</p>\n<p class=\"small key\">";
    for (const SignColour& c : sign_colours)
        out += fmt::format("<i style=\"background:#{:02x}{:02x}{:02x}\"></i>{}", c.colour[0], c.colour[1], c.colour[2],
                           c.text);
    out += "</p>\n";
    for (const SignPicture& exact : pictures) {
        if (!exact.kernel.empty()) continue;
        std::vector<const SignPicture*> kind;
        for (const SignPicture& p : pictures) {
            if (p.simplex == exact.simplex && p.perspective == exact.perspective) kind.push_back(&p);
        }
        out += fmt::format("<h3>{}</h3>\n<div class=\"signs\">\n", kind_of(exact.simplex, exact.perspective));
        for (const SameSigns& group : grouped_pictures(kind)) {
            const Result<std::string> figure = figure_of_signs(group);
            if (!figure) return figure.error();
            out += *figure;
        }
        out += "</div>\n";
    }
    return out;
}

}  // namespace barycert::report
