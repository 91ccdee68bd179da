"""vtkProbeFilter onto an image whose last voxels lie on the boundary of the mesh, exactly: they are masked out.

Mesh: the cube [0, 4.3]^3. Image: 44^3 voxels at 0, 0.1, ... 4.3. In double 43 * 0.1 is 4.3, so every voxel lies in the
closed cube. The judge reads the file that VTK's writer wrote.
"""

from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLUnstructuredGridWriter

from finding import TemporaryDirectory, lattice, report, verify, wavy
from vtk_data import VERSION, grid_of, image_of, probe, use_threads, write

SPACING, SIDE = 0.1, 44
assert 43 * SPACING == 4.3

use_threads(1)
nodes, cells = lattice(4)
nodes *= 4.3
nodes[nodes > 4.29] = 4.3
grid = grid_of(nodes, cells, wavy(nodes))
with TemporaryDirectory() as folder:
    mesh = write(vtkXMLUnstructuredGridWriter(), grid, folder + "/cube.vtu")
    image = write(vtkXMLImageDataWriter(), probe(grid, image_of(SIDE, SPACING)), folder + "/probed.vti")
    verdicts = verify(mesh, image)

missed, rows = verdicts["missed"], verdicts["rows"]
report(VERSION, "VTK 9.1.0", missed == SIDE**3 - (SIDE - 1)**3 and verdicts["outside"] == 0,
       f"{missed} of {rows} voxels masked out, all on the boundary; {verdicts['outside']} are outside",
       voxels=rows, missed=missed, missed_on_boundary=verdicts["missed_on_boundary"], outside=verdicts["outside"])
