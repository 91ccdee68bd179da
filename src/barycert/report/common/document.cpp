#include "barycert/report/common/document.hpp"

#include <fmt/format.h>

#include "barycert/base/json_text.hpp"
#include "barycert/report.hpp"

namespace barycert {

std::string environment_line(const Environment& e) {
    return fmt::format("barycert {}, {}, rounding {}, contraction {}, subnormals {}, SIMD {}{}", e.version, e.compiler,
                       e.rounding, e.contraction ? "ON" : "off", e.flush_to_zero ? "FLUSHED" : "kept", e.simd,
                       e.fma ? ", FMA" : "");
}

namespace report {

void Document::curved(const CurvedCells& curved, const std::string& mesh) {
    const std::string text = message(curved), line = (mesh.empty() ? "" : mesh + ": ") + text;
    if (text.empty()) return;
    const bool really = curved.cells != 0;
    const Tone tone = really ? Tone::strong : Tone::plain;
    const std::size_t half = text.find("; ") + 1;
    if (!mesh.empty())
        say(line, tone, For::terminal);
    else
        add(Named{really ? "curved" : "rounded", {text.substr(0, half), text.substr(half + 1)}, tone}, For::terminal);
    if (!really) return say(line + ".", Tone::soft, For::page);
    add(Headline{.tone = Tone::strong,
                 .text = "Curved cells",
                 .sentences = {line + ". What is said below, \"exact\" and \"certified\" included, holds of the cells "
                                      "with straight sides."}},
        For::page);
}

void Document::figure(std::string_view key, Json value, std::string name, std::string text, Tone tone) {
    data[std::string(key)] = std::move(value);
    this->name(std::move(name), std::move(text), tone);
}

std::string Item::Places::more(std::size_t told) const {
    if (told == 0 || told >= count) return "";
    return at_least ? "and more" : fmt::format("and {} more", count - told);
}

std::string data_text(const Document& document) {
    return base::json_text(document.data, document.indent);
}

std::string not_finite_text(const NotFinite& f) {
    return fmt::format("field {}{}: {} of {} values {} not finite", f.field, f.of_cells ? " of cells" : "", f.count,
                       f.values, f.count == 1 ? "is" : "are");
}

std::string counted(std::uint64_t n, std::string_view one, std::string_view more) {
    return n == 1         ? fmt::format("1 {}", one)
           : more.empty() ? fmt::format("{} {}s", n, one)
                          : fmt::format("{} {}", n, more);
}

}  // namespace report
}  // namespace barycert
