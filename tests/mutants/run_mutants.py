#!/usr/bin/env python3
"""Mutants of the core: one change each (mutant_list.py), made in a scratch copy, against killer.cpp.

  run_mutants.py [--build DIR] [--jobs 2] [--minutes M] [--only FILE] [--listed] [--root DIR] [--scratch DIR] [--again [REGEX]]
                 [--report]

--build is a build of barycert whose libraries stand for all that is not mutated (src/libbarycert*.a in it); --root a
checkout whose sources are mutated, this one if not given. Listed mutants are all run, generated ones until --minutes
are over; in an order in which those left out lie evenly. --only takes the mutants of one source, --listed those listed;
--again goes on
with the last run, those of its survivors anew that change a text which matches: for a killer that has got stronger; --report renders the results of the last run again. The table goes to stdout and, for a whole run, to RESULTS.md
beside this script. A mutant's status:
  killed     with the check that failed, a crash or a hang
  survived   `tiers` says whether the shares of the tiers changed: then the mutant lives, but no answer got wrong
  same code  the compiler made the same object files of it: it was not run
  does not compile
  stale      the text to be changed is not in the source any more
"""
import argparse, json, re, subprocess, sys, time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from bench import HERE, Bench
from mutant_list import all_mutants
import survivors

ROOT = HERE.parent.parent


def key(m):
    """The same in sources of which comments alone have changed."""
    return m["file"], m["old"], m["new"], m["source"], m["column"], m["repeat"]


def explanation(m):
    changed, table = (m["old"], survivors.LISTED) if m["listed"] else (m["source"], survivors.GENERATED)
    for file, part, new, text in table:
        if m["file"] == file and part in changed and (not new or new == m["new"].strip()):
            return text
    return "unexplained"


def cell(s):
    return s.strip().replace("|", "\\|").replace("\n", " ")


def change(m):
    where = "" if m["listed"] else f" in `{cell(m['source'])}`"
    return f"`{cell(m['old'])}` -> `{cell(m['new'])}`{where}"


def counts(mutants):
    found = Counter(m["status"] for m in mutants)
    return ", ".join(f"{found[s]} {s}" for s in sorted(found))


def again(data):
    return ["", "Put together from runs with a killer that got more cases from one to the next: what an earlier one had killed "
            "was not run again, nor were survivors that the new cases do not aim at."] if data.get("again") else []


def render(data):
    mutants = sorted(data["mutants"], key=lambda m: (not m["listed"], m["file"], m["line"]))
    listed = [m for m in mutants if m["listed"]]
    generated = [m for m in mutants if not m["listed"]]
    out = ["# Mutants of the core", "",
           "Made by `run_mutants.py` (see there what the words mean) from `mutant_list.py`; `killer.cpp` is what they met.",
           "The lanes were compiled for AVX2 with fused multiply-add, and for Dekker's product without; what is compiled "
           "for AVX-512 alone was not mutated.", "",
           f"Sources at {data['revision']}; {data['seconds'] / 60:.0f} minutes.", *again(data), "", "| | run | of | |", "|---|---|---|---|",
           f"| listed | {len(listed)} | {data['listed']} | {counts(listed)} |",
           f"| generated | {len(generated)} | {data['generated']} | {counts(generated)} |",
           f"| all | {len(mutants)} | {data['listed'] + data['generated']} | {counts(mutants)} |", "",
           "## Survivors", "",
           "*Equivalent*: no input can tell. *Slack*: the bound is proven with room, and the runs say down to where. "
           "*Performance only*: which tier answers changes, not what. *Not covered*: no case was found, and nothing is "
           "proven.", "", "| where | change | tiers | why it survives |", "|---|---|---|---|"]
    for m in mutants:
        if m["status"] == "survived":
            out.append(f"| {m['file']}:{m['line']} | {change(m)} | {m['tiers']} | {cell(explanation(m))} |")
    out += ["", "## Others", "", "| where | change | by |", "|---|---|---|"]
    for m in mutants:
        if m["status"] != "survived":
            out.append(f"| {m['file']}:{m['line']} | {change(m)} | {m['detail'] or m['status']} |")
    return "\n".join(out) + "\n"


def run_all(a, saved):
    start = time.time()
    before = json.loads(saved.read_text()) if a.again is not None else None
    old = {key(m): m for m in before["mutants"]} if before else {}
    revision = subprocess.run(["git", "-C", a.root, "rev-parse", "--short", "HEAD"], capture_output=True,
                              text=True).stdout.strip()
    bench = Bench(a.build.resolve(), a.scratch, a.root.resolve())
    bench.prepare(a.jobs)
    mutants, texts = all_mutants(bench.pristine)
    mutants = [m for m in mutants if (not a.only or m.file == a.only) and (m.listed or not a.listed)]
    listed, seconds = sum(m.listed for m in mutants), 0
    for m in mutants:
        was = old.get(key(m.__dict__))
        if was and not (was["status"] == "survived" and re.search(a.again, m.old)):
            m.status, m.detail, m.tiers = was["status"], was["detail"], was["tiers"]
    if before:
        seconds = before["seconds"]
    print(f"{len(mutants)} mutants", file=sys.stderr)

    def save():
        saved.write_text(json.dumps({"again": before is not None, "seconds": seconds + time.time() - start, "whole": not a.only and not a.listed,
                                     "listed": listed, "generated": len(mutants) - listed, "revision": revision,
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
        if number % 8 == 0:
            save()

    with ThreadPoolExecutor(a.jobs) as pool:
        list(pool.map(work, enumerate(mutants)))
    save()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--minutes", type=float, default=1e9)
    parser.add_argument("--only", default="")
    parser.add_argument("--listed", action="store_true")
    parser.add_argument("--scratch", type=Path, default=Path("/tmp/barycert-mutants"))
    parser.add_argument("--root", type=Path, default=ROOT)
    parser.add_argument("--again", nargs="?", const="")
    parser.add_argument("--report", action="store_true")
    a = parser.parse_args()
    saved = a.scratch / "results.json"
    if not a.report:
        run_all(a, saved)
    data = json.loads(saved.read_text())
    text = render(data)
    print(text)
    if data["whole"]:
        (HERE / "RESULTS.md").write_text(text)


if __name__ == "__main__":
    main()
