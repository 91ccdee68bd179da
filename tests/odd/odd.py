#!/usr/bin/env python3
"""Small inputs on which something was wrong, refused or unclear: odd.py --barycert PROGRAM --data FOLDER [--files FOLDER] [NAME...]

Runs the cases of cases/NAME.txt, each in a folder of its own in which the folders of data/odd are found by their names.
`files` there are real files of other projects, which are not part of this one: cases that name them are skipped where
they are absent, and so are cases whose files barycert reads by way of meshio where that is not installed.

A case is a paragraph:

    == what is right, in words
    barycert check prisms/wedge.vtk --json r.json     a command for sh; several lines are several commands
    exit 0                                             of the last command; 0 where it is not said
    has 2 positive                                     stands in a line of stdout or stderr; blanks count once
    not negative                                       stands in none
    json r.json /certified true                        the member at the JSON pointer is this JSON value
    row 3 cell=3 feature=vertex u=109                  row 3 (from 0) of the CSV on stdout has these entries

Lines that begin with # are comments. Exits with 77 if every case was skipped.
"""

import argparse
import csv
import io
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
EXPECTATIONS = ("exit", "has", "not", "json", "row")


class Case:
    def __init__(self, title, place):
        self.title = title
        self.place = place
        self.commands = []
        self.expectations = []


def read_cases(path):
    cases = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        line = line.strip()
        if not line or line.startswith("#"):
            continue
        if line.startswith("== "):
            cases.append(Case(line[3:], f"{path.name}:{number}"))
            continue
        if not cases:
            sys.exit(f"{path}:{number}: a case begins with '== '")
        word, _, rest = line.partition(" ")
        if word in EXPECTATIONS:
            cases[-1].expectations.append((word, rest.strip(), number))
        else:
            cases[-1].commands.append(line)
    for case in cases:
        if not case.commands or not any(word != "exit" for word, _, _ in case.expectations):
            sys.exit(f"{case.place}: a case has a command and says what it prints")
    return cases


def at_pointer(value, pointer):
    for key in pointer.split("/")[1:]:
        value = value[int(key)] if isinstance(value, list) else value[key]
    return value


def squeezed(text):
    return re.sub(r"\s+", " ", text).strip()


def same_entry(found, expected):
    """Numbers by their value, so that 100 is 100.0; all else by its letters."""
    try:
        a, b = float(found), float(expected)
    except ValueError:
        return found == expected
    return a == b or (math.isnan(a) and math.isnan(b))


def complaints(case, folder, environment):
    """What is not as expected; an empty list if all is; None if meshio is needed, and is not there."""
    done = None
    for command in case.commands:
        done = subprocess.run(["sh", "-c", command], cwd=folder, env=environment, capture_output=True, text=True,
                              errors="replace", timeout=120)
    if "read by way of meshio, which is not installed" in done.stderr:
        return None
    text = squeezed(done.stdout) + "\n" + squeezed(done.stderr)
    lines = [squeezed(line) for line in (done.stdout + "\n" + done.stderr).splitlines()]
    wrong = []
    wanted = next((rest for word, rest, _ in case.expectations if word == "exit"), "0")
    if done.returncode != int(wanted):
        wrong.append(f"exit {wanted} expected, not {done.returncode}")
    for word, rest, number in case.expectations:
        if word == "has" and squeezed(rest) not in text:
            wrong.append(f"line {number}: nowhere stands: {rest}")
        elif word == "not" and any(squeezed(rest) in line for line in lines):
            wrong.append(f"line {number}: it must not stand there: {rest}")
        elif word == "json":
            name, pointer, expected = rest.split(" ", 2)
            try:
                found = at_pointer(json.loads((folder / name).read_text()), pointer)
            except (OSError, ValueError, KeyError, IndexError, TypeError) as error:
                wrong.append(f"line {number}: {name} has no {pointer} ({error!r})")
                continue
            if found != json.loads(expected):
                wrong.append(f"line {number}: {pointer} is {json.dumps(found)}, not {expected}")
        elif word == "row":
            row, *entries = rest.split()
            rows = list(csv.DictReader(io.StringIO(done.stdout)))
            if int(row) >= len(rows):
                wrong.append(f"line {number}: there is no row {row}")
                continue
            for entry in entries:
                name, _, expected = entry.partition("=")
                found = rows[int(row)].get(name)
                if found is None or not same_entry(found, expected):
                    wrong.append(f"line {number}: {name} is {found}, not {expected}")
    if wrong:
        wrong += ["it printed:", *(f"  {line}" for line in (done.stdout + done.stderr).splitlines()[:40])]
    return wrong


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--barycert", required=True, type=pathlib.Path)
    arguments.add_argument("--data", required=True, type=pathlib.Path)
    arguments.add_argument("--files", type=pathlib.Path)
    arguments.add_argument("names", nargs="*")
    given = arguments.parse_args()
    programs = given.barycert.resolve().parent
    environment = {**os.environ, "NO_COLOR": "1", "PATH": f"{programs}:{os.environ['PATH']}"}
    has_files = given.files is not None and given.files.is_dir()
    counts = {"passed": 0, "failed": 0, "skipped": 0}
    for path in sorted((HERE / "cases").glob("*.txt")):
        if given.names and path.stem not in given.names:
            continue
        for case in read_cases(path):
            if not has_files and any("files/" in command for command in case.commands):
                counts["skipped"] += 1
                continue
            with tempfile.TemporaryDirectory() as name:
                folder = pathlib.Path(name)
                for there in given.data.resolve().iterdir():
                    if there.is_dir():
                        (folder / there.name).symlink_to(there)
                if has_files:
                    (folder / "files").symlink_to(given.files.resolve())
                wrong = complaints(case, folder, environment)
            counts["skipped" if wrong is None else "failed" if wrong else "passed"] += 1
            if wrong:
                print(f"{case.place}: {case.title}")
                print("\n".join(f"  {line}" for line in [*case.commands, *wrong]))
    print(", ".join(f"{count} {what}" for what, count in counts.items()))
    if counts["failed"]:
        return 1
    return 0 if counts["passed"] else 77


if __name__ == "__main__":
    sys.exit(main())
