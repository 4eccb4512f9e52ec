"""A numbered series of VTKHDF files against the same states as one extended XYZ file, read by
ASE, h5py and, where it is installed, VTK.  Usage: read_series.py RUN.vtkhdf.series RUN.xyz
Exit status 77: no h5py or no ASE here."""
import json
import os
import sys

try:
    import ase.io
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)
try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOHDF import vtkHDFReader
except ImportError:
    vtkHDFReader = None

with open(sys.argv[1], encoding='utf-8') as file:
    series = json.load(file)
frames = ase.io.read(sys.argv[2], index=':', format='extxyz')
if series['file-series-version'] != '1.0' or len(series['files']) != len(frames):
    sys.exit(f'{len(series["files"])} files for {len(frames)} frames')
if len({frame.info['step'] for frame in frames}) != len(frames):
    sys.exit('two frames of one step')
for member, frame in zip(series['files'], frames):
    path = os.path.join(os.path.dirname(sys.argv[1]), member['name'])
    if member['time'] != frame.info['step']:
        sys.exit(f'{path}: time {member["time"]} is not step {frame.info["step"]}')
    with h5py.File(path) as file:
        root = file['VTKHDF']
        points = root['Points'][:]
        if not np.array_equal(points, frame.positions) or not np.array_equal(
                root['PointData/force_nN'][:], frame.get_forces(apply_constraint=False)):
            sys.exit(f'{path}: h5py: another state')
        if root['FieldData/density'][0] != frame.info['density']:
            sys.exit(f'{path}: another density')
    if vtkHDFReader is not None:
        reader = vtkHDFReader()
        reader.SetFileName(path)
        reader.Update()
        read = vtk_to_numpy(reader.GetOutput().GetPoints().GetData())
        if not np.array_equal(read, points):
            sys.exit(f'{path}: VTK: another state')
print(len(frames), 'frames')
