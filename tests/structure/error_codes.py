#!/usr/bin/env python3
"""error_codes.py SOURCES: the codes of errors in error_codes.hpp, in doc/errors.md and where errors are made are the
same, each with a meaning and a remedy."""

import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
header = root / "src/core/include/barycert/error_codes.hpp"
listed = re.findall(r'^    "([a-z.-]+)",$', header.read_text(), re.M)
rows = re.findall(r"^\| `([a-z]+\.[a-z-]+)` \| *(.*?) *\| *(.*?) *\|$", (root / "doc/errors.md").read_text(), re.M)
documented = [row[0] for row in rows]

made = set()
for path in sorted((root / "src").rglob("*")):
    if path.suffix in (".cpp", ".hpp", ".py") and path != header:
        made |= set(re.findall(r'"([a-z]+\.[a-z-]+)"', path.read_text()))

faults = []
if len(listed) < 40:
    faults.append("error_codes.hpp: the list is not found")
if listed != documented:
    faults += [f"{code}: not in doc/errors.md" for code in listed if code not in documented]
    faults += [f"{code}: in doc/errors.md, and no code" for code in documented if code not in listed]
    faults.append("doc/errors.md has another order than error_codes.hpp, or a code twice")
faults += [f"{code}: no error has it" for code in listed if code not in made]
faults += [f"{code}: no meaning or no remedy" for code, meaning, remedy in rows if not meaning or not remedy]
for fault in faults:
    print(fault)
sys.exit(1 if faults else 0)
