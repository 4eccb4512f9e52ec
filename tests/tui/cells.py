#!/usr/bin/env python3
"""Every screen, cell by cell, at four sizes in four modes, in a real terminal: views, panes,
dialogs, cards, lists, help; of a live run that is paused, of a die, of discs, of many runs, and
the list of runs.

Usage: cells.py GREENBODY PRESET_FOLDER [MODE...] [PART...]

Checked on the characters that tmux holds: borders of panes and boxes and the axis of a plot
are whole (no text over them), no number is cut (at an edge none is the beginning of one that
the widest screen shows, and none stands before an ellipsis behind other words), the footer
is whole, ASCII is ASCII, and a terminal without colours gets none.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

PATIENCE_S = 900 * float(os.environ.get('GB_TEST_PATIENCE', '1'))
SIZES = [(200, 60), (120, 40), (80, 24), (60, 20)]  # the widest first
MODES = {'utf8': [], 'ascii': ['--ascii'], 'mono': [], 'light': ['--theme=light']}
BELOW_ROWS = 3  # message and footer
VERTICAL = set('│├┤┼┬┴┌┐└┘|+')
AXIS = set('│┤┼├└┬')
NUMBER = re.compile(r'[-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?')
CUT = re.compile(r'\S [-+]?\d[\d.]*…')
CUT_ASCII = re.compile(r'\S [-+]?\d[\d.]*(?<=\d)~(?=\s|$|[|])')
DIALOGS = [('?', 'Keys and glossary'), ('/', 'Find a parameter'), ('o', 'Open a preset'),
           ('d', 'Choose a material'), ('w', 'Save the parameters'), ('e', 'Measured data'),
           ('@', 'Densities at a pressure'), ('#', 'Densities of the curves'),
           ('R', 'Replicas of this scene'), ('C', 'Calibration'), ('c', 'Shell command'),
           ('O', 'Curves (Enter names'), ('Z', 'Ranges of the axes'),
           ('s', 'Picture of the last'), ('X', 'Accuracy against cost of'),
           ('TX', 'Stability of this scene'), ('EW', 'Result: ')]
DIE = ['p3-hertz-mu0', 'numerics.fidelity=fast', 'particles.count=40']
DISCS = ['p2-v1', 'particles.count=150', 'loading.relax=0.005 ns', 'loading.hold=0.005 ns']
LIVE_DIALOGS = [('f', 'What-if: continue'), ('q', 'Quit?')]


class Terminal:
    def __init__(self, program, presets):
        self.here = pathlib.Path(tempfile.mkdtemp())
        self.program = program
        self.socket = f'greenbody-cells-{os.getpid()}'
        self.env = {k: v for k, v in os.environ.items()
                    if k not in ('NO_COLOR', 'COLORTERM', 'TMUX', 'LINES', 'COLUMNS')}
        self.env.update(GB_PRESET_DIR=presets, XDG_CONFIG_HOME=str(self.here / 'config'),
                        XDG_STATE_HOME=str(self.here / 'state'), LC_ALL='C.UTF-8')
        self.rows = []

    def tmux(self, *words):
        return subprocess.run(['tmux', '-u', '-L', self.socket, '-f', '/dev/null', *words],
                              env=self.env, capture_output=True, text=True).stdout

    def start(self, mode, words):
        before = ['env', 'NO_COLOR=1'] if mode == 'mono' else []
        self.tmux('new-session', '-d', '-x', '200', '-y', '60', *before, self.program,
                  *words, *MODES[mode])

    def capture(self):
        self.rows = self.tmux('capture-pane', '-p').split('\n')[:-1]
        return self.rows

    def settled(self):
        """Rows of a screen that no frame changes."""
        before = None
        while before != self.capture():
            before = self.rows
            time.sleep(0.06)
        return self.rows

    def keys(self, *names):
        self.tmux('send-keys', *names)

    def until(self, holds, what):
        end = time.monotonic() + PATIENCE_S
        while not holds(self.capture()):
            if time.monotonic() > end:
                print('\n'.join('# ' + row for row in self.rows))
                print(f'Bail out! never seen: {what}')
                sys.exit(1)
            time.sleep(0.03)

    def until_shown(self, text):
        self.until(lambda rows: any(text in row for row in rows), text)

    def resize(self, cols, rows, last='quit'):
        """`last` is a text of the last row."""
        self.tmux('resize-window', '-x', str(cols), '-y', str(rows))
        self.until(lambda seen: len(seen) == rows and last in seen[-1] and
                   max(len(row.rstrip()) for row in seen[:-1]) >= cols - 2, f'{cols}x{rows}')

    def end(self, key='q'):
        """Quits, and a live run stops."""
        def ended(rows):
            if any('Quit?' in row for row in rows):
                self.keys('y')
            return not rows
        self.keys(key)
        self.until(ended, 'the end')

    def finish(self):
        self.tmux('kill-server')
        shutil.rmtree(self.here, ignore_errors=True)


def cells(row, cols):
    return row.ljust(cols)


def box_of(rows, title):
    """Corners of the box with this title: row, left, right, last row; None: no box."""
    for top, row in enumerate(rows):
        match = re.search(r'[┌+][─-]+ ' + re.escape(title) + r'.* [─-]*[┐+]', row)
        if match and top + 1 < len(rows):
            left, right = match.start(), match.end() - 1
            last = top + 1
            while last < len(rows) and cells(rows[last], right + 1)[left] in '│|':
                last += 1
            if last > top + 1 and last < len(rows):
                return top, left, right, last
    return None


def check_box(rows, title, faults):
    """The box is closed; returns it."""
    box = box_of(rows, title)
    if box is None:
        faults.append('no box')
        return None
    top, left, right, last = box
    for at in range(top + 1, last):
        if cells(rows[at], right + 1)[right] not in '│|':
            faults.append(f'right border of the box in row {at + 1}')
    bottom = cells(rows[last], right + 1)[left:right + 1]
    if not re.fullmatch(r'[└+][─-]+[┘+]', bottom):
        faults.append('bottom of the box')
    return box


def borders_of(rows):
    """Columns of the vertical borders, each with the row that it begins in."""
    joins = re.finditer(r'[─-]([┬+])[─-]', rows[1] if len(rows) > 1 else '')
    return [match.start(1) for match in joins]


def check_panes(rows, cols, faults):
    """Borders between panes are whole down to the row before the message."""
    columns = borders_of(rows)
    for col in columns:
        above = rows[:-BELOW_ROWS]
        last = max((at for at, row in enumerate(above) if cells(row, cols)[col] in VERTICAL),
                   default=0)
        for at in range(1, last + 1):
            if cells(rows[at], cols)[col] not in VERTICAL:
                faults.append(f'border of column {col + 1} in row {at + 1}')
    return columns


def check_axis(rows, cols, faults):
    """The ticks of an axis stand in one column, with nothing else between them and the
    corner where the other axis begins."""
    ticks = {}
    for at, row in enumerate(rows):
        for match in re.finditer(r'\d(┤)', row):
            ticks.setdefault(match.start(1), []).append(at)
    for col, found in ticks.items():
        column = [cells(row, cols)[col] for row in rows]
        while found:
            first = found[0]
            corner = column.index('└', first) if '└' in column[first:] else None
            axis = [at for at in found if corner is None or at < corner]
            found = found[len(axis):]  # of the axis of another pane below
            if len(axis) < 2:  # a single number before a border
                continue
            if corner is None:
                faults.append(f'axis of column {col + 1} without its corner')
            for at in range(first, corner or axis[-1]):
                if column[at] not in AXIS:
                    faults.append(f'axis of column {col + 1} in row {at + 1}: {column[at]!r}')


def numbers(rows):
    return {token for row in rows for token in NUMBER.findall(row)}


def check_numbers(rows, cols, edges, whole, faults, cut):
    """No number at an edge is the beginning of one of the wide screen; none before an
    ellipsis behind a word."""
    for at, row in enumerate(rows[:-1]):
        if cut and cut.search(row):
            faults.append(f'cut number in row {at + 1}: {row.strip()}')
        for edge in edges:
            left = cells(row, cols)[:edge].rstrip(' ')
            if len(left) < edge - 1:
                continue
            match = re.search(NUMBER.pattern + r'$', left)
            if match and match[0] not in whole and any(
                    token != match[0] and token.startswith(match[0]) for token in whole):
                faults.append(f'number at the edge in row {at + 1}: {match[0]}')


def check_mode(terminal, mode, name, faults):
    if mode == 'ascii' and any(ord(c) > 126 for row in terminal.rows for c in row):
        faults.append('not ASCII')
    sent = terminal.tmux('capture-pane', '-p', '-e')
    colours = set(re.findall(r'\x1b\[[0-9;]*(?:[34][0-7]|[34]8;5;\d+|9[0-7]|10[0-7])m', sent))
    if mode == 'mono' and colours:
        faults.append(f'colours: {colours}')
    # the shades of a packing are backgrounds
    if mode == 'light' and 'view 9' not in name and any('48;5;' in c for c in colours):
        faults.append('a background of its own')


class Walk:
    def __init__(self, terminal, mode):
        self.terminal = terminal
        self.mode = mode
        self.whole = {}  # numbers of the widest screen by what is shown
        self.tests = 0
        self.bad = 0

    def check(self, name, cols, lines, box=False, last='quit'):
        terminal, faults = self.terminal, []
        terminal.until(lambda rows: len(rows) == lines and last in rows[-1] or box, name)
        rows = terminal.settled()
        edges = [cols]
        if box:
            found = check_box(rows, name.removeprefix('dialog '), faults)
            edges = [found[2]] if found else []
            inner = rows[found[0] + 1:found[3]] if found else []
        else:
            edges += check_panes(rows, cols, faults)
            check_axis(rows, cols, faults)
            inner = rows
        self.whole.setdefault(name, numbers(inner))
        # in ASCII the sign of a verdict is that of an ellipsis
        verdicts = re.search('curves|difference', name.lower())
        cut = CUT if self.mode != 'ascii' else None if verdicts else CUT_ASCII
        check_numbers(inner, cols, edges, self.whole[name], faults, cut)
        check_mode(terminal, self.mode, name, faults)
        self.tests += 1
        good = not faults
        self.bad += not good
        print(f'{"ok" if good else "not ok"} {self.tests} {self.mode} {cols}x{lines}: {name}',
              flush=True)
        if faults:
            print('\n'.join('# ' + text for text in faults))
            print('\n'.join('# ' + row for row in rows), flush=True)

    def views(self, cols, lines):
        listed = subprocess.run([self.terminal.program, '--views'], capture_output=True,
                                text=True).stdout.splitlines()
        for line in listed:
            key, title = line.split(' ', 1)
            self.terminal.keys(key)
            self.terminal.until_shown(f'{key} {title}'[:16])
            self.check(f'view {key} {title}', cols, lines)
        self.terminal.keys('1')
        self.terminal.until_shown('1 Pressure')

    def panes(self, cols, lines):
        for count in range(4):
            self.check(f'pane {count}', cols, lines)
            self.terminal.keys('Tab')
        self.terminal.keys('z')
        self.terminal.until_shown('z shows all again')
        self.check('zoom', cols, lines)
        self.terminal.keys('z')
        self.terminal.until(lambda rows: not any('z shows' in row for row in rows), 'unzoomed')

    def dialogs(self, cols, lines, listed):
        for key, title in listed:
            self.terminal.keys(*key)
            self.terminal.until_shown(title[:20])
            if key == 'c':  # without a frame at the sides
                self.tests += 1
                good = any('greenbody run' in row for row in self.terminal.settled())
                self.bad += not good
                print(f'{"ok" if good else "not ok"} {self.tests} {self.mode} '
                      f'{cols}x{lines}: the command')
            else:
                self.check(f'dialog {title}', cols, lines, box=True)
            self.terminal.keys('Escape')
            self.terminal.until(lambda rows: not any(title[:20] in row for row in rows),
                                f'{title} closed')

    def editors(self, cols, lines):
        self.terminal.keys('/', 'path', 'Enter', 'Enter')
        self.terminal.until_shown('Legs of loading.path')
        self.check('dialog Legs of loading.path', cols, lines, box=True)
        self.terminal.keys('Escape', 'Escape')
        self.terminal.until(lambda rows: not any('Legs of' in row for row in rows), 'legs closed')
        self.terminal.keys('/', 'n_d0', 'Enter', 'Enter')
        self.terminal.until_shown('Typing')
        self.check('a parameter being edited', cols, lines)
        self.terminal.keys('Escape', 'g', '1')


    def sizes(self, *parts):
        """Each part at each size."""
        for cols, lines in SIZES:
            self.terminal.resize(cols, lines)
            for part in parts:
                part(cols, lines)

    def main_screen(self):
        """Two runs and measured data."""
        self.terminal.start(self.mode, ['default', 'particles.count=300', 'contact.mu=0.15625',
                                        'loading.until=60MPa', 'loading.unload_from=30MPa'])
        prepare(self.terminal)
        self.card()
        self.sizes(self.views, self.panes,
                   lambda cols, lines: self.dialogs(cols, lines, DIALOGS), self.editors)
        self.terminal.end()

    def card(self):
        """Two replicas, whose result opens by itself and whose mean stays."""
        self.terminal.keys('R')
        self.terminal.until_shown('Replicas of this scene')
        self.terminal.keys('C-u', '2', 'Enter')
        self.terminal.until_shown('Result: replicas')
        self.sizes(lambda cols, lines: self.check('dialog Result: replicas', cols, lines,
                                                  box=True))
        self.terminal.keys('Escape')
        self.terminal.until(lambda rows: not any('Result: ' in row for row in rows), 'no card')

    def live(self):
        """A paused run, whose counters are longer."""
        self.terminal.start(self.mode, ['default', 'particles.count=3000',
                                        'loading.step=0.02%'])
        asked = 'the full cell takes long'  # on a slow machine
        self.terminal.until(lambda rows: 'running' in rows[0] or
                            any(asked in row for row in rows), 'the full cell')
        if 'running' not in self.terminal.rows[0]:
            self.terminal.keys('r')
            self.terminal.until_shown('A long run')
            self.terminal.keys('y')
            self.terminal.until(lambda rows: 'running' in rows[0], 'the full cell')
        self.terminal.keys('p')
        self.terminal.until_shown('paused')
        self.sizes(lambda cols, lines: self.check('paused', cols, lines),
                   lambda cols, lines: self.dialogs(cols, lines, LIVE_DIALOGS))
        self.terminal.end()

    def views_of(self, words, keys):
        """A few views of another scene."""
        self.terminal.start(self.mode, words)
        self.terminal.until_shown('done')

        def each(cols, lines):
            for key in keys:
                self.terminal.keys(key)
                self.terminal.until_shown(f'{key} ')
                self.check(f'{words[0]}: view {key}', cols, lines)

        self.sizes(each)
        self.terminal.end()

    def many(self):
        """A sweep, and the list of runs with that of `main_screen`."""
        there = self.terminal.here / 'map'
        subprocess.run([self.terminal.program, 'sweep', 'default', 'particles.count=100',
                        'loading.until=200 MPa', 'loading.unload_from=', '--quiet',
                        '--vary', 'contact.mu=0.1;0.3', '--vary', 'contact.alpha=0.24;0.4',
                        '--replicas', '2', '--out', there], env=self.terminal.env, check=True)
        self.terminal.start(self.mode, ['attach', there])
        self.terminal.until_shown('8 runs: 8 done')

        def each(cols, lines):
            for key in '123':
                self.terminal.keys(key)
                self.terminal.until_shown(f'{key} ')
                self.check(f'many runs: view {key}', cols, lines)

        self.sizes(each)
        self.terminal.end()

    def picker(self):
        self.terminal.start(self.mode, ['attach'])
        self.terminal.until_shown('Esc leaves')
        for cols, lines in SIZES:
            self.terminal.resize(cols, lines, 'Esc leaves')
            # a frame of the size before, which tmux has cropped, ends with the keys, too
            self.terminal.until(lambda rows: re.search('live, .*B *$', rows[0]),
                                'the size at the end of the header')
            self.check('list of runs', cols, lines, last='Esc leaves')
        self.terminal.end('Escape')


def prepare(terminal):
    """Two runs, the first with more digits than a narrow legend has room for, and data."""
    data = terminal.here / 'lab.csv'
    data.write_text('density,density_error,p_MPa\n0.3,0.01,12.25\n0.35,0.01,50.125\n')
    done = 'done'
    terminal.until_shown(done)
    terminal.keys('/', 'contact.mu', 'Enter', 'Enter')
    terminal.until_shown('Enter accepts')
    terminal.keys('0.2875', 'Enter')
    terminal.until_shown('run 2 started')
    terminal.until_shown(done)
    terminal.keys('e')
    terminal.until_shown('Measured data')
    terminal.keys(str(data), 'Enter')
    terminal.until(lambda rows: any('points reached' in row for row in rows), 'the misfit')
    terminal.keys('E')
    terminal.until_shown('Heckel')
    terminal.keys('1')


PARTS = {'main': Walk.main_screen, 'live': Walk.live,
         'die': lambda walk: walk.views_of(DIE, '19'),
         'discs': lambda walk: walk.views_of(DISCS, '139'),
         'many': Walk.many, 'picker': Walk.picker}


def main():
    program, presets = sys.argv[1:3]
    modes = [word for word in sys.argv[3:] if word in MODES] or list(MODES)
    parts = [PARTS[word] for word in sys.argv[3:] if word in PARTS] or PARTS.values()
    tests, bad = 0, 0
    for mode in modes:
        terminal = Terminal(program, presets)
        try:
            walk = Walk(terminal, mode)
            walk.tests, walk.bad = tests, bad
            for part in parts:
                part(walk)
            tests, bad = walk.tests, walk.bad
        finally:
            terminal.finish()
    print(f'1..{tests}')
    return 1 if bad else 0


if __name__ == '__main__':
    sys.exit(main())
