/// The style of HTML reports: one column, wide screens and phones, light and dark, screen and paper; no scripts.
#pragma once

#include <string_view>

namespace barycert::report {

/// Okabe and Ito's colours: told apart by most eyes.
inline constexpr std::string_view page_style = R"(
:root{color-scheme:light dark;--ink:#1d2227;--soft:#59636c;--paper:#fff;--line:#dde2e6;--panel:#f5f7f8;
 --good:#00694c;--good-bg:#eaf6f1;--bad:#a50d26;--bad-bg:#fdeeee;--bar:#0072b2;--bar-bad:#c8102e}
@media (prefers-color-scheme:dark){:root{--ink:#e4e8eb;--soft:#a3adb5;--paper:#15191c;--line:#333b41;--panel:#1e2428;
 --good:#5fd0a8;--good-bg:#12281f;--bad:#ff8f9c;--bad-bg:#331a1e;--bar:#56b4e9;--bar-bad:#ff7a88}}
*{box-sizing:border-box}
body{margin:0 auto;padding:28px 20px 40px;max-width:1040px;background:var(--paper);color:var(--ink);
 font:16px/1.5 system-ui,"Helvetica Neue",Arial,"DejaVu Sans",sans-serif}
h1{font-size:17px;font-weight:normal;color:var(--soft);margin:0 0 12px;overflow-wrap:anywhere}
h2{font-size:20px;margin:36px 0 10px;border-bottom:1px solid var(--line);padding-bottom:4px;break-after:avoid}
h3{font-size:16px;margin:18px 0 4px;break-after:avoid}
p{margin:6px 0}
.verdict{border-left:10px solid;padding:14px 20px;border-radius:4px;margin:0 0 18px}
.verdict b{display:block;font-size:28px;line-height:1.25;margin-bottom:4px;overflow-wrap:anywhere}
.verdict.good{border-color:var(--good);background:var(--good-bg)}.verdict.good b{color:var(--good)}
.verdict.bad{border-color:var(--bad);background:var(--bad-bg)}.verdict.bad b{color:var(--bad)}
.scroll{overflow-x:auto}
table{border-collapse:collapse;width:100%;margin:8px 0}
th,td{text-align:left;vertical-align:top;padding:6px 14px 6px 0;border-bottom:1px solid var(--line)}
th{font-size:14px;color:var(--soft);font-weight:normal}
tr{break-inside:avoid}
th.n,td.n{text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums}
td.bad{color:var(--bad);font-weight:bold}
.small{color:var(--soft);font-size:14px}
.card{border:1px solid var(--line);border-radius:4px;background:var(--panel);padding:10px 14px;margin:8px 0;break-inside:avoid}
.card p{margin:2px 0;overflow-wrap:anywhere}
code{font:13px/1.4 ui-monospace,"DejaVu Sans Mono",monospace;overflow-wrap:anywhere}
.bars td{border:0;padding:1px 12px 1px 0;font-size:14px}
.bars td.w{width:100%;padding-right:0}
.bar{display:block;height:14px;border-radius:2px;background:var(--bar);min-width:2px}
.bar.bad{background:var(--bar-bad)}
footer{margin-top:40px;border-top:1px solid var(--line);padding-top:10px;color:var(--soft);font-size:14px;overflow-wrap:anywhere}
@media (max-width:560px){body{padding:16px 12px;font-size:15px}.verdict{padding:10px 14px}.verdict b{font-size:23px}
 th,td{padding-right:10px}}
@page{margin:12mm}
@media print{:root{--ink:#000;--soft:#444;--paper:#fff;--panel:#fff;--line:#ccc;--good:#00694c;--good-bg:#fff;--bad:#a50d26;
 --bad-bg:#fff;--bar:#0072b2;--bar-bad:#c8102e}body{padding:0;max-width:none;font-size:12px;print-color-adjust:exact}}
)";

}  // namespace barycert::report
