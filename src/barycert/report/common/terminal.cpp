// Documents as text for a terminal.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "barycert/base/text.hpp"
#include "barycert/report/common/document.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert::report {
namespace {

constexpr std::size_t columns = 100;
using base::printable;

std::string wrapped(const std::string& text, Breaks wrap) {
    if (wrap == Breaks::none) return text;
    const std::string_view between = wrap == Breaks::words ? " " : ", ";
    const std::size_t indent = std::min(text.find_first_not_of(' '), text.size());
    std::string out(indent, ' ');
    std::size_t column = 0;  // behind the indent
    for (std::size_t at = indent; at < text.size();) {
        const std::size_t found = text.find(between, at);
        // Without the blank that `between` ends with.
        const std::size_t end = found == std::string::npos ? text.size() : found + between.size() - 1;
        if (column != 0) {
            const bool fits = column + 1 + (end - at) <= columns - indent;
            out += fits ? ' ' : '\n';
            column = fits ? column + 1 : 0;
        }
        out.append(text, at, end - at);
        column += end - at;
        at = end + 1;
    }
    return out;
}

std::string padded(const std::string& text, bool left, std::size_t width) {
    const std::string room(width > text.size() ? width - text.size() : 0, ' ');
    return left ? text + room : room + text;
}

class Writer {
public:
    explicit Writer(bool colour) : paint_(colour) {}
    std::string out;

    void operator()(const Headline& h) {
        std::string line = h.text;
        for (std::size_t i = 0; i < h.reasons.size(); ++i) {
            const std::size_t left = h.reasons.size() - i;
            const std::string rest = fmt::format(", and {}", counted(left, h.rest));
            const std::size_t more = left == 1 ? 0 : fmt::format(", and 20 {}s", h.rest).size();
            if (i > 0 && line.size() + 4 + h.reasons[i].size() + more > columns) {
                line += rest;
                break;
            }
            line += (i == 0 ? ": " : ", ") + h.reasons[i];
        }
        out += toned(printable((h.subject.empty() ? "" : h.subject + ": ") + line), h.tone) + "\n";
        for (const std::string& s : h.sentences) out += wrapped(printable(s), Breaks::words) + "\n";
    }

    void operator()(const Section& s) {
        out += "\n";
        if (s.on_terminal) out += paint_.bold(printable(s.title)) + "\n";
    }

    void operator()(const Paragraph& p) { out += toned(wrapped(printable(p.text), p.wrap), p.tone) + "\n"; }

    void operator()(const Named& n) {
        for (std::size_t i = 0; i < n.lines.size(); ++i) {
            const std::string name = fmt::format("{:<10} ", i == 0 ? n.name : "");
            out += name + toned(wrapped(name + printable(n.lines[i]), n.wrap).substr(name.size()), n.tone) + "\n";
        }
    }

    void operator()(const Listing& t) {
        std::vector<const Column*> columns_shown;
        std::vector<std::size_t> from, widths;  // of cells in a row; of columns
        std::vector<std::vector<std::string>> heads;
        for (std::size_t c = 0; c < t.columns.size(); ++c) {
            const Column& column = t.columns[c];
            if (column.whom == For::page) continue;
            std::istringstream head(t.headless ? "" : column.head);
            std::size_t width = column.width, line = 0;
            for (std::string text; std::getline(head, text); ++line) {
                if (heads.size() == line) heads.emplace_back();
                heads[line].resize(from.size() + 1);
                heads[line].back() = text;
                width = std::max(width, text.size());
            }
            for (const Row& row : t.rows) width = std::max(width, cell_of(row, c).size());
            columns_shown.push_back(&column);
            from.push_back(c);
            widths.push_back(width);
        }
        if (!widths.empty() && columns_shown.back()->left) widths.back() = 0;
        const auto line = [&](auto cell) {
            std::string text;
            for (std::size_t i = 0; i < from.size(); ++i)
                text += std::string(i == 0 ? 0 : columns_shown[i]->gap, ' ') + cell(i);
            return text.erase(text.find_last_not_of(' ') + 1);
        };
        for (std::vector<std::string>& head : heads) {
            head.resize(from.size());
            out +=
                paint_.bold(line([&](std::size_t i) { return padded(head[i], columns_shown[i]->left, widths[i]); })) +
                "\n";
        }
        for (const Row& row : t.rows) {
            const std::string text = line([&](std::size_t i) {
                const std::string cell = padded(cell_of(row, from[i]), columns_shown[i]->left, widths[i]);
                return from[i] < row.cells.size() ? toned(cell, row.cells[from[i]].tone) : cell;
            });
            out += toned(text, row.tone) + "\n";
            for (const std::string& below : row.below) out += paint_.bad("    " + printable(below)) + "\n";
        }
    }

    void operator()(const Item& item) {
        out += (item.title.empty() ? "" : paint_.bold(printable(item.title))) + printable(item.text) + "\n";
        for (const Item::Line& line : item.lines) {
            const std::string text = printable(line.text);
            if (!text.empty()) out += std::string(item.indent, ' ') + (line.command ? paint_.dim(text) : text) + "\n";
            std::vector<std::string> places = line.places.shown;
            if (const std::string more = line.places.more(places.size()); !more.empty()) places.push_back(more);
            std::string of_a_line;
            for (std::size_t i = 0; i < places.size(); ++i) {
                std::string piece = printable(places[i]);
                if (i + 1 < places.size()) piece += line.places.between;
                if (!of_a_line.empty() && of_a_line.size() + 1 + piece.size() > columns) {
                    out += of_a_line + "\n";
                    of_a_line.clear();
                }
                of_a_line += (of_a_line.empty() ? "    " : " ") + piece;
            }
            if (!of_a_line.empty()) out += of_a_line + "\n";
        }
    }

    void operator()(const Bars& b) {
        std::uint64_t most = 1;
        for (const Bars::Bar& bar : b.bars) most = std::max(most, bar.count);
        for (const Bars::Bar& bar : b.bars) {
            const double share = static_cast<double>(bar.count) / static_cast<double>(most);
            out += fmt::format("{:>14} {:>12}  {}\n", bar.label, bar.count,
                               std::string(static_cast<std::size_t>(std::ceil(50 * share)), '#'));
        }
    }

    void operator()(const Pictures& /*markup*/) {}

private:
    std::string toned(const std::string& text, Tone tone) const {
        switch (tone) {
            case Tone::good:
                return paint_.good(text);
            case Tone::bad:
                return paint_.bad(text);
            case Tone::strong:
                return paint_.bold(text);
            case Tone::soft:
                return paint_.dim(text);
            default:
                return text;
        }
    }
    static std::string cell_of(const Row& row, std::size_t i) {
        return i < row.cells.size() ? printable(row.cells[i].text) : "";
    }

    Colours paint_;
};

}  // namespace

std::string terminal_text(const Document& document, bool colour) {
    Writer writer(colour);
    for (const Document::Block& block : document.blocks) {
        if (block.whom != For::page) std::visit(writer, block.content);
    }
    return std::move(writer.out);
}

}  // namespace barycert::report
