"""The program in a terminal of tmux, for cells.py, and what the terminals have found."""
import os
import pathlib
import re
import select
import shutil
import subprocess
import sys
import tempfile
import threading
import time

PATIENCE_S = 900 * float(os.environ.get('GB_TEST_PATIENCE', '1'))
MODES = {'utf8': [], 'ascii': ['--ascii'], 'mono': [], 'light': ['--theme=light']}


class Stopped(Exception):
    """A screen that is never seen, here or in another mode."""


class Results:
    """What the modes have found, line by line; none waits for long once one has stopped."""

    def __init__(self):
        self.lock = threading.Lock()
        self.tests = 0
        self.bad = 0
        self.stopped = False

    def add(self, text, faults, rows):
        with self.lock:
            self.tests += 1
            self.bad += bool(faults)
            print(f'{"not ok" if faults else "ok"} {self.tests} {text}')
            if faults:
                print('\n'.join('# ' + line for line in [*faults, *rows]))
            sys.stdout.flush()

    def end(self):
        """By a limit of time: the terminals are closed."""
        with self.lock:
            self.stopped = True
            print(f'Bail out! stopped after test {self.tests}', flush=True)

    def stop(self, text, rows):
        with self.lock:
            if not self.stopped:
                print('\n'.join('# ' + row for row in rows))
                print(f'Bail out! never seen: {text}', flush=True)
            self.stopped = True
        raise Stopped


class Terminal:
    def __init__(self, program, presets, mode, results):
        self.here = pathlib.Path(tempfile.mkdtemp())
        self.program = program
        self.mode = mode
        self.results = results
        self.socket = f'greenbody-cells-{os.getpid()}-{mode}'
        self.env = {k: v for k, v in os.environ.items()
                    if k not in ('NO_COLOR', 'COLORTERM', 'TMUX', 'LINES', 'COLUMNS')}
        self.env.update(GB_PRESET_DIR=presets, XDG_CONFIG_HOME=str(self.here / 'config'),
                        XDG_STATE_HOME=str(self.here / 'state'), LC_ALL='C.UTF-8')
        self.rows = []
        # Control mode: one client that takes commands line by line, where a process for each
        # look at the screen takes half of the time.  Its own session keeps the server alive.
        self.client = subprocess.Popen(
            ['tmux', '-u', '-C', '-L', self.socket, '-f', '/dev/null', 'new-session', 'cat'],
            env=self.env, stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0)
        self.unread = b''

    def line(self):
        """The next line of the client."""
        while b'\n' not in self.unread:
            ready, _, _ = select.select([self.client.stdout], [], [], PATIENCE_S)
            got = os.read(self.client.stdout.fileno(), 1 << 16) if ready else b''
            if not got:
                self.results.stop(f'an answer of tmux ({self.mode})', self.rows)
            self.unread += got
        line, self.unread = self.unread.split(b'\n', 1)
        return line.decode(errors='replace')

    def tmux(self, *words):
        """The lines that a command prints; none where it fails."""
        command = ' '.join("'" + str(word).replace("'", "'\\''") + "'" for word in words)
        self.client.stdin.write((command + '\n').encode())
        # "%begin TIME NUMBER FLAGS"; the flag is that of a command of this client
        while not re.fullmatch(r'%begin \d+ \d+ 1', self.line()):
            pass
        lines = []
        while not re.fullmatch(r'%(end|error) \d+ \d+ 1', line := self.line()):
            lines.append(line)
        return lines if line.startswith('%end') else []

    def start(self, words):
        before = ['env', 'NO_COLOR=1'] if self.mode == 'mono' else []
        self.tmux('new-session', '-d', '-s', 'work', '-x', 200, '-y', 60, *before,
                  self.program, *words, *MODES[self.mode])

    def capture(self):
        self.rows = self.tmux('capture-pane', '-p', '-t', 'work')
        return self.rows

    def settled(self):
        """Rows of a screen that no frame changes."""
        before = None
        while before != self.capture():
            before = self.rows
            time.sleep(0.06)
        return self.rows

    def keys(self, *names):
        self.tmux('send-keys', '-t', 'work', *names)

    def until(self, holds, what):
        end = time.monotonic() + PATIENCE_S
        while self.results.stopped or not holds(self.capture()):
            if time.monotonic() > end or self.results.stopped:
                self.results.stop(f'{what} ({self.mode})', self.rows)
            time.sleep(0.03)

    def until_shown(self, text):
        self.until(lambda rows: any(text in row for row in rows), text)

    def until_view(self, key):
        """By the title of its pane."""
        self.until(lambda rows: any(re.search(rf'[-\u2500] {key} [A-Z]', row) for row in rows),
                   f'view {key}')

    def until_gone(self, text):
        self.until(lambda rows: not any(text in row for row in rows), f'no {text}')

    def until_done(self):
        """The run of the header; State has "work done" before."""
        self.until(lambda rows: rows and 'done' in rows[0], 'done in the header')

    def resize(self, cols, rows, last='quit'):
        """`last` is a text of the last row."""
        self.tmux('resize-window', '-t', 'work', '-x', cols, '-y', rows)
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
        subprocess.run(['tmux', '-L', self.socket, 'kill-server'], env=self.env, check=False,
                       timeout=PATIENCE_S)
        self.client.communicate(timeout=PATIENCE_S)
        shutil.rmtree(self.here, ignore_errors=True)
