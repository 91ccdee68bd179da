"""Results as tables."""
from collections import Counter

import survivors


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


def render_room(data):
    """For the NOTES.md of the room: the score, and who survived, or passes quick tests if no others were run."""
    run = [m for m in data["mutants"] if m["status"] in ("killed", "survived", "undecided")]
    survived = sorted((m for m in run if m["status"] != "killed"), key=lambda m: (m["file"], m["line"]))
    listed = sum(m["listed"] for m in run)
    out = [f"{len(run) - len(survived)} of {len(run)} killed; {listed} of them were listed, {len(run) - listed} generated, of "
           f"{data['possible']} that can be; {counts([m for m in data['mutants'] if m not in run]) or 'none'} besides. Sources at "
           f"{data['revision']}, {data['seconds'] / 60:.0f} minutes.", "", "| survivor | change |", "|---|---|"]
    out += [f"| {m['file']}:{m['line']} | {change(m)} |" for m in survived]
    return "\n".join(out) + "\n"
