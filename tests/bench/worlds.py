"""How fast whole worlds run, brains, senses and noise included: robots at walls, in pairs and in teams.

    worlds.py FORAGE [BEFORE]

Prints seconds of the world per second of the process's own time, from the difference between a long and a short run, the best of
several turns. BEFORE is another forage to compare with, in the same turns. The challenge's worlds are read where $FORAGE_SHARED is.
"""
import pathlib
import sys
import tempfile

from command_line import SHARED, SYSTEMS, result, run

TURNS = 3
TEAM = [SYSTEMS / "team_a.iqr", SYSTEMS / "team_b.iqr", "--world", SYSTEMS / "worlds" / "team_arena.world"]
CHALLENGE = SHARED / "original" / "SDIC_challenge"


def eight_robots():
    """Eight systems that find lights and avoid walls, one for each robot of the challenge's arena."""
    robots = [f"Team{team}_Bug_0{number}" for team in "AB" for number in (1, 2, 3, 4)]
    command = [SYSTEMS / "reactive_foraging.iqr"] * len(robots) + ["--world", CHALLENGE / "SDIC_arena.world", "--game"]
    return command + [part for robot in robots for part in ("--robot", f"Bug={robot}")]


def cases(folder):
    """Per world: its name, the command, and the seconds of its short and of its long run."""
    yield "reactive_foraging in the open arena, in a corner", [SYSTEMS / "reactive_foraging.iqr", "--world", SYSTEMS / "worlds" / "open_arena.world"], 60, 1260
    yield "team arena, four robots", TEAM, 20, 140
    yield "team arena, filmed", TEAM + ["--video", folder / "team.gif"], 1, 11
    if not CHALLENGE.exists():
        print(f"skipped: the challenge's worlds, there is no {CHALLENGE}")
        return
    bug = CHALLENGE / "gazeboBug.iqr"
    yield "two robots, SDIC_two_robot_arena", [
        bug,
        bug,
        "--lenient",
        "--world",
        CHALLENGE / "SDIC_two_robot_arena.world",
        "--game",
        "--robot",
        "TeamA_Bug_01=TeamA_Bug_01",
        "--robot",
        "TeamA_Bug_01=TeamA_Bug_02",
    ], 10, 310
    yield "eight robots, SDIC_arena", eight_robots(), 10, 110


def times_real_time(forage, command, short, long):
    processor = [run(forage, "run", *command, "--seconds", seconds, "-o", "", "--quiet")[1] for seconds in (short, long)]
    return (long - short) / (processor[1] - processor[0])


def main():
    programs = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        for name, command, short, long in cases(pathlib.Path(folder)):
            best = [0.0] * len(programs)
            for _ in range(TURNS):
                for i, forage in enumerate(programs):
                    best[i] = max(best[i], times_real_time(forage, command, short, long))
            result("worlds/" + name, "x real time", best[0], "")
            if len(best) > 1:
                result("worlds/" + name, "x real time / before", best[0] / best[1], "")


if __name__ == "__main__":
    main()
