"""Compiles a mutant of a room, puts it before the libraries of a build and runs the room's tests against it.

All sources of the room are compiled anew, each alone, with -O1 (every operation is rounded as written: answers are the
same) and the standard library's own checks, lanes for AVX2; objects of a mutant take the place of those. Sources, the
tests' objects and libraries are copied before, so that work may go on meanwhile.
"""
import json, random, re, shlex, shutil, subprocess, sys
from concurrent.futures import ThreadPoolExecutor

from bench import run
from measured import measured
from room_lists import ROOMS
from room_mutants import room_mutants

FLAGS = "-O1 -w -D_GLIBCXX_ASSERTIONS".split()
LANES = "-march=haswell -maes -DHWY_COMPILE_ONLY_STATIC".split()
LINKER = ["-fuse-ld=lld"] if shutil.which("ld.lld") else []
LAUNCHER = ["ccache"] if shutil.which("ccache") else []
INPUTS, SEED = 300, 1  # random bytes, of which targets of the fuzzer make meshes
QUICK = 0.3  # seconds: tests that take longer come after all that do not
INCLUDED = re.compile(r'^#(?:include|define HWY_TARGET_INCLUDE) "(barycert/[^"]+)"', re.MULTILINE)


class RoomBench:
    def __init__(self, build, scratch, root, name, count):
        self.build, self.scratch, self.root, self.name, self.count = build, scratch, root, name, count
        self.room, self.prefix = ROOMS[name], f"barycert/{name}"
        shutil.rmtree(scratch / "src", ignore_errors=True)
        shutil.rmtree(scratch / "kept", ignore_errors=True)
        for place in scratch.glob("m[0-9]*"):
            shutil.rmtree(place)
        scratch.mkdir(parents=True, exist_ok=True)
        self.src = scratch / "src"
        shutil.copytree(root / "src", self.src)
        self.kept = scratch / "kept"
        self.kept.mkdir()
        self.folder = self.src / self.prefix
        # Where some sources are named they lie in the room itself, and its folders are libraries like others.
        sources = self.folder.glob("*.cpp") if self.room.only else self.folder.rglob("*.cpp")
        self.sources = sorted(str(p.relative_to(self.folder)) for p in sources)
        self.texts = {str(p.relative_to(self.src)): p.read_text() for p in self.src.rglob("*pp")}
        self.command = self.command_of_room()

    def mutants(self):
        files = self.room.only or sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob("*pp"))
        return room_mutants(self.folder, files, self.room.listed, self.count)

    # --- compiling -----------------------------------------------------------------------------------------------

    def command_of_room(self):
        """How the build compiles one of the room's sources, or of those joined with it, without the source."""
        for entry in json.loads((self.build / "compile_commands.json").read_text()):
            text = (self.build / entry["file"]).read_text() if "/Unity/" in entry["file"] else entry["file"]
            if f"{self.root}/src/{self.prefix}/" in text and "barycert" in entry["command"].split(" -o ")[1]:
                words = shlex.split(entry["command"].split(" -o ")[0])
                return [w.replace(str(self.root / "src"), str(self.src)) for w in words if w not in ("-Werror", "-O3")]
        sys.exit(f"nothing of {self.prefix} in {self.build}/compile_commands.json")

    def included(self, file, seen):
        for other in INCLUDED.findall(self.texts.get(file, "")):
            if other not in seen:
                seen.add(other)
                self.included(other, seen)
        return seen

    def compile(self, source, out, place=None):
        """`place` has changed files, in folders as those of src."""
        path = f"{self.prefix}/{source}"
        changed = place is not None and (place / path).exists()
        lanes = LANES if "HWY_TARGET_INCLUDE" in self.texts[path] else []
        before = ["-I", place] if place else []
        return run(*LAUNCHER, *self.command[:1], *before, *self.command[1:], *FLAGS, *lanes, "-c", (place if changed else self.src) / path, "-o", out)

    def object(self, source):
        return self.kept / (source.replace("/", "+") + ".o")

    # --- linking -------------------------------------------------------------------------------------------------

    def keep(self, program):
        """Copies what the build links a program of; the words of that command."""
        asked = run("ninja", "-C", self.build, "-t", "commands", program).stdout.strip().splitlines()[-1]
        words, kept = [], []
        parts = shlex.split(asked)
        parts = parts[parts.index("&&") + 1:]
        parts = parts[:parts.index("&&")]
        skip = False
        for word in parts[1:]:
            if skip or word == "-o":
                skip = not skip
                continue
            here = self.build / word
            if not word.startswith(("/", "-")) and here.is_file():
                there = self.kept / word.replace("/", "+")
                if not there.exists():
                    shutil.copy(here, there)
                word = there
            kept.append(word)
        return kept

    def link(self, words, objects, out):
        return run("g++", *LINKER, *objects, *words, "-o", out)

    # --- running -------------------------------------------------------------------------------------------------

    def test(self, program, tests, out, *more):
        left_out = f":-{self.room.left_out}" if tests == "*" and self.room.left_out else ""
        return measured([program, f"--gtest_filter={tests}{left_out}", "--gtest_fail_fast", *more], self.limits.get(tests, 3000), out)

    def replay(self, program, target, out):
        return measured([program, target, self.scratch / "inputs", self.root / "tests/fuzz/corpus" / target,
                         self.root / "tests/fuzz/found" / target], self.limits.get(target, 600), out)

    def blame(self, status, words):
        """What to tell of a run that failed."""
        failed = re.search(r"\[  FAILED  \] ([\w./]+)", words)
        if failed and status is not None:
            return failed.group(1)
        begun = re.findall(r"\[ RUN      \] ([\w./]+)", words)
        return ("too long" if status is None else f"ends with {status}") + (f" in {begun[-1]}" if begun else "")

    def verdict(self, place, objects):
        """Status and detail: the first test that fails."""
        out = place / "words"
        for number, (words, phases) in enumerate(self.programs):
            program = place / f"program{number}"
            if self.link(words, objects, program).returncode != 0:
                return "does not compile", ""
            for runner, what in phases:
                status, _ = runner(program, what, out)
                if status != 0:
                    told = out.read_text(errors="replace")
                    name = self.blame(status, told) if runner == self.test else f"fuzz {what}: {told.strip().splitlines()[-1][:80] if told.strip() else status}"
                    return "killed", name
            program.unlink()
        return "survived", ""

    def prepare(self, jobs):
        """The room itself: compiled, linked, and the time that its tests take."""
        self.limits, self.programs = {}, []
        inputs = self.scratch / "inputs"
        shutil.rmtree(inputs, ignore_errors=True)
        inputs.mkdir()
        draw = random.Random(SEED)
        for i in range(INPUTS):
            (inputs / f"{i:04}").write_bytes(draw.randbytes(draw.randrange(8, 240)))
        with ThreadPoolExecutor(jobs) as pool:
            for done in pool.map(lambda s: self.compile(s, self.object(s)), self.sources):
                if done.returncode != 0:
                    sys.exit(done.stderr[:4000])
        objects = [self.object(s) for s in self.sources]
        tests = f"tests/{self.room.tests}/test_{self.room.tests}"
        self.programs.append((self.keep(tests), self.phases(self.keep(tests), objects)))
        if self.room.fuzz:
            words, phases = self.keep("tests/fuzz/fuzz_replay"), []
            program = self.scratch / "itself"
            self.must(self.link(words, objects, program))
            for target in self.room.fuzz:
                status, seconds = self.replay(program, target, self.scratch / "words")
                if status != 0:
                    sys.exit(f"the room itself fails: fuzz {target}: {(self.scratch / 'words').read_text()[-400:]}")
                self.limits[target] = 10 + 5 * seconds
                phases.append((self.replay, target))
                print(f"fuzz {target}: {seconds:.1f} s", file=sys.stderr)
            self.programs.append((words, phases))

    def must(self, done):
        if done.returncode != 0:
            sys.exit(done.stderr[:4000])

    def phases(self, words, objects):
        """Quick tests, then the others."""
        program, told = self.scratch / "itself", self.scratch / "times.json"
        self.must(self.link(words, objects, program))
        told.unlink(missing_ok=True)
        status, seconds = self.test(program, "*", self.scratch / "words", f"--gtest_output=json:{told}")
        if status != 0:
            sys.exit(f"the room itself fails: {self.blame(status, (self.scratch / 'words').read_text())}")
        times = {f"{suite['name']}.{test['name']}": float(test["time"][:-1])
                 for suite in json.loads(told.read_text())["testsuites"] for test in suite["testsuite"]}
        share = seconds / max(sum(times.values()), 1e-3)  # of the processor, on a machine that others use
        quick = [t for t, s in times.items() if s * share <= QUICK]
        phases = [":".join(quick), ":".join(t for t in times if t not in quick)]
        for tests in phases:
            self.limits[tests] = 10 + 4 * share * sum(times[t] for t in tests.split(":") if t)
        print(f"{len(times)} tests, {seconds:.0f} s, {len(quick)} of them quick", file=sys.stderr)
        return [(self.test, tests) for tests in phases if tests]

    # --- a mutant ------------------------------------------------------------------------------------------------

    def run(self, number, m, text):
        """Sets the mutant's status and detail."""
        if m.position < 0:
            m.status = "stale"
            return
        place = self.scratch / f"m{number}"
        file = place / self.prefix / m.file
        file.parent.mkdir(parents=True)
        file.write_text(text[:m.position] + m.new + text[m.position + len(m.old):])
        m.status, m.detail = self.judge(m, place)
        shutil.rmtree(place)

    def judge(self, m, place):
        objects, same = [], True
        for source in self.sources:
            concerned = source == m.file or f"{self.prefix}/{m.file}" in self.included(f"{self.prefix}/{source}", set())
            objects.append(place / source.replace("/", "+") if concerned else self.object(source))
            if not concerned:
                continue
            if self.compile(source, objects[-1], place).returncode != 0:
                return "does not compile", ""
            same = same and objects[-1].read_bytes() == self.object(source).read_bytes()
        return ("same code", "") if same else self.verdict(place, objects)
