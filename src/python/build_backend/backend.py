"""Builds wheels of barycert with CMake (PEP 517), with nothing but the standard library: pip need fetch nothing."""

import base64
import hashlib
import io
import os
import re
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import tomllib
import zipfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))


def _read(*path):
    with open(os.path.join(ROOT, *path), "rb") as file:
        return file.read()


def _project():
    project = tomllib.loads(_read("pyproject.toml").decode())["project"]
    project["version"] = re.search(r"project\(barycert VERSION ([0-9.]+)", _read("CMakeLists.txt").decode()).group(1)
    project["base"] = f"{project['name']}-{project['version']}"
    project["info"] = project["base"] + ".dist-info"
    return project


def _metadata(project):
    lines = [
        "Metadata-Version: 2.1",
        f"Name: {project['name']}",
        f"Version: {project['version']}",
        f"Summary: {project['description']}",
        f"Requires-Python: {project['requires-python']}",
        "License: Apache-2.0",
    ]
    lines += [f"Requires-Dist: {name}" for name in project["dependencies"]]
    for extra, names in project["optional-dependencies"].items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f"Requires-Dist: {name}; extra == '{extra}'" for name in names]
    lines += ["Description-Content-Type: text/markdown", "", ""]
    return "\n".join(lines).encode() + _read(project["readme"])


def _tag():
    version = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{version}-{version}-" + sysconfig.get_platform().replace("-", "_").replace(".", "_")


def _information(project):
    """Files of the folder .dist-info, but the record of all."""
    wheel = f"Wheel-Version: 1.0\nGenerator: barycert\nRoot-Is-Purelib: false\nTag: {_tag()}\n"
    files = {"LICENSE": _read("LICENSE"), "METADATA": _metadata(project), "WHEEL": wheel.encode()}
    return {f"{project['info']}/{name}": content for name, content in files.items()}


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """Without this, pip would build the wheel to learn its name."""
    project = _project()
    os.mkdir(os.path.join(metadata_directory, project["info"]))
    for path, content in _information(project).items():
        with open(os.path.join(metadata_directory, path), "wb") as file:
            file.write(content)
    return project["info"]


def _run(*command):
    subprocess.run(command, check=True, cwd=ROOT)


def _stage(settings, folder):
    """Builds, and returns where below `folder` the package is, as it is to be installed."""
    build = settings.get("prebuilt")
    if build is None:
        build = settings.get("build-dir", os.path.join(ROOT, "build", "wheel-" + sysconfig.get_config_var("SOABI")))
        audit = settings.get("audit", "ON")
        _run("cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DBARYCERT_PYTHON=ON",
             f"-DBARYCERT_AUDIT={audit}", "-DBARYCERT_CLI=OFF", "-DBARYCERT_TETGEN=OFF",
             f"-DPython3_EXECUTABLE={sys.executable}")  # fmt: skip
        _run("cmake", "--build", build, "--target", "barycert_python")
    _run("cmake", "--install", build, "--component", "python", "--prefix", folder, "--strip")
    for path, _, files in os.walk(folder):
        if "__init__.py" in files:
            return path
    raise RuntimeError(f"{build} has no package for Python: configure it with -DBARYCERT_PYTHON=ON")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Settings (pip --config-settings): build-dir=FOLDER; audit=OFF leaves out the audit, and GMP and MPFR with it;
    prebuilt=FOLDER takes the package from a build by CMake that has it."""
    project = _project()
    name = f"{project['base']}-{_tag()}.whl"
    with tempfile.TemporaryDirectory() as folder:
        package = _stage(config_settings or {}, folder)
        files = {f"barycert/{file}": _read(package, file) for file in sorted(os.listdir(package))}
    files.update(_information(project))
    record = f"{project['info']}/RECORD"
    lines = []
    for path, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        lines.append(f"{path},sha256={digest},{len(content)}")
    files[record] = "\n".join([*lines, f"{record},,", ""])
    with zipfile.ZipFile(os.path.join(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            wheel.writestr(path, content)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """What git knows of."""
    project = _project()
    base = project["base"]
    metadata = _metadata(project)
    files = subprocess.run(["git", "ls-files", "-z"], check=True, cwd=ROOT, capture_output=True).stdout.decode().split("\0")
    with tarfile.open(os.path.join(sdist_directory, base + ".tar.gz"), "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for file in filter(None, files):
            archive.add(os.path.join(ROOT, file), f"{base}/{file}", recursive=False)
        info = tarfile.TarInfo(f"{base}/PKG-INFO")
        info.size = len(metadata)
        archive.addfile(info, io.BytesIO(metadata))
    return base + ".tar.gz"
