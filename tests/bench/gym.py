"""How fast environments for learning agents step: one robot with light sensors, no camera, on one core.

    PYTHONPATH=build/release/python gym.py

Prints steps per second of the thread's own time with random actions, and how many times longer a cycle takes than in run.run() of
the same run; each is the best of several turns. Then worlds side by side: on one thread by its own time, on all by the clock.
"""
import pathlib
import time

import numpy

from forage.gym import BugEnv, BugVectorEnv

WORLD = pathlib.Path(__file__).parents[2] / "systems/worlds/basic_arena.world"
TURNS, CYCLES = 5, 20_000
TURN = 3  # on the spot: no walls, no resets
WANTED = 20_000  # steps per second


def own_seconds(work):
    begun = time.thread_time()
    work()
    return time.thread_time() - begun


def steps(env, number, actions):
    for action in actions[:number]:
        _, _, terminated, truncated, _ = env.step(action)
        if terminated or truncated:
            env.reset()


def main():
    met = True
    chance = numpy.random.default_rng(1)
    for cycles in (1, 5):
        number = CYCLES // cycles
        env = BugEnv(WORLD, sensors=["target"], cycles_per_step=cycles, max_steps=0)
        driven, turned, ran = [], [], []
        for _ in range(TURNS):
            env.reset(seed=1)
            driven.append(own_seconds(lambda: steps(env, number, chance.integers(9, size=number).tolist())))
            env.reset(seed=1)
            turned.append(own_seconds(lambda: steps(env, number, [TURN] * number)))
            ran.append(own_seconds(lambda: env.run.run(cycles=CYCLES)))  # still turns
        rate = number / min(driven)
        met = met and rate >= WANTED
        print(f"BugEnv, {cycles} cycle{'s' * (cycles > 1)} per step: {rate:,.0f} steps/s (wanted {WANTED:,}); on the spot, a cycle takes "
              f"{min(turned) / min(ran):.2f} times as long as in run.run()")
    for threads in (1, 0):
        env = BugVectorEnv(32, WORLD, sensors=["target"], threads=threads)
        env.reset(seed=1)
        chosen = numpy.random.default_rng(1).integers(9, size=(200, 32))
        best = 0
        for _ in range(TURNS):
            clock = time.thread_time if env.threads == 1 else time.perf_counter
            begun = clock()
            for action in chosen:
                env.step(action)
            best = max(best, chosen.size / (clock() - begun))
        print(f"BugVectorEnv, 32 worlds on {env.threads} thread{'s' * (env.threads > 1)}, 5 cycles per step: {best:,.0f} steps/s")
    return 0 if met else 1


if __name__ == "__main__":
    raise SystemExit(main())
