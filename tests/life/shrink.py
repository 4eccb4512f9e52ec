"""Failing cases made smaller: assignments and steps are left out while the failure stays."""
import copy
import time


def _smaller(case):
    """Every case with one thing less, the largest first: steps from the end, then keys."""
    for index in reversed(range(len(case['steps']))):
        less = copy.deepcopy(case)
        del less['steps'][index]
        yield less
    for key in list(case['keys']):
        less = copy.deepcopy(case)
        del less['keys'][key]
        yield less
    for index, step in enumerate(case['steps']):
        if step.get('clock'):
            less = copy.deepcopy(case)
            less['steps'][index]['clock'] = False
            yield less


def shrink(case, failure_of, seconds, enough=0, attempts=3):
    """The smallest case found with the failure of `case`.

    failure_of: case -> name of its failure or None; moments are random, so that a smaller case
    counts as good only after `attempts`.  Ends with at most `enough` steps, and after `seconds` at
    the latest (and a case more).
    """
    name = failure_of(case)
    for _ in range(attempts - 1):
        name = name or failure_of(case)
    if name is None:  # by chance, and rare: kept as it is
        return case
    end = time.monotonic() + seconds
    smaller = True
    while smaller:
        smaller = False
        for less in _smaller(case):
            if time.monotonic() > end:
                return case
            if any(failure_of(less) == name for _ in range(attempts)):
                case, smaller = less, len(less['steps']) > enough
                break
    return case
