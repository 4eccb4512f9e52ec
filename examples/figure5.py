"""P1 Fig. 5, pressure against density of powders of 9.7 and 38 nm, and a figure of one's own:
the coordination of the packing over its pressure, mean and standard error of four cells."""
import greenbody
import matplotlib.pyplot as plt
import numpy as np

presets = ['p1-set2-9.7nm', 'p1-set2-38nm']
sweeps = {name: greenbody.sweep(name, seeds=4, count=1000, until='1 GPa', unload_from='')
          for name in presets}
figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.2), layout='constrained')
for name, runs in sweeps.items():
    for run in runs:
        load = run.curve.loading
        left.plot(load.density, load.p_pa / 1e6, label=name if run.seed == 1 else None,
                  color=f'C{presets.index(name)}', linewidth=0.8)
    p = np.geomspace(10e6, 1e9, 15)
    contacts = [[run.at_pressure(x, 'coordination') for x in p] for run in runs]
    right.errorbar(p / 1e6, np.mean(contacts, 0), np.std(contacts, 0, ddof=1) / 2, label=name)
left.set(xlabel='relative density', ylabel='pressure (MPa)')
right.set(xlabel='pressure (MPa)', ylabel='mean coordination number', xscale='log')
left.legend()
figure.savefig('figure5.png', dpi=200)
