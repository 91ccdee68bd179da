// Documents as pages of HTML.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/report/common/document.hpp"
#include "app/report/common/terminal_text.hpp"
#include "core/base/text.hpp"
#include "draw/picture.hpp"

namespace barycert::report {

std::string html_name(std::string_view name) {
    std::string out = xml_escaped(name);
    for (std::size_t dot = out.find('.'); dot < out.size() - 1; dot = out.find('.', dot + 1))
        out.insert(dot + 1, "<wbr/>");
    return out;
}

namespace {

/// One column for wide screens, phones and paper, light and dark; in Okabe and Ito's colours, told apart by most eyes.
constexpr std::string_view page_style = R"(
:root{color-scheme:light dark;--ink:#1d2227;--soft:#59636c;--paper:#fff;--line:#dde2e6;--panel:#f5f7f8;--ground:var(--paper);
 --good:#00694c;--good-bg:#eaf6f1;--bad:#a50d26;--bad-bg:#fdeeee;--bar:#0072b2;--bar-bad:#c8102e;--second:#c67f00}
@media (prefers-color-scheme:dark){:root{--ink:#e4e8eb;--soft:#a3adb5;--paper:#15191c;--line:#333b41;--panel:#1e2428;
 --good:#5fd0a8;--good-bg:#12281f;--bad:#ff8f9c;--bad-bg:#331a1e;--bar:#56b4e9;--bar-bad:#ff7a88;--second:#e6ab4a}}
*{box-sizing:border-box}
body{margin:0 auto;padding:28px 20px 40px;max-width:1120px;background:var(--paper);color:var(--ink);
 font:16px/1.5 system-ui,"Helvetica Neue",Arial,"DejaVu Sans",sans-serif}
h1{font-size:17px;font-weight:normal;color:var(--soft);margin:0 0 12px;overflow-wrap:anywhere}
h2{font-size:20px;margin:36px 0 10px;border-bottom:1px solid var(--line);padding-bottom:4px;break-after:avoid}
h3{font-size:16px;margin:18px 0 4px;break-after:avoid}
p{margin:6px 0}
.verdict{border-left:10px solid;padding:14px 20px;border-radius:4px;margin:0 0 18px;overflow-wrap:anywhere}
.verdict b{display:block;font-size:28px;line-height:1.25;margin-bottom:4px}
.verdict ul{margin:6px 0;padding-left:22px}
.verdict.good{border-color:var(--good);background:var(--good-bg)}.verdict.good b{color:var(--good)}
.verdict.bad{border-color:var(--bad);background:var(--bad-bg)}.verdict.bad b{color:var(--bad)}
.verdict.told{border-color:var(--second);background:var(--panel)}.verdict.told b{font-size:20px}
.scroll{overflow-x:auto}
dl{display:grid;grid-template-columns:max-content 1fr;gap:4px 18px;margin:8px 0}dt{color:var(--soft)}
dd{margin:0;overflow-wrap:anywhere}
details{margin:4px 0}summary{cursor:pointer;color:var(--soft);font-size:14px}
table{border-collapse:collapse;width:100%;margin:8px 0}
th,td{text-align:left;vertical-align:top;padding:6px 14px 6px 0;border-bottom:1px solid var(--line)}
th{font-size:14px;color:var(--soft);font-weight:normal}
th[scope=row]{color:inherit}
tr{break-inside:avoid}
th.n,td.n{text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums}
td.bad,p.bad{color:var(--bad);font-weight:bold}.ok{color:var(--good)}
.league{font-size:14px}.league th,.league td{padding-right:9px}
.league thead th{white-space:normal;vertical-align:bottom;font-size:13px;line-height:1.3}
.league thead span{white-space:nowrap}
.league tbody th{font-weight:600;white-space:nowrap}
.league th:first-child{position:sticky;left:0;background:var(--paper)}
.small,figcaption{color:var(--soft);font-size:14px}
.card{border:1px solid var(--line);border-radius:4px;background:var(--panel);--ground:var(--panel);padding:10px 14px;
 margin:8px 0;break-inside:avoid}
.card h3{margin:0 0 2px}.card p{margin:2px 0;overflow-wrap:anywhere}
code{font:13px/1.4 ui-monospace,"DejaVu Sans Mono",monospace;overflow-wrap:anywhere}
button{font:inherit;color:inherit;background:none;border:0;padding:0;text-align:inherit;cursor:pointer}
button:focus-visible{outline:2px solid var(--bar);outline-offset:2px}
th button{text-decoration:underline dotted;text-underline-offset:3px}
th[aria-sort]{color:var(--ink)}th[aria-sort=ascending] button::after{content:" \25B2"}
th[aria-sort=descending] button::after{content:" \25BC"}
button.copy{font-size:13px;border:1px solid var(--line);border-radius:4px;background:var(--paper);padding:1px 9px;margin-left:8px}
.figures{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,470px),1fr));gap:18px 24px}
figure{margin:0;break-inside:avoid}
svg{max-width:100%;height:auto;vertical-align:top}
svg text{font-size:12px;fill:var(--ink)}
svg path{fill:none;stroke-linejoin:round;stroke-linecap:round}
.m{text-anchor:middle}.e{text-anchor:end}
svg .tick{fill:var(--soft)}svg .title{font-size:13px}svg .bad{fill:var(--bad)}
svg .grid{stroke:var(--line)}svg .axis{stroke:var(--soft)}
svg .bar{fill:var(--bar)}svg .bar.bad{fill:var(--bar-bad)}svg .count{font-size:9px;fill:var(--soft)}
svg .halo{stroke:var(--ground);stroke-width:4px;fill:var(--ground)}svg .lead{stroke:var(--soft);stroke-width:.7px}
footer{margin-top:40px;border-top:1px solid var(--line);padding-top:10px;color:var(--soft);font-size:14px;overflow-wrap:anywhere}
@media (max-width:560px){body{padding:16px 12px;font-size:15px}.verdict{padding:10px 14px}.verdict b{font-size:23px}
 th,td{padding-right:10px}
 dl{grid-template-columns:1fr;gap:0}dd{margin-bottom:6px}
 .league tbody th{white-space:normal;overflow-wrap:anywhere;min-width:132px}
 .stack,.stack tbody,.stack tr,.stack td{display:block;width:auto}.stack tr{padding:6px 0;border-bottom:1px solid var(--line)}
 .stack thead{display:none}.stack td{border:0;padding:1px 0}.stack td.n{text-align:left}
 .stack td[data-l]::before{content:attr(data-l) ": ";color:var(--soft)}}
@page{margin:12mm}
@media print{:root{color-scheme:light;--ink:#000;--soft:#444;--paper:#fff;--panel:#fff;--line:#ccc;--good:#00694c;
 --good-bg:#fff;--bad:#a50d26;--bad-bg:#fff;--bar:#0072b2;--bar-bad:#c8102e;--second:#c67f00}
 body{padding:0;max-width:none;font-size:12px;print-color-adjust:exact;-webkit-print-color-adjust:exact}
 h2{font-size:16px;margin-top:22px}.small,figcaption,th,code{font-size:10.5px}th,td{padding:3px 8px 3px 0}
 .league,.league thead th{font-size:9.5px}.league th,.league td{padding:2px 6px 2px 0}
 .league tbody th,td{white-space:normal;overflow-wrap:anywhere}.league tbody th{min-width:108px}
 .league th:first-child{position:static}
 button.copy{display:none}.scroll{overflow:visible}}
)";

/// Neither "less than" nor "and" signs, so that the page stays well-formed XML. Cells sort by data-v where they have
/// it, as numbers; else by their text. Buttons are made here, so that there are none where nothing would happen.
constexpr std::string_view page_script = R"js(
"use strict";
(function () {
  function value(row, column) {
    const cell = row.cells[column];
    return cell.dataset.v === undefined ? cell.textContent : Number(cell.dataset.v);
  }
  document.querySelectorAll("table.sortable").forEach(function (table) {
    const body = table.tBodies[0], heads = Array.from(table.tHead.rows[0].cells);
    heads.forEach(function (head, column) {
      const button = document.createElement("button");
      button.type = "button";
      button.append(...head.childNodes);
      head.append(button);
      button.addEventListener("click", function () {
        const rows = Array.from(body.rows), before = head.getAttribute("aria-sort");
        const numbers = typeof value(rows[0], column) === "number";
        const down = before === null ? numbers : before === "ascending";
        heads.forEach(function (other) { other.removeAttribute("aria-sort"); });
        head.setAttribute("aria-sort", down ? "descending" : "ascending");
        rows.sort(function (a, b) {
          const x = value(a, column), y = value(b, column);
          const order = numbers ? Number(x > y) - Number(y > x) : x.localeCompare(y);
          return down ? -order : order;
        });
        body.append(...rows);
      });
    });
  });
  document.querySelectorAll("code.copy").forEach(function (code) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "copy";
    button.textContent = "Copy";
    button.setAttribute("aria-live", "polite");
    function done() {
      button.textContent = "Copied";
      setTimeout(function () { button.textContent = "Copy"; }, 1500);
    }
    function byHand() {
      const range = document.createRange();
      range.selectNodeContents(code);
      getSelection().removeAllRanges();
      getSelection().addRange(range);
      if (document.execCommand("copy")) done();
      else button.textContent = "Press Ctrl+C";
    }
    button.addEventListener("click", function () {
      if (navigator.clipboard) navigator.clipboard.writeText(code.textContent).then(done, byHand);
      else byHand();
    });
    code.after(button);
  });
  let opened = [];
  addEventListener("beforeprint", function () {
    opened = Array.from(document.querySelectorAll("details:not([open])"));
    opened.forEach(function (fold) { fold.open = true; });
  });
  addEventListener("afterprint", function () {
    opened.forEach(function (fold) { fold.open = false; });
    opened = [];
  });
})();
)js";

constexpr std::size_t max_places = 12;

/// ` name="value"`, or nothing.
std::string attribute(std::string_view name, std::string_view value) {
    return value.empty() ? "" : fmt::format(" {}=\"{}\"", name, xml_escaped(value));
}

std::string paragraph(const std::string& markup, std::string_view style = {}) {
    return fmt::format("<p{}>{}</p>\n", attribute("class", style), markup);
}

/// The words of a line: a command is to be copied.
std::string words(const std::string& text, bool command) {
    return command ? "<code class=\"copy\">" + xml_escaped(text) + "</code>" : xml_escaped(text);
}

std::string_view by_tone(const std::array<const char*, 5>& classes, Tone tone) {
    return classes[static_cast<std::size_t>(tone)];
}

struct PageWriter {
    std::string out = {};

    void operator()(const Headline& h) {
        std::string text = h.text;
        if (!h.subject.empty() && text.front() >= 'a' && text.front() <= 'z') text.front() -= 'a' - 'A';
        constexpr std::array classes{"told", "good", "bad", "told", "told"};
        out += fmt::format("<section class=\"verdict {}\"><b>{}</b>", by_tone(classes, h.tone), xml_escaped(text));
        if (h.reasons.size() == 1) out += paragraph(xml_escaped(h.reasons[0]) + ".");
        if (h.reasons.size() > 1)
            out += "<ul>" + joined(h.reasons, "", [](const auto& r) { return "<li>" + xml_escaped(r) + "</li>"; }) +
                   "</ul>";
        for (const std::string& s : h.sentences) out += paragraph(xml_escaped(s));
        out += "</section>\n";
    }

    void operator()(const Section& s) {
        if (!s.title.empty()) out += fmt::format("<h{0}>{1}</h{0}>\n", s.level, xml_escaped(s.title));
    }

    void operator()(const Paragraph& p) {
        const std::string text = xml_escaped(p.text);
        constexpr std::array classes{"", "", "bad", "", "small"};
        out += paragraph(p.tone == Tone::strong ? "<b>" + text + "</b>" : text, by_tone(classes, p.tone));
    }

    void operator()(const Named& n) {
        const std::string lines =
            joined(n.lines, "<br/>", [&](const std::string& line) { return words(line, n.command); });
        out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", xml_escaped(n.name),
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
        out += "<div class=\"card\">" + paragraph("<b>" + xml_escaped(item.title) + "</b>" + xml_escaped(item.text));
        for (const Item::Line& line : item.lines) {
            if (!line.text.empty()) out += paragraph(words(line.text, line.command));
            const std::span shown = std::span(line.places.shown).first(std::min(line.places.shown.size(), max_places));
            std::string places = fmt::format("{}", fmt::join(shown, std::string{line.places.between, ' '}));
            if (const std::string more = line.places.more(shown.size()); !more.empty()) places += "; " + more;
            if (!places.empty()) out += paragraph(xml_escaped(places), "small");
        }
        out += "</div>\n";
    }

    void operator()(const Pictures& p) { out += p(); }

    static std::string head_of(const Column& c) {
        std::string head = c.page.empty() ? c.head : c.page;
        std::ranges::replace(head, '\n', ' ');
        return head;
    }

    /// Flags begin with hyphens, at which lines would be broken.
    static std::string unbroken_words(const std::string& text) {
        if (text.find(" -") == std::string::npos) return xml_escaped(text);
        std::string out;
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find(' ', at), text.size());
            out += fmt::format("{}<span>{}</span>", at == 0 ? "" : " ", xml_escaped(text.substr(at, end - at)));
            at = end + 1;
        }
        return out;
    }

    static std::string cell(const Listing& t, const Row& row, std::size_t i) {
        const Column& column = t.columns[i];
        const Cell& c = row.cells[i];
        const std::string text = t.sorts && column.left ? html_name(c.text) : xml_escaped(c.text);
        if (t.sorts && i == 0) return fmt::format("<th scope=\"row\"{}>{}</th>", attribute("title", row.tip), text);
        const Tone tone = c.tone != Tone::plain ? c.tone : t.sorts || column.left ? Tone::plain : row.tone;
        constexpr std::array classes{"", " ok", " bad", "", ""};
        std::string attributes = attribute("class", (column.left ? "" : "n") + std::string(by_tone(classes, tone)));
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
    for (const Document::Passage& block : d.blocks) {
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
        xml_escaped(d.title), page_style, d.style, xml_escaped(d.heading), writer.out, xml_escaped(d.footer),
        d.script ? "<script>" : "", d.script ? page_script : "", d.script ? "</script>\n" : "");
}

}  // namespace barycert::report
