/// The style sheet of the HTML report.
#pragma once

#include <string_view>

namespace barycert::report {

/// Okabe and Ito's colours: told apart by most eyes. Wide enough for two pictures side by side; on paper likewise.
inline constexpr std::string_view html_style = R"(
*{box-sizing:border-box}
body{margin:0 auto;padding:28px 20px 40px;max-width:1120px;background:#fff;color:#222;
 font:15px/1.45 Helvetica,Arial,"DejaVu Sans",sans-serif;-webkit-print-color-adjust:exact;print-color-adjust:exact}
h1{font-size:17px;font-weight:normal;color:#555;margin:0 0 10px;overflow-wrap:anywhere}
h2{font-size:20px;margin:36px 0 10px;border-bottom:1px solid #ddd;padding-bottom:4px;break-after:avoid}
h3{font-size:15px;margin:0 0 2px;break-after:avoid}
p{margin:6px 0}
.verdict{border-left:10px solid;padding:14px 20px;border-radius:4px;margin:0 0 18px}
.verdict b{display:block;font-size:30px;line-height:1.2;margin-bottom:6px}
.verdict ul{margin:6px 0;padding-left:22px}
.certified{border-color:#009e73;background:#eef8f4}.certified b{color:#00694c}
.broken{border-color:#c8102e;background:#fdf0f0}.broken b{color:#a50d26}
.tiles{display:flex;flex-wrap:wrap;gap:10px;margin:0 0 12px}
.tiles div{border:1px solid #ddd;border-radius:4px;padding:8px 14px;min-width:104px}
.tiles b{display:block;font-size:20px}.tiles span,.small{color:#555;font-size:13px}
table{border-collapse:collapse;width:100%;margin:8px 0}
th,td{text-align:left;vertical-align:top;padding:5px 12px 5px 0;border-bottom:1px solid #e4e4e4}
th{font-size:13px;color:#555;white-space:nowrap}tr{break-inside:avoid}
.k{width:1%;white-space:nowrap;padding-right:18px}
.n{text-align:right;width:1%;white-space:nowrap;padding-right:0}
td.n,.count{font-variant-numeric:tabular-nums}
.ok{color:#00694c}td.bad,b.bad{color:#a50d26;font-weight:bold}
.places,.witness-at{font-size:13px;overflow-wrap:anywhere}
code{font-size:12px;overflow-wrap:anywhere}
.figures{display:flex;flex-wrap:wrap;gap:18px 24px}
figure{margin:0;break-inside:avoid}
.half{width:calc(50% - 12px);min-width:510px}
.views{display:flex;justify-content:space-around}
.card{border:1px solid #ddd;border-radius:4px;padding:10px 12px}
.card p{margin:4px 0;font-size:13px;overflow-wrap:anywhere}
.map{display:flex;gap:24px;align-items:center}.map div{flex:1}.map table{font-size:13px;margin:0}.map td{white-space:nowrap}
.badge{display:inline-block;min-width:22px;padding:0 6px;border-radius:11px;background:#0072b2;color:#fff;
 text-align:center;font-size:13px;line-height:22px}.badge.kind{background:#c8102e}
.swatch{display:inline-block;width:11px;height:11px;margin-right:6px;border-radius:2px}
.swatch.a{background:#0072b2}.swatch.b{background:#e69f00}
footer{margin-top:40px;border-top:1px solid #ddd;padding-top:10px;color:#555;font-size:13px}
svg{max-width:100%;height:auto;vertical-align:top}
svg text{font-size:12px;fill:#222}
svg path{fill:none;stroke-linejoin:round;stroke-linecap:round}
.m{text-anchor:middle}.e{text-anchor:end}
svg .tick{fill:#444}svg .count{font-size:9px;fill:#333}svg .title{font-size:13px}
svg .view{fill:#555}svg .id{font-size:11px}svg .id,svg .number{paint-order:stroke;
 stroke:#fff;stroke-width:3px;stroke-opacity:.8}
svg .bad{fill:#a50d26}svg .number{font-size:13px;font-weight:bold;fill:#00507d}
svg .number.bad{fill:#a50d26}
svg .halo{font-size:12px;stroke:#fff;stroke-width:4px;fill:#fff}
.bar{fill:#0072b2}svg .grid{stroke:#e4e4e4}.axis{stroke:#444}.lead{stroke:#999;stroke-width:.7px}
svg .face{stroke:none;fill-opacity:.16}svg .face.a{fill:#0072b2}svg .face.b{fill:#e69f00}
svg .edge{stroke-width:1.5px}svg .edge.a{stroke:#0072b2}svg .edge.b{stroke:#c67f00}
svg .far{stroke-dasharray:4 4;stroke-width:1px}
.node{fill:#222}.witness{fill:#d00;stroke:#fff;stroke-width:1.2px}
.hull{stroke:#a8b0b7;stroke-width:.7px}.crease{stroke:#7d868e;stroke-width:.8px}
svg .dots{stroke-width:2.4px}.dots.l0{stroke:#a3acb5}.dots.l1{stroke:#c3cad0}.dots.l2{stroke:#dde2e6}
.defects{stroke:#e06070;stroke-width:4px;stroke-opacity:.6}
.box{stroke:#999;stroke-width:.8px;stroke-dasharray:2 4}
.spot{fill:#0072b2;stroke:#fff;stroke-width:1px}.spot.kind{fill:#c8102e}
@page{margin:12mm}
@media print{body{padding:0;max-width:none;font-size:12px}.half{min-width:0}.figures{gap:14px 20px}
 h2{font-size:16px}.small,.places,.witness-at,.card p,.map table,.map th,th,code{font-size:10.5px}h2{margin-top:22px}}
)";

}  // namespace barycert::report
