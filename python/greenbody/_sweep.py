"""Many runs on several cores."""
from __future__ import annotations

import itertools
import os
import pathlib
import threading
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from typing import Any, Callable, Dict, Iterable, List, Mapping, Optional, Sequence, Union

import numpy as np

from ._data import Curve
from ._experiment import Experiment
from ._library import GreenbodyError, InputError
from ._parameters import Keys, Parameters, Preset
from ._states import Path


class SweepRun:
    """One run of a sweep: its values, seed, curve, and the error that ended it (or None)."""

    def __init__(self, values: Dict[str, Any], seed: int, parameters: Parameters) -> None:
        self.values = values
        self.seed = seed
        self.parameters = parameters
        self.curve: Optional[Curve] = None
        self.error: Optional[GreenbodyError] = None

    def at_pressure(self, p_pa: float, member: str = 'density') -> float:
        """A member of the points on loading where the pressure first reaches p_pa; NaN: never."""
        return float('nan') if self.curve is None else self.curve.at_pressure(p_pa, member)

    def __repr__(self) -> str:
        how = 'not run' if self.curve is None else f'{len(self.curve)} points'
        return f'<SweepRun {self.values} seed {self.seed}: {self.error or how}>'


class Sweep(Sequence[SweepRun]):
    """The runs of a sweep, the last key fastest, then the seeds."""

    def __init__(self, runs: List[SweepRun]) -> None:
        self.runs = runs

    def __len__(self) -> int:
        return len(self.runs)

    def __getitem__(self, index):  # type: ignore[no-untyped-def]
        return self.runs[index]

    @property
    def failed(self) -> List[SweepRun]:
        """The runs that did not end."""
        return [run for run in self.runs if run.error is not None]

    def at_pressure(self, p_pa: float, member: str = 'density') -> np.ndarray:
        """A structured array: values and seed of each run, and the member at a pressure."""
        names = list(self.runs[0].values) if self.runs else []
        columns = [np.array([run.values[name] for run in self.runs]) for name in names]
        columns.append(np.array([run.seed for run in self.runs], dtype='u8'))
        columns.append(np.array([run.at_pressure(p_pa, member) for run in self.runs]))
        return np.rec.fromarrays(columns, names=names + ['seed', member])

    def to_pandas(self) -> Any:
        """A pandas.DataFrame of all points: values and seed of the run in the first columns."""
        import pandas
        tables = []
        for run in self.runs:
            if run.curve is not None:
                table = run.curve.to_pandas()
                table.insert(0, 'seed', run.seed)
                for name, value in reversed(list(run.values.items())):
                    table.insert(0, name, value)
                tables.append(table)
        return pandas.concat(tables, ignore_index=True) if tables else pandas.DataFrame()


def _plan(preset: Preset, values: Mapping[str, Iterable[Any]], seeds: List[int], keys: Keys,
          more: Dict[str, Any]) -> List[SweepRun]:
    """All runs, with parameters that are checked before the first one begins."""
    runs = []
    names = [name.replace('__', '.') for name in values]
    for combination in itertools.product(*(list(v) for v in values.values())):
        for seed in seeds:
            parameters = Parameters(preset, keys, **more)
            parameters.update_keys(dict(zip(names, combination)))
            parameters['structure.seed'] = seed
            if parameters['numerics.threads'] == 'auto':
                parameters['numerics.threads'] = 1
            parameters.check()
            parameters.check_cells(len(seeds))
            runs.append(SweepRun(dict(zip(names, combination)), seed, parameters))
    return runs


def _name(run: SweepRun) -> str:
    """The name of its directory, as `greenbody sweep` names them, and the seed."""
    short = [key.split('.')[-1] for key in run.values]
    parts = []
    for key, last in zip(run.values, short):
        text = run.parameters.label('material.name' if key == 'material' else key)
        parts.append(f'{last if short.count(last) == 1 else key}-{text}')
    return '_'.join(parts + [f'seed-{run.seed}'])


def _directories(out: Path, runs: List[SweepRun]) -> Dict[SweepRun, pathlib.Path]:
    """A directory of its own for each run."""
    names: Dict[str, SweepRun] = {}
    for run in runs:
        other = names.setdefault(_name(run), run)
        if other is not run:
            raise InputError(f'{run.values} seed {run.seed}: given twice; expected each value '
                             'and seed once where runs have directories')
    return {run: pathlib.Path(out) / name for name, run in names.items()}


class _Work:
    """The runs under way, so that all can be cancelled."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.under_way: List[Experiment] = []
        self.stopped = False

    def do(self, run: SweepRun, directory: Optional[pathlib.Path], replace: bool) -> SweepRun:
        experiment = None
        try:
            with self.lock:
                if self.stopped:
                    return run
                experiment = Experiment(run.parameters, out=directory, replace=replace)
                self.under_way.append(experiment)
            experiment.run()
        except GreenbodyError as error:
            error.experiment = None
            run.error = error
        if experiment is not None:
            run.curve = experiment.curve
            experiment.close()
            with self.lock:
                self.under_way.remove(experiment)
        return run

    def stop(self) -> None:
        with self.lock:
            self.stopped = True
            for experiment in self.under_way:
                experiment.cancel()


def sweep(preset: Preset = None, values: Optional[Mapping[str, Iterable[Any]]] = None,
          seeds: Union[int, Iterable[int]] = 1, keys: Keys = None, *,
          workers: Optional[int] = None, out: Optional[Path] = None, replace: bool = False,
          progress: Optional[Callable[[int, int, SweepRun], Any]] = None,
          **more: Any) -> Sweep:
    """Runs all combinations of values with several seeds, on several cores.

    values    {"contact.mu": [0.1, 0.3], "particles.diameter": ["9.7 nm", "38 nm"]}
    seeds     how many (1, 2, ...), or which
    keys      changes common to all runs, also as keywords
    workers   runs at a time, one thread each; None: the cores of the machine
    out       directory with a run directory for each; None: not recorded
    progress  function of (runs done, runs, run), called in this thread

    Wrong keys or values raise InputError before the first run begins, and so do several seeds
    for a lattice or a packing from a file, which are the same cell for every seed.  A run that is stopped
    keeps its points and its error; the others continue.  KeyboardInterrupt cancels all.
    """
    chosen = list(range(1, seeds + 1)) if isinstance(seeds, int) else list(seeds)
    if len(set(chosen)) < len(chosen):
        raise InputError(f'seeds = {chosen}: expected each seed once')
    runs = _plan(preset, values or {}, chosen, keys, more)
    directories = {} if out is None else _directories(out, runs)
    work = _Work()
    count = workers or len(os.sched_getaffinity(0))
    with ThreadPoolExecutor(max_workers=max(1, count)) as pool:
        left = {pool.submit(work.do, run, directories.get(run), replace) for run in runs}
        try:
            _wait(left, len(runs), progress)
        except BaseException:
            work.stop()
            raise
    return Sweep(runs)


def _wait(left: 'set[Future[SweepRun]]', count: int,
          progress: Optional[Callable[[int, int, SweepRun], Any]]) -> None:
    while left:
        finished, left = wait(left, timeout=0.2, return_when=FIRST_COMPLETED)
        for future in finished:
            run = future.result()
            if progress is not None:
                progress(count - len(left), count, run)
