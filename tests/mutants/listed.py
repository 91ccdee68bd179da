#!/usr/bin/env python3
"""Every listed mutant changes a text that its source still has: listed.py SRC."""
import sys
from pathlib import Path

from mutant_list import EXPLICIT
from room_lists import ROOMS, folder_of

sources = Path(sys.argv[1])
listed = [("core", file, text, nth) for file, text, nth, *_ in EXPLICIT]
listed += [(name, file, text, 0) for name, room in ROOMS.items() for file, text, *_ in room.listed]
stale = 0
for room, file, text, nth in listed:
    path = sources / folder_of(room) / file
    if not path.exists() or path.read_text().count(text) <= nth:
        print(f"{room}/{file} no longer has {text!r}")
        stale += 1
print(f"{len(listed)} listed mutants, {stale} of them stale")
sys.exit(stale != 0)
