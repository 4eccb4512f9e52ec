"""libgreenbody by ctypes: found, declared, its errors as exceptions."""
from __future__ import annotations

import ctypes
import os
import pathlib
import threading
from ctypes import (POINTER, Structure, c_bool, c_char, c_char_p, c_double, c_int, c_int64,
                    c_size_t, c_uint64, c_void_p)
from typing import Any, Iterator, Optional

SONAME = 'libgreenbody.so.0'
VALUE_SIZE = 8192


class GreenbodyError(Exception):
    """A call of the library failed; the text is the line that the program prints."""

    status = 0
    #: the Experiment of a run that was stopped or cancelled, with the results so far
    experiment: Any = None

    def __reduce__(self) -> Any:
        """To another process without the experiment, which stays in its own."""
        return type(self), self.args


class InputError(GreenbodyError, ValueError):
    """Wrong key, value, preset or file (exit status 2)."""

    status = 1


class GoalWarning(UserWarning):
    """A run ended without reaching a goal, or beyond one, or with points that are not in equilibrium (the
    program's exit status 1)."""


class MachineError(GreenbodyError, OSError):
    """Disk full, no permission, unreadable file (exit status 3)."""

    status = 2


class OutOfMemoryError(GreenbodyError, MemoryError):
    """Out of memory (exit status 3)."""

    status = 3


class GuardError(GreenbodyError):
    """A physical or numerical guard stopped the run; results are kept (exit status 1)."""

    status = 4


class NotConvergedError(GreenbodyError):
    """The relaxation ran out of evaluations; results are kept (exit status 1)."""

    status = 5


class CancelledError(GreenbodyError):
    """The run was asked to stop; it can be advanced further (exit status 130)."""

    status = 6


ERRORS = {kind.status: kind for kind in (InputError, MachineError, OutOfMemoryError, GuardError,
                                         NotConvergedError, CancelledError)}


class Error(Structure):
    """struct gb_error"""

    _fields_ = [('code', c_int), ('text', c_char * 480)]

    def exception(self) -> GreenbodyError:
        return ERRORS.get(self.code, GreenbodyError)(decoded(self.text))


class Array(Structure):
    """struct gb_array"""

    _fields_ = [('size', c_size_t), ('data', c_void_p), ('type', c_int), ('dimensions', c_int),
                ('shape', c_int64 * 2), ('stride', c_int64 * 2), ('unit', c_char_p),
                ('si_unit', c_char_p), ('si', c_double)]


class LawRequest(Structure):
    """struct gb_contact_law_request"""

    _fields_ = [('size', c_size_t), ('law', c_char_p), ('lattice', c_char_p),
                ('x', POINTER(c_double)), ('count', c_size_t), ('h_min', c_double),
                ('history', c_int)]


ON_POINT = ctypes.CFUNCTYPE(None, c_void_p, c_void_p, c_void_p)
ON_EVENT = ctypes.CFUNCTYPE(None, c_void_p, c_void_p, c_int64, c_char_p)
ON_PROGRESS = ctypes.CFUNCTYPE(None, c_void_p, c_void_p, c_double)

OUT = POINTER(c_void_p)
ERR = POINTER(Error)

#: name without gb_, result, arguments
FUNCTIONS = [
    ('library_version', c_char_p, []),
    ('library_point_member', c_bool, [c_size_t, POINTER(c_char_p), POINTER(c_size_t),
                                      POINTER(c_size_t), POINTER(c_char)]),
    ('curve_branch_name', c_void_p, [c_void_p, c_char_p, c_size_t]),
    ('parameters_create', c_bool, [OUT, c_char_p, ERR]),
    ('parameters_copy', c_bool, [OUT, c_void_p, ERR]),
    ('parameters_destroy', None, [c_void_p]),
    ('parameters_set', c_bool, [c_void_p, c_char_p, ERR]),
    ('parameters_get', c_bool, [c_void_p, c_char_p, c_char_p, c_size_t, ERR]),
    ('parameters_label', c_bool, [c_void_p, c_char_p, c_char_p, c_size_t, ERR]),
    ('parameters_check', c_bool, [c_void_p, ERR]),
    ('parameters_check_cells', c_bool, [c_void_p, c_size_t, ERR]),
    ('parameters_save', c_bool, [c_void_p, c_char_p, ERR]),
    ('parameters_text', c_bool, [c_size_t, c_int, c_char_p, c_size_t]),
    ('parameters_presets', c_size_t, [c_char_p, c_size_t]),
    ('simulation_create', c_bool, [OUT, c_void_p, ERR]),
    ('simulation_resume', c_bool, [OUT, c_char_p, ERR]),
    ('simulation_resume_before', c_bool, [OUT, c_char_p, ERR]),
    ('simulation_load', c_bool, [OUT, c_void_p, c_char_p, ERR]),
    ('simulation_leave', None, [c_void_p]),
    ('simulation_destroy', None, [c_void_p]),
    ('simulation_record', c_bool, [c_void_p, c_char_p, c_bool, ERR]),
    ('simulation_on_point', None, [c_void_p, ON_POINT, c_void_p]),
    ('simulation_on_event', None, [c_void_p, ON_EVENT, c_void_p]),
    ('simulation_on_progress', None, [c_void_p, ON_PROGRESS, c_void_p, c_double]),
    ('simulation_advance', c_int, [c_void_p, c_int64, ERR]),
    ('simulation_cancel', None, [c_void_p, c_char_p]),
    ('simulation_points', c_size_t, [c_void_p]),
    ('simulation_point', c_void_p, [c_void_p, c_size_t]),
    ('simulation_progress', c_double, [c_void_p]),
    ('simulation_parameters', c_bool, [c_void_p, OUT, ERR]),
    ('simulation_array', c_bool, [c_void_p, c_char_p, POINTER(Array), ERR]),
    ('simulation_state', c_bool, [c_void_p, OUT, ERR]),
    ('simulation_save', c_bool, [c_void_p, c_char_p, ERR]),
    ('array_name', c_char_p, [c_size_t]),
    ('array_doc', c_char_p, [c_size_t]),
    ('saved_state_load', c_bool, [OUT, c_char_p, ERR]),
    ('saved_state_destroy', None, [c_void_p]),
    ('saved_state_point', c_void_p, [c_void_p]),
    ('saved_state_title', c_char_p, [c_void_p]),
    ('saved_state_seed', c_uint64, [c_void_p]),
    ('saved_state_array', c_bool, [c_void_p, c_char_p, POINTER(Array), ERR]),
    ('recorded_run_open', c_bool, [OUT, c_char_p, ERR]),
    ('recorded_run_destroy', None, [c_void_p]),
    ('recorded_run_state', c_char_p, [c_void_p]),
    ('recorded_run_reason', c_char_p, [c_void_p]),
    ('recorded_run_points', c_size_t, [c_void_p]),
    ('recorded_run_point', c_void_p, [c_void_p, c_size_t]),
    ('recorded_run_parameters', c_bool, [c_void_p, OUT, ERR]),
    ('recorded_run_saved', c_char_p, [c_void_p, c_size_t]),
    ('contact_law_name', c_char_p, [c_size_t]),
    ('contact_law_doc', c_char_p, [c_size_t]),
    ('contact_law_columns', c_char_p, [c_char_p]),
    ('contact_law_variable', c_char_p, [c_char_p]),
    ('contact_law_rows', c_size_t, [POINTER(LawRequest)]),
    ('contact_law_compute', c_bool, [POINTER(LawRequest), c_void_p, POINTER(c_double), c_size_t,
                                     ERR]),
]


def candidates() -> Iterator[str]:
    """Paths of the library: GREENBODY_LIBRARY, the folders around the module, the loader's."""
    if os.environ.get('GREENBODY_LIBRARY'):
        yield os.environ['GREENBODY_LIBRARY']
    for folder in pathlib.Path(__file__).resolve().parents[1:6]:
        for pattern in (f'lib/{SONAME}', f'lib/*/{SONAME}', f'lib64/{SONAME}'):
            yield from (str(path) for path in sorted(folder.glob(pattern)))
    yield SONAME


def find() -> ctypes.CDLL:
    failures = []
    for path in candidates():
        try:
            return ctypes.CDLL(path)
        except OSError as error:
            failures.append(str(error))
    raise ImportError(f'{SONAME} is not found in GREENBODY_LIBRARY, next to the module or by the '
                      f'loader: {"; ".join(failures)}')


lib = find()
for _name, _result, _arguments in FUNCTIONS:
    _function = getattr(lib, 'gb_' + _name)
    _function.restype = _result
    _function.argtypes = _arguments


def call(name: str, *arguments: Any) -> None:
    """Calls gb_NAME with the arguments and an error; false is an exception."""
    error = Error()
    if not getattr(lib, 'gb_' + name)(*arguments, ctypes.byref(error)):
        raise error.exception()


class Handle:
    """An object of the library, destroyed with the last of its users.

    `lock` is for calls that change the object: ctypes lets other threads run during a call.
    """

    def __init__(self, kind: str, pointer: Optional[int]) -> None:
        self.kind = kind
        self.pointer = pointer
        self.lock = threading.RLock()

    def __reduce__(self) -> Any:
        """Its memory belongs to one object of one process."""
        raise TypeError(f'a {self.kind} of the library cannot be copied or pickled; its '
                        'parameters and its curve can')

    @property
    def _as_parameter_(self) -> c_void_p:
        return c_void_p(self.pointer)

    def __del__(self) -> None:
        if self.pointer and lib is not None:
            getattr(lib, f'gb_{self.kind}_destroy')(self.pointer)
            self.pointer = None


def create(kind: str, function: str, *arguments: Any) -> Handle:
    """An object that gb_KIND_FUNCTION creates."""
    out = c_void_p()
    error = Error()
    if not getattr(lib, f'gb_{kind}_{function}')(ctypes.byref(out), *arguments,
                                                 ctypes.byref(error)):
        raise error.exception()
    return Handle(kind, out.value)


def encoded(text: str) -> bytes:
    """A text for the library, where a NUL would end it."""
    return _whole(text.encode('utf-8', 'surrogateescape'))


def decoded(text: Optional[bytes]) -> str:
    """A text of the library; bytes that are no UTF-8 as in paths."""
    return (text or b'').decode('utf-8', 'surrogateescape')


def _whole(text: bytes) -> bytes:
    if b'\0' in text:
        raise InputError(f'{text!r}: expected a text without NUL')
    return text


def path_of(path: 'os.PathLike[str] | str') -> bytes:
    return _whole(os.fsencode(path))


def strings(name: str) -> Iterator[str]:
    """All answers of gb_NAME(index)."""
    index = 0
    while True:
        text = getattr(lib, 'gb_' + name)(index)
        if text is None:
            return
        yield decoded(text)
        index += 1
