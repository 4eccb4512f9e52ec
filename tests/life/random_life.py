#!/usr/bin/env python3
"""Random life of runs: random scenes, random commands and disturbances, with what must hold.

Usage: random_life.py [--seed N] [--seconds S] [--cases N] [--keep DIR] [--extreme SHARE]
           [--shrink SECONDS] [--enough STEPS] [--leap-clock FILE.so] --same-state PROGRAM
           GREENBODY PRESET_FOLDER
       random_life.py --replay CASE.json ... GREENBODY PRESET_FOLDER

Each case follows from its seed.  DIR/seeds.log has the seeds done, so that the same command goes
on with the next one; a case that fails is made smaller and kept in DIR/failed-SEED: case.json,
why.txt, replay.sh, and the run directories.  SHARE of the scenes have a value at the edge of a key
(0.15; 1 finds the faults there soonest).  Exit status: 0 nothing found, 1 a case failed, 2
usage.
"""
import argparse
import json
import os
import random
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True

from check import Broken  # noqa: E402  # pylint: disable=wrong-import-position
from life import HANG_S, Life, TooLong, random_steps  # noqa: E402  # pylint: disable=wrong-import-position
import scenes  # noqa: E402  # pylint: disable=wrong-import-position
from shrink import shrink  # noqa: E402  # pylint: disable=wrong-import-position


def random_case(seed, extreme):
    rng = random.Random(seed)
    preset, keys = scenes.random_scene(rng, extreme)
    return {'seed': seed, 'preset': preset, 'keys': keys,
            'steps': random_steps(rng, scenes.random_edit, scenes.random_change)}


def live(tools, folder, case):
    """How the case ended, and what is broken or None."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    try:
        return Life(tools, folder, case).live(), None
    except TooLong:
        return 'long', None
    except Broken as broken:
        return 'failed', broken


def keep(tools, directory, case, why):
    """The failing case as small as it gets, with its directories and a script that repeats it."""
    trial = os.path.join(tools.scratch, 'trial')

    def failure_of(less):
        broken = live(tools, trial, less)[1]
        return broken.name if broken else None

    case = shrink(case, failure_of, tools.shrink, tools.enough)
    last = next((broken for _ in range(5) if (broken := live(tools, trial, case)[1])), why)
    target = os.path.join(directory, f'failed-{case["seed"]}')
    shutil.rmtree(target, ignore_errors=True)
    shutil.copytree(trial, os.path.join(target, 'files'))
    with open(os.path.join(target, 'case.json'), 'w', encoding='utf-8') as file:
        json.dump(case, file, indent=1)
        file.write('\n')
    with open(os.path.join(target, 'why.txt'), 'w', encoding='utf-8') as file:
        file.write(f'{why}\nmade smaller: {last}\n')
    words = [sys.executable, os.path.abspath(__file__), *tools.words]
    with open(os.path.join(target, 'replay.sh'), 'w', encoding='utf-8') as file:
        file.write('#!/bin/sh\n# Repeats the case: status 1 while it fails.\n'
                   'cd "$(dirname "$0")" || exit 2\n'
                   f'exec {shlex.join(words)} --replay case.json\n')
    os.chmod(os.path.join(target, 'replay.sh'), 0o755)
    return target


def seeds_done(path):
    if not os.path.exists(path):
        return set()
    with open(path, encoding='utf-8') as file:
        return {int(line.split()[0]) for line in file if line.endswith('\n') and line.strip()}


def campaign(tools, options, directory):
    """Cases from the first seed that is not done, until the time is over."""
    log = os.path.join(directory, 'seeds.log')
    os.makedirs(directory, exist_ok=True)
    done = seeds_done(log)
    end = time.monotonic() + options.seconds
    seed, counts = options.seed, {}
    while time.monotonic() < end and sum(counts.values()) < options.cases:
        if seed not in done:
            start = time.monotonic()
            case = random_case(seed, options.extreme)
            how, broken = live(tools, os.path.join(tools.scratch, 'case'), case)
            kind = how.split(':')[0]
            counts[kind] = counts.get(kind, 0) + 1
            line = f'{seed} {how} {time.monotonic() - start:.1f} s'
            if broken is not None:
                target = keep(tools, directory, case, broken)
                line += f' {broken.name}'
                print(f'seed {seed}: {broken}\nkept in {target}', flush=True)
            with open(log, 'a', encoding='utf-8') as file:
                file.write(line + '\n')
        seed += 1
    print(', '.join(f'{count} {how}' for how, count in sorted(counts.items())) or 'no case')
    return 1 if counts.get('failed') or not counts.get('ok') else 0


def replay(tools, path):
    with open(path, encoding='utf-8') as file:
        case = json.load(file)
    how, broken = live(tools, os.path.join(tools.scratch, 'case'), case)
    print(broken or how)
    return 1 if broken else 0


def has_clock(greenbody, leap_clock):
    """Whether this program takes another clock (under sanitizers it does not)."""
    return subprocess.run([greenbody, '--version'], env={**os.environ, 'LD_PRELOAD': leap_clock},
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                          check=False, timeout=HANG_S).returncode == 0


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--seconds', type=float, default=3600)
    parser.add_argument('--cases', type=int, default=10 ** 9)
    parser.add_argument('--keep')
    parser.add_argument('--extreme', type=float, default=0.15)
    parser.add_argument('--shrink', type=float, default=120, metavar='SECONDS')
    parser.add_argument('--enough', type=int, default=0, metavar='STEPS')
    parser.add_argument('--replay')
    parser.add_argument('--leap-clock')
    parser.add_argument('--same-state', required=True)
    parser.add_argument('greenbody')
    parser.add_argument('presets')
    options = parser.parse_args()
    options.greenbody, options.presets, options.same_state = map(
        os.path.abspath, (options.greenbody, options.presets, options.same_state))
    options.words = ['--same-state', options.same_state, options.greenbody, options.presets]
    if options.leap_clock:
        options.leap_clock = os.path.abspath(options.leap_clock)
        options.words = ['--leap-clock', options.leap_clock, *options.words]
        if not has_clock(options.greenbody, options.leap_clock):
            options.leap_clock = None
    with tempfile.TemporaryDirectory() as scratch:
        options.scratch = scratch
        os.environ.update(GB_PRESET_DIR=options.presets,
                          XDG_CONFIG_HOME=os.path.join(scratch, 'config'))
        if options.replay:
            return replay(options, options.replay)
        return campaign(options, options, options.keep or os.path.join(scratch, 'kept'))


if __name__ == '__main__':
    sys.exit(main())
