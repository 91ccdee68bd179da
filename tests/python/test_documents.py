"""Examples in doc/python.md and in docstrings, the script that draws, and the stubs."""

import ast
import doctest
import importlib
import os
import pkgutil
import re
import shutil
import subprocess
import sys

import pytest

import barycert
from barycert import _core
from conftest import SOURCES

FLAGS = doctest.ELLIPSIS | doctest.IGNORE_EXCEPTION_DETAIL


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with the data of the sources."""
    os.symlink(os.path.join(SOURCES, "data"), tmp_path / "data")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.skipif(not _core.has_audit, reason="this build has no audit")
def test_the_document(folder):
    pytest.importorskip("scipy")
    path = folder / "python.md"
    shutil.copy(os.path.join(SOURCES, "doc", "python.md"), path)
    failed, tried = doctest.testfile(str(path), module_relative=False, optionflags=doctest.ELLIPSIS)
    assert tried > 25 and failed == 0


def test_docstrings():
    tried = 0
    for module in pkgutil.iter_modules(barycert.__path__, "barycert."):
        if module.name != "barycert._core":
            result = doctest.testmod(importlib.import_module(module.name), optionflags=FLAGS)
            assert result.failed == 0
            tried += result.attempted
    assert tried >= 4


def test_every_public_name_has_a_docstring():
    for name in barycert.__all__:
        thing = getattr(barycert, name)
        assert thing.__doc__, name
        for member in vars(thing) if isinstance(thing, type) else ():
            value = getattr(thing, member)
            if not member.startswith("_") and callable(value) and thing.__module__.startswith("barycert"):
                if name in ("Feature", "FieldData"):
                    continue
                assert value.__doc__, f"{name}.{member}"


def test_the_picture(folder):
    pytest.importorskip("matplotlib")
    script = os.path.join(SOURCES, "doc", "examples", "slice.py")
    done = subprocess.run([sys.executable, script, "slice.png"], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "certified" in done.stdout and "pixels are inside" in done.stdout
    from matplotlib.image import imread

    picture = imread(folder / "slice.png")
    assert picture.shape[:2] == (420, 520)
    # Coloured, and not all in one colour.
    assert len({tuple(pixel) for row in picture[100:300:20, 100:400:20] for pixel in row}) > 5


def test_bindings_stand_on_public_headers():
    folder = os.path.join(SOURCES, "src", "python")
    includes = set()
    for name in os.listdir(folder):
        if name.endswith((".cpp", ".hpp")):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                includes |= set(re.findall(r'#include ["<](barycert/[^">]*)[">]', file.read()))
    assert len(includes) > 5
    assert all(include.count("/") == 1 for include in includes), includes


def test_the_stub_has_what_users_see_of_the_module():
    with open(os.path.join(os.path.dirname(barycert.__file__), "_core.pyi"), encoding="utf-8") as file:
        stub = ast.parse(file.read())
    for node in stub.body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and node.name != "__getattr__":
            assert hasattr(_core, node.name), node.name
    (error,) = (node for node in stub.body if isinstance(node, ast.ClassDef))
    assert error.name == "Error" and issubclass(_core.Error, ValueError)
    with pytest.raises(_core.Error) as raised:
        _core.fail("field.unknown", "this", expected="that", found="other", remedy="change it")
    assert {item.target.id for item in error.body} == set(vars(raised.value))
    # Whatever else of it users get has a type in the package.
    public = {name for name in barycert.__all__ if getattr(_core, name, None) is getattr(barycert, name)}
    assert public == {"Error"}
    assert os.path.exists(os.path.join(os.path.dirname(barycert.__file__), "py.typed"))


def test_mypy_accepts_the_types():
    pytest.importorskip("mypy")
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--ignore-missing-imports", "--cache-dir=/dev/null", "-p", "barycert"], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout
