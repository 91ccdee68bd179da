"""VTK's readers on damaged files of a mesh: crashes, endless work, and meshes that come from a part of a file.

Files: one small mesh as VTK's writers write it, in XML (text, base64, raw; with and without compression) and in the
legacy format (text, binary). Damage: cut off at many places, a digit changed, bytes changed. Each file is read in a
process of its own, with at most 4 GiB of memory and 10 seconds.

A reader that cannot know is not blamed: bytes of numbers may be changed without any trace. Counted are
    killed    the reader ended its process by a signal
    endless   it took more than 10 seconds
    partial   of a file that was cut off, it returned a mesh that is not the one that was written, and reported no error
barycert reads the same files where VTK was killed.
"""

import os
import resource
import signal
import subprocess
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader, vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

from finding import BARYCERT, TemporaryDirectory, lattice, report, shaken, wavy
from vtk_data import VERSION, grid_of, write

OF_EACH = int(sys.argv[1]) if len(sys.argv) > 1 else 600
SAME, OTHER, REPORTED, ENDLESS = 10, 11, 12, 13


def files(folder):
    """The mesh in every format: name, reader, bytes."""
    nodes, cells = lattice(2)
    nodes = shaken(nodes, 0.1, seed=1)
    grid = grid_of(nodes, cells, wavy(nodes))
    path = folder + "/whole"
    for mode in ("Ascii", "Binary", "Appended"):
        for compressor in ("None", "ZLib"):
            writer = vtkXMLUnstructuredGridWriter()
            getattr(writer, "SetDataModeTo" + mode)()
            getattr(writer, "SetCompressorTypeTo" + compressor)()
            writer.EncodeAppendedDataOff()
            yield f"VTU {mode} {compressor}", vtkXMLUnstructuredGridReader, open(write(writer, grid, path), "rb").read()
    for mode in ("ASCII", "Binary"):
        writer = vtkUnstructuredGridWriter()
        getattr(writer, "SetFileTypeTo" + mode)()
        yield f"legacy {mode}", vtkUnstructuredGridReader, open(write(writer, grid, path), "rb").read()


def damaged(whole, random):
    """(was it cut off, bytes)."""
    for i in range(OF_EACH):
        text = bytearray(whole)
        if i % 3 == 0:
            # The missing part is more than white space and the closing tags.
            yield True, bytes(text[:random.integers(len(text) * 95 // 100)])
            continue
        if i % 3 == 1:
            digits = [k for k, c in enumerate(text) if 48 <= c < 58]
            text[digits[random.integers(len(digits))]] = 48 + random.integers(10)
        else:
            for _ in range(1 + random.integers(4)):
                text[random.integers(len(text))] = random.integers(256)
        yield False, bytes(text)


def content(grid):
    """All that the mesh holds."""
    if grid is None or grid.GetNumberOfPoints() == 0 or grid.GetNumberOfCells() == 0:
        return None
    parts = [grid.GetPoints().GetData(), grid.GetCells().GetConnectivityArray(), grid.GetPointData().GetArray("f"),
             grid.GetCellData().GetArray("cell")]
    return [None if p is None else vtk_to_numpy(p).tobytes() for p in parts]


def read(kind, path):
    """What the reader returns, and whether it reported an error."""
    errors = []
    reader = kind()
    for source in (reader, reader.GetExecutive()):
        source.AddObserver(vtkCommand.ErrorEvent, lambda *_: errors.append(1))
        source.AddObserver(vtkCommand.WarningEvent, lambda *_: errors.append(1))
    reader.SetFileName(path)
    reader.Update()
    return content(reader.GetOutput()), bool(errors) or reader.GetErrorCode() != 0


def read_apart(kind, path, whole):
    """The same in a process of its own: SAME, OTHER, REPORTED, or the signal that ended it, negative."""
    child = os.fork()
    if child == 0:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)
        os.dup2(nowhere, 2)
        resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.alarm(10)
        got, reported = read(kind, path)
        os._exit(REPORTED if reported or got is None else SAME if got == whole else OTHER)
    status = os.waitpid(child, 0)[1]
    if os.WIFSIGNALED(status):
        return ENDLESS if os.WTERMSIG(status) == signal.SIGALRM else -os.WTERMSIG(status)
    return os.WEXITSTATUS(status)


random = numpy.random.default_rng(4)
table, signals, barycert_killed = {}, {}, 0
with TemporaryDirectory() as folder:
    for name, kind, whole in files(folder):
        suffix = ".vtu" if name.startswith("VTU") else ".vtk"
        path = folder + "/damaged" + suffix
        open(path, "wb").write(whole)
        before, reported = read(kind, path)
        assert before is not None and not reported, name
        counts = {"files": 0, "cut_off": 0, "killed": 0, "endless": 0, "partial": 0}
        for cut, text in damaged(whole, random):
            open(path, "wb").write(text)
            ended = read_apart(kind, path, before)
            counts["files"] += 1
            counts["cut_off"] += cut
            counts["killed"] += ended < 0
            counts["endless"] += ended == ENDLESS
            counts["partial"] += cut and ended == OTHER
            if ended < 0:
                label = signal.Signals(-ended).name
                signals[label] = signals.get(label, 0) + 1
                code = subprocess.run([BARYCERT, "check", path, "--quiet"], capture_output=True).returncode
                barycert_killed += code not in (0, 1, 2)
        table[name] = counts

total = {k: sum(counts[k] for counts in table.values()) for k in ("files", "cut_off", "killed", "endless", "partial")}
report(VERSION, "VTK 9.1.0", total["killed"] > 0,
       f"of {total['files']} damaged files {total['killed']} end the reader's process "
       f"({', '.join(f'{n} {k}' for k, n in signals.items())}), {total['endless']} take more than 10 s; of "
       f"{total['cut_off']} cut off {total['partial']} give another mesh and no error; barycert is ended by "
       f"{barycert_killed}",
       formats=table, signals=signals, barycert_killed=barycert_killed, **total)
