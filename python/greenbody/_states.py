"""Packings in files, and run directories."""
from __future__ import annotations

import ctypes
import os
import pathlib
from typing import Any, Iterator, List, Optional, Sequence, Tuple, Union

import numpy as np

from ._data import Curve, Packing, Unit, read_points, view
from ._library import Handle, call, create, decoded, lib, path_of
from ._parameters import Parameters

Path = Union[str, 'os.PathLike[str]']


class State(Packing):
    """A packing read from state.h5 or a kept state, or taken of an Experiment."""

    def __init__(self, path: Path) -> None:
        self._handle = create('saved_state', 'load', path_of(path))
        self.path: 'pathlib.Path | None' = pathlib.Path(path)

    @classmethod
    def _wrap(cls, handle: Handle) -> 'State':
        self = cls.__new__(cls)
        self._handle = handle
        self.path = None
        return self

    def __reduce__(self) -> Any:
        """A packing belongs to its process; its file does not."""
        return self._handle.__reduce__()

    def _view(self, name: str) -> Tuple[np.ndarray, Unit]:
        return view(self._handle, name)

    @property
    def point(self) -> np.record:
        """Measures of the packing: density, pressures, coordination, ..."""
        return read_points([lib.gb_saved_state_point(self._handle)])[0]

    @property
    def title(self) -> str:
        """Title of the preset."""
        return decoded(lib.gb_saved_state_title(self._handle))

    @property
    def seed(self) -> int:
        return lib.gb_saved_state_seed(self._handle)

    def __repr__(self) -> str:
        return f'<State {self.title!r} density {self.point["density"]:.4f}>'


class States(Sequence[State]):
    """The kept states of a run in its order; each is read when it is asked for."""

    def __init__(self, paths: List[pathlib.Path]) -> None:
        self.paths = paths

    def __len__(self) -> int:
        return len(self.paths)

    def __getitem__(self, index):  # type: ignore[no-untyped-def]
        if isinstance(index, slice):
            return States(self.paths[index])
        return State(self.paths[index])

    def __iter__(self) -> Iterator[State]:
        return (State(path) for path in self.paths)


def parameters_of(handle: Handle) -> Parameters:
    """The parameters of a recorded run or of a simulation."""
    out = ctypes.c_void_p()
    call(f'{handle.kind}_parameters', handle, ctypes.byref(out))
    return Parameters._wrap(Handle('parameters', out.value))


class Run:
    """A run as plain data, which can be pickled: the result of `press`, or what a run directory
    holds so far."""

    #: its directory; None of a run that was not recorded
    directory: Optional[pathlib.Path]

    def __init__(self, directory: Path) -> None:
        handle = create('recorded_run', 'open', path_of(directory))
        self.directory = pathlib.Path(directory)
        #: "running", "done", "stopped", "failed"
        self.status: str = decoded(lib.gb_recorded_run_state(handle))
        #: why it was stopped or failed; "" otherwise
        self.reason: str = decoded(lib.gb_recorded_run_reason(handle))
        self.parameters = parameters_of(handle)
        #: rows of curve.csv with its digits
        self.curve: Curve = read_points(lib.gb_recorded_run_point(handle, k)
                                        for k in range(lib.gb_recorded_run_points(handle)))
        paths = []
        while True:
            path = lib.gb_recorded_run_saved(handle, len(paths))
            if path is None:
                break
            paths.append(pathlib.Path(os.fsdecode(path)))
        #: kept states, the last one state.h5
        self.states = States(paths)

    @classmethod
    def _not_recorded(cls, status: str, reason: str, parameters: Parameters,
                      curve: Curve) -> 'Run':
        self = cls.__new__(cls)
        self.directory = None
        self.status = status
        self.reason = reason
        self.parameters = parameters
        self.curve = curve
        self.states = States([])
        return self

    def __repr__(self) -> str:
        return f'<Run {str(self.directory)!r} {self.status}, {len(self.curve)} points>'


def load(path: Path) -> 'Run | State':
    """A run directory as a Run; a state file (.h5) as a State."""
    return State(path) if pathlib.Path(path).is_file() else Run(path)
