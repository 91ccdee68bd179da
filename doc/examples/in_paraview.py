"""A mesh of TetGen in ParaView: checked, sampled in a plane, drawn. PV_PLUGIN_PATH names the folder with Barycert.so.

pvpython doc/examples/in_paraview.py PICTURE
"""
import sys

from paraview import servermanager
from paraview.simple import *

mesh = OpenDataFile("data/meshes/flange.node")
check = BarycertCheck(Input=mesh)
report = servermanager.Fetch(check).GetFieldData().GetAbstractArray("barycert_check")
print(report.GetValue(0))

plane = Plane(Origin=[-2, -2, 0.3], Point1=[2, -2, 0.3], Point2=[-2, 2, 0.3], XResolution=400, YResolution=400)
values = BarycertResample(SourceDataArrays=mesh, DestinationMesh=plane)
mask = servermanager.Fetch(values).GetPointData().GetArray("vtkValidPointMask")
inside = sum(mask.GetTuple1(i) == 1 for i in range(mask.GetNumberOfTuples()))
print(inside, "of", mask.GetNumberOfTuples(), "points lie in the mesh")

view = CreateRenderView(ViewSize=[700, 300], Background=[1, 1, 1], UseColorPaletteForBackground=0, OrientationAxesVisibility=0)
half = Clip(Input=check, ClipType="Plane")
half.ClipType.Origin, half.ClipType.Normal = [0, 0, 0.3], [0, 0, 1]
below = Show(half, view, Representation="Surface")
ColorBy(below, ("CELLS", "min_angle"))
cut = Show(Threshold(Input=values, Scalars=["POINTS", "vtkValidPointMask"], LowerThreshold=1, UpperThreshold=1), view, Position=[4.3, 0, 0])
ColorBy(cut, ("POINTS", "attribute1"))
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [2.15, -6, 5.5], [2.15, 0, 0], [0, 0, 1]
view.CameraViewAngle = 30
SaveScreenshot(sys.argv[1], view)
