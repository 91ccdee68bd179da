/// The style of HTML reports: one column, wide screens and phones, light and dark, screen and paper.
#pragma once

#include <string_view>

namespace barycert::report {

/// Okabe and Ito's colours: told apart by most eyes.
inline constexpr std::string_view page_style = R"(
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
.bars td{border:0;padding:1px 12px 1px 0;font-size:14px}
.bars td.w{width:100%;padding-right:0}
.bars .bar{display:block;height:14px;border-radius:2px;background:var(--bar);min-width:2px}
.bars .bar.bad{background:var(--bar-bad)}
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
svg .bar{fill:var(--bar)}svg .bar.bad{fill:var(--bar-bad)}
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
inline constexpr std::string_view page_script = R"js(
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

}  // namespace barycert::report
