/// What the report on a mesh adds to the style of HTML reports.
#pragma once

#include <string_view>

namespace barycert::report {

/// Two pictures side by side where there is room.
inline constexpr std::string_view html_style = R"(
.k{width:1%;white-space:nowrap;padding-right:18px}
td.n,th.n{width:1%;padding-right:0}
.remedy{margin:2px 0}
.places,.witness-at{font-size:14px;overflow-wrap:anywhere}
.views{display:flex;flex-wrap:wrap;justify-content:space-around}
.card p{margin:4px 0;font-size:14px}
.map{display:flex;flex-wrap:wrap;gap:12px 24px;align-items:center}.map svg{flex:2 1 420px;min-width:0}.map div{flex:1 1 240px}
.map table{font-size:14px;margin:0}
.badge{display:inline-block;min-width:22px;padding:0 6px;border-radius:11px;background:#0072b2;color:#fff;
 text-align:center;font-size:13px;line-height:22px}.badge.problem{background:#c8102e}
.swatch{display:inline-block;width:11px;height:11px;margin-right:6px;border-radius:2px}
.swatch.a{background:var(--bar)}.swatch.b{background:var(--second)}
svg .count{font-size:9px;fill:var(--soft)}
svg .view{fill:var(--soft)}svg .id{font-size:11px}svg .id,svg .number{paint-order:stroke;
 stroke:var(--ground);stroke-width:3px;stroke-opacity:.8}
svg .number{font-size:13px;font-weight:bold;fill:var(--bar)}svg .number.bad{fill:var(--bad)}
svg .face{stroke:none;fill-opacity:.16}svg .face.a{fill:var(--bar)}svg .face.b{fill:var(--second)}
svg .edge{stroke-width:1.5px}svg .edge.a{stroke:var(--bar)}svg .edge.b{stroke:var(--second)}
svg .far{stroke-dasharray:4 4;stroke-width:1px}
.node{fill:var(--ink)}.witness{fill:var(--bar-bad);stroke:var(--ground);stroke-width:1.2px}
svg .hull,svg .crease{stroke:var(--soft);stroke-width:.7px;stroke-opacity:.6}svg .crease{stroke-width:.8px;stroke-opacity:.9}
svg .dots{stroke-width:2.4px;stroke:var(--soft)}.dots.l0{stroke-opacity:.75}.dots.l1{stroke-opacity:.45}.dots.l2{stroke-opacity:.22}
svg .problems{stroke:var(--bar-bad);stroke-width:4px;stroke-opacity:.6}
svg .box{stroke:var(--soft);stroke-width:.8px;stroke-dasharray:2 4}
.spot{fill:var(--bar);stroke:var(--ground);stroke-width:1px}.spot.problem{fill:var(--bar-bad)}
@media (max-width:560px){.k{white-space:normal}}
@media print{.figures{grid-template-columns:1fr 1fr;gap:14px 20px}.places,.witness-at,.card p,.map table{font-size:10.5px}}
)";

}  // namespace barycert::report
