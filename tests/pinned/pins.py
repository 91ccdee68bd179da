#!/usr/bin/env python3
"""The files that the program writes, held to the byte: pins.py --barycert PROGRAM --data FOLDER [--keep FOLDER] [--write] [NAME...]

Runs the commands of commands.txt, each in a folder of its own, and compares every file that it writes, and its exit
status, with the hashes in pins.txt. What it prints is text for people: tests/app/cli and tests/documents hold that. Left
out of the hashes: times, and what says where a run took place. --write renews pins.txt; --keep keeps what was written
and printed, so that two states can be compared by diff.
"""

import argparse
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent

# Members of JSON that differ from run to run or from machine to machine.
VARYING = {"seconds", "ns", "environment", "threads", "dispatch_ns"}


def without_varying(value):
    if isinstance(value, dict):
        return {key: without_varying(v) for key, v in value.items() if key not in VARYING}
    if isinstance(value, list):
        return [without_varying(v) for v in value]
    return value


def held(path):
    """The bytes that are held to."""
    data = path.read_bytes()
    if path.suffix == ".json":
        return json.dumps(without_varying(json.loads(data)), indent=1).encode()
    if path.suffix == ".html":  # the words of the pages are tested elsewhere
        return b""
    if path.suffix == ".xml":
        return re.sub(rb' time="[^"]*"', b"", data)
    return data


def run(name, command, barycert, data, folder):
    """The hashes of what the command writes, by file."""
    where = folder / name
    where.mkdir()
    (where / "data").symlink_to(data)
    (where / "points.csv").write_text(POINTS)
    before = {p.name for p in where.iterdir()}
    environment = {**os.environ, "NO_COLOR": "1", "PATH": f"{barycert.parent}:{os.environ['PATH']}"}
    done = subprocess.run(["sh", "-ec", command], cwd=where, env=environment, capture_output=True)
    hashes = {"exit": str(done.returncode)}
    for path in sorted(where.rglob("*")):
        if path.is_file() and not path.is_symlink() and path.name not in before:
            hashes[str(path.relative_to(where))] = hashlib.sha256(held(path)).hexdigest()[:20]
    (where / "stdout").write_bytes(done.stdout)
    (where / "stderr").write_bytes(done.stderr)
    return hashes


def numbers(seed):
    """Numbers in [0, 1), the same everywhere."""
    state = seed
    while True:
        state = (state * 6364136223846793005 + 1442695040888963407) % 2**64
        yield (state >> 11) / 2**53


def some_points():
    """In the box of the meshes and around it, on its sides, and on lattices, where faces and edges are."""
    draw = numbers(1)
    rows = ["x,y,z"]
    for _ in range(300):
        rows.append(",".join(repr(1.2 * next(draw) - 0.1) for _ in "xyz"))
    for _ in range(200):
        rows.append(",".join(repr(int(9 * next(draw)) / 8) for _ in "xyz"))
    return "\n".join(rows) + "\n"


POINTS = some_points()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--barycert", type=pathlib.Path, required=True)
    parser.add_argument("--data", type=pathlib.Path, required=True)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("names", nargs="*")
    a = parser.parse_args()
    pins_file = HERE / "pins.txt"
    pins = {}
    if pins_file.exists():
        for line in pins_file.read_text().splitlines():
            name, file, pin = line.split()
            pins.setdefault(name, {})[file] = pin
    commands = {}
    for line in (HERE / "commands.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            name, command = line.split(": ", 1)
            commands[name] = command
    chosen = a.names or list(commands)
    failures = 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(a.keep or scratch).resolve()
        folder.mkdir(exist_ok=True)
        for name in chosen:
            got = run(name, commands[name], a.barycert.resolve(), a.data.resolve(), folder)
            if a.write:
                pins[name] = got
            elif got != pins.get(name, {}):
                failures += 1
                wanted = pins.get(name, {})
                for file in sorted(set(got) | set(wanted)):
                    if got.get(file) != wanted.get(file):
                        print(f"{name}: {file}: {got.get(file, 'missing')}, pinned {wanted.get(file, 'not at all')}")
                print(f"  by: {commands[name]}")
    if a.write:
        pins = {name: pins[name] for name in commands if name in pins}
        pins_file.write_text(
            "".join(f"{name} {file} {pin}\n" for name, files in pins.items() for file, pin in files.items())
        )
    print(f"{len(chosen) - failures} of {len(chosen)} commands wrote what is pinned")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
