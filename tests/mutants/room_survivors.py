"""Why mutants of rooms survive: room, file, part of what is changed, replacement or "", explanation."""
ROOM_SURVIVORS = [
    ("check", "conformity.cpp", "!misses_vertex(region)", "", "A test is missing: a vertex on a polygon's side that is no node, with equal areas."),
    ("check", "plc_facet.cpp", "if (deepest != nullptr) return", "", "A test is missing: a ring with a vertex of its own in the triangle at its "
     "lowest corner."),
]
