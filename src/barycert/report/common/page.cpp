#include "barycert/report/common/page.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>

#include "barycert/report/common/html_text.hpp"
#include "barycert/report/common/page_script.hpp"
#include "barycert/report/common/page_style.hpp"

namespace barycert::report {

std::string page_head(std::string_view title, std::string_view style) {
    return fmt::format(
        "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\"><head><meta charset=\"utf-8\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
        "'unsafe-inline'; script-src 'unsafe-inline'\"/>\n"
        "<title>{}</title>\n<style>{}{}</style></head>\n<body><main>\n",
        html_escaped(title), page_style, style);
}

std::string page_foot(std::string_view made_by, bool script) {
    return fmt::format("</main>\n<footer>{}</footer>\n{}{}{}</body></html>\n", html_escaped(made_by),
                       script ? "<script>" : "", script ? page_script : "", script ? "</script>\n" : "");
}

std::string curved_section(const CurvedCells& curved, const std::string& mesh) {
    if (message(curved).empty()) return {};
    const std::string text = html_escaped(mesh + message(curved));
    if (curved.cells == 0) return fmt::format("<p class=\"small\">{}.</p>\n", text);
    return fmt::format(
        "<section class=\"verdict told\"><b>Curved cells</b><p>{}. What is said below, \"exact\" and \"certified\" "
        "included, holds of the cells with straight sides.</p></section>\n",
        text);
}

std::string data_uri(std::string_view type, std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out = fmt::format("data:{};base64,", type);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = bytes.size() - i;
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) out += k > left ? '=' : digits[group >> (18 - 6 * k) & 63U];
    }
    return out;
}

}  // namespace barycert::report
