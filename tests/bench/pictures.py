"""pictures.py PROGRAM [EARLIER]: how long whole commands take that draw, files to files, in milliseconds: medians of 11
runs, those of both programs by turns. Run in the folder of the sources, on an idle machine."""

import os
import statistics
import subprocess
import sys
import tempfile
import time

RUNS = 11
MESHES = "data/meshes/"
PICTURES = [
    ("flange, 800 x 600", "render mesh flange --field attribute0 --output a.png", "--samples 1"),
    ("plate, 800 x 600", "render mesh plate --field attribute0 --output a.png", "--samples 1"),
    ("iso-surface of flange, 640 x 480",
     "render iso flange --field attribute1 --value 0.2 --colours attribute0 --size 640x480 --output a.png", "--samples 1"),
    ("slice of flange, 480 pixels wide", "render slice flange --plane z=0.25 --field attribute1 --width 480 --output a.png",
     "--samples 1"),
    ("flange on a grid of 480 x 480", "resample flange --grid 480x480x1 --fields attribute1 --output a.png", ""),
    ("page of check, bracket", "check bracket --html a.html", ""),
    ("page of check, flange", "check flange --html a.html", ""),
    ("bracket with edges in a box of axes", "render mesh bracket --field attribute0 --edges --axes box --output a.png", ""),
    ("cube-hole cut open, with edges", "render mesh cube-hole --clip y=0.5 --field attribute0 --edges --output a.png", ""),
    ("flange as .svg", "render mesh flange --field attribute0 --output a.svg", ""),
    ("flange as .pdf", "render mesh flange --field attribute0 --output a.pdf", ""),
    ("bracket as .html", "render mesh bracket --field attribute0 --output a.html", ""),
    ("flange as .html", "render mesh flange --field attribute0 --output a.html", ""),
    ("profile of 400 points", "sample flange --line=-2,0,0.25:2,0,0.25 --count 400 --fields attribute0 --plot a.png", ""),
]  # fmt: skip


def main():
    programs = sys.argv[1:3]
    print("| picture | " + ("before | " if len(programs) == 2 else "") + "now | one sample a pixel | size of the file |")
    print("|---|" + "---|" * (len(programs) + 2))
    with tempfile.TemporaryDirectory() as folder:
        for name, line, one in PICTURES:
            words = line.split()
            place = 2 if words[0] == "render" else 1
            words[place] = MESHES + words[place]
            words[words.index("a." + line.rsplit("a.", 1)[1])] = path = os.path.join(folder, line.rsplit(" ", 1)[1])
            commands = [[program] + words for program in reversed(programs)]
            commands += [[programs[0]] + words + one.split()] if one else []
            times = [[] for _ in commands]
            for _ in range(RUNS):
                for command, taken in zip(commands, times):
                    start = time.perf_counter()
                    done = subprocess.run(command + ["--quiet"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                    taken.append(time.perf_counter() - start if done.returncode == 0 else float("nan"))
            subprocess.run([programs[0]] + words + ["--quiet"], check=True)
            figures = [f"{1000 * statistics.median(taken):.0f}" for taken in times] + ([] if one else [""])
            print(f"| {name} | {' | '.join(figures)} | {os.path.getsize(path) / 1000:.0f} kB |".replace("nan", "-"), flush=True)


main()
