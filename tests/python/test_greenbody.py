"""The Python module against the program: same bits, arrays, errors, processes."""
import concurrent.futures
import copy
import csv
import multiprocessing
import os
import pickle
import shutil
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


#: one kind of scene each: one size, many sizes with time, a die
SCENES = [('default', SMALL),
          ('p2-3d-v1', {'particles.count': 500, 'particles.distribution': 'lognormal'}),
          ('p3-hertz-mu0', {'particles.count': 60, 'die.diameter': '60 um'})]


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

    def test_kept(self):
        """Every array of every kind of scene keeps its values over advances and the end."""
        for preset, keys in SCENES:
            run = greenbody.Experiment(preset, keys)
            run.advance(2)
            arrays = {}
            for name in greenbody.arrays:
                try:
                    arrays[name] = run.array(name)
                except greenbody.InputError:
                    continue  # of other scenes
            self.assertIn('torque', arrays)
            self.assertIn('diameter', arrays)
            before = {name: array.copy() for name, array in arrays.items()}
            run.advance(3)
            moved = not np.array_equal(run.position, arrays['position'])
            run.close()
            del run
            litter = [bytearray(array.nbytes) for array in arrays.values() for _ in range(3)]
            for name, array in arrays.items():
                self.assertFalse(array.flags.writeable, name)
                np.testing.assert_array_equal(array, before[name], f'{preset} {name}')
            self.assertTrue(moved)
            del litter

    def test_other_thread(self):
        """While a thread advances, another is refused; afterwards it may read."""
        seen = []

        def look(_share, experiment):
            if seen or len(experiment) == 0:
                return
            experiment.position  # the thread that advances may  # pylint: disable=W0104

            def other():
                for use in (lambda: experiment.position, lambda: experiment.contact,
                            experiment.advance, experiment.close,
                            lambda: experiment.save(self.at('x.h5'))):
                    try:
                        use()
                        seen.append('nothing')
                    except RuntimeError as error:
                        seen.append(str(error))

            thread = threading.Thread(target=other)
            thread.start()
            thread.join()

        run = greenbody.Experiment('default', SMALL, count=2000, until='1 GPa', progress=look)
        while not seen:
            run.advance(1)
        self.assertEqual(set(seen), {'the experiment is advanced by another thread'})
        self.assertEqual(run.position.shape, (2000, 3))
        with self.assertRaises(greenbody.InputError):
            run.advance(-1)

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


    def names(self, values, seeds=1, **keys):
        """The directories of a sweep, each with a run of its own values."""
        runs = greenbody.sweep('default', values, seeds, SMALL, out=self.at('out'),
                               replace=True, **keys)
        found = {}
        for name in os.listdir(self.at('out')):
            found[name] = greenbody.load(os.path.join(self.at('out'), name))
        self.assertEqual(len(found), len(runs))
        for run in runs:
            same = [loaded for loaded in found.values()
                    if all(loaded.parameters[key] == run.parameters[key]
                           for key in run.values)
                    and loaded.parameters['structure.seed'] == str(run.seed)]
            self.assertEqual(len(same), 1, run)
            self.assertEqual(same[0].status, 'done')
        return sorted(found)

    def test_names(self):
        """Values that differ in any character have directories of their own."""
        titles = [f'a{chr(c)}b' for c in range(32, 127)] + ['ab', 'a/../b', 'ä', 'x' * 90,
                                                            'x' * 91]
        names = self.names({'scene.title': titles}, count=60, until='1 MPa')
        self.assertIn('title-ab_seed-1', names)
        self.assertIn('title-a~26b_seed-1', names)

    def test_names_of_numbers(self):
        """As before, and as `greenbody sweep` names them."""
        self.assertEqual(self.names({'contact.mu': [0.1, 0.3], 'particles.diameter': ['9.7 nm']}),
                         ['mu-0.1_diameter-9.7nm_seed-1', 'mu-0.3_diameter-9.7nm_seed-1'])

    def test_given_twice(self):
        with self.assertRaises(greenbody.InputError) as caught:
            greenbody.sweep('default', {'contact.mu': ['0.1', '0.10']}, 1, SMALL,
                            out=self.at('out'))
        self.assertIn('given twice', str(caught.exception))
        self.assertFalse(os.path.exists(self.at('out')))

    def test_pickled(self):
        """A sweep and its errors are plain data."""
        runs = greenbody.sweep('default', {'contact.mu': [0.1]}, 1, SMALL, workers=1)
        again = pickle.loads(pickle.dumps(runs))
        np.testing.assert_array_equal(again[0].curve['p_pa'], runs[0].curve['p_pa'])
        self.assertEqual(dict(again[0].parameters), dict(runs[0].parameters))


class Texts(Folder):
    """What a NUL would cut is refused, wherever a text goes to the library."""

    def test_nul(self):
        parameters = greenbody.Parameters('default', SMALL)
        run = greenbody.Experiment(parameters)
        run.advance(1)
        path = self.at('cut') + '\0.h5'
        for use in (lambda: greenbody.Parameters('default\0x'),
                    lambda: greenbody.Parameters('default', {'contact.mu\0x': 1}),
                    lambda: greenbody.Parameters('default', {'scene.title': 'a\0b'}),
                    lambda: parameters['contact.mu\0x'],
                    lambda: parameters.save(path), lambda: run.save(path),
                    lambda: greenbody.State(path), lambda: greenbody.Run(path),
                    lambda: greenbody.Experiment(parameters, out=path),
                    lambda: greenbody.Experiment.resume(path),
                    lambda: greenbody.Experiment.from_state(path, parameters),
                    lambda: run.array('position\0x'),
                    lambda: run.state.array('position\0x'),
                    lambda: greenbody.law('rod\0x', [0.0]),
                    lambda: greenbody.law('lattice', [0.0], lattice='sc\0x')):
            with self.assertRaises(ValueError):
                use()
        self.assertEqual(os.listdir(self._folder.name), [])

    def test_any_bytes(self):
        """A title and a path of other bytes come back as they are."""
        title = b'\xe4'.decode('utf-8', 'surrogateescape')
        parameters = greenbody.Parameters('default', SMALL)
        out = self.at(title)
        greenbody.run(parameters, out=out)
        self.assertEqual(greenbody.load(out).status, 'done')
        try:
            parameters['scene.title'] = title
        except greenbody.InputError:
            return  # refused as a whole
        self.assertEqual(parameters['scene.title'], title)


def press_in_pool(pool, **keys):
    """Four seeds by the map of a pool."""
    return list(pool.map(greenbody.press, seeds(**keys), timeout=240))


def seeds(**keys):
    return [greenbody.Parameters('default', SMALL, seed=k, **keys) for k in range(1, 5)]


def module(name):
    """Is it installed for this Python?"""
    done = subprocess.run([sys.executable, '-c', f'import {name}'], check=False,
                          capture_output=True)
    return done.returncode == 0


class Processes(Folder):
    """Objects at the border of a process."""

    def test_parameters(self):
        """Of every preset, by pickle and copies, with every key."""
        for preset in greenbody.presets():
            parameters = greenbody.Parameters(preset)
            for again in (pickle.loads(pickle.dumps(parameters)), copy.copy(parameters),
                          copy.deepcopy(parameters)):
                self.assertEqual(dict(again), dict(parameters), preset)
        again['contact.mu'] = 0.77
        self.assertNotEqual(parameters['contact.mu'], '0.77')

    def test_refused(self):
        """What has memory of the library is neither pickled nor copied."""
        run = greenbody.Experiment('default', SMALL)
        run.advance(1)
        run.save(self.at('state.h5'))
        for thing in (run, run.state, greenbody.load(self.at('state.h5')), [run]):
            for use in (pickle.dumps, copy.deepcopy):
                with self.assertRaises(TypeError):
                    use(thing)
        for thing in (run, run.state):
            with self.assertRaises(TypeError):
                copy.copy(thing)
        self.assertTrue(pickle.dumps(run.position))

    def test_press(self):
        """The points of `run`; recorded, continued and returned."""
        parameters = greenbody.Parameters('default', SMALL)
        plain = small()
        done = greenbody.press(parameters)
        self.assertEqual((done.status, done.reason, done.directory), ('done', '', None))
        np.testing.assert_array_equal(done.curve['p_pa'], plain.curve['p_pa'])
        half = greenbody.Experiment(parameters, threads=1, out=self.at('run'))
        half.advance(5)
        half.close()
        for _ in range(2):
            done = greenbody.press(parameters, self.at('run'))
            self.assertEqual(done.status, 'done')
            np.testing.assert_array_equal(done.curve['p_pa'], plain.curve['p_pa'])
        again = pickle.loads(pickle.dumps(done))
        np.testing.assert_array_equal(again.curve['p_pa'], plain.curve['p_pa'])
        self.assertEqual(len(again.states), 1)
        parameters['contact.mu'] = 0.77
        with self.assertRaises(greenbody.InputError):
            greenbody.press(parameters, self.at('run'))

    def test_missed(self):
        """A goal that was missed is a reason, and an error reaches the parent."""
        parameters = greenbody.Parameters(
            'default', SMALL, unload_from='3 MPa', until='density = 0.2405')
        self.assertIn('loading.unload_from = 3 MPa', greenbody.press(parameters).reason)
        parameters['contact.mu'] = 0.1
        parameters['particles.count'] = 100
        wrong = greenbody.Parameters(parameters, {'loading.unload_from': '3 MPa',
                                                  'loading.until': '1 MPa'})
        with concurrent.futures.ProcessPoolExecutor(1) as pool:
            here = there = None
            try:
                greenbody.press(wrong)
            except greenbody.GreenbodyError as error:
                here = error
            try:
                pool.submit(greenbody.press, wrong).result(120)
            except greenbody.GreenbodyError as error:
                there = error
            self.assertIsNotNone(here)
            self.assertEqual((type(here), str(here)), (type(there), str(there)))

    def check(self, runs):
        for run, parameters in zip(runs, seeds()):
            np.testing.assert_array_equal(run.curve['p_pa'],
                                          greenbody.press(parameters).curve['p_pa'])
        self.assertEqual(len(runs), 4)

    def test_pools(self):
        """concurrent.futures and multiprocessing, forked with a run under way, and spawned."""
        with greenbody.Experiment('default', SMALL, count=1000, threads=2) as parent:
            parent.advance(2)
            for method in ('fork', 'spawn'):
                context = multiprocessing.get_context(method)
                with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as pool:
                    self.check(press_in_pool(pool))
                with context.Pool(2) as pool:
                    self.check(pool.map_async(greenbody.press, seeds()).get(240))
                    with self.assertRaises(TypeError):
                        pool.map_async(type, [parent]).get(240)

    def test_fork(self):
        """A child that inherits a recorded run ends, and leaves its directory alone."""
        run = greenbody.Experiment('default', SMALL, count=1000, threads=2, out=self.at('run'))
        run.advance(3)
        with open(self.at('run/events.log'), encoding='utf-8') as file:
            events = file.read()
        for use in ('del run', 'run.close()', 'run.position', 'run.advance(1)'):
            pid = os.fork()
            if pid == 0:
                signal.alarm(120)
                code = 0
                try:
                    if use == 'del run':
                        del run
                    elif use == 'run.close()':
                        run.close()
                    else:
                        code = 1
                        eval(use)  # pylint: disable=eval-used
                except greenbody.InputError:
                    code = 0
                finally:
                    os._exit(code)  # pylint: disable=protected-access
            self.assertEqual(os.waitpid(pid, 0)[1], 0, use)
        with open(self.at('run/events.log'), encoding='utf-8') as file:
            self.assertEqual(file.read(), events)
        run.run()
        self.assertTrue(run.done)

    def test_fork_to_the_end(self):
        """The same for a child that ends as a script does."""
        script = ('import os, sys, greenbody\n'
                  'run = greenbody.Experiment("default", {"particles.count": 300,'
                  ' "loading.until": "5 MPa", "loading.unload_from": ""}, threads=2,'
                  ' out=sys.argv[1])\n'
                  'run.advance(3)\n'
                  'pid = os.fork()\n'
                  'if pid:\n'
                  '    assert os.waitpid(pid, 0)[1] == 0\n'
                  '    run.run()\n')
        done = subprocess.run([sys.executable, '-c', script, self.at('run')], check=False,
                              capture_output=True, text=True, timeout=240)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        with open(self.at('run/events.log'), encoding='utf-8') as file:
            self.assertNotIn('left before its end', file.read())
        self.assertEqual(greenbody.load(self.at('run')).status, 'done')

    def recipe(self, word):
        """The block of the page that has this word, as a script; the page is its source."""
        page = os.path.join(os.path.dirname(__file__), '..', '..', 'docs', 'many-runs.md')
        with open(page, encoding='utf-8') as file:
            blocks = file.read().split('```python\n')[1:]
        found = [block.split('```')[0] for block in blocks if word in block]
        self.assertEqual(len(found), 1, word)
        with open(self.at('recipe.py'), 'w', encoding='utf-8') as file:
            file.write(found[0])
        return self.at('recipe.py')

    def run_recipe(self, *command):
        """Its runs are those of `press` alone, and a second time they are only read."""
        for _ in range(2):
            done = subprocess.run(command, cwd=self._folder.name, check=False,
                                  capture_output=True, text=True, timeout=300)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(len(done.stdout.split()), 8, done.stdout)
        for k in range(1, 9):
            run = greenbody.load(self.at(f'runs/seed-{k}'))
            self.assertEqual(run.status, 'done')
        alone = greenbody.press(run.parameters)
        np.testing.assert_array_equal(run.curve['density'], alone.curve['density'])
        self.assertAlmostEqual(float(done.stdout.split()[7]), run.curve['density'][-1])

    def test_recipe_of_futures(self):
        self.run_recipe(sys.executable, self.recipe('ProcessPoolExecutor'))

    def test_recipe_of_mpi(self):
        if not module('mpi4py') or not shutil.which('mpiexec'):
            self.skipTest('mpi4py or mpiexec is not installed (python3-mpi4py)')
        root = ['--allow-run-as-root'] if os.geteuid() == 0 else []
        help_text = subprocess.run(['mpiexec', '--version'], check=False, capture_output=True,
                                   text=True).stdout
        options = root + ['--oversubscribe'] if 'Open' in help_text else []
        self.run_recipe('mpiexec', *options, '-n', '3', sys.executable, '-m', 'mpi4py.futures',
                        self.recipe('MPIPoolExecutor'))

    def test_recipe_of_dask(self):
        if not module('distributed'):
            self.skipTest('dask.distributed is not installed (python3-distributed)')
        self.run_recipe(sys.executable, self.recipe('dask.distributed'))


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
    unittest.main(verbosity=2)  # with the reasons of what is skipped
