"""Each case as a NumPy program of the kind that an expert writes: groups in one array, no loops over groups or cells,
products left to OpenBLAS or SciPy, results written in place. (The maximum of two arrays is three times as fast as that of
an array and 0.)

program(case, weights) returns step(spikes), which takes the activity of the random source in a cycle and returns the
activities of all other groups in the next cycle, group by group. `weights` is the matrix of a connection whose synapses
have random attenuations: target x source.
"""
import numpy as np
from numpy.lib.stride_tricks import sliding_window_view


def program(case, weights=None):
    last = case.connections[-1]
    if case.name.startswith("ring"):
        return ring(case)
    if last.learning_rate:
        return hebbian(case)
    if needs_scipy(case):
        return diagonals(weights)
    if last.attenuated:
        return dense(weights)
    if last.sigma:
        return gaussian(case)
    if last.window == 0:
        return all_to_all(case)
    return driven(case) if case.targets[0].kept else one_to_one(case)


def needs_scipy(case):
    return case.connections[-1].attenuated > 0 and case.connections[-1].window > 0


def ring(case):
    """All groups in one array. One to one: group x cell. With windows: y x group x x, so that each axis takes one product."""
    first, connection = case.connections[0], case.connections[1]
    n, side = len(case.targets), case.source.width
    if connection.window > 1:
        return ring_of_windows(n, side, first.weight, connection)
    old_and_new = [np.zeros((n, side * side)) for _ in range(2)]
    zeros, drive = np.zeros((n, side * side)), np.zeros(side * side)

    def step(spikes):
        old, new = old_and_new
        np.multiply(old[:-1], connection.weight, out=new[1:])
        np.multiply(old[-1], connection.weight, out=new[0])
        np.multiply(spikes, first.weight, out=drive)
        new[0] += drive
        np.maximum(new, zeros, out=new)
        old_and_new.reverse()
        return new
    return step


def ring_of_windows(n, side, weight, connection):
    band = window_matrix(side, connection.window)
    activity, rows, sums, zeros = np.zeros((4, side, n, side))
    drive = np.zeros((side, side))

    def step(spikes):
        np.dot(activity.reshape(side * n, side), connection.weight * band, out=rows.reshape(side * n, side))
        np.dot(band, rows.reshape(side, n * side), out=sums.reshape(side, n * side))
        np.multiply(spikes.reshape(side, side), weight, out=drive)
        sums[:, -1] += drive
        np.maximum(sums[:, :-1], zeros[:, :-1], out=activity[:, 1:])
        np.maximum(sums[:, -1], zeros[:, -1], out=activity[:, 0])
        return activity.transpose(1, 0, 2)
    return step


def driven(case):
    weight, kept = case.connections[0].weight, case.targets[0].kept
    potential = np.zeros((len(case.targets), case.source.cells))
    activity, zeros, drive = np.zeros_like(potential), np.zeros_like(potential), np.zeros(case.source.cells)

    def step(spikes):
        np.multiply(spikes, weight, out=drive)
        np.multiply(potential, kept, out=potential)
        np.add(potential, drive, out=potential)
        return np.maximum(potential, zeros, out=activity)
    return step


def one_to_one(case):
    weight, (activity, zeros) = case.connections[0].weight, np.zeros((2, case.source.cells))

    def step(spikes):
        np.multiply(spikes, weight, out=activity)
        return np.maximum(activity, zeros, out=activity)
    return step


def all_to_all(case):
    """Equal weights: one sum."""
    weight, activity = case.connections[0].weight, np.zeros(case.source.cells)

    def step(spikes):
        activity.fill(max(weight * spikes.sum(), 0))
        return activity
    return step


def dense(weights):
    """One product of a matrix and a vector. To sum only the columns of active sources takes as long."""
    matrix = np.ascontiguousarray(weights)
    activity, zeros = np.zeros((2, len(matrix)))

    def step(spikes):
        np.dot(matrix, spikes, out=activity)
        return np.maximum(activity, zeros, out=activity)
    return step


def diagonals(weights):
    """A window with random weights. By diagonals SciPy is a third faster than by rows (CSR)."""
    import scipy.sparse
    matrix = scipy.sparse.csr_matrix(weights).todia()
    activity, zeros = np.zeros((2, len(weights)))

    def step(spikes):
        return np.maximum(matrix @ spikes, zeros, out=activity)
    return step


def gaussian(case):
    """A Gaussian attenuation, from which that of the farthest cell is subtracted: the sum of two products of a function of x
    and a function of y, so two matrix products on each side."""
    c, side = case.connections[0], case.source.width
    uniform = window_matrix(side, c.window)
    distance = np.subtract.outer(np.arange(side), np.arange(side))
    bell = uniform * np.exp(-distance ** 2 / (2 * c.sigma ** 2))
    farthest = np.exp(-2 * (c.window // 2) ** 2 / (2 * c.sigma ** 2))
    left = np.vstack([bell, uniform])
    right = c.weight * np.vstack([bell, -farthest * uniform])
    half, sides, (activity, zeros) = np.zeros((2 * side, side)), np.zeros((side, 2 * side)), np.zeros((2, side, side))

    def step(spikes):
        np.matmul(left, spikes.reshape(side, side), out=half)
        sides[:, :side], sides[:, side:] = half[:side], half[side:]
        np.matmul(sides, right, out=activity)
        return np.maximum(activity, zeros, out=activity)
    return step


def hebbian(case):
    """Two windows, one of them plastic. Only the weights of active sources change or count, so each source has a row of
    11 x 11 weights. The targets lie in a frame, so that all rows are of one length."""
    fixed, plastic = case.connections
    side, window = case.source.width, plastic.window
    margin, framed = window // 2, side + 2 * (window // 2)
    places = np.arange(framed * framed).reshape(framed, framed)
    targets = sliding_window_view(places, (window, window)).reshape(side * side, window * window).copy()
    weights = np.zeros(targets.shape)
    growth = np.zeros((framed, framed))
    inner = growth[margin:-margin, margin:-margin]
    band = window_matrix(side, fixed.window)
    half, activity, zeros = np.zeros((3, side, side))

    def step(spikes):
        np.multiply(activity, plastic.learning_rate, out=inner)
        active = np.flatnonzero(spikes)
        to = targets.take(active, axis=0)
        learned = weights.take(active, axis=0)
        learned += growth.ravel().take(to)
        weights[active] = learned
        sums = np.bincount(to.ravel(), learned.ravel(), framed * framed).reshape(framed, framed)
        np.dot(band, spikes.reshape(side, side), out=half)
        np.dot(half, fixed.weight * band, out=activity)
        np.add(activity, sums[margin:-margin, margin:-margin], out=activity)
        return np.maximum(activity, zeros, out=activity)
    return step


def window_matrix(side, window):
    """1 where two cells of a line are in each other's window."""
    distance = np.subtract.outer(np.arange(side), np.arange(side))
    return (abs(distance) <= window // 2).astype(float)
