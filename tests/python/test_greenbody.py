"""The Python module against the program: same bits, arrays without copies, errors."""
import csv
import os
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else 'greenbody'

try:
    import numpy as np
except ImportError:
    print('SKIP: numpy is not installed')
    sys.exit(77)

import greenbody  # noqa: E402  # pylint: disable=wrong-import-position

SMALL = {'particles.count': 150, 'loading.until': '5 MPa', 'loading.unload_from': ''}


def small(**more):
    return greenbody.run('default', SMALL, **more)


def words(keys):
    return [f'{key}={value}' for key, value in keys.items()]


class Folder(unittest.TestCase):
    """A folder of its own."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)

    def at(self, name):
        return os.path.join(self._folder.name, name)

    def program(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)


class SameBits(Folder):
    """Rows of the program and of the module are equal."""

    def rows(self, directory):
        with open(os.path.join(directory, 'curve.csv'), encoding='utf-8') as file:
            return list(csv.DictReader(line for line in file if not line.startswith('#')))

    def check(self, preset, keys):
        done = self.program('run', preset, *words(keys), '--quiet', '--out', self.at('program'))
        self.assertEqual(done.returncode, 0, done.stderr)
        curve = greenbody.run(preset, keys).curve
        rows = self.rows(self.at('program'))
        self.assertEqual(len(rows), len(curve))
        for row, point in zip(rows, curve):
            self.assertEqual(float(row['density']), point['density'])
            self.assertEqual(float(row['coordination']), point['coordination'])
            self.assertEqual(int(row['evaluations']), point['evaluations'])

    def test_quasistatic(self):
        self.check('default', SMALL)

    def test_planar_dynamic(self):
        self.check('p2-v1', {'particles.count': 60, 'loading.relax': '0.005 ns',
                             'loading.hold': '0.005 ns', 'loading.until': 'density = 0.55'})

    def test_recorded(self):
        """A run that the module records is one of the program."""
        run = small(out=self.at('run'))
        again = self.program('verify', self.at('run'))
        self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
        loaded = greenbody.load(self.at('run'))
        self.assertEqual(loaded.status, 'done')
        np.testing.assert_array_equal(loaded.curve['density'], run.curve['density'])
        np.testing.assert_array_equal(loaded.states[-1].position.shape, (150, 3))

    def test_stepped(self):
        """Any division into advances gives the same points."""
        whole = small().curve
        stepped = greenbody.Experiment('default', SMALL)
        while not stepped.done:
            stepped.advance(7)
        np.testing.assert_array_equal(stepped.curve['p_pa'], whole['p_pa'])
        self.assertEqual(len(list(greenbody.Experiment('default', SMALL))), len(whole))


class Arrays(Folder):
    """Memory of the engine, and copies that outlive it."""

    def test_no_copy(self):
        run = greenbody.Experiment('default', SMALL)
        run.advance(1)
        position = run.position
        self.assertTrue(np.shares_memory(position, run.position))
        self.assertFalse(position.flags.writeable)
        before = position.copy()
        run.advance(5)
        self.assertFalse(np.array_equal(position, before))

    def test_contacts(self):
        run = small()
        self.assertEqual(len(run.contact), len(run.contact_force))
        self.assertLess(int(run.contact.max()), 150)
        self.assertEqual(run.unit('contact_force').si_unit, 'N')
        # every contact is counted at both of its particles
        self.assertEqual(int(run.coordination.sum()) % 2, 0)

    def test_outlives(self):
        run = small()
        position = run.position
        first = position[0].copy()
        del run
        np.testing.assert_array_equal(position[0], first)

    def test_state(self):
        run = small()
        run.save(self.at('state.h5'))
        state = greenbody.load(self.at('state.h5'))
        self.assertEqual(state.point['density'], run.curve['density'][-1])
        self.assertEqual(state.seed, 1)

    def test_every_array(self):
        run = small()
        state = run.state
        for name in greenbody.arrays:
            try:
                array, unit = state.array(name), state.unit(name)
            except greenbody.InputError:
                continue  # of other scenes
            self.assertFalse(array.flags.writeable, name)
            self.assertIsInstance(unit.unit, str)


class Errors(Folder):
    """The program's lines as exceptions."""

    def line(self, *arguments):
        done = self.program('run', 'default', *arguments, '--out', self.at('wrong'))
        self.assertEqual(done.returncode, 2)
        return done.stderr.strip()

    def check(self, key, value):
        with self.assertRaises(greenbody.InputError) as caught:
            greenbody.run('default', {key: value})
        self.assertIn(str(caught.exception), self.line(f'{key}={value}'))

    def test_wrong_key(self):
        self.check('particles.colour', '3')

    def test_wrong_value(self):
        self.check('contact.mu', '-1')

    def test_wrong_unit(self):
        self.check('particles.diameter', '3 MPa')

    def test_keywords(self):
        parameters = greenbody.Parameters('default', contact__mu=0.25,
                                          particles__diameter='21 nm')
        self.assertEqual(parameters['contact.mu'], '0.25')
        self.assertEqual(parameters['particles.diameter'], '21 nm')
        for wrong in ({'color': 1}, {'diameter': '21 nm'}):  # of particles or of the die?
            with self.assertRaises(greenbody.InputError):
                greenbody.Parameters('default', **wrong)

    def test_no_preset(self):
        with self.assertRaises(greenbody.InputError):
            greenbody.run('no-such-preset')

    def test_table(self):
        """The doc string has every key."""
        self.assertGreater(len(greenbody.parameters), 80)
        for key in greenbody.parameters:
            self.assertIn(key.replace('.', '__'), greenbody.run.__doc__)

    def test_missed_goal(self):
        keys = dict(SMALL, **{'loading.unload_from': '3 MPa', 'loading.until': 'density = 0.2405'})
        with warnings.catch_warnings(record=True) as seen:
            warnings.simplefilter('always')
            run = greenbody.run('default', keys)
        self.assertTrue(run.done)
        self.assertEqual([w.category for w in seen], [greenbody.GoalWarning])
        self.assertIn('loading.unload_from = 3 MPa', str(seen[0].message))


class Cancel(Folder):
    """Another thread, a callback and an interrupt end an advance."""

    def test_thread(self):
        """Cancelled, and advanced to the same end."""
        run = greenbody.Experiment('default', SMALL)
        run.cancel()
        with self.assertRaises(greenbody.CancelledError):
            run.run()
        run.run()
        np.testing.assert_array_equal(run.curve['density'], small().curve['density'])

    def test_callback(self):
        class Stop(Exception):
            """Of the callback."""

        def stop(_share, _experiment):
            raise Stop

        with self.assertRaises(Stop):
            greenbody.run('default', SMALL, count=4000, until='1 GPa', progress=stop)

    def interrupt(self, size, when):
        """An advance that SIGINT ends in the main thread, sent once `when` says so."""
        run = greenbody.Experiment('default', SMALL, count=size, until='1 GPa')
        done = threading.Event()

        def send():
            while not when(run) and not done.wait(0.005):
                pass
            signal.raise_signal(signal.SIGINT)  # Python's own handler runs in the main thread

        thread = threading.Thread(target=send)
        thread.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                run.run()
        finally:
            done.set()
            thread.join()
        self.assertLess(run.progress, 1.0)
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)
        return run

    def test_interrupt(self):
        """While it runs, where it can be advanced further."""
        run = self.interrupt(2000, lambda run: len(run) > 1)
        points = len(run)
        self.assertEqual(run.advance(2), 2)
        self.assertEqual(len(run), points + 2)

    def test_interrupt_of_packing(self):
        """While the packing is built."""
        called = threading.Event()
        run = greenbody.Experiment('default', SMALL, count=200000,
                                   progress=lambda *_: called.set() or
                                   signal.raise_signal(signal.SIGINT))
        with self.assertRaises(KeyboardInterrupt):
            run.run()
        self.assertTrue(called.is_set())
        self.assertEqual(len(run), 0)

    def test_two_at_once(self):
        """Two runs in two threads have the bits of two runs in turn."""
        alone = [small(seed=seed).curve for seed in (1, 2)]
        together = {}

        def work(seed):
            together[seed] = small(seed=seed).curve

        threads = [threading.Thread(target=work, args=(seed,)) for seed in (1, 2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for seed in (1, 2):
            np.testing.assert_array_equal(together[seed]['p_pa'], alone[seed - 1]['p_pa'])


class Sweeps(Folder):
    """Values and seeds on several cores."""

    def test_sweep(self):
        done = []
        runs = greenbody.sweep('default', {'contact.mu': [0.1, 0.3]}, 2, SMALL, workers=2,
                               progress=lambda k, n, run: done.append((k, n)))
        self.assertEqual(len(runs), 4)
        self.assertEqual(done[-1], (4, 4))
        self.assertEqual([run.seed for run in runs], [1, 2, 1, 2])
        alone = greenbody.run('default', SMALL, mu=0.3, seed=2)
        np.testing.assert_array_equal(runs[3].curve['p_pa'], alone.curve['p_pa'])
        table = runs.at_pressure(3e6)
        self.assertTrue(np.all(np.isfinite(table['density'])))

    def test_wrong_value_first(self):
        with self.assertRaises(greenbody.InputError):
            greenbody.sweep('default', {'contact.mu': [0.1, -1.0]}, 1, SMALL)

    def test_copies_of_a_cell(self):
        lattice = {'structure.kind': 'fcc', 'particles.count': 108}
        for seeds in (3, [4, 7]):
            with self.assertRaisesRegex(greenbody.InputError, 'structure.kind = fcc'):
                greenbody.sweep('default', {'contact.mu': [0.1]}, seeds, lattice)
            with self.assertRaisesRegex(greenbody.InputError, 'structure.kind = sc'):
                greenbody.sweep('default', {'structure.kind': ['grown', 'sc']}, seeds,
                                {'particles.count': 125})
        with self.assertRaisesRegex(greenbody.InputError, 'each seed once'):
            greenbody.sweep('default', {'contact.mu': [0.1]}, [1, 1], SMALL)

    def test_pandas(self):
        try:
            import pandas  # noqa: F401  # pylint: disable=unused-import
        except ImportError:
            self.skipTest('pandas is not installed')
        frame = small().curve.to_pandas()
        self.assertIn('branch_name', frame)
        self.assertEqual(set(frame['branch_name']) - {'relax', 'load'}, set())


class Laws(unittest.TestCase):
    """Contact laws by name."""

    def test_all_named(self):
        self.assertIn('rod', greenbody.laws)

    def test_rod(self):
        table = greenbody.law('rod', [0.0, 0.01, 0.02], 'default')
        force = table[table.dtype.names[-1]] if 'force' not in table.dtype.names else table.force
        self.assertEqual(len(force), 3)
        printed = subprocess.run([PROGRAM, 'law', 'rod', '--range', 'h=0:0.02:3', 'default'],
                                 capture_output=True, text=True, check=False)
        rows = [line.split(',') for line in printed.stdout.splitlines()
                if line and not line.startswith('#')]
        self.assertEqual(rows[0], list(table.dtype.names), printed.stderr)
        for row, mine in zip(rows[1:], table):
            for text, value in zip(row, mine):
                self.assertAlmostEqual(float(text), float(value), delta=1e-9 * abs(float(value)))


if __name__ == '__main__':
    unittest.main()
