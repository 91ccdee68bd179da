"""Runs the programs of this folder and prints one table: ./run findings [NAME...] [--json FILE] [--list]

Exits with 1 if a finding is not reproduced with the version for which doc/findings.md says so, or a program fails. What
is not installed is told and passed over; with another version a finding may well be gone, which is no failure.
"""

import argparse
import json
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
NOT_THERE = 77

parser = argparse.ArgumentParser(prog="./run findings", description="Reproduces the findings of doc/findings.md.")
parser.add_argument("names", nargs="*", metavar="NAME", help="findings to run; without: all")
parser.add_argument("--json", metavar="FILE", help="also write all counts; - is the standard output, without the table")
parser.add_argument("--list", action="store_true", help="print the names of the findings")
parser.add_argument("--programs", default="", metavar="FOLDER", help="where those in C++ were built")
parser.add_argument("--barycert", default="barycert", metavar="FILE", help="the judge")
given = parser.parse_args()

shared = {"finding.py", "vtk_data.py", "run.py"}
scripts = sorted(f for f in os.listdir(HERE) if f.endswith(".py") and f not in shared)
commands = {f[:-3].replace("_", "-"): [sys.executable, os.path.join(HERE, f)] for f in scripts}
for source in sorted(f for f in os.listdir(HERE) if f.endswith(".cpp")):
    name = source[:-4].replace("_", "-")
    commands[name] = [os.path.join(given.programs, "finding_" + source[:-4])]
if given.list:
    print(*commands, sep="\n")
    sys.exit()
for name in given.names:
    if name not in commands:
        parser.error(f"no finding {name}; there are {', '.join(commands)}")

environment = dict(os.environ, BARYCERT_PROGRAM=given.barycert, PYTHONDONTWRITEBYTECODE="1")
reports, failed = [], 0
for name in given.names or commands:
    print("run: " + name, file=sys.stderr, flush=True)
    try:
        ended = subprocess.run(commands[name], capture_output=True, text=True, env=environment, timeout=1200)
    except (OSError, subprocess.TimeoutExpired) as error:
        ended = subprocess.CompletedProcess(commands[name], 1, "", str(error))
    if ended.returncode == 0:
        report = json.loads(ended.stdout.splitlines()[-1])
        known = report["system"] == report["documented"]
        report["state"] = "yes" if report["reproduced"] else "NO" if known else "no (another version)"
        failed += known and not report["reproduced"]
    else:
        missing = "ModuleNotFoundError" in ended.stderr or ended.returncode == NOT_THERE
        last = (ended.stderr.strip().splitlines() or ["no message"])[-1]
        report = {"finding": name, "system": "", "state": "not installed" if missing else "FAILED", "summary": last}
        failed += not missing
    reports.append(report)

if given.json:
    text = json.dumps({"schema": 1, "findings": reports}, indent=2) + "\n"
    if given.json == "-":
        sys.stdout.write(text)
    else:
        with open(given.json, "w") as file:
            file.write(text)
if given.json != "-":
    print("| finding | version | reproduced | counts |\n|---|---|---|---|")
    for report in reports:
        print(f"| {report['finding']} | {report['system']} | {report['state']} | {report['summary']} |")
sys.exit(1 if failed else 0)
