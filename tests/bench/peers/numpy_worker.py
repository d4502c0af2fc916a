"""numpy_worker.py CASE [WEIGHTS.npy]: runs a case's NumPy program with its own random spikes, cycle by cycle."""
import sys

import numpy as np

import cases
import turns
from numpy_programs import program


def random_spikes(cells, probability):
    """A function that draws spikes from 16 random bits per cell, the fastest way that was found. (The probability is
    a multiple of 2^-16; Forage's is exact.)"""
    bits = np.random.SFC64(1)
    words = -(-cells // 4)
    threshold = np.uint16(round(probability * 2 ** 16))

    def draw(spikes):
        spikes[:] = bits.random_raw(words).view(np.uint16)[:cells] < threshold
    return draw


def main():
    case = cases.find(sys.argv[1])
    weights = np.load(sys.argv[2]) if len(sys.argv) > 2 else None
    step = program(case, weights)
    draw = random_spikes(case.source.cells, cases.PROBABILITY)
    spikes = np.zeros(case.source.cells)

    def run(cycles):
        for _ in range(cycles):
            draw(spikes)
            step(spikes)

    def check(spikes_file, activities_file):
        step = program(case, weights)
        for row in np.load(spikes_file):
            activities = step(row)
        np.save(activities_file, activities.reshape(len(case.targets), -1))

    turns.serve(turns.Rate(run), check)


if __name__ == "__main__":
    main()
