#include "barycert/report/check/check_surface.hpp"

#include "barycert/report/check/check_words.hpp"

namespace barycert::report {
namespace {

/// A table has no more rows than a screen.
constexpr std::size_t max_rows = 20;

std::string or_none(std::int64_t number) {
    return number < 0 ? "-" : std::to_string(number);
}

void tell_shells(Document& d, const SurfaceReport& s) {
    Listing table{.columns = {left("shell", 6), right("triangles", 10), left("edges", 7), right("volume", 22),
                              right("area", 12), right("inside", 7)}};
    for (std::size_t i = 0; i < std::min(s.shells.size(), max_rows); ++i) {
        const SurfaceShell& shell = s.shells[i];
        table.rows.push_back(
            {{std::to_string(i), std::to_string(shell.triangles), std::string(shell.closed ? "closed" : "open"),
              shell.volume ? base::shortest(*shell.volume) : "-", fmt::format("{:.6g}", shell.area),
              or_none(shell.inside)}});
    }
    d.table(std::move(table), "Shells");
    if (s.shell_count > max_rows) d.say(fmt::format("And {} more.", s.shell_count - max_rows), Tone::soft);
    d.say(
        "Volumes are exact, rounded once; negative where normals point inwards; - where triangles are not turned "
        "alike.",
        Tone::soft);
}

void tell_regions(Document& d, const SurfaceReport& s) {
    if (s.regions.empty()) return;
    Listing table{.columns = {left("region", 6), right("volume", 22), right("shell", 7), left("points in it", 12)}};
    for (std::size_t i = 0; i < std::min(s.regions.size(), max_rows); ++i) {
        std::vector<std::string> seeds;
        for (const PlcSeed& seed : s.seeds) {
            if (seed.region == static_cast<std::int64_t>(i))
                seeds.push_back(fmt::format("{} {}", seed.hole ? "hole" : "region", seed.number));
        }
        table.rows.push_back({{std::to_string(i), base::shortest(s.regions[i].volume), or_none(s.regions[i].shell),
                               seeds.empty() ? std::string("-") : fmt::format("{}", fmt::join(seeds, ", "))}});
    }
    d.table(std::move(table), "Regions: what the triangles enclose, less what lies in it");
    if (s.regions.size() > max_rows) d.say(fmt::format("And {} more.", s.regions.size() - max_rows), Tone::soft);
}

}  // namespace

std::string tetgen_sentence(const CheckReport& r) {
    const SurfaceReport& s = *r.surface;
    std::vector<std::string> reasons;
    for (const Defect& f : r.defects) {
        // TetGen makes one node of two at one place, and leaves out what collapses.
        if (f.breaks() && f.kind != DefectKind::open_edge && f.kind != DefectKind::repeated_node)
            reasons.push_back(reason(f));
    }
    if (!reasons.empty()) return fmt::format("TetGen will not get a valid PLC: {}", fmt::join(reasons, ", "));
    const auto left = std::ranges::count(s.regions, false, &SurfaceRegion::hole);
    if (s.regions.empty()) return "TetGen will have nothing to mesh: the triangles enclose no region";
    if (left == 0) return "TetGen will have nothing to mesh: hole points lie in all regions";
    std::string off;
    if (s.off_plane != 0)
        off = fmt::format("; {} up to {:.3g} of its extent off {} plane, where TetGen's own tolerance is 1e-8",
                          counted(s.off_plane, "facet is", "facets are"), s.relative_off_plane,
                          s.off_plane == 1 ? "its" : "their");
    return fmt::format("TetGen will get a valid PLC that bounds {}{}",
                       counted(static_cast<std::uint64_t>(left), "region"), off);
}

void tell_surface_verdict(Document& d, const CheckReport& r, const std::string& name) {
    const SurfaceReport& s = *r.surface;
    const char* const what = s.plc ? "a valid PLC" : "a closed surface without self-intersections";
    if (r.certified()) {
        const std::string size = fmt::format("{} in {}{}{}", counted(s.plc ? s.facets : r.cells, cell_word(r)),
                                             counted(s.shell_count, "shell"), s.regions.empty() ? "" : " around ",
                                             s.regions.empty() ? "" : counted(s.regions.size(), "region"));
        d.add(Headline{Tone::good,
                       name,
                       fmt::format("certified: {}", what),
                       {size},
                       {"Proved in exact arithmetic: any two triangles meet in a common node or edge, or not at all.",
                        tetgen_sentence(r) + "."}});
        return;
    }
    std::vector<std::string> reasons;
    for (const Defect& f : r.defects) {
        if (f.breaks())
            reasons.push_back(f.kind == DefectKind::open_edge ? counted(f.count, "edge is open", "edges are open")
                                                              : reason(f));
    }
    if (reasons.empty()) reasons.emplace_back("no triangles");
    d.add(Headline{Tone::bad, name, fmt::format("NOT certified to be {}", what), std::move(reasons)});
    d.say(tetgen_sentence(r) + ".", Tone::plain, For::all, Breaks::words);
}

void tell_surface(Document& d, const CheckReport& r) {
    const SurfaceReport& s = *r.surface;
    d.part("Shells and regions");
    d.name("surface",
           fmt::format("{}{}, {}, {} at {}",
                       s.plc || s.facets != r.cells ? counted(s.facets, s.plc ? "facet" : "polygon") + ", " : "",
                       counted(r.cells, "triangle"), counted(s.edges, "edge"), counted(r.nodes, "node"),
                       counted(s.places, "place")));
    d.name("edges",
           fmt::format("{}, {}, {}", s.closed ? "closed" : "NOT closed", s.manifold ? "manifold" : "not manifold",
                       s.plc         ? "turned as the facets are"
                       : !s.oriented ? "NOT oriented alike"
                       : s.outward   ? "oriented outward"
                                     : "oriented alike"));
    if (!s.shells.empty()) tell_shells(d, s);
    tell_regions(d, s);
    if (!s.plc) d.say(tetgen_sentence(r) + ".", Tone::plain, For::page);
}

}  // namespace barycert::report
