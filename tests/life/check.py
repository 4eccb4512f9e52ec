"""What holds of a run directory and of an exit status at any moment."""
import json
import math
import os
import re

# docs/manual.md, exit status
DOCUMENTED = {0, 1, 2, 3, 129, 130, 143}

# Files of a run that no process writes to: docs/manual.md, run directories.
KNOWN = re.compile(r'preset\.ini|curve\.csv|events\.log|status\.json|state\.h5|state-before\.h5'
                   r'|snapshots|trajectory(-contacts)?\.[\w-]+')


class Broken(Exception):
    """A broken invariant: its name, which tells it from others, and what was seen."""

    def __init__(self, name, detail):
        super().__init__(f'{name}: {detail}')
        self.name = name


def expect(good, name, detail):
    if not good:
        raise Broken(name, detail)


def answer(status, stderr, accepted, what):
    """An exit status that is documented and fits, and one line for each failure."""
    lines = stderr.count('\n')
    seen = f'{what}: status {status}, {stderr!r}'
    expect(status in accepted, 'exit status', f'{seen}, accepted {sorted(accepted)}')
    expect(status in DOCUMENTED or -status in accepted or status < 0, 'exit status', seen)
    expect(status < 0 or lines == (status != 0), 'one line per failure', seen)
    expect(not re.search(r'[\x00-\x08\x0b-\x1f\x7f]', stderr), 'plain text', seen)


def read_rows(directory):
    """Header and rows of curve.csv without their seconds; none where there is no curve."""
    path = os.path.join(directory, 'curve.csv')
    if not os.path.exists(path):
        return []
    with open(path, encoding='utf-8', newline='') as file:
        text = file.read()
    expect(text == '' or text.endswith('\n'), 'whole rows', f'{path} ends with {text[-60:]!r}')
    rows = [line.split(',') for line in text.split('\n') if line and not line.startswith('#')]
    if not rows:
        return []
    at, columns = rows[0].index('seconds'), len(rows[0])
    for row in rows:
        expect(len(row) == columns, 'whole rows', f'{path}: {row}')
        del row[at]
    return rows


def check_rows(rows, filled):
    """Densities in (0, 1), numbers finite; filled: the run told that all space is filled."""
    for row in rows[1:]:
        for name, text in zip(rows[0], row):
            if name == 'branch' or text == '':
                continue
            try:
                value = float(text)
            except ValueError as error:
                raise Broken('finite columns', f'{name} = {text!r} in {row}') from error
            expect(math.isfinite(value), 'finite columns', f'{name} = {text} in {row}')
            if name == 'density':
                expect(0 < value < 1 or (filled and value == 1), 'density', f'{text} in {row}')


# Shares of the largest energy and momentum so far: the error of the time steps (some tenths of
# a percent, 4 % at the slowest rates) and of the rounding (single precision 1e-7).
ENERGY_ERROR = 0.15
MOMENTUM_ERROR = 1e-5
ROUNDING_NN = 1e-9  # forces on the particles of a perfect crystal are rounding alone


def check_energies(rows):
    """Work = kinetic + elastic + dissipated; the balance is the recorded one; friction takes."""
    names = ('work', 'kinetic', 'elastic', 'dissipated', 'energy_residual')
    if not rows or any(name not in rows[0] for name in names):
        return
    columns = [rows[0].index(name) for name in names]
    largest = 0.0
    for row in rows[1:]:
        if any(row[column] == '' for column in columns[:4]):
            continue
        work, kinetic, elastic, dissipated = (float(row[column]) for column in columns[:4])
        largest = max(largest, abs(work), abs(kinetic), abs(elastic) + abs(dissipated))
        lost = work - kinetic - elastic - dissipated
        expect(kinetic >= 0, 'energy', f'kinetic {kinetic} in {row}')
        if row[columns[4]] == '':  # before any work
            continue
        expect(abs(lost) <= ENERGY_ERROR * largest, 'energy', f'{lost} J are lost in {row}')
        expect(dissipated >= -ENERGY_ERROR * largest, 'energy',
               f'{dissipated} J are dissipated in {row}')
        recorded = float(row[columns[4]]) * abs(work)
        expect(abs(lost - recorded) <= 1e-9 * largest, 'energy',
               f'{lost} J are lost, {recorded} J recorded in {row}')


def check_momentum(table):
    """Forces and momenta of the particles of a periodic cell are 0 together."""
    with open(table, encoding='utf-8') as file:
        rows = [line.rstrip('\n').split(',') for line in file if not line.startswith('#')]
    mass = [float(row[rows[0].index('diameter_nm')]) ** 3 for row in rows[1:]]
    for names, weights, floor in (
            (('fx_nN', 'fy_nN', 'fz_nN'), [1.0] * len(mass), ROUNDING_NN),
            (('vx_m_per_s', 'vy_m_per_s', 'vz_m_per_s'), mass, 0.0)):
        if any(name not in rows[0] for name in names):
            continue
        columns = [[weight * float(row[rows[0].index(name)] or 0)
                    for weight, row in zip(weights, rows[1:])] for name in names]
        every = sum(abs(number) for column in columns for number in column)
        for name, column in zip(names, columns):
            expect(abs(sum(column)) <= MOMENTUM_ERROR * every + floor, 'momentum',
                   f'{name}: {sum(column)} of {every}')


def is_prefix(part, whole, what):
    """The rows are the first ones of `whole`."""
    for index, row in enumerate(part):
        expect(index < len(whole), 'rows', f'{what}: {len(part) - len(whole)} rows too many')
        expect(row == whole[index], 'rows',
               f'{what}: row {index} is {row}, not {whole[index]}')


def check_status_file(directory, rows, ended):
    path = os.path.join(directory, 'status.json')
    try:
        with open(path, encoding='utf-8') as file:
            status = json.load(file)
    except (OSError, ValueError) as error:
        raise Broken('status.json', str(error)) from error
    expect(not ended or status['state'] != 'running', 'status.json', f'state {status["state"]}')
    expect(not ended or status['points'] == max(len(rows) - 1, 0), 'status.json',
           f'{status["points"]} points, {len(rows) - 1} rows')


def check_files(directory):
    """No file that only a writer under way has."""
    for name in os.listdir(directory):
        expect(KNOWN.fullmatch(name), 'files', f'{name} in {directory}')


def contents(directory):
    """Every file's bytes."""
    found = {}
    for folder, _, names in os.walk(directory):
        for name in names:
            path = os.path.join(folder, name)
            with open(path, 'rb') as file:
                found[path] = file.read()
    return found
