"""Compiles a mutant of a room, puts it before the libraries of a build and runs the room's tests against it.

What is compiled anew is compiled alone, with -O1 (every operation is rounded as written: answers are the same) and the
standard library's own checks, lanes for AVX2. The linker takes the first definition of what the libraries define again:
these are compiled with -fPIC, so that nothing of other sources is part of a function of theirs. A test that fails must
pass with the unchanged source compiled alike, or it says nothing. Sources, the tests' objects and libraries are copied
before, so that work may go on meanwhile.
"""
import json, random, re, shlex, shutil, sys, threading

from bench import run
from measured import measured
from room_lists import ROOMS, folder_of
from room_mutants import room_mutants

FLAGS = "-O1 -w -D_GLIBCXX_ASSERTIONS".split()
LANES = "-march=haswell -maes -DHWY_COMPILE_ONLY_STATIC".split()
LINKER = [*(["-fuse-ld=lld"] if shutil.which("ld.lld") else []), "-Wl,-z,muldefs"]
LAUNCHER = ["ccache"] if shutil.which("ccache") else []
INPUTS, SEED = 300, 1  # random bytes, of which targets of the fuzzer make meshes
INCLUDED = re.compile(r'^#(?:include|define HWY_TARGET_INCLUDE) "([a-z]+/[^"]+)"', re.MULTILINE)


def object_name(source):
    return source.replace("/", "+") + ".o"


class RoomBench:
    def __init__(self, build, scratch, root, name, count, quick):
        self.build, self.scratch, self.root, self.name, self.count, self.quick = build, scratch, root, name, count, quick
        self.room, self.prefix = ROOMS[name], folder_of(name)
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
        self.sources = sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob("*.cpp"))
        self.lock, self.passed = threading.RLock(), {}
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

    def unchanged(self, source):
        """The object of the source as it is."""
        out = self.kept / object_name(source)
        with self.lock:
            if not out.exists():
                self.must(self.compile(source, out))
        return out

    def must(self, done):
        if done.returncode != 0:
            sys.exit(done.stderr[:4000])

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

    # --- running -------------------------------------------------------------------------------------------------

    def phases(self):
        """(program, what to run of it, seconds): quick tests, the fuzzer's targets, tests that take long."""
        room = self.room
        others = ":".join([*room.last, *room.left_out])
        yield "tests", f"*:-{others}" if others else "*", room.seconds
        for target in room.fuzz:
            yield "replay", target, 60
        if room.last and not self.quick:
            yield "tests", ":".join(room.last), 4 * room.seconds

    def start(self, program, kind, what, seconds, out):
        if kind == "tests":
            return measured([program, f"--gtest_filter={what}", "--gtest_fail_fast"], seconds, out)
        places = [self.scratch / "inputs", *(self.root / "tests/fuzz" / part / what for part in ("corpus", "found"))]
        return measured([program, what, *places], seconds, out)

    def failing(self, status, kind, what, words):
        """What failed, and which single test to ask again."""
        if kind == "replay":
            told = words.strip().splitlines() or [""]
            return f"fuzz {what}: " + ("too long" if status is None else told[-1][:80]), what
        failed = re.search(r"\[  FAILED  \] ([\w./]+)", words)
        begun = re.findall(r"\[ RUN      \] ([\w./]+)", words)
        if failed and status is not None:
            return failed.group(1), failed.group(1)
        return ("too long" if status is None else f"ends with {status}") + f" in {begun[-1] if begun else '?'}", begun[-1] if begun else "*"

    def program(self, kind, objects, place):
        out = place / kind
        if not out.exists():
            self.must(run("g++", *LINKER, *objects, *self.words[kind], "-o", out))
        return out

    def passes_unchanged(self, sources, kind, what, seconds):
        """Whether the room itself, compiled as mutants are, passes."""
        key = tuple(sources), kind, what
        with self.lock:
            if key not in self.passed:
                place = self.scratch / "m-unchanged"
                shutil.rmtree(place, ignore_errors=True)
                place.mkdir()
                program = self.program(kind, [self.unchanged(s) for s in sources], place)
                self.passed[key] = self.start(program, kind, what, seconds, place / "words") == 0
        return self.passed[key]

    def prepare(self, _):
        inputs = self.scratch / "inputs"
        shutil.rmtree(inputs, ignore_errors=True)
        inputs.mkdir()
        draw = random.Random(SEED)
        for i in range(INPUTS):
            (inputs / f"{i:04}").write_bytes(draw.randbytes(draw.randrange(8, 240)))
        self.words = {"tests": self.keep(f"tests/{self.prefix}/test_{self.room.tests}")}
        if self.room.fuzz:
            self.words["replay"] = self.keep("tests/fuzz/fuzz_replay")

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
        sources = [s for s in self.sources if s == m.file or f"{self.prefix}/{m.file}" in self.included(f"{self.prefix}/{s}", set())]
        objects = [place / object_name(s) for s in sources]
        for source, out in zip(sources, objects):
            if self.compile(source, out, place).returncode != 0:
                return "does not compile", ""
        if all(out.read_bytes() == self.unchanged(source).read_bytes() for source, out in zip(sources, objects)):
            return "same code", ""
        for kind, what, seconds in self.phases():
            status = self.start(self.program(kind, objects, place), kind, what, seconds, place / "words")
            if status != 0:
                told, again = self.failing(status, kind, what, (place / "words").read_text(errors="replace"))
                return "killed" if self.passes_unchanged(sources, kind, again, seconds) else "fails unchanged", told
        return ("undecided", "passes quick tests") if self.quick and self.room.last else ("survived", "")
