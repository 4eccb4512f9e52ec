"""One case: a scene and the steps of a run directory, with what must hold after each."""
import fcntl
import math
import os
import resource
import shutil
import signal
import subprocess
import time

from check import (Broken, answer, check_energies, check_files, check_momentum, check_rows,
                   check_status_file, contents, expect, is_prefix, read_rows)
import scenes

# Seconds after which only a hang is under way, and the processor time of a scene that is too long
# for a case.
PATIENCE = int(os.environ.get('GB_TEST_PATIENCE', '1'))
HANG_S = 300 * PATIENCE
LONG_S = 12 * PATIENCE

SIGNALS = {'kill': signal.SIGKILL, 'term': signal.SIGTERM, 'int': signal.SIGINT,
           'hup': signal.SIGHUP}


class TooLong(Exception):
    """The scene takes longer than a case may."""


class Refused(Exception):
    """The scene was refused, as it should be."""


def random_steps(rng, random_edit, random_change):
    """Three to eight steps."""
    steps = []
    for _ in range(rng.randrange(3, 9)):
        do = rng.choices(['go', 'verify', 'attach', 'threads', 'move', 'occupied', 'edit',
                          'what-if', 'picture'], [14, 2, 2, 2, 1, 2, 2, 2, 1])[0]
        step = {'do': do}
        if do == 'go':
            step['end'] = rng.choices(['kill', 'term', 'int', 'hup', 'stand', 'size', 'none'],
                                      [8, 4, 2, 2, 3, 4, 1])[0]
            step['after'] = round(rng.uniform(0, 1.1), 3)
            step['bytes'] = int(10 ** rng.uniform(2, 6))
            step['clock'] = rng.random() < 0.3
            step['watch'] = rng.random() < 0.2
        elif do == 'threads':
            step['count'] = rng.choice([1, 2, 3, 4])
        elif do == 'edit':
            step['key'], step['value'] = random_edit(rng)
        elif do == 'what-if':
            step['at'], step['change'] = round(rng.random(), 3), random_change(rng)
        steps.append(step)
    return steps


class Life:
    """Does the steps of a case in a folder of its own; raises Broken."""

    def __init__(self, tools, folder, case):
        self.tools, self.folder = tools, folder
        self.preset, self.keys = case['preset'], dict(case['keys'])
        self.steps = case['steps']
        self.directory = os.path.join(folder, 'life')
        self.straight = os.path.join(folder, 'straight')
        self.rows, self.status, self.length, self.filled = [], 0, 0.0, False
        self.started, self.errors = [], {}  # processes, and the files of their stderr

    # --- the program ----------------------------------------------------------------------

    def _start(self, words, clock=False, limit=None):
        environment = dict(os.environ)
        if clock and self.tools.leap_clock:
            environment['LD_PRELOAD'] = self.tools.leap_clock

        def limited():
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

        errors_path = os.path.join(self.folder, f'stderr-{len(self.started)}')
        with open(errors_path, 'wb') as errors:
            process = subprocess.Popen(
                [self.tools.greenbody, *words], stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL, stderr=errors, cwd=self.folder, env=environment,
                start_new_session=True, preexec_fn=limited if limit else None)
        self.started.append(process)
        self.errors[process] = errors_path
        return process

    def _send(self, process, what):
        """A signal to all processes of a command."""
        if process.poll() is None:
            os.killpg(process.pid, what)

    def _clear(self):
        """Nothing of a case that failed goes on."""
        for process in self.started:
            self._send(process, signal.SIGKILL)
            process.wait(HANG_S)

    @staticmethod
    def _looked_up(process):
        """Processor time of a process under way, and whether any of its threads wants more."""
        ticks, wants = 0, False
        folder = f'/proc/{process.pid}/task'
        try:
            for thread in os.listdir(folder):
                with open(f'{folder}/{thread}/stat', encoding='utf-8') as file:
                    words = file.read().rpartition(')')[2].split()
                ticks += int(words[11]) + int(words[12])
                wants = wants or words[0] == 'R'
        except OSError:  # it ends
            return 0.0, True
        return ticks / os.sysconf('SC_CLK_TCK'), wants

    def _ended(self, process, processor_s, what):
        """Exit status; TooLong beyond the processor time.

        A hang waits, or computes, for as long as HANG_S; what waits for a processor of a busy
        machine does not hang.
        """
        waited, used = 0.0, 0.0
        while waited < HANG_S and used < min(processor_s, HANG_S):
            try:
                return process.wait(0.2)
            except subprocess.TimeoutExpired:
                used, wants = self._looked_up(process)
                waited = 0.0 if wants else waited + 0.2
        self._send(process, signal.SIGKILL)
        process.wait(HANG_S)
        if used >= processor_s:
            raise TooLong()
        raise Broken('hang', what)

    def _wait(self, process, processor_s=math.inf, what=''):
        """Exit status, and what stderr has."""
        status = self._ended(process, processor_s, what)
        with open(self.errors[process], encoding='utf-8', errors='backslashreplace') as file:
            return status, file.read()

    def _command(self, *words):
        return self._wait(self._start(words), what=' '.join(words))

    def _new(self, out):
        words = [f'{key}={value}' for key, value in self.keys.items()]
        return ['run', self.preset, *words, '--yes', '--quiet', '--out', out]

    # --- the undisturbed run --------------------------------------------------------------

    def _undisturbed(self):
        """Curve, status and length of the scene without steps."""
        shutil.rmtree(self.straight, ignore_errors=True)
        start = time.monotonic()
        status, stderr = self._wait(self._start(self._new('straight')), LONG_S, 'run')
        self.length = time.monotonic() - start
        answer(status, stderr, {0, 1, 2}, 'run')
        if status == 2:
            # the only input that is found under way (run/change.h)
            expect('lies on an unloading branch' in stderr or not os.path.exists(self.straight),
                   'refused', 'and a directory is made')
            raise Refused(stderr)
        self.status, self.filled = status, 'all space is filled' in stderr
        self.rows = read_rows(self.straight)
        check_rows(self.rows, self.filled)
        if not scenes.is_unstable(self.keys):
            check_energies(self.rows)
        check_status_file(self.straight, self.rows, True)
        check_files(self.straight)
        self._balance()

    def _balance(self):
        """Momentum of the last state, where no wall takes any."""
        if scenes.has_walls(self.preset) or \
                not os.path.exists(os.path.join(self.straight, 'state.h5')):
            return
        table = os.path.join(self.folder, 'particles.csv')
        status, stderr = self._command('export', self.straight, '--format', 'csv', '-o', table,
                                       '--force')
        answer(status, stderr, {0}, 'export')
        check_momentum(table)

    def _has_run(self):
        return os.path.exists(os.path.join(self.directory, 'preset.ini'))

    def _written(self):
        """What a run that has begun changes."""
        path = os.path.join(self.directory, 'status.json')
        return os.stat(path).st_mtime_ns if os.path.exists(path) else None

    def _looked_at(self, what):
        """The rows there are, each one of the undisturbed run."""
        rows = read_rows(self.directory)
        is_prefix(rows, self.rows, what)
        return rows

    # --- steps ----------------------------------------------------------------------------

    def _begin(self, step, limit=None):
        if self._has_run():
            words = ['resume', '--quiet', self.directory]
        else:
            shutil.rmtree(self.directory, ignore_errors=True)
            words = self._new(self.directory)
        return self._start(words, step.get('clock', False), limit)

    @staticmethod
    def _stands(process):
        with open(f'/proc/{process.pid}/stat', encoding='utf-8') as file:
            return file.read().rpartition(')')[2].split()[0] in 'TtZ'

    def _is_locked(self):
        """Whether an engine has begun to write there."""
        try:
            lock = os.open(os.path.join(self.directory, '.lock'), os.O_RDONLY)
        except FileNotFoundError:
            return False
        try:
            fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
            return False
        except BlockingIOError:
            return True
        finally:
            os.close(lock)

    def _stand(self, process):
        """Stopped in the middle, a run is its engine's alone; then it goes on."""
        self._send(process, signal.SIGSTOP)
        while process.poll() is None and not self._stands(process):
            time.sleep(0.01)
        if self._has_run() and self._is_locked():
            status, stderr = self._command('resume', '--quiet', self.directory)
            answer(status, stderr, {2}, 'resume of a run under way')
        self._send(process, signal.SIGCONT)

    def _go(self, step):
        end = step['end']
        resumed, written = self._has_run(), self._written()
        process = self._begin(step, step['bytes'] if end == 'size' else None)
        watcher = self._watch() if step.get('watch') else None
        accepted = {self.status}
        before = []
        if end == 'size':
            accepted.add(3)
        elif end != 'none':
            try:
                process.wait(step['after'] * self.length)
            except subprocess.TimeoutExpired:
                # resume cuts what lies behind the checkpoint before it writes its status
                has_cut = not resumed or self._written() != written
                rows = self._looked_at('a run under way')
                before = rows if has_cut else []
                if end == 'stand':
                    self._stand(process)
                else:
                    self._send(process, SIGNALS[end])
                    accepted |= {-9} if end == 'kill' else {128 + SIGNALS[end], -SIGNALS[end]}
        status, stderr = self._wait(process, what=f'run with {end}')
        if watcher is not None:
            seen, told = self._wait(watcher, what='attach')
            self._attached(seen, told)
        # before it has begun, any program ends by the signal alone
        expect(status >= 0 or end == 'kill' or self._written() == written, 'exit status',
               f'signal {-status} ended a run that had begun')
        answer(status, stderr, accepted, f'run with {end}')
        if not self._has_run():
            return
        rows = self._looked_at(f'after {end}')
        if end == 'kill':
            is_prefix(before, rows, 'rows there before the kill')
        if status >= 0 and status != 3:
            check_status_file(self.directory, rows, True)
            check_files(self.directory)

    def _verify(self, _step):
        if not self._has_run():
            return
        before = contents(self.directory)
        status, stderr = self._command('verify', self.directory)
        answer(status, stderr, {0, 2}, 'verify')
        expect(contents(self.directory) == before, 'verify', 'changed the directory')

    def _watch(self):
        """A second process that follows a run under way, once there is one."""
        end = time.monotonic() + self.length
        while time.monotonic() < end and not self._has_run():
            time.sleep(0.01)
        return self._start(['attach', self.directory]) if self._has_run() else None

    def _attached(self, status, stderr):
        lines = [line for line in stderr.split('\n') if line.startswith('greenbody: ')]
        expect(status in {0, 1, 2, 3} and len(lines) == (status != 0), 'attach',
               f'status {status}, {stderr!r}')

    def _attach(self, _step):
        if not self._has_run():
            return
        before = contents(self.directory)
        self._attached(*self._command('attach', self.directory))
        expect(contents(self.directory) == before, 'attach', 'changed the directory')

    def _threads(self, step):
        path = os.path.join(self.directory, 'preset.ini')
        if not self._has_run():
            return
        with open(path, encoding='utf-8') as file:
            lines = [f'threads = {step["count"]}' if line.startswith('threads = ') else line
                     for line in file.read().split('\n')]
        with open(path, 'w', encoding='utf-8') as file:
            file.write('\n'.join(lines))

    def _move(self, _step):
        if self._has_run():
            moved = os.path.join(self.folder, 'moved')
            os.rename(self.directory, moved)
            self.directory, moved = moved, self.directory
            if os.path.basename(moved) == 'moved':
                os.rename(self.directory, moved)
                self.directory = moved

    def _occupied(self, _step):
        if self._has_run():
            before = contents(self.directory)
            status, stderr = self._command(*self._new(self.directory))
            answer(status, stderr, {2}, 'run in an occupied directory')
            expect(contents(self.directory) == before, 'occupied', 'changed the directory')

    def _with_keys(self, keys):
        """The scene of other keys, unless it is refused or too long."""
        before = (self.keys, self.rows, self.status, self.length, self.filled)
        kept = self.straight + '-kept'
        shutil.rmtree(kept, ignore_errors=True)
        os.rename(self.straight, kept)
        self.keys = keys
        try:
            self._undisturbed()
        except (Refused, TooLong):
            self.keys, self.rows, self.status, self.length, self.filled = before
            shutil.rmtree(self.straight, ignore_errors=True)
            os.rename(kept, self.straight)
            return False
        shutil.rmtree(self.directory, ignore_errors=True)
        return True

    def _edit(self, step):
        """As --force does: the old run is replaced as a whole."""
        old = self.directory if self._has_run() else None
        kept = os.path.join(self.folder, 'old')
        if old:
            shutil.copytree(old, kept)
        if self._with_keys({**self.keys, step['key']: step['value']}) and old:
            os.rename(kept, self.directory)
            status, stderr = self._command(*self._new(self.directory), '--force')
            answer(status, stderr, {self.status}, 'run --force')
            rows = self._looked_at('run --force')
            expect(rows == self.rows, 'rows', f'{len(rows)} of {len(self.rows)} after --force')
            check_files(self.directory)
        shutil.rmtree(kept, ignore_errors=True)

    def _what_if(self, step):
        """Up to the change the curve is the one before."""
        old = self.rows
        if len(old) < 3 or 'loading.changes' in self.keys:
            return
        at = int(1 + step['at'] * (len(old) - 2))
        number = old[0].index('step')
        after = int(old[at][number])
        if self._with_keys({**self.keys, 'loading.changes': f'{after} {step["change"]}'}):
            same = [row for row in old[1:] if row[0] == 'load' and int(row[number]) <= after]
            new = [row for row in self.rows[1:] if row[0] == 'load' and int(row[number]) <= after]
            names = [old[0].index(name) for name in ('density', 'p_MPa')]
            for one, two in zip(same, new):
                expect([one[k] for k in names] == [two[k] for k in names], 'what-if',
                       f'{one} before the change, {two} with it')

    def _picture(self, _step):
        """The picture of a run repeats it."""
        picture = os.path.join(self.folder, 'picture.png')
        status, _ = self._command('snapshot', self.straight, '-o', picture, '--force')
        if status == 0:
            out = os.path.join(self.folder, 'again')
            shutil.rmtree(out, ignore_errors=True)
            status, stderr = self._command('run', '--from', picture, '--yes', '--quiet',
                                           '--out', out)
            answer(status, stderr, {self.status}, 'run --from')
            expect(read_rows(out) == self.rows, 'run --from', 'another curve')

    def _finish(self):
        """Resumed to the end: the undisturbed run."""
        self._go({'end': 'none'})
        rows = self._looked_at('at the end')
        expect(rows == self.rows, 'rows', f'{len(rows)} rows at the end of {len(self.rows)}')
        check_rows(rows, self.filled)
        check_files(self.directory)
        if os.path.exists(os.path.join(self.straight, 'state.h5')):
            done = subprocess.run([self.tools.same_state, self.straight, self.directory],
                                  stderr=subprocess.PIPE, text=True, check=False,
                                  timeout=HANG_S)
            expect(done.returncode == 0, 'state', done.stderr.strip())
            status, stderr = self._command('verify', self.directory)
            answer(status, stderr, {0}, 'verify at the end')

    def live(self):
        """All steps; 'ok', or 'refused' or 'long' of a scene that is not run."""
        try:
            self._undisturbed()
        except Refused as refused:
            return f'refused: {refused}'.strip()
        except TooLong:
            return 'long'
        steps = {'go': self._go, 'verify': self._verify, 'attach': self._attach,
                 'threads': self._threads, 'move': self._move, 'occupied': self._occupied,
                 'edit': self._edit, 'what-if': self._what_if, 'picture': self._picture}
        try:
            for number, step in enumerate(self.steps):
                where = f'step {number + 1}, {step["do"]}'
                steps[step['do']](step)
            where = 'end'
            self._finish()
        except Broken as broken:
            raise Broken(broken.name, f'{where}: {broken}') from broken
        finally:
            self._clear()
        return 'ok'
