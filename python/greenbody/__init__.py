"""Cold compaction of powders by discrete elements.

>>> import greenbody
>>> run = greenbody.run('p1-set2-9.7nm', mu=0.3, until='100 MPa', progress=True)
>>> run.curve.density, run.curve.p_pa
>>> run.contact_normal.max() * run.unit('contact_normal').si   # N

`run` from begin to end, `press` the same as a call for a pool of processes, `Experiment` step by step, `sweep` over values and seeds, `load` for run
directories and states, `law` for contact laws; `greenbody.parameters` is the table of all keys,
`greenbody.presets()` the presets, `greenbody.arrays` the arrays of a packing.
"""
from ._data import Curve, Packing, Unit, arrays, point_dtype
from ._experiment import Bar, Experiment, press, run
from ._laws import law, laws
from ._library import (CancelledError, GoalWarning, GreenbodyError, GuardError, InputError,
                       MachineError, NotConvergedError, OutOfMemoryError, lib)
from ._parameters import Parameter, Parameters, parameters, presets
from ._states import Run, State, States, load
from ._sweep import Sweep, SweepRun, sweep

__version__: str = lib.gb_library_version().decode()

__all__ = ['Bar', 'CancelledError', 'Curve', 'Experiment', 'GoalWarning', 'GreenbodyError',
           'GuardError', 'InputError', 'MachineError', 'NotConvergedError', 'OutOfMemoryError',
           'Packing', 'Parameter', 'Parameters', 'Run', 'State', 'States', 'Sweep', 'SweepRun',
           'Unit', 'arrays', 'law', 'laws', 'load', 'parameters', 'point_dtype', 'press', 'presets',
           'run', 'sweep']
