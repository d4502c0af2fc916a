"""Runs the robot of the tutorial, prints what it did, and draws its paths: python -m forage.demo."""
import os

import forage


def main() -> None:
    picture = "forage-out/trajectory.png"
    with forage.open(forage.SYSTEMS / "reactive_foraging.iqr", world=forage.SYSTEMS / "worlds/basic_arena.world") as run:
        run.run(trials=30)
        reached = run.trials["reached_target"]
        print(f"The robot drove through the arena for {run.seconds:.0f} s, and looked for the light in {len(reached)} trials.")
        print(f"It reached the light in {reached.sum()} of them.")
        os.makedirs(os.path.dirname(picture), exist_ok=True)
        run.plot("trajectory").save(picture)
    print(f"Its paths are drawn in {picture}. Its brain is {forage.SYSTEMS / 'reactive_foraging.iqr'}.")


if __name__ == "__main__":
    main()
