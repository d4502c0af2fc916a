"""Worlds, films, several systems in one run, and the page on how to make a world.

    world_test.py FORAGE_PROGRAM PROJECT_DIRECTORY [TEST...]
"""

import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

FORAGE = str(pathlib.Path(sys.argv[1]).resolve())
PROJECT = pathlib.Path(sys.argv[2]).resolve()
SYSTEMS = PROJECT / "systems"
TEAMS = [SYSTEMS / "team_a.iqr", SYSTEMS / "team_b.iqr", "--world", SYSTEMS / "worlds" / "team_arena.world"]


def gif_frames(data):
    """Counts the pictures of a GIF file and checks that it is complete."""
    assert data[:6] == b"GIF89a" and data[-1:] == b";", data[:6]
    at = 13 + (3 << ((data[10] & 7) + 1) if data[10] & 128 else 0)
    frames = 0
    while data[at] != 0x3B:
        if data[at] == 0x21:
            at += 2
        else:
            frames += 1
            at += 10 + (3 << ((data[at + 9] & 7) + 1) if data[at + 9] & 128 else 0) + 1
        while data[at]:
            at += data[at] + 1
        at += 1
    return frames


class World(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.here = pathlib.Path(directory.name)

    def forage(self, *arguments, status=0):
        done = subprocess.run([FORAGE, *map(str, arguments)], cwd=self.here, capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def test_every_shipped_world_is_listed_and_drawn(self):
        for world in sorted((SYSTEMS / "worlds").glob("*.world")):
            out = self.forage("world", world, "-o", f"{world.stem}.png").stdout
            self.assertRegex(out, r"robot +\w+ at \(")
            self.assertEqual((self.here / f"{world.stem}.png").read_bytes()[:4], b"\x89PNG")

    def test_mistakes_in_a_world_are_reported_with_file_line_and_column(self):
        text = (SYSTEMS / "worlds" / "team_arena.world").read_text()
        models = {"FORAGE_MODEL_PATH": str(SYSTEMS / "worlds" / "models")}
        for old, new, said in [
            ("-4.5 5.5 0 0 0 -0.8", "-4.5 nan 0 0 0 -0.8", r"bad.world:\d+:\d+: error: <pose> = 'nan' is not a finite number"),
            ("<name>A_2</name>", "<name>A_1</name>", r"bad.world:\d+:\d+: error: there are two robots named 'A_1'"),
            ("model://home", "model://hom", r"bad.world:\d+:\d+: error: there is no model 'model://hom'"),
            ("<most>12</most>", "<moost>12</moost>", r"bad.world:\d+:\d+: error: <plugin> cannot hold <moost>"),
            ("<site>-1 1 0.1</site>", "<site>-1 1</site>", r"bad.world:\d+:\d+: error: <site> has 2 numbers instead of 3"),
        ]:
            self.assertIn(old, text)
            (self.here / "bad.world").write_text(text.replace(old, new, 1))
            done = subprocess.run([FORAGE, "world", "bad.world"], cwd=self.here, capture_output=True, text=True, env=os.environ | models)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertRegex(done.stderr, said)
            self.assertFalse((self.here / "bad.png").exists())

    def test_two_teams_play_the_same_game_on_any_number_of_threads(self):
        for threads in (1, 4):
            out = self.forage("run", *TEAMS, "--seconds", 100, "--threads", threads, "-o", f"game{threads}").stdout
        self.assertRegex(out, r"score +team +points +good +bad\n +A +-?\d+ +\d+ +\d+\n +B +-?\d+")
        for name in ("score.csv", "trajectory_A_1.csv", "trajectory_B_2.csv"):
            self.assertEqual((self.here / "game1" / name).read_bytes(), (self.here / "game4" / name).read_bytes())
        with (self.here / "game1/score.csv").open(newline="") as file:
            deliveries = list(csv.DictReader(file))
        self.assertGreater(len(deliveries), 2)  # they do bring balls home
        points = {"A": 0, "B": 0}
        for row in deliveries:
            points[row["team"]] += int(row["points"])
            self.assertEqual((points["A"], points["B"]), (int(row["score_a"]), int(row["score_b"])))

    def test_two_modules_cannot_drive_one_robot(self):
        for command in (("run", TEAMS[0], TEAMS[0], *TEAMS[2:], "--seconds", 1), ("check", TEAMS[0], TEAMS[0], *TEAMS[2:])):
            said = self.forage(*command, status=2).stderr
            self.assertRegex(said, r"team_a.iqr:15:\d+: error: two modules drive the robot 'A_1': those of '.+' and '.+'\n")
            self.assertEqual(said.count("error: "), 2)  # and A_2
        # Without a world it is a warning, as --robot can still bind them to different robots.
        self.assertIn("warning: two modules drive the robot 'A_1'", self.forage("check", TEAMS[0], TEAMS[0]).stderr)

    def test_settings_change_the_rate_of_a_world_also(self):
        sound = PROJECT / "tests" / "diagnostics" / "sound"
        text = (sound / "system.iqr").read_text().replace('cylesPerSecond="25"', 'cylesPerSecond="{1 / cycle}"')
        file = self.here / "system.iqr"
        file.write_text(text.replace('<Process id="p"', '<Constant name="cycle" value="0.5"/><Process id="p"'))
        said = self.forage("check", file, "--world", sound / "world.world", "--set", "cycle=0.02").stdout
        self.assertIn("0.02 s of simulated time per cycle", said)

    def test_a_film_has_the_reported_number_of_frames(self):
        out = self.forage("run", *TEAMS, "--seconds", 3, "--video", "game.gif", "-o", "").stdout
        frames = int(re.search(r"game.gif: (\d+) frames", out)[1])
        self.assertGreater(frames, 20)
        self.assertEqual(gif_frames((self.here / "game.gif").read_bytes()), frames)
        out = self.forage("run", *TEAMS, "--seconds", 1, "--video", "game.png", "-o", "").stdout
        pictures = sorted(p.name for p in self.here.glob("game_*.png"))
        self.assertGreater(len(pictures), 5)
        self.assertIn(f"{pictures[0]} to {pictures[-1]}", out)
        self.assertIn("it ends with .gif, .mp4 or .png", self.forage("run", *TEAMS, "--video", "game.avi", status=2).stderr)

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_a_film_of_ffmpeg_shows_groups_beside_the_world(self):
        reactive = [SYSTEMS / "reactive_foraging.iqr", "--world", SYSTEMS / "worlds" / "basic_arena.world", "--seconds", 2, "-o", ""]
        out = self.forage("run", *reactive, "--video", "film.mp4").stdout
        groups = ("--video-group", "Bug/Motor", "--video-group", "mean(Bug/Light)")
        self.forage("run", *reactive, "--video", "wide.mp4", *groups)
        frames = int(re.search(r"film.mp4: (\d+) frames", out)[1])
        sizes = {}
        for name in ("film.mp4", "wide.mp4"):
            count = subprocess.run(["ffmpeg", "-i", name, "-f", "framemd5", "-"], cwd=self.here, capture_output=True, text=True)
            lines = count.stdout.splitlines()
            self.assertEqual(sum(not line.startswith("#") for line in lines), frames)
            sizes[name] = next(int(line.split()[-1].split("x")[0]) for line in lines if line.startswith("#dimensions"))
        self.assertEqual(sizes["wide.mp4"] - sizes["film.mp4"], 230)
        self.assertEqual(sorted(p.name for p in self.here.iterdir()), ["film.mp4", "wide.mp4"])
        self.assertIn("there is no group", self.forage("run", *reactive, "--video", "x.mp4", "--video-group", "Bug/Nothing", status=2).stderr)

    def test_a_film_of_ffmpeg_needs_ffmpeg(self):
        done = subprocess.run([FORAGE, "run", *map(str, TEAMS), "--video", "x.mp4"], cwd=self.here, capture_output=True, text=True, env={"PATH": "/nowhere"})
        self.assertEqual(done.returncode, 2)
        self.assertIn("'x.mp4' needs the program ffmpeg, which is not installed", done.stderr)
        self.assertEqual(list(self.here.iterdir()), [])

    def test_the_page_on_making_a_world_works_as_it_is_written(self):
        page = (PROJECT / "docs" / "how-to" / "make-a-world.md").read_text()
        os.symlink(SYSTEMS, self.here / "systems")
        (self.here / "build/release/bin").mkdir(parents=True)
        os.symlink(FORAGE, self.here / "build/release/bin/forage")
        blocks = re.findall(r"```sh\n(.*?)```", page, re.DOTALL)
        self.assertGreater(len(blocks), 3)
        for block in blocks:
            with self.subTest(block):
                done = subprocess.run(["sh", "-e"], input=block, cwd=self.here, capture_output=True, text=True, timeout=600)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        out = self.here / "forage-out/my"
        for name in ("my.png", "my.gif", "run/trajectory.png"):
            self.assertTrue((out / name).stat().st_size > 1000)
        with (out / "avoid/trajectory.csv").open(newline="") as file:
            path = [(float(row["x"]), float(row["y"])) for row in csv.DictReader(file)]
        for x, y in path:  # the system of one's own keeps the robot off the walls, on all sides
            self.assertTrue(-3.7 < x < 3.7 and -2.7 < y < 2.7, (x, y))
        self.assertTrue(min(x for x, _ in path) < -3 and max(x for x, _ in path) > 3)
        self.assertTrue((out / "duel/score.csv").is_file())

    def test_the_page_on_the_rules_of_the_robot_names_existing_tests(self):
        rows = re.findall(r"^\| (.+?) \| (.+?) \|$", (PROJECT / "docs/reference/robot-tests.md").read_text(), re.MULTILINE)[1:]
        self.assertGreater(len(rows), 25)
        files = ""
        for what, where in rows:
            folder = ""
            if not where.startswith("the same"):
                files = ""
            for name in re.findall(r"`([^`]+)`", where):
                folder, stem = name.rsplit("/", 1) if "/" in name else (folder, name)
                path = PROJECT / "tests" / folder / stem
                files += (path if path.suffix else path.with_suffix(".cpp")).read_text()
            for test in re.findall(r'"([^"]+)"', where):
                self.assertRegex(files, rf'TEST_CASE\(\s*"{test}|def test_{test}', what)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
