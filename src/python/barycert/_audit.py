"""Kernels for barycentric weights, held against exact arithmetic."""

from __future__ import annotations

import json
import os
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Union

import numpy as np

from . import _core
from ._arguments import Progress, count_of, telling
from ._mesh import Mesh

Kernel = Union[Callable[[np.ndarray, np.ndarray], Any], str, os.PathLike]


class KernelResult(dict):
    """What was found of one kernel: the members of its JSON by name, and the most important as attributes.

    Attributes:
        name: such as "tetrahedron.my_kernel".
        cases, wrong_cases: how many were asked, and how many have a finding.
        findings: dict, class of finding to count; those found alone.
        worst_weight_ulp, worst_value_ulp: the largest errors in ulps of the exact result; None if none could be measured.
        witnesses: list of dicts, the worst case of each finding, with vertices and point in hexadecimal floats.
    """

    def __init__(self, entry: Dict[str, Any], witnesses: List[Dict[str, Any]]) -> None:
        super().__init__(entry)
        self.name: str = entry["name"]
        self.cases: int = entry["cases"]
        self.wrong_cases: int = entry["wrong_cases"]
        self.findings: Dict[str, int] = {name: entry[name] for name in _core.finding_names() if entry[name]}
        self.worst_weight_ulp: Optional[float] = entry["worst_weight_ulp"]
        self.worst_value_ulp: Optional[float] = entry["worst_value_ulp"]
        self.witnesses = witnesses

    def __repr__(self) -> str:
        found = ", ".join(f"{count} {name}" for name, count in self.findings.items())
        return f"<{self.name}: {self.wrong_cases} of {self.cases} cases wrong{': ' if found else ''}{found}>"


class AuditReport:
    """What `audit` found. str() is the report as `barycert audit` prints it; it is true if no kernel has a finding, and
    none was given up.

    Attributes:
        kernels: list of KernelResult, worst first.
    """

    def __init__(self, core: Any) -> None:
        self._core = core
        self._data: Dict[str, Any] = json.loads(core.json())
        self.kernels = [
            KernelResult(entry, [w for w in self._data["witnesses"] if w["kernel"] == entry["name"]])
            for entry in self._data["kernels"]
        ]

    def text(self, wide: bool = False) -> str:
        """The report for a terminal."""
        return self._core.text(wide)

    def to_dict(self) -> Dict[str, Any]:
        """All of it, as the JSON of `barycert audit --json` has it."""
        return self._data

    def html(self) -> str:
        """The report as one self-contained page."""
        return self._core.html()

    def __bool__(self) -> bool:
        return all(kernel.wrong_cases == 0 and kernel["not_run"] == 0 for kernel in self.kernels)

    def __str__(self) -> str:
        return self.text()

    def __repr__(self) -> str:
        return f"<barycert.AuditReport: {', '.join(map(repr, self.kernels))}>"


def audit(
    kernel: Union[Kernel, Sequence[Union[str, os.PathLike]]], *, simplex: str = "tetrahedron",
    name: Optional[str] = None, declares_degenerate: bool = False, tolerance: Optional[float] = None,
    against: Sequence[str] = (), contained: bool = True, count: int = 10000, seed: int = 1,
    families: Sequence[str] = (), meshes: Union[Sequence[Mesh], Mapping[str, Mesh]] = (), threads: int = 0,
    oracle: str = "automatic", progress: Progress = None,
) -> AuditReport:  # fmt: skip
    """Asks a kernel for barycentric weights over families of cases and compares each answer with the exact one.

    Args:
        kernel: a callable of (vertices (n, d), point (d,)) that returns n weights, or None for a simplex that it declares
            degenerate; the path of a shared library with the functions of barycert/kernel.h; or a name of the catalogue,
            * and ? allowed ("tetrahedron.*"). Or several paths and names: libraries need names that differ. Kernels of
            the catalogue are reported in its order.
        simplex: of a callable: "segment" (2, 3), "triangle" (3, 2), "triangle3d" (3, 3) or "tetrahedron" (4, 3).
        name: of a callable; None: its own.
        declares_degenerate: the callable may return None.
        tolerance: a point is inside if every weight is at least -tolerance; None: the signs of the weights tell. Not for
            libraries that certify their answers.
        against: kernels of the catalogue to be asked the same.
        contained: a shared library runs in a process of its own, where accidents become findings.
        count: cases a family. seed: of the random numbers.
        families: names, * and ? allowed; none: all (those that draw from meshes, if there are `meshes`).
        meshes: whose cells become cases, too.
        threads: 0 for as many as the machine has; a callable is asked by one.
        oracle: "automatic", "integers", "cgal" or "both".

    Raises:
        Error: no such kernel, library or family; an answer of another shape; a process that the callable forked and
            left behind. An exception of the callable is a finding, `raised`; KeyboardInterrupt ends the audit.
    """
    _need_audit()
    callable_kernel = None
    libraries: List[str] = []
    catalogue = list(against)
    if callable(kernel):
        callable_kernel = kernel
        name = name or getattr(kernel, "__name__", type(kernel).__name__).strip("<>")
    else:
        for one in [kernel] if isinstance(kernel, (str, os.PathLike)) else kernel:
            text = os.fspath(one)
            is_path = isinstance(one, os.PathLike) or os.sep in text or text.endswith(".so")
            # The loader of shared libraries looks elsewhere for a name without a folder.
            libraries.append(os.path.abspath(text)) if is_path else catalogue.append(text)
    named = meshes.items() if isinstance(meshes, Mapping) else ((f"mesh{i}", mesh) for i, mesh in enumerate(meshes))
    core = _core.audit(
        callable_kernel, simplex, name or "", declares_degenerate, tolerance, libraries, catalogue, contained,
        count_of(count, "count="), count_of(seed, "seed="),
        [families] if isinstance(families, str) else list(families),
        [(label, mesh._core) for label, mesh in named], count_of(threads, "threads="), oracle, telling(progress),
    )  # fmt: skip
    return AuditReport(core)


def _need_audit() -> None:
    if not _core.has_audit:
        _core.fail("tool.missing", "this build of barycert has no audit", remedy="build it with -DBARYCERT_AUDIT=ON")


def kernels() -> List[Dict[str, Any]]:
    """The catalogue of kernels: dicts with name, simplex, formula, source, fails and more."""
    _need_audit()
    return json.loads(_core.kernels())["kernels"]


def families() -> List[Dict[str, Any]]:
    """The families of cases: dicts with name, after, parameters, simplices and more."""
    _need_audit()
    return json.loads(_core.families())["families"]
