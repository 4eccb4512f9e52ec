"""Particles and contacts of a VTKHDF export against the tables of the same state, read by h5py
and, where it is installed, by VTK.  Usage: read_vtkhdf.py P.vtkhdf C.vtkhdf P.csv C.csv
Exit status 77: no h5py here."""
import csv
import sys

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)


def table(path):
    with open(path, encoding='utf-8') as file:
        rows = list(csv.reader(line for line in file if not line.startswith('#')))
    return {name: np.array([float(row[k]) for row in rows[1:]])
            for k, name in enumerate(rows[0])}


def vector(columns, names):
    return np.stack([columns[name] for name in names.split()], axis=1)


def same(what, a, b):
    if a.shape != b.shape or not np.array_equal(a, b):
        sys.exit(f'{what}: {a.shape} and {b.shape} differ')


particles, contacts, p, c = sys.argv[1], sys.argv[2], table(sys.argv[3]), table(sys.argv[4])
with h5py.File(particles) as file:
    root = file['VTKHDF']
    if root.attrs['Type'] != b'UnstructuredGrid' or list(root.attrs['Version']) != [1, 0]:
        sys.exit('no UnstructuredGrid of version 1.0')
    if root.attrs.get_id('Type').get_type().get_size() != len('UnstructuredGrid'):
        sys.exit('a Type with bytes behind it, which ParaView 5.11 does not know')
    points = root['Points'][:]
    same('positions', points, vector(p, 'x_nm y_nm z_nm'))
    same('diameters', root['PointData/diameter_nm'][:], p['diameter_nm'])
    same('coordination', root['PointData/coordination'][:].astype(float), p['coordination'])
    for name, unit, columns in [
            ('velocity', 'm_per_s', 'vx_m_per_s vy_m_per_s vz_m_per_s'),
            ('omega', 'per_ns', 'omegax_per_ns omegay_per_ns omegaz_per_ns'),
            ('force', 'nN', 'fx_nN fy_nN fz_nN'),
            ('torque', 'nN_nm', 'tqx_nN_nm tqy_nN_nm tqz_nN_nm')]:
        present = f'{name}_{unit}' in root['PointData']
        if present != (columns.split()[0] in p):
            sys.exit(f'{name}: in one of the formats only')
        if present:
            same(name, root[f'PointData/{name}_{unit}'][:], vector(p, columns))
    same('stress', root['PointData/stress_MPa'][:],
         vector(p, 'sxx_MPa syy_MPa szz_MPa sxy_MPa syz_MPa sxz_MPa'))
with h5py.File(contacts) as file:
    root = file['VTKHDF']
    same('forces', root['CellData/force_nN'][:], vector(c, 'fx_nN fy_nN fz_nN'))
    same('normal forces', root['CellData/normal_nN'][:], c['normal_nN'])
    for name in ['overlap_nm', 'shear_nN', 'radius_nm', 'area_nm2', 'bridge_radius_nm']:
        same(name, root[f'CellData/{name}'][:], c[name])
    same('bridges', root['CellData/bridged'][:].astype(float), c['bridged'])
    same('pairs', root['CellData/particles'][:] + 1.0, vector(c, 'i j'))
    ends = root['Points'][:].reshape(-1, 2, 3)
    branch = vector(c, 'bx_nm by_nm bz_nm')
    if len(branch) and np.abs(ends[:, 0] - ends[:, 1] - branch).max() > 1e-9 * np.abs(ends).max():
        sys.exit('lines are not the branch vectors')

try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOHDF import vtkHDFReader
except ImportError:
    print('h5py alone')
    sys.exit(0)


def read(path):
    reader = vtkHDFReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


grid = read(particles)
same('VTK: positions', vtk_to_numpy(grid.GetPoints().GetData()).astype(float), points)
same('VTK: diameters', vtk_to_numpy(grid.GetPointData().GetArray('diameter_nm')),
     p['diameter_nm'])
lines = read(contacts)
if lines.GetNumberOfCells() != len(c['i']):
    sys.exit('VTK: no line for each contact')
if len(c['i']) and lines.GetCell(0).GetNumberOfPoints() != 2:
    sys.exit('VTK: a contact is no line')
same('VTK: forces', vtk_to_numpy(lines.GetCellData().GetArray('normal_nN')), c['normal_nN'])
print('h5py and VTK')
