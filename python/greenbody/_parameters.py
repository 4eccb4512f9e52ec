"""Parameters by their keys, and the table of all keys."""
from __future__ import annotations

import ctypes
import os
from typing import Any, Dict, Iterator, List, Mapping, MutableMapping, NamedTuple, Optional, Union

from ._library import (VALUE_SIZE, Handle, call, create, decoded, encoded, lib,
                       path_of)

Preset = Union[str, 'os.PathLike[str]', 'Parameters', None]
Keys = Optional[Mapping[str, Any]]


class Parameter(NamedTuple):
    """A row of the table of keys (`greenbody params`)."""

    key: str
    type: str
    unit: str
    default: str
    range: str
    choices: str
    doc: str
    source: str


def _table() -> Dict[str, Parameter]:
    rows: Dict[str, Parameter] = {}
    buffer = ctypes.create_string_buffer(VALUE_SIZE)
    while lib.gb_parameters_text(len(rows), 0, buffer, VALUE_SIZE):
        texts: List[str] = []
        for what in range(len(Parameter._fields)):
            lib.gb_parameters_text(len(rows), what, buffer, VALUE_SIZE)
            texts.append(decoded(buffer.value))
        rows[texts[0]] = Parameter(*texts)
    return rows


#: every key with type, unit, default, range, choices, meaning and source
parameters: Dict[str, Parameter] = _table()


def presets() -> List[str]:
    """Names of all presets that are found."""
    size = lib.gb_parameters_presets(None, 0)
    buffer = ctypes.create_string_buffer(size)
    lib.gb_parameters_presets(buffer, size)
    return decoded(buffer.value).split('\n') if buffer.value else []


def text_of(value: Any) -> str:
    """A value as a preset has it: numbers with all digits, lists with ';' between."""
    if isinstance(value, (list, tuple)):
        return '; '.join(text_of(item) for item in value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return value
    return repr(value.item() if hasattr(value, 'item') else value)


class Parameters(MutableMapping[str, str]):
    """Parameters of a run: a mapping of keys to texts with units.

    preset  name or path of a preset, a run directory's preset.ini, or other Parameters
    keys    changes, {"contact.mu": 0.3}; as keyword `contact__mu=0.3`, or `mu=0.3` where one
            group alone has the key

    >>> p = Parameters('p1-set2-9.7nm', mu=0.3)
    >>> p['contact.mu']
    '0.3'
    """

    def __init__(self, preset: Preset = None, keys: Keys = None, **more: Any) -> None:
        if isinstance(preset, Parameters):
            self._handle = create('parameters', 'copy', preset._handle)
        else:
            self._handle = create('parameters', 'create',
                                  None if preset is None else path_of(preset))
        self.update_keys(keys, **more)

    @classmethod
    def _wrap(cls, handle: Handle) -> 'Parameters':
        self = cls.__new__(cls)
        self._handle = handle
        return self

    def update_keys(self, keys: Keys = None, **more: Any) -> None:
        """Sets several keys; `__` in a keyword stands for the dot."""
        for key, value in (keys or {}).items():
            self[key] = value
        for key, value in more.items():
            self[key.replace('__', '.')] = value

    def __setitem__(self, key: str, value: Any) -> None:
        with self._handle.lock:
            call('parameters_set', self._handle, encoded(f'{key}={text_of(value)}'))

    def __getitem__(self, key: str) -> str:
        return self._text('get', key)

    def _text(self, function: str, key: str) -> str:
        buffer = ctypes.create_string_buffer(VALUE_SIZE)
        with self._handle.lock:
            call(f'parameters_{function}', self._handle, encoded(key), buffer, VALUE_SIZE)
        return decoded(buffer.value)

    def label(self, key: str) -> str:
        """The value of a key as the names of a sweep's directories have it: "9.7nm"."""
        return self._text('label', key)

    @classmethod
    def _of_texts(cls, changed: Dict[str, str]) -> 'Parameters':
        return cls(None, changed)

    def __reduce__(self) -> Any:
        """Pickled as the texts that differ from the defaults."""
        return self._of_texts, (self._changed(),)

    def __copy__(self) -> 'Parameters':
        return Parameters(self)

    def __deepcopy__(self, _memo: Any) -> 'Parameters':
        return Parameters(self)

    def _changed(self) -> Dict[str, str]:
        return {key: value for key, value in self.items()
                if value != parameters[key].default}

    def __delitem__(self, key: str) -> None:
        """Back to the default."""
        self[key] = parameters[key].default

    def __contains__(self, key: object) -> bool:
        return key in parameters

    def __iter__(self) -> Iterator[str]:
        return iter(parameters)

    def __len__(self) -> int:
        return len(parameters)

    def __repr__(self) -> str:
        return f'Parameters({self._changed()!r})'

    def check(self) -> None:
        """Checks each value and their relations: InputError."""
        call('parameters_check', self._handle)

    def check_cells(self, cells: int) -> None:
        """Checks a plan of several cells that differ by structure.seed only: InputError for
        lattices and packings from a file, which are the same cell for every seed."""
        call('parameters_check_cells', self._handle, cells)

    def save(self, path: 'os.PathLike[str] | str') -> None:
        """Writes a preset file."""
        call('parameters_save', self._handle, path_of(path))


def keys_doc() -> str:
    """The table of keys for a doc string."""
    lines = []
    for row in parameters.values():
        accepted = row.range or row.choices.replace(';', ', ') or row.type
        unit = f' [{row.unit}]' if row.unit else ''
        lines.append(f'{row.key.replace(".", "__")}: {accepted}{unit}; default '
                     f'{row.default or "none"}\n    {row.doc}')
    return '\n'.join(lines)
