#!/usr/bin/env python3
"""Every screen, cell by cell, at four sizes in four modes, in a real terminal: views, panes,
dialogs, result cards, lists, help; of a live run that is paused, of a die, of discs, of many
runs, and the list of runs.  The modes have a terminal each and run side by side.

Usage: cells.py GREENBODY PRESET_FOLDER [MODE...] [PART...]

Checked on the characters that tmux holds: borders of panes and boxes and the axis of a plot
are whole (no text over them), no number is cut (at an edge none is the beginning of one that
the widest screen shows, and none stands before an ellipsis behind other words), the footer
is whole, ASCII is ASCII, and a terminal without colours gets none.
"""
import concurrent.futures
import re
import signal
import subprocess
import sys
import time

from cell_checks import (check_axis, check_box, check_mode, check_numbers, check_panes,
                         numbers)
from cell_terminal import MODES, PATIENCE_S, Results, Stopped, Terminal

SIZES = [(200, 60), (120, 40), (80, 24), (60, 20)]  # the widest first
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
FAULT_STAYS_S = 30
LIVE_DIALOGS = [('f', 'What-if: continue'), ('q', 'Quit?')]


class Walk:
    def __init__(self, terminal, mode, results):
        self.terminal = terminal
        self.mode = mode
        self.results = results
        self.whole = {}  # numbers of the widest screen by what is shown

    def faults_of(self, name, cols, box):
        terminal, faults = self.terminal, []
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
        whole = self.whole.get(name, numbers(inner))
        # in ASCII the sign of a verdict is that of an ellipsis
        verdicts = re.search('curves|difference', name.lower())
        cut = CUT if self.mode != 'ascii' else None if verdicts else CUT_ASCII
        check_numbers(inner, cols, edges, whole, faults, cut)
        check_mode(terminal, self.mode, name, faults)
        return faults, rows, whole

    def check(self, name, cols, lines, box=False, last='quit'):
        """A fault is one that stays: on a busy machine half a frame may stay for a while."""
        self.terminal.until(lambda rows: len(rows) == lines and last in rows[-1] or box, name)
        end = time.monotonic() + FAULT_STAYS_S
        faults, rows, whole = self.faults_of(name, cols, box)
        while faults and time.monotonic() < end:
            faults, rows, whole = self.faults_of(name, cols, box)
        self.whole.setdefault(name, whole)
        self.results.add(f'{self.mode} {cols}x{lines}: {name}', faults, rows)

    def views(self, cols, lines):
        listed = subprocess.run([self.terminal.program, '--views'], capture_output=True,
                                text=True, timeout=PATIENCE_S).stdout.splitlines()
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
        self.terminal.until_gone('z shows')

    def dialogs(self, cols, lines, listed):
        for key, title in listed:
            self.terminal.keys(*key)
            self.terminal.until_shown(title[:20])
            if key == 'c':  # without a frame at the sides
                rows = self.terminal.settled()
                faults = [] if any('greenbody run' in row for row in rows) else ['no command']
                self.results.add(f'{self.mode} {cols}x{lines}: the command', faults, rows)
            else:
                self.check(f'dialog {title}', cols, lines, box=True)
            self.terminal.keys('Escape')
            self.terminal.until_gone(title[:20])

    def editors(self, cols, lines):
        self.terminal.keys('/', 'path', 'Enter', 'Enter')
        self.terminal.until_shown('Legs of loading.path')
        self.check('dialog Legs of loading.path', cols, lines, box=True)
        self.terminal.keys('Escape', 'Escape')
        self.terminal.until_gone('Legs of')
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
        self.terminal.start(['default', 'particles.count=300', 'contact.mu=0.15625',
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
        self.terminal.until_gone('Result: ')

    def live(self):
        """A paused run, whose counters are longer."""
        self.terminal.start(['default', 'particles.count=3000', 'loading.step=0.02%'])
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
        self.terminal.start(words)
        self.terminal.until_done()

        def each(cols, lines):
            for key in keys:
                self.terminal.keys(key)
                self.terminal.until_view(key)
                self.check(f'{words[0]}: view {key}', cols, lines)

        self.sizes(each)
        self.terminal.end()

    def many(self):
        """A sweep, and the list of runs with that of `main_screen`."""
        there = self.terminal.here / 'map'
        subprocess.run([self.terminal.program, 'sweep', 'default', 'particles.count=100',
                        'loading.until=200 MPa', 'loading.unload_from=', '--quiet',
                        '--vary', 'contact.mu=0.1;0.3', '--vary', 'contact.alpha=0.24;0.4',
                        '--replicas', '2', '--out', there], env=self.terminal.env, check=True,
                       timeout=PATIENCE_S)
        self.terminal.start(['attach', there])
        self.terminal.until_shown('8 runs: 8 done')

        def each(cols, lines):
            for key in '123':
                self.terminal.keys(key)
                self.terminal.until_view(key)
                self.check(f'many runs: view {key}', cols, lines)

        self.sizes(each)
        self.terminal.end()

    def picker(self):
        self.terminal.start(['attach'])
        self.terminal.until_shown('Esc leaves')
        for cols, lines in SIZES:
            self.terminal.resize(cols, lines, 'Esc leaves')
            # a frame of the size before, which tmux has cropped, ends with the keys, too
            self.terminal.until(lambda rows: re.search('live, .*B *$', rows[0]),
                                'the size at the end of the header')
            self.check('list of runs', cols, lines, last='Esc leaves')
            self.terminal.keys('DC')
            self.terminal.until_shown('y deletes')
            self.check('list of runs: delete?', cols, lines, last='Esc leaves')
            self.terminal.keys('n')
            self.terminal.until_gone('y deletes')
        self.terminal.end('Escape')


    def cards(self):
        """Each result is made once; `W`, Left and Right show all of them at each size."""
        terminal = self.terminal
        terminal.start(['default', 'particles.count=100', 'numerics.fidelity=fast',
                        'loading.until=50MPa', 'loading.unload_from='])
        terminal.until_done()
        made = self.results_made()

        def each(cols, lines):
            terminal.keys('W')
            for title in made:
                terminal.until_shown(f'Result: {title}')
                self.check(f'dialog Result: {title}', cols, lines, box=True)
                terminal.keys('Left')
            terminal.keys('Escape')
            terminal.until_gone('Result: ')

        self.sizes(each, self.reading)
        terminal.end()

    def reading(self, cols, lines):
        """A file that can be read in two ways."""
        data = self.terminal.here / 'two.csv'
        data.write_text('Druck (MPa);Dichte (%)\n1,125;40\n2,125;55\n')
        self.terminal.keys('e')
        self.terminal.until_shown('Measured data')
        self.terminal.keys('C-u', str(data), 'Enter')
        self.terminal.until_shown('How is this file')
        self.check('dialog How is this file read?', cols, lines, box=True)
        self.terminal.keys('Escape')
        self.terminal.until_gone('How is this file')

    def long_run(self):
        """The question before a long run."""
        self.terminal.start(['p2-v5'])
        self.terminal.until_shown('A long run: start it?')
        self.terminal.until_gone('quick cell')
        self.sizes(lambda cols, lines: self.check('dialog A long run: start it?', cols, lines,
                                                  box=True))
        self.terminal.keys('n')
        self.terminal.until_gone('A long run')
        self.terminal.end()

    def results_made(self):
        """Titles, the newest first."""
        terminal = self.terminal
        made = []

        def makes(title, *keys):
            for key in keys:
                terminal.keys(key)
            terminal.until_shown(f'Result: {title}')
            made.insert(0, title)
            terminal.keys('Escape')
            terminal.until_gone('Result: ')

        version = subprocess.run([terminal.program, '--version'], capture_output=True,
                                 text=True, timeout=PATIENCE_S).stdout
        if 'no pictures' not in version:
            makes('picture', 's', 'Enter')
        makes('report', 'x')
        makes('elastic moduli', 'Y')
        makes('accuracy against cost', 'X', 'C-u', '2 1ms', 'Enter')
        terminal.keys('T')
        terminal.until_shown('T Stab')
        makes('stability of the methods', 'X', '10 MPa', 'Enter')
        terminal.keys('1')
        data = terminal.here / 'small.csv'
        data.write_text('p_MPa,density,density_error\n20,0.30,0.01\n50,0.35,0.01\n')
        terminal.keys('e')
        terminal.until_shown('Measured data')
        terminal.keys('C-u', str(data), 'Enter')
        terminal.until_shown('points reached')
        makes('calibration', 'C', 'C-u', 'mu=0.05:0.4,alpha=0.2:0.5', 'Enter')
        return made


def prepare(terminal):
    """Two runs, the first with more digits than a narrow legend has room for, and data."""
    data = terminal.here / 'lab.csv'
    data.write_text('density,density_error,p_MPa\n0.3,0.01,12.25\n0.35,0.01,50.125\n')
    terminal.until_done()
    terminal.keys('/', 'contact.mu', 'Enter', 'Enter')
    terminal.until_shown('Enter accepts')
    terminal.keys('0.2875', 'Enter')
    terminal.until_shown('run 2 started')
    terminal.until_done()
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
         'many': Walk.many, 'picker': Walk.picker, 'cards': Walk.cards,
         'long': Walk.long_run}


def walk_mode(program, presets, mode, parts, results):
    terminal = Terminal(program, presets, mode, results)
    try:
        walk = Walk(terminal, mode, results)
        for part in parts:
            part(walk)
    except Stopped:
        pass
    finally:
        terminal.finish()


def main():
    program, presets = sys.argv[1:3]
    modes = [word for word in sys.argv[3:] if word in MODES] or list(MODES)
    parts = [PARTS[word] for word in sys.argv[3:] if word in PARTS] or list(PARTS.values())
    results = Results()
    signal.signal(signal.SIGTERM, lambda *_: results.end())
    with concurrent.futures.ThreadPoolExecutor(len(modes)) as pool:
        walks = [pool.submit(walk_mode, program, presets, mode, parts, results)
                 for mode in modes]
    for walk in walks:
        walk.result()
    if not results.stopped:
        print(f'1..{results.tests}')
    return 1 if results.bad or results.stopped else 0


if __name__ == '__main__':
    sys.exit(main())
