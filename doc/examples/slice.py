"""A slice through a mesh as a picture: ./run python doc/examples/slice.py [PICTURE]

Reads a mesh with a field, proves that its cells are a partition, resamples the field onto a plane, and draws it with
matplotlib. The values are correctly rounded; what is white is outside, exactly.
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import barycert

# %% The mesh, and whether it can be trusted.
mesh = barycert.read("data/meshes/flange")
report = mesh.check()
print(repr(mesh))
print(repr(report))

# %% The field on a plane: a grid of one layer.
low, high = mesh.bounds.T
height = (low[2] + high[2]) / 2
bounds = [[low[0], high[0]], [low[1], high[1]], [height, height]]
values = mesh.resample((400, 400, 1), bounds, "attribute1")[:, :, 0]
inside = ~np.isnan(values)
print(f"{inside.sum()} of {values.size} pixels are inside; values from {values[inside].min():.4g} to {values[inside].max():.4g}")

# %% The same value by its point: the same bits.
x, y, z = mesh.grid_axes((400, 400, 1), bounds)
i, j = np.argwhere(inside)[0]
assert mesh.sample([x[i], y[j], z[0]], "attribute1") == values[i, j]

# %% The picture.
figure, axes = plt.subplots(figsize=(5.2, 4.2), layout="constrained")
# Rows of a picture are y, and they go upwards.
image = axes.imshow(values.T, origin="lower", extent=[low[0], high[0], low[1], high[1]])
axes.set(xlabel="x", ylabel="y", title=f"attribute1 at z = {height:.4g}")
figure.colorbar(image)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "slice.png", dpi=100)
