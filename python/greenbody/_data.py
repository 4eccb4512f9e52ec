"""Memory of the library as numpy arrays: points of a curve, arrays of a packing."""
from __future__ import annotations

import ctypes
from typing import Any, Callable, Dict, Iterable, List, NamedTuple, Tuple

import numpy as np

from ._library import Array, Handle, call, encoded, lib, strings


def _point_dtype() -> np.dtype:
    name, kind = ctypes.c_char_p(), ctypes.c_char()
    offset, count = ctypes.c_size_t(), ctypes.c_size_t()
    types = {b'd': 'f8', b'q': 'i8', b'i': 'i4'}
    names: List[str] = []
    formats: List[Any] = []
    offsets: List[int] = []
    while lib.gb_library_point_member(len(names), ctypes.byref(name), ctypes.byref(offset),
                                      ctypes.byref(count), ctypes.byref(kind)):
        assert name.value is not None
        names.append(name.value.decode())
        formats.append((types[kind.value], (count.value,)) if count.value > 1
                       else types[kind.value])
        offsets.append(offset.value)
    width = max(o + np.dtype(f).itemsize for o, f in zip(offsets, formats))
    return np.dtype({'names': names, 'formats': formats, 'offsets': offsets,
                     'itemsize': width})


#: members of a recorded point, SI units in the names: p_pa, density, coordination, ...
point_dtype: np.dtype = _point_dtype()


class Curve(np.recarray):
    """Recorded points of a run: a structured array, `curve.density`, `curve['p_pa']`.

    Pressures in Pa; NaN where a value does not exist.  branch: 0 on loading, k >= 1 on the
    k-th unloading branch.
    """

    @property
    def loading(self) -> 'Curve':
        """The points of the loading branch."""
        return self[self['branch'] == 0]

    def at_pressure(self, p_pa: float, member: str = 'density') -> float:
        """A member of the points on loading where the pressure first reaches p_pa; NaN: never."""
        loading = self.loading
        above = np.flatnonzero(loading['p_pa'] >= p_pa)
        if len(above) == 0:
            return float('nan')
        k = int(above[0])
        if k == 0:
            return float(loading[member][0])
        p, y = loading['p_pa'][k - 1:k + 1], loading[member][k - 1:k + 1]
        return float(y[0] + (y[1] - y[0]) * (p_pa - p[0]) / (p[1] - p[0]))

    @property
    def branch_name(self) -> np.ndarray:
        """The branch column of curve.csv: "load", "unload:100MPa", ..."""
        rows = np.ascontiguousarray(self)
        buffer = ctypes.create_string_buffer(64)
        names = []
        for k in range(len(rows)):
            lib.gb_curve_branch_name(rows.ctypes.data + k * rows.strides[0], buffer, 64)
            names.append(buffer.value.decode())
        return np.array(names, dtype=object)

    def to_pandas(self) -> Any:
        """A pandas.DataFrame: a column a member, tensors as strain_0, strain_1, ..."""
        import pandas
        columns: Dict[str, Any] = {'branch_name': self.branch_name}
        for name in self.dtype.names or ():
            values = np.asarray(self[name])
            if values.ndim == 1:
                columns[name] = values
            else:
                columns.update({f'{name}_{k}': values[:, k] for k in range(values.shape[1])})
        return pandas.DataFrame(columns)


def read_points(addresses: Iterable[int]) -> Curve:
    """A copy of the points at these addresses."""
    size = point_dtype.itemsize
    data = b''.join(ctypes.string_at(address, size) for address in addresses)
    return np.frombuffer(bytearray(data), dtype=point_dtype).view(Curve)


class Unit(NamedTuple):
    """Unit of an array: `unit` of its numbers, of which one is `si` in `si_unit`."""

    unit: str
    si_unit: str
    si: float


#: arrays of a packing with shape, unit and meaning
arrays: Dict[str, str] = dict(zip(strings('array_name'), strings('array_doc')))

_DTYPES = {0: np.dtype('f8'), 1: np.dtype('i4'), 2: np.dtype('u1')}


def copied(owner: Handle, name: str) -> Tuple[np.ndarray, Unit]:
    """A copy of an array of a simulation, whose memory the next advance changes or frees."""
    with owner.lock:
        array, unit = view(owner, name)
        array = array.copy()
    array.flags.writeable = False
    return array, unit


def view(owner: Handle, name: str) -> Tuple[np.ndarray, Unit]:
    """The array of a state: its memory, read only, which keeps the state and never moves."""
    found = Array(size=ctypes.sizeof(Array))
    with owner.lock:
        call(f'{owner.kind}_array', owner, encoded(name), ctypes.byref(found))
    dtype = _DTYPES[found.type]
    shape = tuple(found.shape[:found.dimensions])
    strides = tuple(found.stride[:found.dimensions])
    unit = Unit(found.unit.decode(), found.si_unit.decode(), found.si)
    if 0 in shape or not found.data:
        empty = np.empty(shape, dtype)
        empty.flags.writeable = False
        return empty, unit
    extent = dtype.itemsize + sum((n - 1) * s for n, s in zip(shape, strides))
    memory = (ctypes.c_char * extent).from_address(found.data)
    memory.owner = owner  # type: ignore[attr-defined]
    array = np.ndarray(shape, dtype, buffer=memory, strides=strides)
    array.flags.writeable = False
    return array, unit


class Packing:
    """Arrays of a packing by name: `position`, `diameter`, `contact`, `contact_force`, ...

    Numbers are in the reduced units of the engine, lengths in particle diameters d, forces in
    E d^2; `unit(name).si` converts them: `packing.position * packing.unit('position').si` is
    in m.  `greenbody.arrays` lists all.
    """

    def _view(self, name: str) -> Tuple[np.ndarray, Unit]:
        raise NotImplementedError

    def array(self, name: str) -> np.ndarray:
        """The array of this name, read only."""
        return self._view(name)[0]

    def unit(self, name: str) -> Unit:
        """Unit of the array of this name."""
        return self._view(name)[1]


def _property(name: str, doc: str) -> property:
    read: Callable[[Packing], np.ndarray] = lambda self: self.array(name)
    return property(read, doc=doc)


for _name, _doc in arrays.items():
    setattr(Packing, _name, _property(_name, _doc))
