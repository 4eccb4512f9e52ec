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
