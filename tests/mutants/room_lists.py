"""The rooms whose mutants meet the tests of the project: what is changed there, and what runs against it."""
from dataclasses import dataclass, field

# Mistakes of a tired programmer: (file, exact text, replacement, why).
CHECK = [
    ("boundary.cpp", "if (fans < 2) ++fans;", "++fans;", "a count of fans in eight bits"),
    ("boundary.cpp", "if (same.size() == 2) piece_.join(same[0].facet, same[1].facet);",
     "for (std::size_t i = 1; i < same.size(); ++i) piece_.join(same[0].facet, same[i].facet);", "pieces that touch along a ridge are one"),
    ("cells.cpp", "c.report.negative <= c.report.positive ? -1 : 1", "c.report.negative < c.report.positive ? -1 : 1", "as many of either order"),
    ("cells.cpp", "repeated = repeated || nodes[i] == nodes[j];", "repeated = nodes[i] == nodes[j];", "the last pair of nodes alone"),
    ("cells.cpp", "d == 3 && proper(3, {{}, {p[0], other, p[i]}})", "d == 3", "nodes on a line are coplanar"),
    ("cells.cpp", "std::isnormal(volume) && ", "", "the shape of a cell from a subnormal volume"),
    ("check.cpp", ' && t.condition != "P5"', "", "overlaps looked for where only P5 fails"),
    ("stages.hpp", "        ExactEnvironment::renew();\n", "", "what the caller's progress did to the environment stays"),
    ("conformity.cpp", "box.high[k] / 2 - box.low[k] / 2", "(box.high[k] - box.low[k]) / 2", "an extent that overflows"),
    ("conformity.cpp", "crossing < 0 && areas.equal()", "areas.equal()", "areas alone"),
    ("conformity.cpp", " && !misses_vertex(region)", "", "a vertex that is no node"),
    ("delaunay.cpp", "const bool mutual = opposite(cell, p, i, node);", "const bool mutual = true;", "one apex in the other's sphere is taken for both"),
    ("facets.cpp", "apex(copy) > copy.highest", "apex(copy) >= copy.highest", "which facet tells of a duplicate"),
    ("measures.cpp", "(known.size() - 1) / 2", "known.size() / 2", "the upper median"),
    ("nodes.cpp", "{&c.mesh.mid_nodes, &c.mesh.shapes.nodes, ", "{&c.mesh.shapes.nodes, ", "nodes midway are used"),
    ("fix.cpp", "if (mesh_.dimension == 3) std::swap(mid[2], mid[3]);", "", "mid-edge nodes of 02 and 03 that stay"),
    ("plc_facet.hpp", "p[k] / 2 - o[k] / 2, 1 - exponent_", "p[k] - o[k], -exponent_", "a difference that overflows"),
    ("plc_facet.hpp", "area_ += std::fabs(", "area_ -= std::fabs(", "the share of a facet below 0"),
    ("surface/regions.cpp", "all.chamber[front] - part.six[k]", "all.chamber[front] + part.six[k]", "chambers on the side of a normal"),
    ("surface/regions.cpp", "all.chamber[back] + part.six[k]", "all.chamber[back]", "chambers behind triangles"),
    ("surface/topology.cpp", "if (sheets[j][1] < sheets[i][1]) continue;", "", "sheets that touch said to pass through each other"),
    ("surface/surface_check.cpp", "return t.condition == \"S2\";", "return t.breaks;", "no regions beside triangles without an area"),
    ("surface/topology.cpp", "turn.sorted(edge)", "edge", "the order of triangles around an edge"),
    ("pairs.cpp", "if (!complete) c.defects[DefectKind::nested_part].at_least = true;", "", "not said that there may be more"),
]
LOCATE = [
    ("surface/side_rules.cpp", "outward < 0 ?", "outward > 0 ?", "shells turned inside out"),
    ("surface/side_rules.cpp", "if (--left[e] == 1) single.push_back(e);", "", "fins of fins are left"),
    ("surface/nearest_triangle.cpp", "distance[i] < 0 || distance[i] == least", "distance[i] == least", "many candidates whose distance is not certain"),
    ("near_flat.cpp", "if (signs.sign(0) == Sign::positive) return 1U << a | 1U << b;", "return 1U << a | 1U << b;", "a segment beyond its end"),
    ("contested_cells.cpp", "if (index_.original[cells_[i]] < index_.original[cells_[j]]) std::swap(i, j);", "if (i < j) std::swap(i, j);", "lower by place, not by number"),
    ("contested_cells.cpp", "cells_.size() + 7) / 8", "cells_.size()) / 8", "the last group of cells"),
    ("near_bounds.hpp", "if (size_x > 0) error += size_x * size_y * roundings + min;", "", "no bound of the error"),
    ("near_bounds.hpp", "slack += off * (2 * place.reach[k] + off) + min;", "", "the rounding of a projection"),
    ("near_bounds.hpp", "if (!(max <= 0)) guess.gap = std::max(guess.gap, 2 * max);", "", "a guess taken for the nearest"),
    ("nearest.cpp", "(excess >= 0 && number > found_.cell)", "(excess >= 0)", "of cells as near, not the lowest"),
    ("nearest.cpp", "(order == 0 && number > found_.cell)", "order == 0", "of cells as near, not the lowest"),
    ("nearest.cpp", "limited_ ? limit + 0x1p-1074L : 0", "limit", "a limit that is a distance rounded"),
    ("nearest.cpp", "return found.distance <= limit ? found : none;", "return found;", "beyond the limit"),
    ("nearest.cpp", "(below + fan - 1) / fan", "below / fan", "the last box of a level"),
    ("node_cells.hpp", "        std::erase_if(place, [&](Place c) { return std::ranges::binary_search(degenerate, c); });\n", "",
     "degenerate cells at a node"),
    ("occupancy.cpp", "width - 1 - last % width", "width - last % width", "the last bin of a row"),
    ("cells_at_points.cpp", "~std::uint64_t{0} >> (63 - x1 % 64)", "~std::uint64_t{0} >> (64 - x1 % 64)", "the last bin of a row"),
    ("cells_at_points.cpp", "points[i + k] <= box.high[k]", "points[i + k] < box.high[k]", "points on the upper side"),
    ("single.cpp", "static_cast<std::size_t>(last_end.place) < index.cell_count()", "true", "a place of a locator that is gone"),
    ("single.cpp", "last_end.cell == hint && last_end.data == &data", "last_end.cell == hint", "a place of another locator"),
    ("single.cpp", "if (end.inside && !proved->proof.is_contested(end.cell))", "if (end.inside)", "the lowest of cells that overlap"),
    ("sorted_points.cpp", "finite &= find_bins", "finite = find_bins", "the last points alone"),
]
SAMPLE = [
    ("points/chunk_sampler.cpp", "[](double x) { return std::isnan(x); }) ? 1 : 0;", "[](double x) { return std::isnan(x); }) ? 0 : 0;",
     "a value that is not finite, uncounted"),
    ("points/chunk_sampler.cpp", "const bool asked = data.quadratic && !data.at_points.empty();", "const bool asked = false;",
     "gradients at the point, not at its projection"),
    ("points/sampler.cpp", "(data.point_components + 2) / 4", "data.point_components / 4", "the last group of components"),
    ("points/sampler.cpp", "late.component < 0) late.component", "true) late.component", "a component asked for again"),
    ("points/sampler.cpp", "if (one.gradient || known) continue;", "if (known) continue;", "hidden columns for a gradient"),
    ("grid/grid.cpp", "if (low[k] + (steps + 1) * spacing[k] <= high[k]) ++steps;", "", "a quotient rounded down"),
    ("grid/grid.cpp", "while (steps > 0 && low[k] + steps * spacing[k] > high[k]) --steps;", "", "a quotient rounded up"),
    ("grid/grid.cpp", "if (i == counts[axis] - 1 && i != 0) return last[axis];", "", "the last coordinate as a sum"),
    ("grid/slab_cells.hpp", "std::upper_bound(first, layers.end(), high)", "std::lower_bound(first, layers.end(), high)", "a layer on a cell's top"),
    ("grid/slab_cells.hpp", "* scale - slack, to", "* scale, to", "room for rounding"),
    ("points/near_piece.hpp", "std::max_element(of_corner", "std::min_element(of_corner", "a cell's least weight as the rest"),
]
AUDIT = [
    ("asking.hpp", "r == Region::interior || r == Region::boundary", "r == Region::interior", "boundary is inside"),
    ("asking.cpp", "std::max({error, e, smallest})", "std::max(error, e)", "an error that underflows is none"),
    ("asking.cpp", "std::isfinite(difference) ? difference / scale : std::fabs(weights[i] / 2 - to / 2) / (scale / 2)", "difference / scale",
     "a difference that overflows"),
    ("asking.cpp", "if (!std::isfinite(weights[i])) return std::numeric_limits<double>::infinity();", "", "weights that are no numbers"),
    ("asking.cpp", " || wrong_value || r.wrong()", " || r.wrong()", "a certificate for a wrong value"),
    ("asking.cpp", "if (!perfect || kernel.rule != RegionRule::sign) compare_regions", "if (!perfect) compare_regions", "a rule of its own"),
    ("statistics.cpp", "for (std::size_t e = 0; e < 4; ++e)", "for (std::size_t e = 0; e < 3; ++e)", "degenerate cases of other threads"),
    ("statistics.cpp", "(word & fraction) + step - 1) / step", "word & fraction) / step", "steps that are not begun"),
    ("statistics.cpp", "    not_run += other.not_run;\n", "", "not run by another thread"),
    ("statistics.cpp", "total() - unanswered()", "total()", "cases without an answer"),
    ("judge.cpp", "if (!same_answer(answer, other))", "if (answer.region != other.region)", "regions alone"),
    ("judge.cpp", " || (choice_ == OracleChoice::automatic && !answer.narrow)", "", "wide integers asked again"),
    ("thresholds.cpp", " || s.not_run != 0", "", "not run: no error to measure"),
    ("thresholds.cpp", "value > rule.limit", "value >= rule.limit", "at the limit"),
    ("block.cpp", "(bound == worst.value && index > worst.index)", "bound == worst.value", "the first of the worst"),
    ("judge.hpp", "other->index < first->index", "true", "the first disagreement"),
    ("block.cpp", "return y < x ? std::nextafter(y, std::numeric_limits<double>::infinity()) : y;", "return y;", "a bound rounded down"),
    ("pictures.cpp", "p.kernel.empty() && p.simplex", "p.simplex", "a kernel's picture taken for the exact one"),
]


@dataclass
class Room:
    tests: str  # the executable of its tests, test_NAME, in the folder of the same path as the room's
    seconds: int  # more than ever so long its quick tests take
    listed: list
    fuzz: list = field(default_factory=list)  # targets of fuzz_replay
    only: list = field(default_factory=list)  # sources; all of the room's if empty
    last: list = field(default_factory=list)  # tests that take a second or more each
    left_out: list = field(default_factory=list)  # tests of time, and one of six minutes


def folder_of(room):
    """The folder of a room, below src."""
    return room if room in ("core", "audit") else f"mesh/{room}"


ROOMS = {
    "check": Room("check", 30, CHECK, ["meshes"], left_out=["HardMeshes.TimeOfCellsOneInAnother", "Contacts.OfExtremeCoordinates"],
                  last=["Defects.InPairs*", "Theorem.*", "Candidates.*", "Robustness.SameFromAnyThreads"]),
    "locate": Room("locate", 60, LOCATE, ["meshes", "nearest"],
                   last=["LocateSoups.L1L2*", "LocateNearest.N1*", "LocateNearest.O*", "LocateData.*", "LocateRanges.*"]),
    "sample": Room("sample", 100, SAMPLE, ["meshes", "weights", "expressions", "maps"], left_out=["ResampleBounds.NearFacesOfSlivers"],
                   last=["ResampleFuzz.*", "ResampleBounds.AlongFaces", "ResampleValues.A*", "ResampleOrder.*", "ResampleBoxes.PartsAndSlabs",
                         "SampleOrder.*", "ResampleCells.Slivers", "ResampleMeshes.AnyScale"]),
    # Sources that decide whether a kernel is wrong, and by how much.
    "audit": Room("audit", 60, AUDIT, last=["Contained.*", "Gaps.*"],
                  only=["asking.cpp", "block.cpp", "judge.cpp", "pictures.cpp", "statistics.cpp", "thresholds.cpp"]),
}
