/// The script of HTML pages: tables that sort, commands to copy, and nothing folded on paper.
#pragma once

#include <string_view>

namespace barycert::report {

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
