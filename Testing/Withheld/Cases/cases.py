"""What the generators in numpy have in common: sizes of gaps, and the files of a set of cases as CaseWriter writes them."""

import csv
import os

import numpy


def rms(values):
    return float(numpy.sqrt((values ** 2).mean()))


def strength_of(target, gap, high, rounds):
    """At which gap(strength) is of the size, where it grows with the strength up to `high`."""
    low = 1e-4
    for _ in range(rounds):
        middle = numpy.sqrt(low * high)
        low, high = (middle, high) if rms(gap(middle)) < target else (low, middle)
    return numpy.sqrt(low * high)


def table(path, header, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def lists(folder, key, cases):
    """The names of the cases for the diagnosis, what was planted for the scorer: name, set, effects, kinds, axes, gap, best shrink, and
    the effects that may not be tried."""
    table(os.path.join(folder, "cases.csv"), ["case", "without"], [[case[0], case[-1]] for case in cases])
    table(key, ["case", "set", "effects", "kinds", "axes", "gap_rms", "best_shrink", "without", "twin"],
          [[*case, ""] for case in cases])
    print(f"{len(cases)} cases in {folder}")
