"""Pictures: what notebooks show of a mesh, and what files hold."""

import io
import os
import subprocess

import numpy as np
import pytest

import barycert
from conftest import kuhn

PNG = b"\x89PNG\r\n\x1a\n"


@pytest.fixture(scope="module")
def mesh():
    points, cells = kuhn(3, 3, 1 / 3)
    return barycert.Mesh(points, cells, point_data={"T": points[:, 0], "v": points}, cell_data={"k": np.arange(len(cells))})


def pixels(png):
    image = pytest.importorskip("PIL.Image").open(io.BytesIO(png))
    return np.asarray(image.convert("RGB")).astype(int)


def test_notebooks_show_it(mesh):
    picture = mesh.plot("T", title="a cube", unit="K", size=(400, 300))
    assert picture._repr_png_().startswith(PNG)
    svg = picture._repr_svg_()
    assert svg.startswith(("<?xml", "<svg")) and "a cube" in svg and "T (K)" in svg
    assert picture._repr_html_().startswith('<img src="data:image/png;base64,')
    assert pixels(picture._repr_png_()).shape == (300, 400, 3)


def test_it_is_the_picture_of_the_command(mesh, tmp_path):
    mesh.write(tmp_path / "m.vtu")
    program = os.path.join(os.environ["BARYCERT_BUILD"], "bin", "barycert")
    if not os.path.exists(program):
        pytest.skip("no program")
    options = ["--field", "T", "--edges", "--view", "iso", "--clip", "x=0.4", "--size", "300x200", "--range", "0,2"]
    subprocess.run([program, "render", "mesh", "m.vtu", *options, "--quiet", "--output", "a.png"], cwd=tmp_path, check=True)
    picture = mesh.plot("T", edges=True, view="iso", clip=((1, 0, 0), 0.4), size=(300, 200), range=(0, 2))
    picture.save(tmp_path / "b.png")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes() == picture._repr_png_()


def test_files(mesh, tmp_path):
    picture = mesh.plot("cell:k" if "cell:k" in mesh.fields else "k", outline=True, colormap="cividis")
    for suffix, begin in ((".png", PNG), (".pdf", b"%PDF"), (".svg", b"<"), (".html", b"<!DOCTYPE html>")):
        picture.save(tmp_path / ("picture" + suffix))
        assert (tmp_path / ("picture" + suffix)).read_bytes().startswith(begin)
    with pytest.raises(barycert.Error, match="picture.gif"):
        picture.save(tmp_path / "picture.gif")


def test_scenes(mesh):
    grey = pixels(mesh.plot(size=(200, 150))._repr_png_())
    for options in (
        {"field": "T"}, {"field": "|v|"}, {"threshold": ("T", 0.3, 1)}, {"slices": [((0, 0, 1), 0.5)], "outline": True},
        {"field": "T", "iso": [0.5]}, {"arrows": "v", "arrow_count": 20}, {"arrows": "v", "field": "T", "surface": False},
        {"points": [[1.1, 0.5, 0.5]], "point_size": 20}, {"marked": [0, 5]}, {"camera": (10, 80)},
        {"background": (0, 0, 0, 255)}, {"box": ((0.4, 0.4, 0.4), (2, 2, 2))}, {"axes": "box"}, {"parallel": True},
    ):  # fmt: skip
        assert (pixels(mesh.plot(size=(200, 150), **options)._repr_png_()) != grey).any(), options


def test_points_have_colours_of_values(mesh):
    points = np.array([[0.2, 0.5, 0.5], [0.9, 0.5, 0.5], [5, 0.5, 0.5]])
    options = {"surface": False, "bar": False, "axes": "none", "view": "+z", "parallel": True, "size": (200, 60), "samples": 1}
    shown = pixels(mesh.plot("T", points=points, point_size=8, range=(0, 1), **options)._repr_png_())
    colours = np.unique(shown.reshape(-1, 3), axis=0)
    assert len(colours) == 4, "a colour for each point, and the ground"
    for point in ([[0.2, 0.5]], np.zeros((3, 2)), [[np.nan, 0, 0]]):
        with pytest.raises(barycert.Error):
            mesh.plot("T", points=point)


def test_what_cannot_be_drawn(mesh):
    for options, match in (
        ({"field": "none"}, "none"), ({"colour": 1}, "no such option.*colour"), ({"edges": "yes"}, "edges"),
        ({"view": "up"}, "view.*up"), ({"axes": "round"}, "axes=.*round"), ({"threshold": ("T", 5, 6)}, "no cell"),
        ({"colormap": "jet"}, "jet"), ({"size": (0, 10)}, "width of a raster"),
    ):  # fmt: skip
        with pytest.raises(barycert.Error, match=match):
            mesh.plot(**options)


def test_line(mesh, tmp_path):
    plot = mesh.plot_line([-0.2, 0.4, 0.4], [1.2, 0.4, 0.4], ["T", "v.y"], count=50, unit="m")
    svg = plot._repr_svg_()
    assert "length from the first point" in svg and ">T<" in svg and "v.y" in svg
    assert plot._repr_png_().startswith(PNG)
    plot.save(tmp_path / "line.pdf")
    assert (tmp_path / "line.pdf").read_bytes().startswith(b"%PDF")
    with pytest.raises(barycert.Error):
        mesh.plot_line([0, 0], [1, 1])
    with pytest.raises(barycert.Error, match="count="):
        mesh.plot_line([0, 0, 0], [1, 1, 1], count=-1)


def test_plane():
    points, cells = kuhn(4, 2, 0.25)
    flat = barycert.Mesh(points, cells, point_data={"u": points.sum(axis=1)})
    assert "u" in flat.plot("u", edges=True)._repr_svg_()
