#!/usr/bin/env python3
"""Bytes of resident memory for each particle of a run with checkpoints: the difference between two
runs of 1000 and 20,000 particles, so that the program itself does not count.
Usage: particle_memory.py GREENBODY PRESET_FOLDER"""

import os
import subprocess
import sys
import tempfile

FEW, MANY = 1000, 20000
# Bytes; 1480 with records of doubles, a copy of them for state.h5 and spare room resident.
LIMIT = 1270


def peak(program, folder, count):
    """Largest resident memory of a run, bytes."""
    scene = ["p1-set2-9.7nm", f"particles.count={count}", "structure.base=auto",
             "loading.until=density=0.26", "loading.unload_from=", "numerics.threads=2",
             "output.checkpoint_every=0.1 s"]
    run = subprocess.Popen([program, "run", *scene, "--quiet", "--out",
                            os.path.join(folder, f"run-{count}")])
    _, status, usage = os.wait4(run.pid, 0)
    run.returncode = os.waitstatus_to_exitcode(status)
    if run.returncode != 0:
        sys.exit(f"Bail out! the run of {count} particles ended with {run.returncode}")
    return 1024 * usage.ru_maxrss


def main():
    program = sys.argv[1]
    os.environ["GB_PRESET_DIR"] = sys.argv[2]
    os.environ.pop("MALLOC_PERTURB_", None)  # it writes to spare room, which is resident then
    print("1..1")
    with tempfile.TemporaryDirectory() as folder:
        few, many = (peak(program, folder, count) for count in (FEW, MANY))
    each = (many - few) / (MANY - FEW)
    print(f"# {few / 1e6:.1f} MB with {FEW}, {many / 1e6:.1f} MB with {MANY} particles")
    print(f"{'ok' if each < LIMIT else 'not ok'} 1 - {each:.0f} bytes a particle, of {LIMIT}")
    return 0 if each < LIMIT else 1


if __name__ == "__main__":
    sys.exit(main())
