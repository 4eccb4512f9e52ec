"""Runs: an Experiment to step, and `run` from begin to end."""
from __future__ import annotations

import contextlib
import os
import signal
import sys
import threading
import time
import warnings
from typing import Any, Callable, Iterator, List, Optional, Tuple, Union

import ctypes

import numpy as np

from ._data import Curve, Packing, Unit, copied, read_points
from ._library import (ON_EVENT, ON_POINT, ON_PROGRESS, CancelledError, Error, GoalWarning,
                       GreenbodyError, GuardError, Handle, InputError, NotConvergedError,
                       call, create, decoded, lib, path_of)
from ._parameters import Keys, Parameters, Preset, keys_doc
from ._states import Path, Run, State, parameters_of

Progress = Union[bool, Callable[[float, 'Experiment'], Any], None]

NONE, DONE, STOPPED, CANCELLED, FAILED = range(5)
ALL_POINTS = 2 ** 63 - 1

#: arrays that the engine has; the others are lists of the present contacts, made for all at once
ENGINE = frozenset(('position', 'diameter', 'force', 'torque', 'velocity', 'spin', 'cell',
                    'tilt'))


class Bar:
    """Progress as one line on a stream that is rewritten."""

    def __init__(self, stream: Any = None, width: int = 40) -> None:
        self.stream = stream if stream is not None else sys.stderr
        self.width = width
        self.begun = time.monotonic()
        self.shown = 0.0

    def __call__(self, share: float, experiment: 'Experiment') -> None:
        now = time.monotonic()
        if now - self.shown >= 0.2 or share >= 1.0:
            self.shown = now
            full = int(share * self.width)
            self.stream.write(f'\r[{"#" * full}{"." * (self.width - full)}] {share:4.0%} '
                              f'{len(experiment)} points {now - self.begun:.0f} s')
            self.stream.flush()

    def close(self) -> None:
        self.stream.write('\n')


class Experiment(Packing):
    """One run, advanced point by point.

    preset    name or path of a preset, or Parameters
    keys      changes as a dict, {"contact.mu": 0.3}; or as keywords, `contact__mu=0.3`, `mu=0.3`
    out       directory that records the run, as `greenbody run --out`; None: not recorded
    replace   an old run in that directory is removed
    progress  True: a bar on stderr; or a function of (share, experiment)
    on_event  function of (step, text): guards, beginning of an unloading, ...

    >>> e = Experiment('p1-set2-9.7nm', count=500)
    >>> for point in e:
    ...     print(point['density'], e.contact_normal.max())

    Arrays are read only, and keep their values over the next advance.  Positions may lie outside
    of the periodic cell by any number of edges.

    One thread at a time uses an experiment; `cancel` and the points are for any thread.  It
    belongs to the process that made it: it cannot be pickled, and a child that inherits it by
    fork can read its points and parameters and nothing else.
    """

    def __init__(self, preset: Preset = None, keys: Keys = None, *,
                 out: Optional[Path] = None, replace: bool = False, progress: Progress = None,
                 on_event: Optional[Callable[[int, str], Any]] = None, **more: Any) -> None:
        parameters = Parameters(preset, keys, **more)
        self._start(create('simulation', 'create', parameters._handle), progress, on_event)
        if out is not None:
            call('simulation_record', self._handle, path_of(out), replace)

    @classmethod
    def resume(cls, directory: Path, *, before: bool = False, progress: Progress = None,
               on_event: Optional[Callable[[int, str], Any]] = None) -> 'Experiment':
        """Continues the run in a directory from its last checkpoint, recorded there.

        before  from the checkpoint before the last one, where that is damaged
        """
        self = cls.__new__(cls)
        function = 'resume_before' if before else 'resume'
        self._start(create('simulation', function, path_of(directory)), progress, on_event)
        return self

    @classmethod
    def from_state(cls, path: Path, preset: Preset = None, keys: Keys = None, *,
                   progress: Progress = None,
                   on_event: Optional[Callable[[int, str], Any]] = None,
                   **more: Any) -> 'Experiment':
        """Continues from a state that `save` or a run of the same parameters has written."""
        self = cls.__new__(cls)
        parameters = Parameters(preset, keys, **more)
        self._start(create('simulation', 'load', parameters._handle, path_of(path)), progress,
                    on_event)
        return self

    def _start(self, handle: Handle, progress: Progress,
               on_event: Optional[Callable[[int, str], Any]]) -> None:
        self._handle = handle
        self._progress = Bar() if progress is True else progress or None
        self._event = on_event
        self._failure: Optional[BaseException] = None
        self._state: Optional[State] = None
        self._points: List[Curve] = []
        self._advances = False
        self.done = False
        # kept, so that the library can call them as long as the experiment exists
        self._calls = (ON_PROGRESS(self._on_progress), ON_EVENT(self._on_event))
        # also without a function: an interrupt of Python is noticed here
        lib.gb_simulation_on_progress(handle, self._calls[0], None, 0.1)
        if on_event is not None:
            lib.gb_simulation_on_event(handle, self._calls[1], None)
        #: the parameters as run
        self.parameters = parameters_of(handle)

    def __reduce__(self) -> Any:
        """Its memory, threads and files belong to its process."""
        return self._handle.__reduce__()

    @contextlib.contextmanager
    def _alone(self) -> Iterator[None]:
        """Excludes other threads.  Raises RuntimeError while one of them advances."""
        if not self._handle.lock.acquire(blocking=not self._advances):
            raise RuntimeError('the experiment is advanced by another thread')
        try:
            yield
        finally:
            self._handle.lock.release()

    def _guarded(self, function: Callable[..., Any], *arguments: Any) -> None:
        """An exception in a callback, also KeyboardInterrupt, cancels the advance."""
        try:
            function(*arguments)
        except BaseException as failure:  # pylint: disable=broad-except
            self._failure = self._failure or failure
            self.cancel()

    @contextlib.contextmanager
    def _interrupts(self) -> Iterator[None]:
        """An interrupt cancels the advance and is raised after it.

        Python calls the handler at the first line of a callback, before any `try` in it, where
        ctypes drops exceptions.
        """
        previous = signal.getsignal(signal.SIGINT)
        if threading.current_thread() is not threading.main_thread() or not callable(previous):
            yield
            return
        signal.signal(signal.SIGINT, lambda *arguments: self._guarded(previous, *arguments))
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, previous)

    def _on_progress(self, _data: Any, _simulation: Any, share: float) -> None:
        self._guarded(self._progress or (lambda *_: None), share, self)

    def _on_event(self, _data: Any, _simulation: Any, step: int, text: bytes) -> None:
        self._guarded(self._event or (lambda *_: None), step, decoded(text))

    def advance(self, points: Optional[int] = 1) -> int:
        """Advances by so many recorded points; None: to the end.  Returns how many there were.

        Raises GuardError or NotConvergedError where the run was stopped, CancelledError where it
        was cancelled, KeyboardInterrupt after one: the points so far are kept, and after the
        last two it can be advanced further.  A run that misses a goal warns
        (GoalWarning).
        """
        if points is not None and not 0 <= points <= ALL_POINTS:
            raise InputError(f'points = {points}: expected 0 to {ALL_POINTS}, or None')
        with self._alone():
            if self._advances:
                raise RuntimeError('the experiment is advanced already')
            self._advances = True
            try:
                return self._advance(ALL_POINTS if points is None else points)
            finally:
                self._advances = False

    def _advance(self, points: int) -> int:
        before = len(self)
        error = Error()
        self._state = None
        self._failure = None
        with self._interrupts():
            outcome = lib.gb_simulation_advance(self._handle, points, ctypes.byref(error))
            if self._failure is not None and outcome == NONE:  # after the last of the points
                outcome = lib.gb_simulation_advance(self._handle, 1, ctypes.byref(error))
        self.done = outcome == DONE
        if isinstance(self._progress, Bar) and outcome != NONE:
            self._progress(self.progress, self)
            self._progress.close()
        if outcome in (DONE, STOPPED, FAILED):
            lib.gb_simulation_leave(self._handle)
        if self._failure is not None:
            raise self._failure
        if outcome == DONE and error.code:
            warnings.warn(decoded(error.text), GoalWarning, stacklevel=4)
        if outcome in (STOPPED, CANCELLED, FAILED):
            raise self._exception(error)
        return len(self) - before

    def _exception(self, error: Error) -> GreenbodyError:
        failure = error.exception()
        failure.experiment = self
        return failure

    def run(self) -> 'Experiment':
        """Advances to the end; returns itself."""
        self.advance(None)
        return self

    def __iter__(self) -> Iterator[np.record]:
        """Advances point by point to the end, and gives each point."""
        while not self.done:
            if self.advance(1):
                yield self.curve[-1]

    def cancel(self) -> None:
        """Ends the advance under way in any thread, or the next one."""
        lib.gb_simulation_cancel(self._handle, None)

    def close(self) -> None:
        """Writes the last files of a recorded run and unlocks its directory."""
        with self._alone():
            lib.gb_simulation_leave(self._handle)

    def __enter__(self) -> 'Experiment':
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __len__(self) -> int:
        """Recorded points so far."""
        return lib.gb_simulation_points(self._handle)

    @property
    def progress(self) -> float:
        """Share of the loading that is done, 0 to 1."""
        return lib.gb_simulation_progress(self._handle)

    @property
    def curve(self) -> Curve:
        """The recorded points so far: a structured array with a row each."""
        have = sum(len(part) for part in self._points)
        if have < len(self):
            self._points.append(read_points(lib.gb_simulation_point(self._handle, k)
                                            for k in range(have, len(self))))
            self._points = [np.concatenate(self._points).view(Curve)]
        return self._points[0] if self._points else read_points([])

    @property
    def state(self) -> State:
        """The packing as it is now, as an object that outlives the next advance."""
        with self._alone():
            if self._state is None:
                out = ctypes.c_void_p()
                call('simulation_state', self._handle, ctypes.byref(out))
                self._state = State._wrap(Handle('saved_state', out.value))
            return self._state

    def _view(self, name: str) -> Tuple[np.ndarray, Unit]:
        if name not in ENGINE:
            return self.state._view(name)
        with self._alone():
            return copied(self._handle, name)

    def save(self, path: Path) -> None:
        """Writes the state of the last recorded point (HDF5), for `from_state` and `load`."""
        with self._alone():
            call('simulation_save', self._handle, path_of(path))

    def __repr__(self) -> str:
        return (f'<Experiment {self.parameters["scene.title"]!r}, {len(self)} points, '
                f'{self.progress:.0%}>')


def run(preset: Preset = None, keys: Keys = None, *, out: Optional[Path] = None,
        replace: bool = False, progress: Progress = None,
        on_event: Optional[Callable[[int, str], Any]] = None, **more: Any) -> Experiment:
    """Runs a preset to its end and returns the Experiment with its curve and packing.

    preset    name or path of a preset (`greenbody.presets()`), or Parameters
    keys      changes as a dict: {"contact.mu": 0.3}
    out       directory that records the run, as `greenbody run --out`; None: not recorded
    replace   an old run in that directory is removed
    progress  True: a bar on stderr; or a function of (share, experiment)
    on_event  function of (step, text)

    The same preset and seed give the points of `greenbody run`, to the bit.  Wrong keys raise
    InputError with the line that the program prints.

    >>> curve = greenbody.run('p1-set2-9.7nm', mu=0.3, until='100 MPa').curve

    Keywords, with `__` for the dot, or without the group where one group alone has the key:

    """
    return Experiment(preset, keys, out=out, replace=replace, progress=progress,
                      on_event=on_event, **more).run()


def press(parameters: Preset, out: Optional[Path] = None) -> Run:
    """Runs to the end in one thread, for the processes of a pool or a cluster.

    parameters  Parameters, or the name or path of a preset
    out         directory that records the run; None: not recorded

    Arguments and result can be pickled.  The result has `status` ("done", "stopped"), `reason`
    (why it was stopped, or the goals that it missed), `parameters` and `curve`.  A run that
    `out` has already is continued from its last checkpoint, or returned where it is done: the
    same call may be repeated after its process was killed.

    Wrong parameters, or a directory with a run of others, raise InputError.

    >>> with concurrent.futures.ProcessPoolExecutor() as pool:
    ...     runs = list(pool.map(greenbody.press, [Parameters('default', seed=k) for k in (1, 2)]))
    """
    given = Parameters(parameters)
    if given['numerics.threads'] == 'auto':
        given['numerics.threads'] = 1
    experiment = None
    if out is not None and os.path.exists(os.path.join(os.fspath(out), 'preset.ini')):
        recorded = Run(out)
        if dict(recorded.parameters) != dict(given):
            raise InputError(f'{os.fspath(out)}: holds a run of other parameters; expected '
                             'another directory')
        if recorded.status == 'done':
            return recorded
        experiment = Experiment.resume(out)
    else:
        experiment = Experiment(given, out=out)
    status, reason = 'done', ''
    with warnings.catch_warnings(record=True) as missed:
        warnings.simplefilter('always')
        try:
            experiment.run()
        except (GuardError, NotConvergedError) as failure:
            status, reason = 'stopped', str(failure)
        finally:
            experiment.close()
    if out is not None:
        return Run(out)
    for warning in missed:
        if issubclass(warning.category, GoalWarning):
            reason = str(warning.message)
    return Run._not_recorded(status, reason, experiment.parameters, experiment.curve)


run.__doc__ = (run.__doc__ or '').rstrip(' ') + keys_doc()
