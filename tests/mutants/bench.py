"""Compiles a mutant, links it to the killer and runs that; what a mutant leaves alone is compiled once."""
import shutil, subprocess, sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from mutant_list import all_mutants

HERE = Path(__file__).resolve().parent
FLAGS = "-std=c++20 -O1 -ffp-contract=off -DHWY_SHARED_DEFINE -w".split()
KILLER_FLAGS = "-std=c++20 -O1 -frounding-math -ffp-contract=off -w".split()
# Targets of the lanes: one with fused multiply-add, one without.
TARGETS = {"fma": "-march=haswell -maes -DHWY_COMPILE_ONLY_STATIC".split(), "split": ["-DHWY_COMPILE_ONLY_EMU128"]}
TARGET_CHECK = {"fma": "HWY_NATIVE_FMA == 1 && HWY_TARGET == HWY_AVX2", "split": "HWY_NATIVE_FMA == 0"}
PREPARE_LIBRARIES = "-lhwy -ltbb -lfmt -lmpfr -lgmpxx -lgmp -ldl -pthread".split()

SOURCES = ["quotient.cpp", "exact_weights.cpp", "lanes.cpp", "predicates.cpp", "weight_signs.cpp", "weights.cpp",
           "inverse.cpp"]
# Which sources to compile anew. The integers' inline functions are called from these two alone.
INTEGERS = ["exact_weights.cpp", "quotient.cpp"]
USERS = {
    "integer.hpp": INTEGERS, "scaled_double.hpp": INTEGERS,
    "numerators-inl.hpp": ["exact_weights.cpp", "lanes.cpp", "predicates.cpp"],
    "filter-inl.hpp": ["lanes.cpp"], "refinement-inl.hpp": ["lanes.cpp"],
    "error_free-inl.hpp": ["lanes.cpp"], "lane_loop-inl.hpp": ["lanes.cpp"],
    "blocks.hpp": ["weight_signs.cpp", "weights.cpp"],
}
# Compiled ahead, once for each target: half the time of a mutant is theirs otherwise. The lanes include Highway in a
# way of their own, so that only what it includes itself can be had before.
HEADERS = ["immintrin.h", "algorithm", "array", "cmath", "cstring", "limits", "string", "tuple", "vector", "hwy/base.h"]


def run(*command, **more):
    """Detached (setsid), so that a scheduler that shares out time by terminals gives all jobs theirs."""
    more["start_new_session"] = True
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, **more)


class Bench:
    def __init__(self, build, scratch, root):
        self.build, self.scratch, self.root = build, scratch, root
        for place in scratch.glob("*"):
            if place.is_dir():
                shutil.rmtree(place)
        scratch.mkdir(parents=True, exist_ok=True)
        self.pristine = scratch / "pristine" / "core"
        shutil.copytree(root / "src/core", self.pristine)
        self.cases = scratch / "cases.bin"
        places = [root, root / "src", *sorted((root / "src").glob("*/include"))]
        self.includes = [word for place in places for word in ("-I", place)]

    def mutants(self):
        mutants, texts = all_mutants(self.pristine)
        return mutants, len(mutants), texts

    def ahead(self, target):
        place = self.scratch / f"ahead.{target}"
        place.mkdir()
        # The list of targets goes before any header of Highway's.
        text = '#pragma once\n#include "core/simd_targets.hpp"\n' + "".join(f"#include <{h}>\n" for h in HEADERS)
        (place / "ahead.hpp").write_text(text)
        if target in TARGETS:
            (place / "target.cpp").write_text(f"#include <hwy/highway.h>\nstatic_assert({TARGET_CHECK[target]});\n")
            known = run("g++", *FLAGS, *TARGETS[target], "-fsyntax-only", place / "target.cpp")
            if known.returncode != 0:
                return known
        else:
            (place / "ahead.hpp").write_text(text + "#include <hwy/highway.h>\n")
        return run("g++", *FLAGS, *TARGETS.get(target, []), *self.includes, "-x", "c++-header", place / "ahead.hpp", "-o",
                   place / "ahead.hpp.gch")

    def compile(self, include, source, target, out):
        target = target if source == "lanes.cpp" else "plain"
        return run("g++", *FLAGS, *TARGETS.get(target, []), "-include", self.scratch / f"ahead.{target}/ahead.hpp",
                   "-I", include, *self.includes, "-c", include / "core" / source, "-o", out)

    def link(self, objects, out):
        return run("g++", self.scratch / "killer.o", *objects, self.build / "src/core/libbarycert_core.a", "-lhwy", "-pthread",
                   "-o", out)

    def check(self, program):
        """Status and detail: the failed check, or the hash of the tiers' counts."""
        try:
            done = run(program, self.cases, timeout=40)
        except subprocess.TimeoutExpired:
            return "killed", "hang"
        line = (done.stdout.strip().splitlines() or [""])[-1]
        if done.returncode == 0 and line.startswith("SURVIVED"):
            return "survived", line.split()[1]
        return "killed", line[7:] if line.startswith("KILLED") else f"crash ({done.returncode})"

    def prepare(self, jobs):
        """Everything that is not mutated, the cases, and the unmutated core against the killer on both targets."""
        def all_good(function, arguments):
            with ThreadPoolExecutor(jobs) as pool:
                for done in pool.map(lambda a: function(*a), arguments):
                    if done.returncode != 0:
                        sys.exit(done.stderr[:4000])

        def own(name):
            return run("g++", *KILLER_FLAGS, *self.includes, "-c", HERE / f"{name}.cpp", "-o",
                       self.scratch / f"{name}.o")

        root = self.scratch / "pristine"
        own_sources = ["prepare", "climbed", "near_ties"]
        all_good(self.ahead, [("plain",), *((t,) for t in TARGETS)])
        all_good(own, [(s,) for s in [*own_sources, "killer"]])
        all_good(lambda s, t: self.compile(root, s, t, self.object(s, t)),
                 [(s, "fma") for s in SOURCES] + [("lanes.cpp", "split")])
        libraries = [*(self.build / f"src/{name}/libbarycert_{name}.a" for name in ("audit", "mesh", "files", "core")), *PREPARE_LIBRARIES]
        made = run("g++", *(self.scratch / f"{s}.o" for s in own_sources), *libraries, "-o", self.scratch / "prepare")
        if made.returncode == 0:
            made = run(self.scratch / "prepare", self.cases, self.root / "data")
        if made.returncode != 0:
            sys.exit(made.stderr)
        print(made.stdout, file=sys.stderr)
        self.hash = {}
        for target in TARGETS:
            program = self.scratch / f"baseline.{target}"
            linked = self.link([self.object(s, target) for s in SOURCES], program)
            if linked.returncode != 0:
                sys.exit(linked.stderr)
            status, self.hash[target] = self.check(program)
            if status != "survived":
                sys.exit(f"the core itself fails ({target}): {self.hash[target]}")
            print(f"the core itself passes ({target})", file=sys.stderr)

    def object(self, source, target):
        return self.scratch / f"{source}.{target if source == 'lanes.cpp' else 'fma'}.o"

    def run(self, number, m, text):
        """Sets the mutant's status, detail and tiers."""
        if m.position < 0:
            m.status = "stale"
            return
        place = self.scratch / f"m{number}"
        core = place / "core"
        core.mkdir(parents=True)
        anew = USERS.get(m.file, [m.file])
        for f in self.pristine.iterdir():
            if f.name in anew:
                shutil.copy(f, core / f.name)  # headers are found beside the including file first
            elif f.name != m.file:
                (core / f.name).symlink_to(f)
        (core / m.file).write_text(text[:m.position] + m.new + text[m.position + len(m.old):])
        self.judge(m, place, anew)
        shutil.rmtree(place)

    def judge(self, m, place, anew):
        objects, same = [], True
        for source in SOURCES:
            before = self.object(source, m.target)
            objects.append(place / f"{source}.o" if source in anew else before)
            if source not in anew:
                continue
            if self.compile(place, source, m.target, objects[-1]).returncode != 0:
                m.status = "does not compile"
                return
            same = same and objects[-1].read_bytes() == before.read_bytes()
        if same:
            m.status = "same code"
            return
        program = place / "killer"
        if self.link(objects, program).returncode != 0:
            m.status = "does not compile"
            return
        m.status, m.detail = self.check(program)
        if m.status == "survived":
            m.tiers = "as before" if m.detail == self.hash[m.target] else "changed"
            m.detail = ""
