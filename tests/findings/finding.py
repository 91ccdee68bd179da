"""What the programs of this folder share: meshes, files, the judge, the report.

A program tries one system on one thing, holds what it answers against barycert, and prints one line of JSON:
    finding      name of the program
    system       name and version of what ran
    documented   the version with which doc/findings.md says that this happens
    reproduced   whether it did
    figures      what was counted, by name
    summary      the same in one line

Where points, cells and values are in question the judge is `barycert verify`, on files that the system wrote or on columns
that numpy wrote with what it said; elsewhere the program's own docstring says what its answers are held against.
"""

import itertools
import json
import os
import subprocess
import sys
from tempfile import TemporaryDirectory

import numpy

BARYCERT = os.environ.get("BARYCERT_PROGRAM", "barycert")


def report(system, documented, reproduced, summary, **figures):
    """Prints the line."""
    name = os.path.splitext(os.path.basename(sys.argv[0]))[0].replace("_", "-")
    print(json.dumps({"finding": name, "system": system, "documented": documented, "reproduced": bool(reproduced),
                      "summary": summary, "figures": figures}))


def barycert(*arguments, codes=(0, 1)):
    """Runs barycert; returns what it prints."""
    ended = subprocess.run([BARYCERT, *arguments], capture_output=True, text=True)
    if ended.returncode not in codes:
        raise RuntimeError(f"barycert {' '.join(arguments)}: exit code {ended.returncode}\n{ended.stderr}")
    return ended.stdout


def verify(mesh, results, *options):
    """Holds the rows of a file against the exact ones. Returns the JSON of `barycert verify`."""
    return json.loads(barycert("verify", mesh, "--results", results, *options, "--json", "-", "--quiet"))


def lattice(cells, dimension=3):
    """Nodes of the unit cube (square) in steps of 1/cells, and six tetrahedra (two triangles) for each small cube.

    The tetrahedra are those of Kuhn: one for each order in which a path from the lowest corner to the highest may take
    the axes. All have positive volume.
    """
    axis = numpy.arange(cells + 1) / cells
    nodes = numpy.stack([a.ravel() for a in numpy.meshgrid(*[axis] * dimension, indexing="ij")], 1)
    corner = [a.ravel() for a in numpy.meshgrid(*[numpy.arange(cells)] * dimension, indexing="ij")]
    number = lambda at: numpy.ravel_multi_index(at, (cells + 1,) * dimension)
    simplices = []
    for order in itertools.permutations(range(dimension)):
        at = [a.copy() for a in corner]
        path = [number(at)]
        for k in order:
            at[k] += 1
            path.append(number(at))
        if numpy.linalg.det(numpy.eye(dimension)[list(order)]) < 0:
            path[1], path[2] = path[2], path[1]
        simplices.append(numpy.stack(path, 1))
    return nodes, numpy.concatenate(simplices)


def shaken(nodes, by, seed):
    """The nodes inside the unit cube moved by up to `by` along each axis."""
    random = numpy.random.default_rng(seed)
    inside = numpy.all((nodes > 0) & (nodes < 1), axis=1)
    moved = nodes.copy()
    moved[inside] += random.uniform(-by, by, (inside.sum(), nodes.shape[1]))
    return moved


def wavy(nodes):
    """A smooth field with values at the nodes."""
    x, y, z = nodes[:, 0], nodes[:, 1], nodes[:, -1]
    return numpy.sin(7 * x) * numpy.cos(5 * y) + z * z


def points_on(nodes, simplices, corners, count, random):
    """Random points of faces of `corners` corners, as doubles have them."""
    dimension = nodes.shape[1]
    cell = random.integers(len(simplices), size=count)
    which = random.permuted(numpy.tile(numpy.arange(dimension + 1), (count, 1)), axis=1)[:, :corners]
    weights = random.dirichlet(numpy.ones(corners), count)
    return (weights[:, :, None] * nodes[simplices[cell[:, None], which]]).sum(1)


def write_mesh(stem, nodes, simplices, values):
    """TetGen's (Triangle's) files, with every double as it is. The field is attribute0."""
    with open(stem + ".node", "w") as file:
        print(len(nodes), nodes.shape[1], 1, 0, file=file)
        for i, (node, value) in enumerate(zip(nodes.tolist(), values.tolist())):
            print(i, *map(repr, node), repr(value), file=file)
    with open(stem + ".ele", "w") as file:
        print(len(simplices), simplices.shape[1], 0, file=file)
        for i, simplex in enumerate(simplices.tolist()):
            print(i, *simplex, file=file)
    return stem


def write_rows(path, points, **columns):
    """Points with what a system said of them, as a structured array: cell=..., attribute0=..."""
    names = list("xyz"[:points.shape[1]])
    table = numpy.zeros(len(points), [(n, "f8") for n in names] + [(n, c.dtype) for n, c in columns.items()])
    for k, name in enumerate(names):
        table[name] = points[:, k]
    for name, column in columns.items():
        table[name] = column
    numpy.save(path, table)
    return path
