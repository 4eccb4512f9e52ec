"""A numbered series of VTKHDF files as ParaView reads it: steps, and particles in each, as in the
same states as one extended XYZ file.  Usage: pvpython read_paraview.py RUN.vtkhdf.series RUN.xyz"""
import re
import sys

from paraview import servermanager, simple

counts, steps = [], []
with open(sys.argv[2], encoding='utf-8') as file:
    for line in file:
        if line.strip().isdigit():
            counts.append(int(line))
        found = re.search(r'\bstep=(\d+)', line)
        if found:
            steps.append(float(found.group(1)))
reader = simple.VTKHDFReader(FileName=[sys.argv[1]])
reader.UpdatePipeline()
if not steps or list(reader.TimestepValues) != steps:
    sys.exit(f'steps {list(reader.TimestepValues)}: must be {steps}')
for step, count in zip(steps, counts):
    reader.UpdatePipeline(step)
    grid = servermanager.Fetch(reader)
    names = [grid.GetPointData().GetArrayName(k)
             for k in range(grid.GetPointData().GetNumberOfArrays())]
    if grid.GetNumberOfPoints() != count or 'diameter_nm' not in names:
        sys.exit(f'step {step}: {grid.GetNumberOfPoints()} points with {names}')
