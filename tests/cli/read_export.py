"""Exports of a state against the state file itself, read by h5py, ASE and LAMMPS.
Usage: read_export.py STATE.h5 PREFIX [BACK.dump...]
PREFIX.extxyz, .lammps-dump, .lammps-data, .csv: exports, -c.csv and -c.lammps-dump its
contacts; BACK.dump: what LAMMPS has written of
what it has read, from the data file and then from the dump.
Exit status 77: no h5py or no ASE here."""
import csv
import io
import sys

try:
    import ase.io
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

state_path, prefix, back = sys.argv[1], sys.argv[2], sys.argv[3:]


def fail(text):
    sys.exit(f'{prefix}: {text}')


def same(what, read, want, share=1e-13):
    """Equal but for the rounding of factors; want 0 is 0."""
    if read.shape != want.shape:
        fail(f'{what}: {read.shape} instead of {want.shape}')
    if read.size and not np.all(np.abs(read - want) <= share * np.abs(want)):
        fail(f'{what}: differs by {np.abs(read - want).max()}')


def state_arrays():
    """Of the state file in nm, ns, nN, MPa."""
    with h5py.File(state_path) as file:
        metre, pascal = file.attrs['metre_per_length'], file.attrs['pascal_per_stress']
        second = file.attrs.get('second_per_time', np.nan)
        record = file['checkpoint']
        nm, nn, ns = metre * 1e9, pascal * metre ** 2 * 1e9, second * 1e9
        factors = {'position': nm, 'radius': nm, 'contacts': 1.0, 'velocity': nm / ns,
                   'spin': 1.0 / ns, 'force': nn, 'torque': nn * nm}
        arrays = {name: factor * file[name][:] for name, factor in factors.items()
                  if name in file}
        pairs = file['pair'][:].reshape(-1, 2)
        arrays.update(pair=pairs, pair_force=nn * file['pair_force'][:],
                      pair_normal=nn * file['pair_normal'][:],
                      bridged=file['pair_bridged'][:].astype(float),
                      contact_radius=nm * file['contact_radius'][:],
                      reduced=1.0 / (1.0 / arrays['radius'][pairs]).sum(axis=1))
        if 'world/history' in record:
            arrays['deepest'] = nm * file['checkpoint/world/history'][:].reshape(
                len(pairs), -1)[:, 0]
        if 'bed/deepest' in record:
            arrays.update(bed_deepest=nm * record['bed/deepest'][:],
                          wall=file['wall'][:].reshape(-1, 2),
                          wall_force=nn * file['wall_force'][:])
        arrays['dimension'] = file.attrs['dimension']
        if 'world/history' in record:
            arrays['stress'] = 1e-6 * np.concatenate(
                [[file.attrs[name] for name in ('px_pa', 'py_pa', 'pz_pa')],
                 file.attrs['shear_stress_pa']])
        cell, tilt = nm * file.attrs['cell_d'], nm * file.attrs['cell_tilt_d']
        arrays['cell'] = np.array([[cell[0], 0, 0], [tilt[0], cell[1], 0],
                                   [tilt[1], tilt[2], cell[2]]])
        if 'motion/velocity' in record:
            same('velocity of the checkpoint', arrays['velocity'],
                 nm / ns * record['motion/velocity'][:])
            # rotations of a cell are arcs there, diameters times angles, torques over them
            same('spin of the checkpoint', arrays['spin'] * 2.0 * file['radius'][:][:, None],
                 record['motion/spin'][:] / ns)
        if 'world/torque' in record:
            same('torque of the checkpoint', arrays['torque'],
                 nn * nm * 2.0 * file['radius'][:][:, None] * record['world/torque'][:])
        if 'bed/roll' in record:
            radius = file['radius'][:][:, None]
            same('spin of the checkpoint', arrays['spin'] * radius,
                 record['bed/roll'][:, :3] / ns)
            same('torque of the checkpoint', arrays['torque'],
                 nn * nm * radius * record['bed/moment'][:, :3])
        if 'world/force' in record:
            same('force of the checkpoint', arrays['force'], nn * record['world/force'][:])
    return arrays


def table(path):
    with open(path, encoding='utf-8') as file:
        rows = list(csv.reader(line for line in file if not line.startswith('#')))
    return {name: np.array([float(row[k]) for row in rows[1:]])
            for k, name in enumerate(rows[0])}


def dump(path, rows_of='ATOMS', order='id'):
    """The last frame of a dump, by id."""
    with open(path, encoding='utf-8') as file:
        head, _, atoms = file.read().rpartition(f'ITEM: {rows_of} ')
    names, _, rows = atoms.partition('\n')
    names = names.split()
    data = np.loadtxt(io.StringIO(rows), ndmin=2) if rows else np.empty((0, len(names)))
    data = data[np.argsort(data[:, names.index(order)])]
    return {name: data[:, k] for k, name in enumerate(names)}, head


def vector(columns, names):
    return np.stack([columns[name] for name in names.split()], axis=1)


def has(name, columns):
    """A format has the columns of an array if the state has it."""
    if (name in want) != columns:
        fail(f'{name}: {"missing" if name in want else "from nowhere"}')
    return columns


want = state_arrays()
rows = {'velocity': ('vx_m_per_s vy_m_per_s vz_m_per_s', 'vx vy vz', 'velo', 1.0),
        'spin': ('omegax_per_ns omegay_per_ns omegaz_per_ns', 'omegax omegay omegaz',
                 'omega', 1.0),
        'force': ('fx_nN fy_nN fz_nN', 'fx fy fz', 'forces', 1e3),
        'torque': ('tqx_nN_nm tqy_nN_nm tqz_nN_nm', 'tqx tqy tqz', 'torques', 1e3)}

# --- tables ------------------------------------------------------------------------------
particles = table(f'{prefix}.csv')
same('csv: positions', vector(particles, 'x_nm y_nm z_nm'), want['position'])
same('csv: diameters', particles['diameter_nm'], 2.0 * want['radius'])
same('csv: coordination', particles['coordination'], want['contacts'])
for name, (columns, _, _, _) in rows.items():
    if has(name, columns.split()[0] in particles):
        same(f'csv: {name}', vector(particles, columns), want[name])
stress = vector(particles, 'sxx_MPa syy_MPa szz_MPa sxy_MPa sxz_MPa syz_MPa')

# --- ASE ---------------------------------------------------------------------------------
atoms = ase.io.read(f'{prefix}.extxyz', index=-1, format='extxyz')
arrays = dict(atoms.arrays)
if atoms.calc is not None:
    arrays.update(atoms.calc.results)
same('ASE: positions', atoms.positions, want['position'])
same('ASE: cell', atoms.cell[:], want['cell'])
same('ASE: radii', arrays['radius'], want['radius'])
same('ASE: coordination', arrays['coordination'], want['contacts'])
same('ASE: stress', arrays['stress_MPa'], stress)
for name, (_, _, key, _) in rows.items():
    if has(name, key in arrays):
        same(f'ASE: {name}', arrays[key], want[name])

# --- contacts ----------------------------------------------------------------------------
contacts = table(f'{prefix}-c.csv')
local, _ = dump(f'{prefix}-c.lammps-dump', 'ENTRIES', 'index')
for name, other in [('fx_nN', 'fx_nN'), ('fz_nN', 'fz_nN'), ('normal_nN', 'normal_nN'),
                    ('bx_nm', 'bx'), ('bridged', 'bridged'), ('overlap_nm', 'overlap'),
                    ('shear_nN', 'shear_nN'), ('radius_nm', 'radius'),
                    ('area_nm2', 'area'), ('bridge_radius_nm', 'bridge_radius')]:
    same(f'contacts of both tables: {name}', local[other], contacts[name])
# attraction across gaps follows the contacts
gaps = {name: column[len(want['pair']):] for name, column in contacts.items()}
if np.any(gaps['overlap_nm'] >= 0.0) or np.any(gaps['normal_nN'] >= 0.0) or any(
        np.any(gaps[name] != 0.0) for name in ('shear_nN', 'radius_nm', 'area_nm2', 'bridged')):
    fail('gaps: one is no attraction across a gap')
if 'stress' in want:
    force, branch = vector(contacts, 'fx_nN fy_nN fz_nN'), vector(contacts, 'bx_nm by_nm bz_nm')
    tensor = 1e3 * np.einsum('ka,kb->ab', force, branch) / np.linalg.det(want['cell'])
    tensor = 0.5 * (tensor + tensor.T)[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    weight = want['radius'] ** want['dimension']
    mean = (weight[:, None] * stress).sum(axis=0) / weight.sum()
    largest = np.nanmax(np.abs(want['stress']))
    for what, value in ('pairs', tensor), ('particles', mean):
        if np.nanmax(np.abs(value - want['stress'])) > 1e-6 * largest:
            fail(f'{what}: {value} do not make up the stress {want["stress"]}')
contacts = {name: column[:len(want['pair'])] for name, column in contacts.items()}
same('contacts: pairs', vector(contacts, 'i j'), want['pair'] + 1.0)
force, branch = vector(contacts, 'fx_nN fy_nN fz_nN'), vector(contacts, 'bx_nm by_nm bz_nm')
same('contacts: forces', force, want['pair_force'])
same('contacts: normal forces', contacts['normal_nN'], want['pair_normal'])
same('contacts: bridges', contacts['bridged'], want['bridged'])
same('contacts: radii', contacts['radius_nm'], want['contact_radius'])
same('contacts: areas', contacts['area_nm2'], np.pi * want['contact_radius'] ** 2)
same('contacts: bridge radii', contacts['bridge_radius_nm'],
     want['contact_radius'] * want['bridged'])
unit = branch / np.linalg.norm(branch, axis=1)[:, None]
across = np.linalg.norm(force - (force * unit).sum(axis=1)[:, None] * unit, axis=1)
if len(across) and np.abs(across - contacts['shear_nN']).max() > 1e-9 * np.abs(force).max():
    fail('contacts: force across')
# a^2 = R* h, of a bridge that of its deepest overlap
if 'deepest' in want:
    held = np.where(want['bridged'] > 0.0, want['deepest'], contacts['overlap_nm'])
    square = want['reduced'] * np.maximum(held, 0.0)
    if np.abs(square - contacts['radius_nm'] ** 2).max(initial=0.0) > 1e-9 * square.max(
            initial=1.0):
        fail('contacts: radii of the law')
if 'bed_deepest' in want:
    # Hertz' a^2 = R* h; of a contact that has flowed 2 c^2 R* h at its deepest overlap,
    # c^(2 + m) = 1.43 exp(-0.97 m) with m = 0.2
    square = contacts['radius_nm'] ** 2 / want['reduced']
    plastic = 2.0 * (1.43 * np.exp(-0.97 * 0.2)) ** (2.0 / 2.2) * want['bed_deepest']
    flowed = np.abs(square - plastic) < 1e-9 * plastic
    elastic = np.abs(square - np.maximum(contacts['overlap_nm'], 0.0)) < 1e-9 * plastic
    if not flowed.any() or not elastic.any() or not np.all(flowed | elastic):
        fail('contacts: radii of the law of a die')
    # without attraction the contacts of a particle make up its resultant
    total = np.zeros_like(want['force'])
    np.add.at(total, want['pair'][:, 0], force)
    np.add.at(total, want['pair'][:, 1], -force)
    np.add.at(total, want['wall'][:, 0], want['wall_force'])
    if np.abs(total - want['force']).max() > 1e-9 * np.abs(force).max():
        fail('contacts: do not make up the resultants')

# --- the dump, and LAMMPS of both of its formats ------------------------------------------
columns, head = dump(f'{prefix}.lammps-dump')
if 'ITEM: UNITS\nnano\n' not in head:
    fail('dump: no units')
same('dump: radii', columns['radius'], want['radius'])
same('dump: stress', vector(columns, 'sxx syy szz sxy sxz syz'), stress)
for name, (_, keys, _, nano) in rows.items():
    if has(name, keys.split()[0] in columns):
        same(f'dump: {name}', vector(columns, keys), nano * want[name])
for k, path in enumerate(back):
    read, _ = dump(path)
    same(f'LAMMPS {k}: positions', vector(read, 'x y z'), want['position'], 1e-12)
    same(f'LAMMPS {k}: radii', read['radius'], want['radius'])
    moving = want.get('velocity', 0.0 * want['position'])
    same(f'LAMMPS {k}: velocities', vector(read, 'vx vy vz'), moving)
    if k == 0:
        spin = want.get('spin', 0.0 * want['position'])
        same('LAMMPS 0: spins', vector(read, 'omegax omegay omegaz'), spin)
print('h5py and ASE' + (' and LAMMPS' if back else ''))
