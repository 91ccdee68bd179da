"""pip install . in a virtual environment that sees Debian's packages, without a network."""

import os
import subprocess
import sys
import zipfile

import pytest

from conftest import SOURCES

BUILD = os.environ.get("BARYCERT_BUILD")


@pytest.mark.skipif(not BUILD, reason="not run from a build")
def test_pip_installs(tmp_path):
    pytest.importorskip("venv")
    pytest.importorskip("pip")
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    # No index is asked: what would need one fails.
    environment.update(PIP_NO_INDEX="1", PIP_DISABLE_PIP_VERSION_CHECK="1")

    def run(*command):
        done = subprocess.run([str(c) for c in command], env=environment, capture_output=True, text=True, cwd=tmp_path)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    run(sys.executable, "-m", "venv", "--system-site-packages", "venv")
    python = tmp_path / "venv" / "bin" / "python"
    # The compiled part is this build's: compiling it again would take minutes.
    run(python, "-m", "pip", "install", "--config-settings", f"prebuilt={BUILD}", SOURCES)
    where = run(python, "-c", "import barycert; print(barycert.__file__)")
    assert where.startswith(str(tmp_path / "venv"))
    text = "import barycert as b, numpy as n; print(b.Interpolator(n.eye(3)[:, :2], [[0, 1, 2]], [1, 2, 3])(0.25, 0.5))"
    assert run(python, "-c", text) == "2.0\n"
    assert "Version: 0" in run(python, "-m", "pip", "show", "barycert")
    run(python, "-m", "pip", "uninstall", "-y", "barycert")
    run(python, "-m", "pip", "wheel", "--no-deps", "--config-settings", f"prebuilt={BUILD}", "-w", "wheels", SOURCES)
    (wheel,) = os.listdir(tmp_path / "wheels")
    names = zipfile.ZipFile(tmp_path / "wheels" / wheel).namelist()
    assert {"barycert/__init__.py", "barycert/_core.pyi", "barycert/py.typed"} <= set(names)
    assert any(name.startswith("barycert/_core.") and name.endswith(".so") for name in names)
    assert wheel.startswith("barycert-0") and f"cp{sys.version_info.major}{sys.version_info.minor}" in wheel


def test_metadata_need_no_build(tmp_path, monkeypatch):
    """What pip asks first; and it is what the wheel has."""
    monkeypatch.syspath_prepend(os.path.join(SOURCES, "src", "python", "build_backend"))
    import backend

    def no_build(*command):
        raise AssertionError(command)

    with monkeypatch.context() as without:
        without.setattr(backend, "_run", no_build)
        folder = backend.prepare_metadata_for_build_wheel(str(tmp_path))
    assert folder.startswith("barycert-0") and folder.endswith(".dist-info")
    metadata = (tmp_path / folder / "METADATA").read_text(encoding="utf-8")
    assert metadata.startswith("Metadata-Version: 2.1\nName: barycert\nVersion: 0")
    if BUILD:
        with zipfile.ZipFile(tmp_path / backend.build_wheel(str(tmp_path), {"prebuilt": BUILD})) as wheel:
            for name in os.listdir(tmp_path / folder):
                assert wheel.read(f"{folder}/{name}") == (tmp_path / folder / name).read_bytes()
