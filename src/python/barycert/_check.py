"""What a check of a mesh found."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Dict, List, Tuple, Union

import numpy as np

from . import _core
from ._arguments import forwarded

if TYPE_CHECKING:
    from ._mesh import Mesh
    from ._surface import Surface


@dataclass(frozen=True)
class Place:
    """Where a defect is: indices in the mesh. `other_nodes`: of the facet that `nodes` meet, or of the edge or facet that
    the node hangs on. `distance`: of near nodes."""

    cells: Tuple[int, ...]
    nodes: Tuple[int, ...]
    detail: str
    other_nodes: Tuple[int, ...] = ()
    distance: float = 0.0


@dataclass(frozen=True)
class Defect:
    """A kind of defect, how often it was found, and where.

    Attributes:
        kind: its name, such as "overlapping_cells".
        count: how many; `at_least` if the search stopped there.
        breaks: whether it breaks the certificate; `condition`: which one ("P1" to "P5"), or "".
        severity: "error" if it does, "warning" if there is something to do about it, else "note".
        text: what it is. remedy: what to do about it, or "".
        places: the first of them.
    """

    kind: str
    count: int
    at_least: bool
    breaks: bool
    severity: str
    condition: str
    text: str
    remedy: str
    places: Tuple[Place, ...]

    def __repr__(self) -> str:
        more = "at least " if self.at_least else ""
        where = f", first: cells {self.places[0].cells}, nodes {self.places[0].nodes}" if self.places else ""
        return f"<Defect {self.kind}: {more}{self.count} {self.text}{where}>"


@dataclass(frozen=True)
class Contact:
    """Two cells that meet where they must not.

    Attributes:
        cells: the two. overlap: their interiors meet. dimension: of their intersection.
        point: a common point, rounded; exact: the rounded one is common, too. fraction: it as exact fractions, texts.
    """

    cells: Tuple[int, int]
    overlap: bool
    dimension: int
    point: Tuple[float, ...]
    exact: bool
    fraction: Tuple[str, ...]


@dataclass(frozen=True)
class Repair:
    """What `Mesh.fix` did.

    Attributes:
        merged: of each node taken out: it, the node that is kept, how far it moved.
        dropped: of each cell taken out: it, and why: "repeated_node", "degenerate_cell" or "duplicate_cell".
        turned: how many cells were negative.
        fields: where merged nodes have other values than the node that is kept: name, how many, largest difference.
    """

    merged: List[Tuple[int, int, float]]
    dropped: List[Tuple[int, str]]
    turned: int
    fields: List[Tuple[str, int, float]]


class CheckReport:
    """What `Mesh.check` found. str() is the report as `barycert check` prints it; it is true if the mesh is certified.

    Attributes:
        verdict: "certified" or "not certified".
        certified: bool.
        defects: list of Defect; first those that break the certificate.
        contacts: list of Contact: pairs of cells that overlap or touch where they must not.
        measures: dict of arrays, one entry a cell: orientation (exact sign), volume (signed; areas in the plane; correctly
            rounded), condition, radius_edge, aspect, min_angle, max_angle (degrees).
    """

    def __init__(self, core: _core.CheckReport, mesh: Union[Mesh, Surface]) -> None:
        self._core = core
        self.verdict: str = core.verdict
        self.certified: bool = core.certified
        self.defects: List[Defect] = [
            Defect(places=tuple(Place(*place) for place in defect.pop("places")), **defect) for defect in core.defects
        ]
        self.contacts: List[Contact] = [Contact(**contact) for contact in core.contacts]
        self._mesh = mesh

    measures: Dict[str, np.ndarray] = forwarded("_core.measures", "One entry a cell.")

    def text(self, name: str = "mesh") -> str:
        """The report for a terminal."""
        return self._core.text(name)

    def to_dict(self, name: str = "mesh") -> Dict[str, Any]:
        """All of it, as the JSON of `barycert check --json` has it."""
        return json.loads(self._core.json(name))

    def html(self, name: str = "mesh") -> str:
        """The report as one self-contained page."""
        return self._core.html(name)

    def __bool__(self) -> bool:
        return self.certified

    def __str__(self) -> str:
        return self.text()

    def __repr__(self) -> str:
        found = "; ".join(f"{'>= ' if d.at_least else ''}{d.count} {d.kind}" for d in self.defects)
        return f"<barycert.CheckReport: {self.verdict}, {len(self._mesh.cells)} cells{': ' if found else ''}{found}>"
