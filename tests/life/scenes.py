"""Random scenes of every kind, small enough for seconds: a preset and keys that replace its own."""

PRESSURES = ['2 MPa', '5 MPa', '10 MPa', '20 MPa', '40 MPa', '60 MPa']

# Values at the edge of what a key takes: refused, guarded or pressed, but by the rules.
EXTREMES = [
    ('particles.count', '10'), ('contact.mu', '2'), ('contact.mu', '0'),
    ('numerics.max_evaluations', '1'), ('numerics.max_evaluations', '40'),
    ('loading.until', '1000 GPa'), ('loading.until', '1 kPa'),
    ('loading.until', 'density = 0.99'), ('loading.until', 'density = 0.02'),
    ('structure.density', '0.74'), ('structure.density', '0.01'), ('structure.base', '3 d'),
    ('loading.step', '2 %'), ('loading.step', '0.02 %'), ('material.young', '1 kPa'),
    ('material.epsilon', '0 kB'), ('material.epsilon', '100000 kB'), ('material.poisson', '0'),
    ('contact.alpha', '0.05'), ('contact.alpha', '10'), ('contact.bridge_length', '0.00001 d'),
    ('contact.shear_strength', '0 E'), ('contact.viscosity', '0 mPa s'),
    ('contact.damping', '0'), ('loading.rate', '1 1/ps'), ('loading.time', '1 ns'),
    ('die.punch_mass', '0.001'), ('die.punch_mass', '100'), ('particles.diameter', '1 nm'),
    ('particles.diameter', '1 mm'), ('numerics.time_step', '10 T'), ('numerics.safety', '10'),
    ('numerics.tolerance', '0.1'), ('structure.seed', '18446744073709551615'),
    ('loading.unload_from', '1 GPa'), ('die.diameter', '10 um'), ('loading.relax', '0 fs'),
]


def has_walls(preset):
    """A die; the other scenes are periodic cells."""
    return preset.startswith('p3')


def is_unstable(keys):
    """Steps of time too large for a balance of energy."""
    return 'numerics.time_step' in keys or keys.get('numerics.safety') == '10'


def _sizes(rng, keys, diameter):
    """One size, a log-normal law or a table; diameter is a number and its unit."""
    kind = rng.choice(['mono', 'mono', 'lognormal', 'table'])
    number, unit = diameter
    keys['particles.distribution'] = kind
    if kind == 'lognormal':
        keys['particles.median'] = f'{number} {unit}'
        keys['particles.sigma'] = f'{rng.uniform(0.05, 0.4):.3f}'
    elif kind == 'table':
        percent, larger = rng.randrange(20, 80), number * rng.uniform(1.2, 2)
        keys['particles.table'] = (f'number: {number} {unit} {percent / 100}; '
                                   f'{larger:.3f} {unit} {1 - percent / 100:.2f}')


def _contact(rng, keys):
    keys['contact.mu'] = f'{rng.uniform(0, 0.6):.3f}'
    if rng.random() < 0.5:
        keys['contact.alpha'] = f'{rng.uniform(0.15, 0.6):.3f}'
    if rng.random() < 0.5:
        keys['contact.bridge_length'] = rng.choice(['0.002 d', '0.008 d', '0.03 d', '1 d'])
    if rng.random() < 0.3:
        keys['contact.shear_strength'] = rng.choice(['auto', '0.01 E', '0.03 E'])
    if rng.random() < 0.3:
        keys['contact.bridge_radius'] = 'current'
    if rng.random() < 0.2:
        keys['contact.relative_motion'] = 'full'


def _path(rng):
    return rng.choice([
        'isotropic to 10 MPa; unload',
        'uniaxial to 20 MPa; isotropic to 40 MPa; unload',
        'isotropic to 5 MPa; shear xz to 5 % at z = 5 MPa; unload',
        'biaxial to 10 MPa; uniaxial to 20 MPa',
    ])


def _geometry(rng, plane):
    return rng.choice(['uniaxial', 'isotropic'] if plane else ['uniaxial', 'biaxial', 'isotropic'])


def _grains(rng, keys):
    """Dry grains, and lattices in place of a grown structure."""
    if rng.random() < 0.2:
        keys['contact.normal'] = 'hertz'
        keys['structure.density'] = 'auto'
    if rng.random() < 0.2:
        keys['structure.density'] = 'auto'
        keys['structure.kind'] = rng.choice(['square', 'hexagonal'] if keys['scene.dimension'] == '2'
                                            else ['sc', 'fcc', 'bcc', 'diamond'])


def _quasistatic(rng, keys):
    dimension = rng.choice(['3', '3', '2'])
    keys['scene.dimension'] = dimension
    keys['structure.base'] = 'auto'
    keys['particles.count'] = str(rng.randrange(100, 401))
    keys['structure.density'] = '0.5' if dimension == '2' else f'{rng.uniform(0.2, 0.35):.3f}'
    keys['numerics.tolerance'] = rng.choice(['0.05', '0.01', '3e-3'])
    keys['loading.unload_from'] = ''
    keys['loading.until'] = rng.choice(PRESSURES)
    if dimension == '3' and rng.random() < 0.2:
        keys['loading.path'] = _path(rng)
    elif rng.random() < 0.2:
        keys['loading.until'] = f'density = {0.58 if dimension == "2" else 0.42}'
    else:
        most = PRESSURES.index(keys['loading.until'])
        start = rng.sample(PRESSURES[:most + 1], rng.randrange(0, min(3, most + 1)))
        keys['loading.unload_from'] = '; '.join(sorted(start, key=PRESSURES.index))
    if 'loading.path' not in keys:
        keys['loading.geometry'] = _geometry(rng, dimension == '2')
    _sizes(rng, keys, (10, 'nm'))
    _contact(rng, keys)
    if keys['particles.distribution'] == 'mono':
        _grains(rng, keys)
    if rng.random() < 0.2:
        keys['numerics.relaxer'] = rng.choice(['predict', 'fire', 'steepest'])
    if rng.random() < 0.2:
        keys['numerics.precision'] = rng.choice(['single', 'double'])
    return rng.choice(['default', 'p1-set1-uniaxial', 'p1-set2-38nm'])


def _dynamic(rng, keys):
    plane = rng.random() < 0.6
    keys['particles.count'] = str(rng.randrange(100, 301))
    keys['structure.base'] = 'auto'
    keys['structure.density'] = '0.5' if plane else '0.3'
    keys['loading.relax'] = keys['loading.hold'] = '0.005 ns'
    keys['loading.record'] = rng.choice(['0.2 %', '1 %'])
    keys['loading.record_time'] = '0.001 ns'
    keys['loading.until'] = f'density = {rng.uniform(0.55, 0.7) if plane else 0.36:.3f}'
    keys['loading.geometry'] = _geometry(rng, plane)
    _sizes(rng, keys, (10, 'nm'))
    _contact(rng, keys)
    if rng.random() < 0.3:
        keys['contact.viscous_forces'] = rng.choice(['all', 'translation', 'normal'])
    return rng.choice(['p2-v1', 'p2-v2', 'p2-v4']) if plane else rng.choice(['p2-3d-v1',
                                                                            'p2-3d-v3'])


def _die(rng, keys):
    keys['particles.count'] = str(rng.randrange(20, 60))
    if rng.random() < 0.3:
        keys['particles.distribution'] = 'lognormal'
        keys['particles.median'] = '4.65 um'
        keys['particles.sigma'] = f'{rng.uniform(0.05, 0.3):.3f}'
    if rng.random() < 0.2:
        keys['die.weld_strength'] = rng.choice(['0 Pa', '800 MPa'])
        return 'p3-cycle'
    keys['contact.mu'] = f'{rng.uniform(0, 0.2):.3f}'
    keys['contact.mu_wall'] = f'{rng.uniform(0, 0.2):.3f}'
    keys['loading.until'] = rng.choice(PRESSURES[2:])
    keys['contact.normal'] = rng.choice(['hertz', 'storakers'])
    if keys['contact.normal'] == 'storakers':
        keys['material.hardening'] = rng.choice(['0', '0.1', '0.2'])
    return rng.choice(['p3-hertz-mu0', 'p3-storakers-m0-mu0', 'p3-storakers-m0.2-mu0.02'])


def _output(rng, keys):
    keys['output.checkpoint_every'] = rng.choice(['0.1 s', '0.1 s', '0.3 s', '60 s'])
    keys['numerics.threads'] = rng.choice(['1', '2', '3'])
    keys['output.on_hangup'] = rng.choice(['stop', 'detach'])
    if rng.random() < 0.2:
        keys['output.snapshots_at'] = rng.choice(['every 20', 'every 50', '5 MPa'])
        if rng.random() < 0.5:
            keys['output.export'] = rng.choice(['extxyz', 'lammps-dump', 'csv'])


def random_scene(rng, extreme):
    """A preset's name, and keys in the order in which they are given.

    extreme: the share of scenes that have a value at the edge of a key.
    """
    keys = {'scene.title': f'life {rng.randrange(10 ** 6)}',
            'structure.seed': str(rng.choice([1, rng.randrange(2 ** 32), rng.randrange(2 ** 64)]))}
    preset = rng.choice([_quasistatic, _quasistatic, _dynamic, _die])(rng, keys)
    _output(rng, keys)
    if rng.random() < extreme:
        key, value = rng.choice(EXTREMES)
        keys[key] = value
    return preset, keys


def random_edit(rng):
    """A key that is set anew, as between two runs of one directory."""
    return rng.choice([
        ('contact.mu', f'{rng.uniform(0, 0.6):.3f}'), ('structure.seed', str(rng.randrange(99))),
        ('numerics.threads', rng.choice(['1', '2', '4'])), ('particles.count', '120'),
        ('output.checkpoint_every', '0.1 s'), rng.choice(EXTREMES)])


def random_change(rng):
    """What a run goes on with."""
    return rng.choice([f'contact.mu={rng.uniform(0, 1):.3f}', 'contact.mu=0',
                       f'contact.alpha={rng.uniform(0.15, 0.6):.3f}',
                       'contact.bridge_length=1 d', 'loading.geometry=isotropic'])
