#!/usr/bin/env python3
"""Mutants: one change of a source each, made in a scratch copy, against tests.

  run_mutants.py [--room core] [--build DIR] [--jobs 2] [--minutes M] [--count N] [--only FILE] [--listed] [--root DIR]
                 [--scratch DIR] [--again [REGEX]] [--quick] [--report]

--room core: the mutants of mutant_list.py against killer.cpp. Other rooms (room_lists.py): those of room_mutants.py against
the tests of the room and targets of the fuzzer, of a build that has them (preset dev; targets test_ROOM and fuzz_replay).

--build is a build of barycert whose libraries stand for all that is not mutated (src/*/libbarycert_*.a in it); --root a
checkout whose sources are mutated, this one if not given. Listed mutants are all run, generated ones until --minutes
are over, in an order in which those left out lie evenly; --count of them, as many of each kind, of other rooms than the
core. --only takes the mutants of one source, --listed those listed; --again goes on with the last run, those of its
survivors anew that change a text which matches: for a killer that has got stronger, or after an interruption (a REGEX
of nothing that is there). --quick: quick tests alone, undecided is what passes them, and --again goes on with it. --report renders the results of the
last run again. The table goes to stdout and, for a whole run of the core, to RESULTS.md beside this script; that of
another room is for its NOTES.md. A mutant's status:
  killed     with the check that failed, a crash or a hang
  survived   `tiers` says whether the shares of the tiers changed: then the mutant lives, but no answer got wrong
  same code  the compiler made the same object files of it: it was not run
  does not compile
  fails unchanged  the unchanged source fails as well: look why
  stale      the text to be changed is not in the source any more
"""
import argparse, json, re, subprocess, sys, threading, time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from bench import HERE, Bench
from report import render, render_room
from room_bench import RoomBench
from room_lists import ROOMS

ROOT = HERE.parent.parent


def key(m):
    """The same in sources of which comments alone have changed."""
    return m["file"], m["old"], m["new"], m["source"], m["column"], m["repeat"]


def run_all(a, saved):
    start = time.time()
    before = json.loads(saved.read_text()) if a.again is not None else None
    old = {key(m): m for m in before["mutants"]} if before else {}
    revision = subprocess.run(["git", "-C", a.root, "rev-parse", "--short", "HEAD"], capture_output=True,
                              text=True).stdout.strip()
    places = a.build.resolve(), saved.parent, a.root.resolve()
    bench = Bench(*places) if a.room == "core" else RoomBench(*places, a.room, a.count, a.quick)
    bench.prepare(a.jobs)
    mutants, possible, texts = bench.mutants()
    mutants = [m for m in mutants if (not a.only or m.file == a.only) and (m.listed or not a.listed)]
    listed, seconds = sum(m.listed for m in mutants), 0
    for m in mutants:
        was = old.get(key(m.__dict__))
        anew = was and (was["status"] == "undecided" or was["status"] == "survived" and re.search(a.again, m.old))
        if was and not anew:
            m.status, m.detail, m.tiers = was["status"], was["detail"], was["tiers"]
    if before:
        seconds = before["seconds"]
    print(f"{len(mutants)} mutants", file=sys.stderr)

    lock = threading.Lock()

    def save():
        saved.write_text(json.dumps({"again": before is not None, "seconds": seconds + time.time() - start, "whole": not a.only and not a.listed,
                                     "listed": listed, "generated": len(mutants) - listed, "revision": revision, "possible": possible,
                                     "mutants": [m.__dict__ for m in mutants if m.status]}))

    def work(task):
        number, m = task
        if m.status:
            return
        if not m.listed and time.time() - start > 60 * a.minutes:
            return
        bench.run(number, m, texts[m.file])
        print(f"{number + 1}/{len(mutants)} {m.file}:{m.line} {m.old.strip()!r} -> {m.new.strip()!r}: {m.status} "
              f"{m.detail}{m.tiers}", file=sys.stderr, flush=True)
        with lock:
            save()

    with ThreadPoolExecutor(a.jobs) as pool:
        list(pool.map(work, enumerate(mutants)))
    save()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--room", choices=["core", *ROOMS], default="core")
    parser.add_argument("--count", type=int, default=80)
    parser.add_argument("--build", type=Path, default=ROOT / "build")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--minutes", type=float, default=1e9)
    parser.add_argument("--only", default="")
    parser.add_argument("--listed", action="store_true")
    parser.add_argument("--scratch", type=Path, default=Path("/tmp/barycert-mutants"))
    parser.add_argument("--root", type=Path, default=ROOT)
    parser.add_argument("--again", nargs="?", const="")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--report", action="store_true")
    a = parser.parse_args()
    saved = a.scratch / a.room / "results.json"
    if not a.report:
        run_all(a, saved)
    data = json.loads(saved.read_text())
    text = render(data) if a.room == "core" else render_room(data)
    print(text)
    if data["whole"] and a.room == "core":
        (HERE / "RESULTS.md").write_text(text)


if __name__ == "__main__":
    main()
