// Documents as pages of HTML.

#include <algorithm>
#include <cmath>

#include "barycert/base/text.hpp"
#include "barycert/report/common/document.hpp"
#include "barycert/report/common/page_style.hpp"
#include "barycert/report/common/picture.hpp"

namespace barycert::report {

std::string html_escaped(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const std::size_t size = base::first_character(text).size;
        const char c = text.front();
        const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
        out += size == 0  ? "\xef\xbf\xbd"
               : c == '&' ? "&amp;"
               : c == '<' ? "&lt;"
               : c == '>' ? "&gt;"
               : c == '"' ? "&quot;"
               : control  ? " "
                          : text.substr(0, size);
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return out;
}

std::string html_name(std::string_view name) {
    std::string out;
    for (std::size_t at = 0; at < name.size();) {
        const std::size_t dot = name.find('.', at);
        const std::size_t end = dot == std::string_view::npos ? name.size() : dot + 1;
        out += html_escaped(name.substr(at, end - at)) + (end < name.size() ? "<wbr/>" : "");
        at = end;
    }
    return out;
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

namespace {

constexpr std::size_t max_places = 12;

/// ` name="value"`, or nothing.
std::string attribute(std::string_view name, std::string_view value) {
    return value.empty() ? "" : fmt::format(" {}=\"{}\"", name, html_escaped(value));
}

std::string paragraph(const std::string& markup, std::string_view style = {}) {
    return fmt::format("<p{}>{}</p>\n", attribute("class", style), markup);
}

/// Of a line: a command is to be copied.
std::string words(const std::string& text, bool command) {
    return command ? "<code class=\"copy\">" + html_escaped(text) + "</code>" : html_escaped(text);
}

class PageWriter {
public:
    std::string out;

    void operator()(const Headline& h) {
        std::string text = h.text;
        if (!h.subject.empty() && text.front() >= 'a' && text.front() <= 'z') text.front() -= 'a' - 'A';
        out += fmt::format("<section class=\"verdict {}\"><b>{}</b>",
                           h.tone == Tone::good  ? "good"
                           : h.tone == Tone::bad ? "bad"
                                                 : "told",
                           html_escaped(text));
        if (h.reasons.size() == 1) out += paragraph(html_escaped(h.reasons[0]) + ".");
        if (h.reasons.size() > 1)
            out += "<ul>" + joined(h.reasons, "", [](const auto& r) { return "<li>" + html_escaped(r) + "</li>"; }) +
                   "</ul>";
        for (const std::string& s : h.sentences) out += paragraph(html_escaped(s));
        out += "</section>\n";
    }

    void operator()(const Section& s) {
        if (!s.title.empty()) out += fmt::format("<h{0}>{1}</h{0}>\n", s.level, html_escaped(s.title));
    }

    void operator()(const Paragraph& p) {
        const std::string text = html_escaped(p.text);
        out += paragraph(p.tone == Tone::strong ? "<b>" + text + "</b>" : text, p.tone == Tone::soft  ? "small"
                                                                                : p.tone == Tone::bad ? "bad"
                                                                                                      : "");
    }

    void operator()(const Named& n) {
        const std::string lines =
            joined(n.lines, "<br/>", [&](const std::string& line) { return words(line, n.command); });
        out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", html_escaped(n.name),
                           n.tone == Tone::strong || n.tone == Tone::bad ? "<b>" + lines + "</b>" : lines);
    }

    void operator()(const Listing& t) {
        std::string heads, rows;
        for (const Column& c : t.columns) {
            if (c.whom == For::terminal) continue;
            heads += fmt::format("<th scope=\"col\" class=\"{}\"{}>{}</th>", c.left ? "t" : "n",
                                 attribute("title", c.tip), unbroken_words(head_of(c)));
        }
        for (const Row& row : t.rows) {
            rows += "<tr>";
            for (std::size_t i = 0; i < std::min(row.cells.size(), t.columns.size()); ++i)
                if (t.columns[i].whom != For::terminal) rows += cell(t, row, i);
            rows += "</tr>\n";
        }
        out +=
            fmt::format("{}<table class=\"{}{}{}\"><thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table>{}\n",
                        t.sorts ? "<div class=\"scroll\" tabindex=\"0\">" : "", t.sorts ? "sortable league" : "stack",
                        t.style.empty() ? "" : " ", t.style, heads, rows, t.sorts ? "</div>" : "");
    }

    void operator()(const Item& item) {
        out += "<div class=\"card\">" + paragraph("<b>" + html_escaped(item.title) + "</b>" + html_escaped(item.text));
        for (const Item::Line& line : item.lines) {
            if (!line.text.empty()) out += paragraph(words(line.text, line.command));
            std::string places;
            const std::size_t shown = std::min(line.places.shown.size(), max_places);
            for (std::size_t i = 0; i < shown; ++i)
                places += (i == 0 ? "" : std::string(1, line.places.between) + " ") + line.places.shown[i];
            if (const std::string more = line.places.more(shown); !more.empty()) places += "; " + more;
            if (!places.empty()) out += paragraph(html_escaped(places), "small");
        }
        out += "</div>\n";
    }

    void operator()(const Bars& b) {
        out += "<table class=\"bars\">\n";
        for (const Bars::Bar& bar : b.bars)
            out += fmt::format("<tr><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"w\">{}</td></tr>\n",
                               html_escaped(bar.label), bar.count,
                               bar.count == 0 ? ""
                                              : fmt::format("<span class=\"bar{}\" style=\"width:{:.2f}%\"></span>",
                                                            bar.bad ? " bad" : "", 100 * b.share(bar)));
        out += "</table>\n";
    }

    void operator()(const Pictures& p) { out += p.markup(); }

private:
    static std::string head_of(const Column& c) {
        std::string head = c.page.empty() ? c.head : c.page;
        std::replace(head.begin(), head.end(), '\n', ' ');
        return head;
    }

    /// Flags begin with hyphens, at which lines would be broken.
    static std::string unbroken_words(const std::string& text) {
        if (text.find(" -") == std::string::npos) return html_escaped(text);
        std::string out;
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find(' ', at), text.size());
            out += fmt::format("{}<span>{}</span>", at == 0 ? "" : " ", html_escaped(text.substr(at, end - at)));
            at = end + 1;
        }
        return out;
    }

    static std::string cell(const Listing& t, const Row& row, std::size_t i) {
        const Column& column = t.columns[i];
        const Cell& c = row.cells[i];
        const std::string text = t.sorts && column.left ? html_name(c.text) : html_escaped(c.text);
        if (t.sorts && i == 0) return fmt::format("<th scope=\"row\"{}>{}</th>", attribute("title", row.tip), text);
        const Tone tone = c.tone != Tone::plain ? c.tone : t.sorts || column.left ? Tone::plain : row.tone;
        std::string attributes = attribute("class", fmt::format("{}{}", column.left ? "" : "n",
                                                                tone == Tone::bad    ? " bad"
                                                                : tone == Tone::good ? " ok"
                                                                                     : ""));
        if (c.order)
            attributes += attribute("data-v", std::isinf(*c.order) ? "Infinity" : base::shortest(*c.order));
        else if (!t.sorts && i != 0)
            attributes += attribute("data-l", head_of(column));
        return fmt::format("<td{}>{}</td>", attributes, text);
    }
};

}  // namespace

std::string page_text(const Document& d) {
    PageWriter writer;
    std::vector<const Document::Content*> blocks;
    for (const Document::Block& block : d.blocks) {
        if (block.whom != For::terminal) blocks.push_back(&block.content);
    }
    const auto folds = [&](std::size_t i) {
        const Item* const item = i < blocks.size() ? std::get_if<Item>(blocks[i]) : nullptr;
        return item != nullptr && item->folds;
    };
    const auto named = [&](std::size_t i) { return i < blocks.size() && std::holds_alternative<Named>(*blocks[i]); };
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (named(i) && (i == 0 || !named(i - 1))) writer.out += "<dl>\n";
        if (folds(i) && (i == 0 || !folds(i - 1))) {
            std::size_t end = i;
            while (folds(end)) ++end;
            writer.out += fmt::format("<details><summary>{} more</summary>\n", end - i);
        }
        std::visit(writer, *blocks[i]);
        if (named(i) && !named(i + 1)) writer.out += "</dl>\n";
        if (folds(i) && !folds(i + 1)) writer.out += "</details>\n";
    }
    return fmt::format(
        "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\"><head><meta charset=\"utf-8\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
        "'unsafe-inline'; script-src 'unsafe-inline'\"/>\n"
        "<title>{}</title>\n<style>{}{}</style></head>\n<body><main>\n<h1>{}</h1>\n{}</main>\n<footer>{}</footer>\n"
        "{}{}{}</body></html>\n",
        html_escaped(d.title), page_style, d.style, html_escaped(d.heading), writer.out, html_escaped(d.footer),
        d.script ? "<script>" : "", d.script ? page_script : "", d.script ? "</script>\n" : "");
}

}  // namespace barycert::report
