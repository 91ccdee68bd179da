"""The rooms whose mutants meet the tests of the project: what is changed there, and what runs against it."""
from dataclasses import dataclass, field


@dataclass
class Room:
    tests: str  # the folder and the executable of its tests
    fuzz: list = field(default_factory=list)  # targets of fuzz_replay
    only: list = field(default_factory=list)  # sources; all of the room's if empty
    left_out: str = ""  # tests that take too long for what they see
    listed: list = field(default_factory=list)  # (file, exact text, replacement, why)


ROOMS = {
    "check": Room("check", ["meshes"]),
    "locate": Room("locate", ["meshes", "nearest"]),
    "sample": Room("sample", ["meshes", "weights", "expressions", "maps"], left_out="ResampleBounds.NearFacesOfSlivers"),
    # What decides whether a kernel is wrong, and by how much.
    "audit": Room("audit", only=["asking.cpp", "block.cpp", "comparison.cpp", "drift.cpp", "error_sizes.cpp", "judge.cpp",
                                 "prediction.cpp", "signs.cpp", "statistics.cpp", "thresholds.cpp"]),
}
