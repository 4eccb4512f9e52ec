"""Contact laws by name."""
from __future__ import annotations

import ctypes
from typing import Any, Dict, Optional

import numpy as np

from ._library import LawRequest, call, encoded, lib, strings
from ._parameters import Keys, Parameters, Preset

#: contact laws with their meaning
laws: Dict[str, str] = dict(zip(strings('contact_law_name'), strings('contact_law_doc')))


def law(name: str, x: Any = None, preset: Preset = None, keys: Keys = None, *,
        h_min: Optional[float] = None, path: bool = False, lattice: Optional[str] = None,
        **more: Any) -> np.recarray:
    """Values of a contact law, as `greenbody law` prints them: a row for each x.

    name     of greenbody.laws
    x        values of its variable, an overlap or distance in particle diameters, or an overlap
             in m for two bodies; None for a law without a variable
    h_min    deepest overlap of a bridge so far
    path     x are visited one after the other by one contact with its history
    lattice  of law "lattice": "sc", "fcc", "bcc" or "diamond"
    Columns are fields of the result; units: reduced (d, E d^2) or, for two bodies, SI.
    """
    values = np.ascontiguousarray([] if x is None else np.atleast_1d(x), dtype='f8')
    pointer = ctypes.POINTER(ctypes.c_double)
    request = LawRequest(size=ctypes.sizeof(LawRequest), law=encoded(name),
                         lattice=encoded(lattice) if lattice else None,
                         x=values.ctypes.data_as(pointer), count=len(values),
                         h_min=float('nan') if h_min is None else h_min, history=int(path))
    header = lib.gb_contact_law_columns(encoded(name)) or b'none'
    columns = header.decode().split(',')
    out = np.empty((lib.gb_contact_law_rows(ctypes.byref(request)), len(columns)))
    parameters = Parameters(preset, keys, **more)
    call('contact_law_compute', ctypes.byref(request), parameters._handle,
         out.ctypes.data_as(pointer), out.size)
    return out.view([(column, 'f8') for column in columns]).reshape(-1).view(np.recarray)
