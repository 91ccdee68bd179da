"""The pictures of doc/gallery.md as VTK and matplotlib make them, beside ours.

    xvfb-run -a python3 doc/gallery/peers.py          with the package barycert on PYTHONPATH, from the sources' folder

Writes doc/gallery/NAME-vtk.png and NAME-matplotlib.png. Each is what a short program of their usual calls gives: colour
maps by name, scalar bars and axes as they come, 480 x 360 pixels, eight samples a pixel."""

import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk

import barycert

FOLDER = os.path.dirname(os.path.abspath(__file__))
WIDTH, HEIGHT = 480, 360


def grid_of(mesh, field=None):
    grid = mesh.to_vtk()
    if field:
        grid.GetPointData().SetActiveScalars(field)
    return grid


def mapped(source, field=None, values=None, cells=False):
    """An actor of a filter's output, and the scalar bar of its colours."""
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputConnection(source.GetOutputPort()) if hasattr(source, "GetOutputPort") else surface.SetInputData(source)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(surface.GetOutputPort())
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    if field is None:
        mapper.ScalarVisibilityOff()
        return actor, None
    colours = vtk.vtkLookupTable()
    viridis = plt.get_cmap("viridis")
    colours.SetNumberOfTableValues(256)
    for i in range(256):
        colours.SetTableValue(i, *viridis(i / 255.0))
    colours.SetRange(*values)
    mapper.SetLookupTable(colours)
    mapper.SetScalarRange(*values)
    mapper.SetScalarModeToUseCellFieldData() if cells else mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(field)
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(colours)
    bar.SetTitle(field)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0.1, 0.1, 0.1)
    return actor, bar


def write(name, *actors, view=(30, 25)):
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for actor in actors:
        if actor is not None:
            renderer.AddActor2D(actor) if isinstance(actor, vtk.vtkScalarBarActor) else renderer.AddActor(actor)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(WIDTH, HEIGHT)
    window.AddRenderer(renderer)
    azimuth, elevation = np.radians(view)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation))
    camera.SetFocalPoint(0, 0, 0)
    camera.SetViewUp(0, 1, 0) if elevation > 1.5 else camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera()
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(os.path.join(FOLDER, name + "-vtk.png"))
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


def filtered(kind, grid, **settings):
    result = kind()
    result.SetInputData(grid)
    for name, value in settings.items():
        call = getattr(result, name)
        call(*value) if isinstance(value, tuple) else call(value)
    result.Update()
    return result


def plane(origin, normal):
    result = vtk.vtkPlane()
    result.SetOrigin(*origin)
    result.SetNormal(*normal)
    return result


def outlined(grid):
    edges = vtk.vtkFeatureEdges()
    surface = filtered(vtk.vtkDataSetSurfaceFilter, grid)
    edges.SetInputConnection(surface.GetOutputPort())
    actor, _ = mapped(edges)
    actor.GetProperty().SetColor(0.1, 0.1, 0.1)
    return actor


def with_edges(pair):
    pair[0].GetProperty().EdgeVisibilityOn()
    return pair


def scenes():
    flange, cube, torus = (barycert.read(f"data/meshes/{name}") for name in ("flange", "cube-hole", "torus"))
    of = lambda mesh, name: (mesh[name].min(), mesh[name].max())
    write("mesh", *mapped(grid_of(flange), "attribute0", of(flange, "attribute0")))
    cut = filtered(vtk.vtkCutter, grid_of(flange), SetCutFunction=plane((0, 0, 0.25), (0, 0, 1)))
    write("slice", *mapped(cut, "attribute1", of(flange, "attribute1")), view=(-90, 90))
    iso = filtered(vtk.vtkContourFilter, grid_of(cube, "attribute0"))
    for i, value in enumerate((1, 1.5, 2)):
        iso.SetValue(i, value)
    write("iso", *mapped(iso, "attribute0", (1, 2)), outlined(grid_of(cube)))
    clip = filtered(vtk.vtkClipDataSet, grid_of(cube), SetClipFunction=plane((0, 0.5, 0), (0, 1, 0)), InsideOutOn=())
    write("clip", *with_edges(mapped(clip, "attribute0", of(cube, "attribute0"))))
    kept = filtered(vtk.vtkThreshold, grid_of(torus, "attribute1"), SetLowerThreshold=0.0, SetThresholdFunction=1)
    write("threshold", *with_edges(mapped(kept, "attribute1", (-1, 0))), outlined(grid_of(torus)))
    grid = grid_of(torus)
    turning = numpy_to_vtk(np.stack([-torus.points[:, 1], torus.points[:, 0], 0.3 * torus.points[:, 0]], axis=-1), deep=1)
    turning.SetName("turning")
    grid.GetPointData().AddArray(turning)
    grid.GetPointData().SetActiveVectors("turning")
    thinned = filtered(vtk.vtkMaskPoints, grid, SetOnRatio=3, RandomModeOn=())
    glyphs = vtk.vtkGlyph3D()
    glyphs.SetInputConnection(thinned.GetOutputPort())
    arrow = vtk.vtkArrowSource()
    glyphs.SetSourceConnection(arrow.GetOutputPort())
    glyphs.SetVectorModeToUseVector()
    glyphs.SetScaleModeToScaleByVector()
    glyphs.SetScaleFactor(0.25)
    dark, _ = mapped(glyphs)
    dark.GetProperty().SetColor(0.15, 0.15, 0.15)
    write("arrows", mapped(grid)[0], dark)
    turns = np.arange(600) / 6
    radius = 1 + 0.25 * np.cos(turns)
    coil = np.stack([radius * np.cos(turns / 16), radius * np.sin(turns / 16), 0.25 * np.sin(turns)], axis=-1)
    at = vtk.vtkPoints()
    at.SetData(numpy_to_vtk(coil, deep=1))
    cloud = vtk.vtkPolyData()
    cloud.SetPoints(at)
    probe = filtered(vtk.vtkProbeFilter, cloud, SetSourceData=(grid_of(torus),))
    discs = vtk.vtkVertexGlyphFilter()
    discs.SetInputConnection(probe.GetOutputPort())
    points, bar = mapped(discs, "attribute1", of(torus, "attribute1"))
    points.GetProperty().SetPointSize(6)
    points.GetProperty().RenderPointsAsSpheresOn()
    write("points", points, bar, outlined(grid_of(torus)))
    halves = barycert.read("data/gmsh/halves.msh")
    write("labels", *with_edges(mapped(grid_of(halves), "gmsh:physical", (10, 20), cells=True)))
    marked = filtered(vtk.vtkExtractCells, grid_of(cube))
    cells = vtk.vtkIdList()
    for cell in MARKED:
        cells.InsertNextId(cell)
    marked.SetCellList(cells)
    red, _ = mapped(marked)
    red.GetProperty().SetColor(0.8, 0.06, 0.18)
    write("defects", red, outlined(grid_of(cube)))


MARKED = [67, 115, 116, 127, 141, 164, 246, 381, 493, 509, 566, 592, 660, 922, 1190, 1203, 1237, 1241, 1484]


def plots():
    flange, torus = barycert.read("data/meshes/flange"), barycert.read("data/meshes/torus")
    points = np.linspace([-2, 0, 0.25], [2, 0, 0.25], 400)
    figure, axes = plt.subplots(figsize=(WIDTH / 100, HEIGHT / 100), dpi=100)
    for name in ("attribute0", "attribute1"):
        axes.plot(points[:, 0] + 2, flange.sample(points, name), label=name)
    axes.set(xlabel="length from the first point", ylabel="K", title="through the middle of the flange")
    axes.legend()
    figure.savefig(os.path.join(FOLDER, "profile-matplotlib.png"))
    figure, axes = plt.subplots(figsize=(WIDTH / 100, HEIGHT / 100), dpi=100)
    x = torus.points[:, 0]
    for i, probe in enumerate([(1.2, 0, 0), (0, 1.2, 0), (-1, 0.2, 0.1)]):
        values = []
        for k in range(9):
            torus["T"] = np.sin(0.7 * k + x) * np.exp(-0.1 * k)
            values.append(torus.sample(probe, "T"))
        axes.plot(values, marker="o", label=f"T, point {i}")
    axes.set(xlabel="step", title="three probes")
    axes.legend()
    figure.savefig(os.path.join(FOLDER, "series-matplotlib.png"))
    bracket = barycert.read("data/meshes/bracket")
    corners = bracket.points[bracket.cells]
    edges = corners[:, 1:] - corners[:, :1]
    sides = [np.linalg.norm(corners[:, i] - corners[:, j], axis=1) for i in range(4) for j in range(i)]
    figure, axes = plt.subplots(2, 1, figsize=(5.2, 5.2), dpi=100, layout="constrained")
    axes[0].hist(np.abs(np.linalg.det(edges)) / 6, bins=48)
    axes[0].set(xlabel="volume", ylabel="cells")
    axes[1].hist(np.max(sides, axis=0) / np.min(sides, axis=0), bins=48)
    axes[1].set(xlabel="longest edge / shortest edge", ylabel="cells")
    figure.savefig(os.path.join(FOLDER, "histogram-matplotlib.png"))


scenes()
plots()
