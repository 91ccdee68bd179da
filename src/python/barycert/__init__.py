"""Exact interpolation over triangles and tetrahedra, and audits of what interpolates.

    f = barycert.Interpolator(points, cells, values)   # as scipy.interpolate.LinearNDInterpolator
    f(p)

    mesh = barycert.read("part.1")                     # or barycert.Mesh(points, cells)
    loc = mesh.locate(p)                               # loc.cell, loc.feature, loc.weights, loc.matrix()
    mesh.sample(p, "T"); mesh.resample((64, 64, 64), fields="T"); mesh.gradient("T"); mesh.check()

    s = barycert.Surface(points, triangles)            # in space; or barycert.Surface.read("part.stl")
    s.check(); s.contains(p); s.nearest(p).distance; s.sample(p, "T")

    barycert.orient3d(a, b, c, d)                      # exact signs
    barycert.audit(kernel)                             # is a formula right?
    barycert.verify(mesh, p, {"T": values})            # are results right?

Cells are exact for all finite doubles; values are the exact ones rounded once, to nearest, ties to even; both are the same
on every machine and any number of threads. Indices count from 0. Errors are `barycert.Error`, a ValueError. Work runs
without the interpreter's lock and stops at Ctrl-C.
"""

from . import _core
from ._audit import AuditReport, KernelResult, audit, families, kernels
from ._check import CheckReport, Contact, Defect, Place, Repair
from ._core import Error
from ._figure import Picture
from ._interpolator import Interpolator
from ._location import Feature, Location
from ._mesh import FieldData, Mesh, read
from ._predicates import barycentric_weights, det3d, incircle, insphere, orient2d, orient3d, weight_signs
from ._surface import NearestPoints, Surface
from ._verify import ColumnErrors, Verification, WrongRow, verify

__version__: str = _core.version

__all__ = [
    "AuditReport", "CheckReport", "ColumnErrors", "Contact", "Defect", "Error", "Feature", "FieldData", "Interpolator",
    "KernelResult", "Location", "Mesh", "NearestPoints", "Picture", "Place", "Repair", "Surface", "Verification", "WrongRow",
    "audit", "barycentric_weights", "det3d", "families", "incircle", "insphere", "kernels", "orient2d", "orient3d", "read", "verify", "weight_signs",
]  # fmt: skip
