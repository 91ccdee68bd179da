// Documents, and their writer for terminals.

#include "app/report/common/document.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "app/report/common/terminal_text.hpp"
#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/report.hpp"
#include "core/base/text.hpp"

namespace barycert {

std::string environment_line(const Environment& e) {
    return fmt::format("barycert {}, {}, rounding {}, contraction {}, subnormals {}, SIMD {}{}", e.version, e.compiler,
                       e.rounding, e.contraction ? "ON" : "off", e.flush_to_zero ? "FLUSHED" : "kept", e.simd,
                       e.fma ? ", FMA" : "");
}

namespace report {

using base::printable;

void Document::curved(const CurvedCells& curved, const std::string& mesh) {
    const std::string text = message(curved), line = (mesh.empty() ? "" : mesh + ": ") + text;
    if (text.empty()) return;
    const bool really = curved.cells != 0 || curved.by_corners != 0;
    const Tone tone = really ? Tone::strong : Tone::plain;
    if (!mesh.empty()) {
        say(line, tone, For::terminal);
    } else {
        std::vector<std::string> lines;  // each ends with its semicolon
        for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
            end = std::min(text.find("; ", at), text.size() - 1) + 1;
            lines.push_back(text.substr(at, end - at));
        }
        add(Named{really ? "curved" : "rounded", std::move(lines), tone}, For::terminal);
    }
    if (!really) return say(line + ".", Tone::soft, For::page);
    add(Headline{.tone = Tone::strong,
                 .text = "Curved cells",
                 .sentences = {line + (curved.mapped ? "."
                                                     : ". What is said below, \"exact\" and \"certified\" included, "
                                                       "holds of the cells with straight sides.")}},
        For::page);
}

namespace {

constexpr std::size_t columns = 100;

std::string_view separator(Breaks wrap) {
    return wrap == Breaks::none ? "" : wrap == Breaks::words ? " " : ", ";
}

/// Broken behind `between`, which ends with a blank; not, if there is none.
std::string wrapped(const std::string& text, std::string_view between, std::size_t max = columns) {
    if (between.empty()) return text;
    const std::size_t indent = std::min(text.find_first_not_of(' '), text.size());
    std::string out(indent, ' ');
    std::size_t column = 0;  // behind the indent
    for (std::size_t at = indent; at < text.size();) {
        const std::size_t found = text.find(between, at);
        // Without the blank that `between` ends with.
        const std::size_t end = found == std::string::npos ? text.size() : found + between.size() - 1;
        if (column != 0) {
            const bool fits = column + 1 + (end - at) <= max - indent;
            out += fits ? ' ' : '\n';
            column = fits ? column + 1 : 0;
        }
        out.append(text, at, end - at);
        column += end - at;
        at = end + 1;
    }
    return out;
}

struct Writer {
    bool colour;
    std::string out = {};

    void operator()(const Headline& h) {
        std::string line = h.text;
        for (std::size_t i = 0; i < h.reasons.size(); ++i) {
            const std::size_t left = h.reasons.size() - i;
            const std::size_t more = left == 1 ? 0 : std::string_view(", and 20 more defects").size();
            if (i > 0 && line.size() + 4 + h.reasons[i].size() + more > columns) {
                line += ", and " + counted(left, "more defect");
                break;
            }
            line += (i == 0 ? ": " : ", ") + h.reasons[i];
        }
        tell((h.subject.empty() ? "" : h.subject + ": ") + line, h.tone);
        for (const std::string& s : h.sentences) tell(s, Tone::plain, Breaks::words);
    }

    void operator()(const Section& s) {
        out += "\n";
        if (s.on_terminal) tell(s.title, Tone::strong);
    }

    void operator()(const Paragraph& p) { tell(p.text, p.tone, p.wrap); }

    void operator()(const Named& n) {
        for (std::size_t i = 0; i < n.lines.size(); ++i) {
            const std::string name = fmt::format("{:<10} ", i == 0 ? n.name : "");
            const std::string line = wrapped(name + printable(n.lines[i]), separator(n.wrap)).substr(name.size());
            out.append(name).append(toned(line, n.tone)).append("\n");
        }
    }

    void operator()(const Listing& t) {
        struct Shown {
            std::size_t cell, width;
            const Column& column;
            std::vector<std::string> head = {};

            std::string padded(const std::string& text) const {
                const std::string room(width > text.size() ? width - text.size() : 0, ' ');
                return column.left ? text + room : room + text;
            }
        };
        std::vector<Shown> shown;
        std::size_t head_lines = 0;
        for (std::size_t c = 0; c < t.columns.size(); ++c) {
            if (t.columns[c].whom == For::page) continue;
            Shown& s = shown.emplace_back(Shown{c, t.columns[c].width, t.columns[c]});
            std::istringstream head(t.headless ? "" : s.column.head);
            for (std::string text; std::getline(head, text); s.head.push_back(text))
                s.width = std::max(s.width, text.size());
            head_lines = std::max(head_lines, s.head.size());
            for (const Row& row : t.rows) s.width = std::max(s.width, cell_of(row, c).size());
        }
        if (!shown.empty() && shown.back().column.left) shown.back().width = 0;
        const auto line = [&](Tone tone, auto cell) {
            std::string text;
            for (const Shown& s : shown) text += std::string(&s == shown.data() ? 0 : s.column.gap, ' ') + cell(s);
            out += toned(text.erase(text.find_last_not_of(' ') + 1), tone) + "\n";
        };
        for (std::size_t l = 0; l < head_lines; ++l)
            line(Tone::strong, [&](const Shown& s) { return s.padded(l < s.head.size() ? s.head[l] : ""); });
        for (const Row& row : t.rows) {
            line(row.tone, [&](const Shown& s) {
                const std::string text = s.padded(cell_of(row, s.cell));
                return s.cell < row.cells.size() ? toned(text, row.cells[s.cell].tone) : text;
            });
            for (const std::string& below : row.below) tell("    " + below, Tone::bad);
        }
    }

    void operator()(const Item& item) {
        out += (item.title.empty() ? "" : toned(printable(item.title), Tone::strong)) + printable(item.text) + "\n";
        for (const Item::Line& line : item.lines) {
            if (!line.text.empty())
                out += std::string(item.indent, ' ') +
                       toned(printable(line.text), line.command ? Tone::soft : Tone::plain) + "\n";
            std::vector<std::string> places = line.places.shown;
            if (const std::string more = line.places.more(places.size()); !more.empty()) places.push_back(more);
            const std::string between{line.places.between, ' '};
            std::istringstream lines(
                wrapped(printable(fmt::format("{}", fmt::join(places, between))), between, columns - 4));
            for (std::string text; std::getline(lines, text);) out += "    " + text + "\n";
        }
    }

    void operator()(const Pictures& /*markup*/) {}

    std::string toned(const std::string& text, Tone tone) const {
        constexpr std::array<const char*, 5> codes{"", "32", "31", "1", "2"};  // by Tone
        const char* const code = codes[static_cast<std::size_t>(tone)];
        return colour && *code != '\0' ? fmt::format("\033[{}m{}\033[0m", code, text) : text;
    }
    void tell(const std::string& text, Tone tone, Breaks wrap = Breaks::none) {
        out += toned(wrapped(printable(text), separator(wrap)), tone) + "\n";
    }
    static std::string cell_of(const Row& row, std::size_t i) {
        return i < row.cells.size() ? printable(row.cells[i].text) : "";
    }
};

}  // namespace

std::string terminal_text(const Document& document, bool colour) {
    Writer writer{colour};
    for (const Document::Passage& block : document.blocks) {
        if (block.whom != For::page) std::visit(writer, block.content);
    }
    return std::move(writer.out);
}

}  // namespace report
}  // namespace barycert
