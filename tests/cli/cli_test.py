"""The program as users see it: its output, its files and its exit status.

    cli_test.py FORAGE_PROGRAM PROJECT_DIRECTORY [TEST...]
"""

import csv
import filecmp
import json
import os
import pathlib
import pty
import re
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "support"))
import pictures  # noqa: E402
from waiting import wait_for  # noqa: E402

FORAGE = str(pathlib.Path(sys.argv[1]).resolve())
PROJECT = pathlib.Path(sys.argv[2]).resolve()
SYSTEM = str(PROJECT / "systems" / "reactive_foraging.iqr")
EXERCISE = str(PROJECT / "systems" / "reactive_foraging_exercise.iqr")
WORLD = str(PROJECT / "systems" / "worlds" / "basic_arena.world")
OPEN_WORLD = str(PROJECT / "systems" / "worlds" / "open_arena.world")
SHARED = pathlib.Path(os.environ.get("FORAGE_SHARED", PROJECT.parent / "shared"))


class Cli(unittest.TestCase):
    def setUp(self):
        self._directory = tempfile.TemporaryDirectory()
        self.addCleanup(self._directory.cleanup)
        self.here = pathlib.Path(self._directory.name)

    def forage(self, *arguments, status=0):
        done = subprocess.run([FORAGE, *map(str, arguments)], cwd=self.here, capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def table(self, name):
        with (self.here / name).open(newline="") as file:
            return list(csv.reader(file))

    def run_robot(self, *arguments, system=SYSTEM, out="out", **more):
        return self.forage("run", system, "--world", WORLD, "-o", out, *arguments, **more)


class Run(Cli):
    def test_thirty_trials_give_a_table_a_picture_and_a_record(self):
        done = self.run_robot("--trials", 30, "--seed", 1)
        header, *rows = self.table("out/trials.csv")
        rows = [dict(zip(header, row)) for row in rows]
        self.assertEqual(len(rows), 30)
        self.assertEqual(
            header,
            [
                "trial",
                "start_x",
                "start_y",
                "start_yaw",
                "cycles",
                "smallest_distance",
                "outcome",
                "first_cycle",
                "end_x",
                "end_y",
                "end_yaw",
                "start",
                "patches",
                "recent_success",
                "discrepancy",
                "cue_peak",
                "distractor_peak",
                "sequences",
                "segments",
            ],
        )
        for number, row in enumerate(rows, 1):
            self.assertEqual(int(row["trial"]), number)
            self.assertGreater(int(row["cycles"]), 20)
            self.assertEqual(row["outcome"], "target" if float(row["smallest_distance"]) < 0.45 else "missed")
            # The middle start is the world's second one; each path leads over one lower and one upper patch.
            start = round(float(row["start_x"]) / 1.5) + 2
            self.assertEqual((int(row["start"]), row["patches"]), (start, {1: "cyan > red", 2: "blue > yellow", 3: "magenta > green"}[start]))
            self.assertEqual(float(row["recent_success"]), sum(r["outcome"] == "target" for r in rows[:number]) / number)
            self.assertEqual({row[layer] for layer in ("discrepancy", "cue_peak", "sequences")}, {""})  # no such layers
        reached = sum(row["outcome"] == "target" for row in rows)
        self.assertGreaterEqual(reached, 25)
        self.assertIn(f"{reached} of 30", done.stdout)
        self.assertRegex(done.stdout, r"[\d]+ cycles/s, [\d]+ x real time")
        record = json.loads((self.here / "out/run.json").read_text())
        self.assertEqual((record["seed"], record["trials"], record["result"]["robots"][0]["at_target"]), (1, 30, reached))
        picture = (self.here / "out/trajectory.png").read_bytes()
        self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
        width, height = struct.unpack(">II", picture[16:24])
        self.assertGreater(width, 600)
        self.assertGreater(height, 600)
        self.assertEqual(sorted(p.name for p in (self.here / "out").iterdir()), ["run.json", "trajectory.csv", "trajectory.png", "trials.csv"])

    def test_measures_of_the_learning_layers_are_those_of_their_groups(self):
        # A group shows the values that its module writes one cycle later.
        done = self.forage(
            "run",
            PROJECT / "systems/dac_foraging.iqr",
            "--world",
            WORLD,
            "--trials",
            25,
            "-o",
            "out",
            "--set",
            "Contextual.enableModule=true",
            "--set",
            "Contextual.Discrepancy Threshold=0.5",
            "--record",
            "Adaptive/discrepancy",
            "--record",
            "Adaptive/prototype",
            "--record",
            "Contextual/Empty",
        )
        header, *rows = self.table("out/trials.csv")
        trials = [dict(zip(header, row)) for row in rows]
        column = lambda name: [list(map(float, row[1:])) for row in self.table(f"out/{name}_act.csv")[1:]]
        discrepancy, prototype = column("Adaptive_discrepancy"), column("Adaptive_prototype")
        empty = self.table("out/Contextual_Empty_act.csv")[1:]  # large: only what is needed becomes numbers
        stored = 0
        for trial in trials[:-1]:
            first = int(trial["first_cycle"])
            end = first + int(trial["cycles"])  # the first cycle after the trial
            self.assertEqual(float(trial["discrepancy"]), discrepancy[end][0])
            peaks = [float(trial["distractor_peak"]), float(trial["cue_peak"])]
            self.assertEqual(max(peaks), max(max(cells) for cells in prototype[first + 1 : end + 1]))
            cells = list(map(float, empty[end][1:]))
            memory = [cells[row * 100 : (row + 1) * 100] for row in range(50)]
            if sum(map(sum, memory)) == 0:  # closed: it has written nothing yet
                self.assertEqual((trial["sequences"], trial["segments"]), ("0", "0"))
                continue
            self.assertEqual(int(trial["sequences"]), sum(row[0] == 0 for row in memory))
            self.assertEqual(int(trial["segments"]), sum(row.count(0) for row in memory))
            stored = int(trial["sequences"])
        self.assertGreater(stored, 5)
        self.assertRegex(done.stdout, rf"memory +{trials[-1]['sequences']} of 50 sequences, of [\d.]+ segments on average")
        self.assertRegex(done.stdout, r"discrepancy +0\.\d+ after the first trial, 0\.\d+ after the last")
        self.assertRegex(done.stdout, r"prototypes +[\d.]+ times as strong at the last patch")

    def test_the_readme_has_the_number_of_trials_that_reach_the_target(self):
        done = self.run_robot("--trials", 30, "--seed", 1)
        reached = re.search(r"at the target +(\d+ of 30)", done.stdout).group(1)
        self.assertIn(f"**{reached}**", (PROJECT / "README.md").read_text())

    def test_the_same_seed_gives_the_same_bytes_and_another_seed_other_bytes(self):
        record = ("--record", "Bug/Light", "--record", "Bug/Motor:vm", "--cycles", 300)
        for out, seed in (("a", 3), ("b", 3), ("c", 4)):
            self.forage("run", SYSTEM, "--world", WORLD, "-o", out, "--seed", seed, *record)
        names = sorted(p.name for p in (self.here / "a").iterdir())
        self.assertEqual(len(names), 6)
        self.assertEqual(filecmp.cmpfiles(self.here / "a", self.here / "b", names, shallow=False), (names, [], []))
        self.assertFalse(filecmp.cmp(self.here / "a/Bug_Light_act.csv", self.here / "c/Bug_Light_act.csv", shallow=False))

    def test_recording_has_a_header_and_a_row_for_every_kth_cycle(self):
        self.run_robot("--cycles", 100, "--record", "Bug/GPS", "--record-every", 10)
        rows = self.table("out/Bug_GPS_act.csv")
        self.assertEqual(rows[0], ["cycle", "x1_y1", "x2_y1", "x3_y1"])
        self.assertEqual([int(r[0]) for r in rows[1:]], list(range(0, 100, 10)))
        # The group reads x + 10, y + 10, heading + pi; values that are sensed at the end of cycle t arrive in t + 2.
        self.assertAlmostEqual(float(rows[2][1]), 10, delta=0.05)
        self.assertAlmostEqual(float(rows[2][2]), 10 - 2 + 0.08 * 5, delta=0.5)
        self.assertAlmostEqual(float(rows[2][3]), 1.5708 + 3.1416, delta=0.05)

    def test_trials_trajectory_and_recordings_agree(self):
        self.run_robot("--trials", 6, "--record", "Bug/GPS")
        header, *trials = self.table("out/trials.csv")
        trials = [dict(zip(header, map(float, row[:6] + [0] + row[7:12]))) for row in trials]
        gps = {int(r[0]): (float(r[1]) - 10, float(r[2]) - 10) for r in self.table("out/Bug_GPS_act.csv")[1:]}
        path = [[float(v) for v in row] for row in self.table("out/trajectory.csv")[1:]]
        for trial in trials:
            own = [p for p in path if p[0] == trial["trial"]]
            self.assertEqual(own[0][2:], [trial["start_x"], trial["start_y"], trial["start_yaw"]])
            self.assertEqual(own[-1][2:], [trial["end_x"], trial["end_y"], trial["end_yaw"]])
            self.assertEqual(own[-1][1], trial["first_cycle"] + trial["cycles"] - 1)
            # The GPS group shows in t + 2 where the robot is at the end of cycle t.
            for _, cycle, x, y, _ in own[1:-1]:
                if cycle + 2 in gps:
                    self.assertAlmostEqual(gps[cycle + 2][0], x, places=9)
                    self.assertAlmostEqual(gps[cycle + 2][1], y, places=9)
            nearest = min(((x - 0) ** 2 + (y - 2.5) ** 2) ** 0.5 for _, _, x, y, _ in own)
            self.assertLessEqual(trial["smallest_distance"], nearest + 1e-9)
            self.assertGreater(trial["smallest_distance"], nearest - 0.1)

    def test_recordings_of_an_earlier_run_are_removed(self):
        self.run_robot("--cycles", 10, "--record", "Bug/GPS")
        (self.here / "out/mine.txt").write_text("kept")
        self.run_robot("--cycles", 10, "--record", "Bug/Light")
        names = sorted(p.name for p in (self.here / "out").iterdir())
        self.assertEqual(names, ["Bug_Light_act.csv", "mine.txt", "run.json", "trajectory.csv", "trajectory.png", "trials.csv"])

    def test_the_robot_is_driven_by_hand(self):
        self.run_robot("--seconds", 2, "--clamp", "Bug/Motor(5,1)=1", system=EXERCISE)  # straight on, full speed
        end = self.table("out/trials.csv")[1]
        self.assertAlmostEqual(float(end[8]), 0, delta=0.02)
        self.assertAlmostEqual(float(end[9]), -2 + 2, delta=0.02)
        self.run_robot("--seconds", 1, "--clamp", "Bug/Motor(1,5)=1", system=EXERCISE)  # turn left on the spot
        end = self.table("out/trials.csv")[1]
        self.assertAlmostEqual(float(end[9]), -2, delta=0.02)
        self.assertGreater(float(end[10]), 1.57 + 0.5)

    def test_a_full_disk_keeps_complete_rows_and_the_other_results(self):
        command = (
            f'ulimit -f 100; trap "" XFSZ; exec {shlex.quote(FORAGE)} run {shlex.quote(SYSTEM)} --world {shlex.quote(WORLD)} '
            "--cycles 5000 -o out -r 'Bug/Place Cells' -r Bug/GPS"
        )
        done = subprocess.run(["bash", "-c", command], cwd=self.here, capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, 1)
        self.assertIn("File too large", done.stderr)
        cells, gps = self.table("out/Bug_Place_Cells_act.csv"), self.table("out/Bug_GPS_act.csv")
        self.assertTrue(all(len(row) == len(cells[0]) for row in cells))
        self.assertGreaterEqual(len(gps), len(cells))
        self.assertGreater(len(cells), 3)
        names = sorted(p.name for p in (self.here / "out").iterdir())
        self.assertIn("trials.csv", names)
        self.assertFalse([n for n in names if n.endswith(".part")])

    def test_length_in_seconds_and_in_cycles(self):
        self.run_robot("--seconds", 8, "-q")
        self.assertEqual(json.loads((self.here / "out/run.json").read_text())["result"]["cycles"], 100)  # 80 ms each
        self.run_robot("--cycles", 77, "-q")
        self.assertEqual(json.loads((self.here / "out/run.json").read_text())["result"]["cycles"], 77)

    def test_the_summary_says_whether_the_condition_of_until_held(self):
        (self.here / "small.iqr").write_text(SMALL_SYSTEM)
        (self.here / "d.csv").write_text("-1,*,out,1,2\n4,*,out,3,2\n")
        run = ("run", "small.iqr", "--cycles", 9, "--replay", "d.csv", "-o", "", "--until")
        self.assertRegex(self.forage(*run, "P/A(1,1) > 100").stdout, r"\n  until +P/A\(1,1\) > 100: it never held\n")
        self.assertRegex(self.forage(*run, "P/A(1,1) >= 3").stdout, r"\n  until +P/A\(1,1\) >= 3: it held after cycle 6\n")

    def test_a_run_in_a_world_without_trials_has_none(self):
        done = self.forage("run", SYSTEM, "--world", OPEN_WORLD, "--seconds", 60, "--seed", 2, "-o", "out")
        self.assertRegex(done.stdout, r"target +0\.\d\d m away at the nearest: reached")
        self.assertEqual(len(self.table("out/trials.csv")), 1)  # the header
        self.forage("plot", "out", "trajectory", "-o", "again")
        self.assertTrue(filecmp.cmp(self.here / "out/trajectory.png", self.here / "again/trajectory.png", shallow=False))

    def test_a_world_may_have_no_robots(self):
        (self.here / "small.iqr").write_text(SMALL_SYSTEM)
        (self.here / "d.csv").write_text("-1,*,out,1,2\n")
        (self.here / "empty.world").write_text('<sdf version="1.4"><world name="empty"/></sdf>')
        self.forage("run", "small.iqr", "--replay", "d.csv", "--world", "empty.world", "--cycles", 5, "-o", "out", "-p", "time:P/A")

    def test_set_changes_a_parameter(self):
        self.run_robot("--cycles", 200, "--set", "Motor In to Motor.weight=0", "--record", "Bug/Motor")
        rows = self.table("out/Bug_Motor_act.csv")[1:]
        self.assertTrue(all(float(v) == 0 for r in rows for v in r[1:]))

    def test_at_changes_a_parameter_in_exactly_one_cycle(self):
        (self.here / "small.iqr").write_text(SMALL_SYSTEM)
        (self.here / "d.csv").write_text("-1,*,out,1,2\n4,*,out,3,2\n")
        done = self.forage(
            "run",
            "small.iqr",
            "--cycles",
            9,
            "--replay",
            "d.csv",
            "-r",
            "P/A",
            "-o",
            "out",
            "--schedule",
            "cycle 2: P/A.excGain=10",
            "--schedule",
            "P/A(1,1) > 20 && cycle > 3: P/A.excGain = 0",
            "--schedule",
            "0.28 s: P/A.excGain=0.5",
            "--schedule",
            "cycle 9: P/A.excGain=7",
        )
        self.assertEqual([r[1] for r in self.table("out/P_A_act.csv")[1:]], ["1", "1", "10", "10", "10", "30", "0", "1.5", "1.5"])
        self.assertIn("in cycle 6, at P/A(1,1) > 20 && cycle > 3: P/A.excGain = 0", done.stdout)
        self.assertIn("not changed    at cycle 9: P/A.excGain=7: it never was", done.stdout)
        result = json.loads((self.here / "out/run.json").read_text())["result"]
        self.assertEqual([c["cycle"] for c in result["changes"]], [2, 6, 7, None])

    def test_a_name_that_begins_as_a_move_is_a_name(self):
        (self.here / "small.iqr").write_text(SMALL_SYSTEM.replace('name="P"', 'name="move on"'))
        (self.here / "d.csv").write_text("-1,*,out,1,2\n")
        done = self.forage("run", "small.iqr", "--cycles", 4, "--replay", "d.csv", "-o", "", "--schedule", "cycle 2: move on/A.excGain=10")
        self.assertIn("in cycle 2, at cycle 2: move on/A.excGain=10", done.stdout)

    def test_patterns_change_the_activity(self):
        (self.here / "small.iqr").write_text(SMALL_SYSTEM)
        (self.here / "d.csv").write_text("-1,*,out,1,2\n")
        (self.here / "p.txt").write_text("# three patterns\n1 2\n\n3, 4\n\n\n5 6")

        def a(*options):
            self.forage("run", "small.iqr", "--cycles", 8, "--replay", "d.csv", "-r", "P/A", "-o", "out", "-q", *options)
            return [float(r[1]) for r in self.table("out/P_A_act.csv")[1:]], [float(r[2]) for r in self.table("out/P_A_act.csv")[1:]]

        self.assertEqual(a("--clamp", "P/A(2,1)=9; from cycle 2; until cycle 4"), ([1, 1, 0, 0, 1, 1, 1, 1], [2, 2, 9, 9, 2, 2, 2, 2]))
        self.assertEqual(a("--add", "P/A(1,1)=9; from cycle 2", "--add", "P/A(2,1)=1;from cycle 2"), ([1, 1, 10, 10, 10, 10, 10, 10], [2, 2, 3, 3, 3, 3, 3, 3]))
        self.assertEqual(a("--multiply", "P/A(1,1)=3 (2,1)=-1; every 3"), ([3, 1, 1, 3, 1, 1, 3, 1], [-2, 2, 2, -2, 2, 2, -2, 2]))
        self.assertEqual(a("--clamp", "P/A=p.txt; times 2")[0], [1, 3, 5, 1, 3, 5, 1, 1])
        self.assertEqual(a("--add", "P/A = p.txt; step 2; every 2; backwards")[0], [6, 1, 2, 1, 6, 1, 2, 1])
        self.assertEqual(a("--clamp", "P/A(1,1)=5", "--multiply", "P/A(1,1)=2", "--add", "P/A(1,1)=1")[0], [12] * 8)  # in this order: clamp, add, multiply
        settings = json.loads((self.here / "out/run.json").read_text())
        self.assertEqual((settings["clamp"], settings["multiply"]), (["P/A(1,1)=5"], ["P/A(1,1)=2"]))
        for rows, message in (
            ("1 2\n3\n", "p.txt:2:1: error: 1 number in a row, not 2"),
            ("1 2\n3 x\n\n", "p.txt:2:3: error: 'x' is not a number"),
            ("1 2\n3 4\n\n", "p.txt:2:1: error: a pattern ends here after 2 rows, not 1"),
            ("\n", "p.txt: error: there are no patterns"),
        ):
            (self.here / "p.txt").write_text(rows)
            self.assertIn(message, self.forage("run", "small.iqr", "--cycles", 1, "--replay", "d.csv", "--clamp", "P/A=p.txt", status=2).stderr)

    def test_at_a_trial(self):
        self.run_robot("--trials", 3, "-r", "Bug/Motor", "--schedule", "trial 3: Motor In to Motor.weight=0", "--trial-timeout", 20, status=1)
        cycle = json.loads((self.here / "out/run.json").read_text())["result"]["changes"][0]["cycle"]
        trials = self.table("out/trials.csv")[1:]
        third = int(trials[2][7])  # first_cycle
        self.assertLess(int(trials[1][7]) + int(trials[1][4]), cycle + 1)  # the second is over
        self.assertLessEqual(cycle, third)
        motor = {int(r[0]): [float(v) for v in r[1:]] for r in self.table("out/Bug_Motor_act.csv")[1:]}
        self.assertTrue(any(motor[cycle]))  # what was delivered before
        self.assertFalse(any(any(row) for c, row in motor.items() if c > cycle))

    def test_the_exercise_stands_still_and_the_run_ends(self):
        done = self.run_robot("--trials", 2, "--trial-timeout", 20, system=EXERCISE, status=1)
        self.assertEqual(done.stderr, "error: trial 1 did not end within 20 s (--trial-timeout)\n")
        self.assertIn("did not end within 20 s", done.stdout)
        self.assertIn("0.00 m apart", done.stdout)

    def test_quiet_prints_nothing(self):
        done = self.run_robot("--cycles", 10, "-q")
        self.assertEqual((done.stdout, done.stderr), ("", ""))

    def test_without_a_directory_no_files_are_written(self):
        self.forage("run", SYSTEM, "--world", WORLD, "--cycles", 10, "-o", "")
        self.assertEqual(list(self.here.iterdir()), [])

    def test_a_run_in_real_time_takes_the_time_of_the_world(self):
        begin = time.monotonic()
        self.run_robot("--seconds", 1, "--realtime")
        self.assertGreaterEqual(time.monotonic() - begin, 0.9)

    def test_progress_on_a_terminal_only(self):
        self.assertNotIn("\r", self.run_robot("--cycles", 1000).stderr)
        try:
            pid, terminal = pty.fork()
        except OSError as error:
            self.skipTest(f"no terminal to be had: {error}")
        if pid == 0:
            os.chdir(self.here)
            os.environ["TERM"] = "xterm"
            os.execv(FORAGE, [FORAGE, "run", SYSTEM, "--world", WORLD, "--seconds", "2", "--realtime"])
        seen = b""
        try:
            while chunk := os.read(terminal, 4096):
                seen += chunk
        except OSError:
            pass
        os.waitpid(pid, 0)
        self.assertRegex(seen, rb"\[=* *\] +\d+ %  0 trials, 0 at the target  \d+ x real time  \d+ cycles/s")

    def test_an_interrupt_keeps_the_results_so_far(self):
        command = [FORAGE, "run", SYSTEM, "--world", WORLD, "--seconds", "1000", "--realtime", "--record", "Bug/Light"]
        process = subprocess.Popen(command, cwd=self.here, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        table = self.here / "forage-out/Bug_Light_act.csv.part"
        wait_for(lambda: table.exists() and table.read_bytes().count(b"\n") > 3, process)
        process.send_signal(signal.SIGINT)
        text, said = process.communicate(timeout=600)
        self.assertEqual(process.returncode, 130)
        self.assertRegex(said, r"(?m)^finishing cycle \d+; Ctrl-C again ends at once$")
        self.assertIn("stopped", text)
        rows = self.table("forage-out/Bug_Light_act.csv")
        self.assertGreater(len(rows), 2)
        self.assertTrue(all(len(r) == 33 for r in rows))

    @unittest.skipIf(len(os.sched_getaffinity(0)) < 2, "there is one core: threads share nothing")
    def test_the_summary_has_the_share_of_shared_cycles(self):
        small = re.sub("<Module.*</Module>", "", SMALL_SYSTEM, flags=re.DOTALL)
        (self.here / "small.iqr").write_text(small)
        self.assertNotIn("threads", self.forage("run", "small.iqr", "--cycles", 10).stdout)
        out = self.forage("run", "small.iqr", "--cycles", 10, "--threads", 2).stdout
        self.assertRegex(out, r"threads +1 of 2: the cycles are too short to share, or too few to measure")
        (self.here / "large.iqr").write_text(small.replace('hcount="2" vcount="1"', 'hcount="100" vcount="80"'))
        self.assertRegex(
            self.forage("run", "large.iqr", "--cycles", 100, "--threads", 2).stdout,
            r"threads +2, which shared [1-9]\d*\.\d % of the cycles; in the others, one thread was as fast when measured",
        )
        self.assertRegex(self.forage("run", "large.iqr", "--cycles", 100, "--threads", 1000).stdout, r"threads +\d+ of 1000, one per core, which shared")

    def test_drive_and_clamp_tables(self):
        system = self.here / "small.iqr"
        system.write_text(SMALL_SYSTEM)
        (self.here / "drive.csv").write_text("cycle,process,target,v0...\n0,P,out,1,2\n3,P,out,5,0\n")
        (self.here / "clamp.csv").write_text("cycle,process,target,v0...\n2,P,B,7,8\n")
        self.forage("run", system, "--cycles", 6, "--replay", "drive.csv", "--clamp", "clamp.csv", "-r", "P/A", "-r", "P/B", "-o", "out")
        a = self.table("out/P_A_act.csv")[1:]
        b = self.table("out/P_B_act.csv")[1:]
        self.assertEqual(a, [["0", "0", "0"], ["1", "1", "2"], ["2", "1", "2"], ["3", "1", "2"], ["4", "5", "0"], ["5", "5", "0"]])
        self.assertEqual(b, [["0", "0", "0"], ["1", "0", "0"], ["2", "7", "8"], ["3", "7", "8"], ["4", "7", "8"], ["5", "7", "8"]])


class Mistakes(Cli):
    def test_usage_is_status_2_with_a_hint(self):
        for arguments in (
            ["rum"],
            ["run"],
            ["run", SYSTEM, "--cycles", "0"],
            ["run", SYSTEM, "--cycles", "5", "--trials", "2"],
            ["run", SYSTEM, "--seed", "x"],
            ["run", SYSTEM, "--seed", "-1"],
            ["run", SYSTEM, "--seconds", "nan"],
            ["run", SYSTEM, "--seconds", "-1"],
            ["run", SYSTEM, "--record-every", "2"],
            ["run", SYSTEM, "--threads", "0"],
        ):
            done = self.forage(*arguments, status=2)
            self.assertIn("error:", done.stderr)
            self.assertIn("hint:", done.stderr)
            self.assertLess(len(done.stderr), 200)
        self.assertIn("there is no command 'chekc'", self.forage("chekc", SYSTEM, status=2).stderr)
        self.assertIn("did you mean 'check'", self.forage("chekc", SYSTEM, status=2).stderr)
        self.assertIn("did you mean '--trials'", self.forage("run", SYSTEM, "--trails", "3", status=2).stderr)
        self.assertIn("Usage:", self.forage(status=2).stderr)
        self.assertIn("Usage:", self.forage("help").stdout)
        self.assertEqual(self.forage("help", "run").stdout, self.forage("run", "--help").stdout)
        self.assertIn("there is no command 'rum'", self.forage("help", "rum", status=2).stderr)

    def test_every_mistake_of_a_file_is_reported_with_its_place(self):
        bad = self.here / "bad.iqr"
        text = SMALL_SYSTEM.replace('name="excGain"', 'name="exGain"').replace('target="a" type', 'target="nowhere" type')
        bad.write_text(text)
        for command in (["check", bad], ["run", bad, "--cycles", "1"]):
            done = self.forage(*command, status=2)
            self.assertRegex(done.stderr, r"bad\.iqr:\d+:\d+: error: neuronLinearThreshold has no parameter 'exGain'")
            self.assertIn("did you mean 'excGain'", done.stderr)
            self.assertRegex(done.stderr, r"bad\.iqr:\d+:\d+: error: .*'nowhere'")
        self.assertEqual([p.name for p in self.here.iterdir()], ["bad.iqr"])  # nothing left behind

    def test_a_file_name_that_no_result_could_hold_is_refused(self):
        name = os.fsdecode(b"caf\xe9.iqr")
        (self.here / name).write_text(SMALL_SYSTEM)
        for command in (["check", name], ["run", name, "--cycles", "1"], ["describe", name]):
            done = self.forage(*command, status=2)
            self.assertIn("caf\\xe9.iqr: error: the name of this file is not UTF-8\n  hint: rename it", done.stderr)
        self.assertEqual(len(list(self.here.iterdir())), 1)

    def test_names_of_a_system_do_not_lead_out_of_the_results(self):
        (self.here / "a" / "b").mkdir(parents=True)
        (self.here / "a" / "b" / "x.iqr").write_text(WITHOUT_MODULE.replace('name="A"', 'name="../../../evil"').replace('name="P"', 'name="../../up"'))
        group = "../../up/../../../evil"
        self.forage("run", "a/b/x.iqr", "--cycles", "3", "--record", group, "--plot", f"time:{group}", "-o", "a/b/out")
        self.assertEqual([p.name for p in self.here.iterdir()], ["a"])
        self.assertEqual([p.name for p in (self.here / "a").iterdir()], ["b"])
        self.assertEqual(sorted(p.name for p in (self.here / "a/b").iterdir()), ["out", "x.iqr"])

    def test_links_in_a_folder_of_results_lead_nowhere(self):
        (self.here / "x.iqr").write_text(WITHOUT_MODULE)
        run = ["run", "x.iqr", "--cycles", "3", "--record", "P/A", "--plot", "time:P/A", "-o", "out"]
        self.forage(*run)
        self.forage("plot", "out")
        self.forage("view", "out")
        mine = self.here / "mine"
        mine.write_text("mine")
        names = [p.name for p in (self.here / "out").iterdir()]
        self.assertIn("index.html", names)

        def link(names):
            for name in names:
                (self.here / "out" / name).unlink(missing_ok=True)
                (self.here / "out" / name).symlink_to(mine)

        link([*names, *(name + ".part" for name in names)])
        self.forage(*run)
        self.assertEqual(mine.read_text(), "mine")
        link(name for name in names if name.endswith((".png", ".html")))
        self.forage("plot", "out")
        self.forage("view", "out")
        self.assertEqual(mine.read_text(), "mine")
        self.assertTrue((self.here / "out/index.html").read_text().startswith("<!DOCTYPE html>"))

    def test_lenient_turns_unknown_names_into_warnings(self):
        bad = self.here / "bad.iqr"
        bad.write_text(SMALL_SYSTEM.replace('name="excGain"', 'name="exGain"'))
        done = self.forage("check", bad, "--lenient")
        self.assertIn("warning:", done.stderr)
        self.assertIn("fine", done.stdout)

    def test_wrong_names_on_the_command_line(self):
        for arguments, message in (
            (["--record", "Bug/Ligth"], "did you mean 'Bug/Light'"),
            (["--record", "Bug/Light:vn"], "did you mean 'vm'"),
            (["--set", "Bug/Light.thresold=1"], "did you mean 'threshold'"),
            (["--set", "Bug/Light.threshold=high"], "is not a number"),
            (["--set", "Bug.device_name=a\x1b"], "'a\\x1b' has a control character"),
            (["--set", "Bug.device_name=a\u0085"], "'a\\u0085' has a control character"),
            (["--set", "nonsense"], "not an assignment"),
            (["--replay", "absent.csv"], "absent.csv: error: there is no such file"),
            (["--record", "Light"], "did you mean 'Bug/Light'"),
            (["--set", "US.threshold=1"], "did you mean 'Reactive Layer/US'"),
            (["--set", "Approach.threshold=1"], "did you mean 'Reactive Layer/Approach' or 'Selection/Approach'"),
            (["--clamp", "Bug/Motor(10,1)=1"], "it has 9 columns and 9 rows"),
            (["--clamp", "Bug/Motr(1,1)=1"], "did you mean 'Bug/Motor'"),
            (["--clamp", "Bug/Motor:vm(1,1)=1"], "only the activity"),
            (["--add", "Bug/Motor(1,1)=x"], "--add '(1,1)=x', column 7: 'x' is not a number"),
            (["--add", "Bug/Motor(1,1)=1 2"], "column 9: '2' is not a cell with a value"),
            (["--add", "Bug/Motor"], "write 'Process/Group=value', 'Process/Group(x,y)=value' or 'Process/Group=FILE', or name a table"),
            (["--multiply", "Bug/Motor(1,1)=1; evry 2"], "'evry 2' is not an option of a manipulation; options are every N, step N"),
            (["--multiply", "Bug/Motor(1,1)=1; every 0"], "'every' needs a whole number, at least 1"),
            (["--add", "Bug/Motor(1,1)=1; from trail 2"], "column 8: a comparison is missing behind 'trail 2'"),
            (["--add", "Bug/Motor=absent.txt"], "absent.txt: error: there is no such file"),
            (["--schedule", "trial 5"], "'trial 5': not a condition, a colon, a blank and a change; for example 'trial >= 200:"),
            (["--schedule", "trial 5: Bug/Light.thresold=1"], "did you mean 'threshold'"),
            (["--schedule", "trail 5: Bug/Light.threshold=1"], "column 8: a comparison is missing behind 'trail 5'"),
            (["--schedule", "max(Bug/Ligth) > 5: Bug/Light.threshold=1"], "did you mean 'Bug/Light'"),
            (["--schedule", "cycle 5: move Bgu=1,1"], "there is no robot and no movable object 'Bgu'\n  hint: did you mean 'Bug'?"),
            (["--schedule", "cycle 5: move Bug=1,a"], "column 12: 'a' is not a number"),
            (["--schedule", "cycle 5: move Bug=20000,0"], "a place is within 10 km"),
            (["--schedule", "cycle 5: begin_trial Bug=99"], "there is no start pose 99: there are 3"),
            (["--schedule", "cycle 5: Bug.device_name=x"], "'device_name' is read at start only"),
            (["--schedule", "cycle 5: Bug.placeSigma=0"], "must be above 0"),
            (["--schedule", "cycle 5: Bug.enableModule=false"], "cannot be switched on or off"),
        ):
            done = self.run_robot("--cycles", 1, *arguments, status=2)
            self.assertIn("error:", done.stderr)
            self.assertIn(message, done.stderr)

    def test_names_with_blanks_and_ids_work(self):
        self.run_robot("--cycles", 1, "--set", " Bug/Light . threshold = 0.1 ", "--set", "reactive.us.threshold=0.3", "--record", "bug.gps")

    def test_a_parameter_that_is_set_twice_is_named(self):
        done = self.run_robot("--cycles", 1, "--set", "Bug/Light.threshold=0.1", "--set", "Bug/Light.threshold =0.2")
        self.assertEqual(done.stderr.count("warning: --set: 'Bug/Light.threshold' is set more than once\n  hint: the last one counts"), 1)

    def test_rows_that_nothing_plays_and_wrong_tables(self):
        (self.here / "small.iqr").write_text(SMALL_SYSTEM)
        for rows, message in (
            ("0,P,outt,1,2", "t.csv:1:3: error: no moduleReplay plays 'P,outt'"),
            ("0,P,out,1,2,3", "t.csv:1:3: error: 3 values for 'P/A', which has 2 cells"),
            ("0,P,out,1,x", "t.csv:1:11: error: 'x' is not a number"),
            ("0,P,out,1,2,", "t.csv:1:13: error: there is no number here"),
            ("", "there are no rows in it"),
        ):
            (self.here / "t.csv").write_text(rows + "\n")
            self.assertIn(message, self.forage("run", "small.iqr", "--cycles", 1, "--replay", "t.csv", status=2).stderr)
        (self.here / "t.csv").write_text("\ufeffcycle,process,target\n# a remark\n 0 , P , out , 1 , 2 \r\n")
        self.forage("run", "small.iqr", "--cycles", 1, "--replay", "t.csv")
        self.assertIn("no process has an enabled moduleReplay", self.run_robot("--cycles", 1, "--replay", "t.csv", status=2).stderr)
        (self.here / "t.csv").write_text("0,*,B,1,2\n")
        self.forage("run", "small.iqr", "--cycles", 1, "--replay", "d.csv", "--clamp", "t.csv", status=2)  # no d.csv
        (self.here / "d.csv").write_text("0,*,out,1,2\n")
        self.forage("run", "small.iqr", "--cycles", 1, "--replay", "d.csv", "--clamp", "t.csv")

    def test_a_file_that_a_system_names_is_found_beside_it(self):
        (self.here / "sub").mkdir()
        module = '<Module name="moduleReplay"><Parameter name="file" value="d.csv"/>'
        (self.here / "sub/small.iqr").write_text(SMALL_SYSTEM.replace('<Module name="moduleReplay">', module))
        (self.here / "sub/d.csv").write_text("0,P,out,1,2\n")
        self.forage("run", "sub/small.iqr", "--cycles", 3)
        (self.here / "sub/d.csv").write_text("0,P,out,1\n")
        self.assertRegex(self.forage("check", "sub/small.iqr", status=2).stderr, r"sub/d.csv:1:3: error: 1 value for 'P/A'")

    def test_a_directory_that_cannot_be_written(self):
        if os.geteuid() == 0:
            self.skipTest("root may write everywhere")
        (self.here / "out").mkdir(mode=0o555)
        self.assertIn("Permission denied", self.run_robot("--cycles", 1, status=2).stderr)

    def test_no_files_are_written_when_a_name_is_wrong(self):
        self.run_robot("--cycles", 1, "--record", "Bug/Ligth", status=2)
        self.assertEqual(list(self.here.iterdir()), [])

    def test_missing_files(self):
        self.assertIn("absent.iqr", self.forage("run", "absent.iqr", status=2).stderr)
        self.assertIn("absent.world", self.forage("run", SYSTEM, "--world", "absent.world", status=2).stderr)

    def test_a_robot_without_a_world(self):
        done = self.forage("run", SYSTEM, "--cycles", 5, "-o", "", status=2)
        self.assertIn("--world", done.stderr)

    def test_trials_in_a_world_without_trials(self):
        self.assertIn("never resets", self.forage("run", SYSTEM, "--world", OPEN_WORLD, "--trials", 2, status=2).stderr)
        system = self.here / "small.iqr"
        system.write_text(SMALL_SYSTEM)
        self.assertIn("needs a world", self.forage("run", system, "--trials", 2, status=2).stderr)

    def test_a_directory_that_cannot_be_made(self):
        (self.here / "file").write_text("")
        self.assertIn("error:", self.run_robot("--cycles", 1, out="file/out", status=2).stderr)


class Convert(Cli):
    def test_converting_a_converted_file_changes_no_byte(self):
        for system in (PROJECT / "systems").glob("*.iqr"):
            self.forage("convert", system, "one.iqr")
            self.forage("convert", "one.iqr", "two.iqr")
            self.assertEqual((self.here / "one.iqr").read_bytes(), (self.here / "two.iqr").read_bytes())
            self.assertIn("<!--", (self.here / "one.iqr").read_text())
            self.forage("check", "one.iqr")

    def test_a_converted_system_runs_the_same(self):
        self.forage("convert", SYSTEM, "copy.iqr")
        self.run_robot("--cycles", 200, "--record", "Bug/Motor", out="a")
        self.run_robot("--cycles", 200, "--record", "Bug/Motor", out="b", system="copy.iqr")
        self.assertTrue(filecmp.cmp(self.here / "a/Bug_Motor_act.csv", self.here / "b/Bug_Motor_act.csv", shallow=False))

    def test_extract_link_embed_and_import(self):
        (self.here / "small.iqr").write_text(SMALL_SYSTEM)
        self.forage("convert", "small.iqr", "part.iqrProcess", "--extract", "P")
        linking = (
            SMALL_SYSTEM[: SMALL_SYSTEM.index("  <Process")]
            + '  <Process id="p" name="P" path="../part.iqrProcess"><DiagramIcon x="1" y="2"/></Process>\n</System>\n'
        )
        (self.here / "sub").mkdir()
        (self.here / "sub/linking.iqr").write_text(linking)
        self.assertIn("2 groups", self.forage("check", "sub/linking.iqr").stdout)
        self.forage("convert", "sub/linking.iqr", "linking.iqr")  # the link follows
        self.assertIn('path="part.iqrProcess"', (self.here / "linking.iqr").read_text())
        self.forage("convert", "sub/linking.iqr", "whole.iqr", "--embed")
        self.assertIn("<Connection", (self.here / "whole.iqr").read_text())
        said = self.forage("convert", "small.iqr", "twice.iqr", "--import", "part.iqrProcess").stdout
        self.assertIn("imported 'P'; nothing connects it with the other processes yet", said)
        self.assertRegex(said, r"the ids of its groups are CB1\w+ \(A\), CB1\w+ \(B\)")
        self.assertIn("4 groups", self.forage("check", "twice.iqr").stdout)

    def test_mistakes(self):
        (self.here / "small.iqr").write_text(SMALL_SYSTEM)
        self.assertIn("--extract", self.forage("convert", "small.iqr", "out.iqrProcess", status=2).stderr)
        self.assertIn("there is no process 'Q'", self.forage("convert", "small.iqr", "o.iqrProcess", "--extract", "Q", status=2).stderr)
        self.assertIn("absent.iqr", self.forage("convert", "absent.iqr", "o.iqr", status=2).stderr)
        self.assertEqual([p.name for p in self.here.iterdir()], ["small.iqr"])


class Edit(Cli):
    def test_one_operation_several_and_a_file_of_them(self):
        (self.here / "small.iqr").write_text(SMALL_SYSTEM)
        self.assertEqual(self.forage("edit", "small.iqr", '{"do": "add_process", "name": "Q", "id": "q"}', "-o", "more.iqr").stdout, "q\n")
        self.assertEqual((self.here / "small.iqr").read_text(), SMALL_SYSTEM)
        (self.here / "grow.json").write_text('[{"do": "add_group", "process": "q", "name": "G", "id": "g"}, {"do": "rename", "id": "g", "name": "H"}]\n')
        self.assertEqual(self.forage("edit", "more.iqr", "grow.json").stdout, "g\n")
        self.assertIn("3 groups", self.forage("check", "more.iqr").stdout)
        before, after = SMALL_SYSTEM.splitlines(), (self.here / "more.iqr").read_text().splitlines()
        self.assertTrue(set(before) <= set(after))

    def test_what_is_wrong_since_the_edit_is_a_warning_and_links_stay_links(self):
        (self.here / "small.iqr").write_text(SMALL_SYSTEM)
        (self.here / "link.iqr").symlink_to("small.iqr")
        said = self.forage("edit", "link.iqr", '{"do": "add_group", "process": "p", "name": "N", "neuron": "neuronNone", "id": "n"}')
        self.assertRegex(said.stderr, r"warning: .*neuronNone")
        self.assertEqual(said.stdout, "n\n")
        self.assertTrue((self.here / "link.iqr").is_symlink())
        self.assertIn("neuronNone", (self.here / "small.iqr").read_text())
        world = self.here / "small.world"
        world.write_bytes((PROJECT / "systems/worlds/two_bugs.world").read_bytes())
        (self.here / "link.world").symlink_to("small.world")
        shutil.copytree(PROJECT / "systems/worlds/models", self.here / "models")
        self.forage("edit", "link.world", '{"do": "add", "kind": "pillar", "x": 0, "y": 0}')
        self.assertTrue((self.here / "link.world").is_symlink())
        (self.here / "dangling.iqr").symlink_to("made.iqr")
        self.forage("edit", "small.iqr", "[]", "-o", "dangling.iqr")
        self.assertTrue((self.here / "dangling.iqr").is_symlink() and (self.here / "made.iqr").is_file())
        self.assertIn("Pillar", world.read_text())

    def test_a_part_is_used_dissolved_and_made_with_the_same_numbers(self):
        shutil.copytree(PROJECT / "systems/parts", self.here / "parts")
        tour, made = "parts/tour.iqr", self.here / "parts/mine.iqrProcess"

        def numbers():
            shutil.rmtree(self.here / "out", ignore_errors=True)
            self.forage("run", tour, "--cycles", "50", "--clamp", "In/Drive=1", "--record", "Pair/Cells", "--record", "Left BG/GPi", "-o", "out")
            return {f.name: f.read_bytes() for f in sorted(self.here.glob("out/*.csv"))}

        before, text = numbers(), (self.here / tour).read_text()
        self.assertTrue(before)
        self.assertEqual(self.forage("edit", tour, '[{"do": "dissolve", "id": "pair"}, {"do": "dissolve", "id": "left"}]').stdout, "")
        self.assertNotIn("half_centre.iqrProcess", (self.here / tour).read_text())
        self.assertEqual((self.here / tour).read_text().splitlines()[:3], text.splitlines()[:3])
        self.assertEqual(numbers(), before)
        operation = '{"do": "make_part", "id": "pair", "file": "parts/mine.iqrProcess"}'
        self.assertEqual(self.forage("edit", tour, operation).stderr, "")
        self.assertIn('path="mine.iqrProcess"', (self.here / tour).read_text())
        self.assertEqual(numbers(), before)
        self.assertEqual(self.forage("edit", tour, '{"do": "use_part", "file": "parts/half_centre.iqrProcess", "id": "third"}').stdout, "third\n")
        self.assertIn('<Process id="third" name="Half-centre"', (self.here / tour).read_text())
        kept = made.read_text()
        refused = self.forage("edit", tour, operation.replace("pair", "in").replace("mine", "other"), status=2).stderr
        self.assertIn("process 'Memory' gives the group 'done' of 'In' to its part", refused)
        self.forage("edit", tour, '{"do": "remove", "ids": ["memory"]}')
        self.assertIn("exists", self.forage("edit", tour, operation.replace("pair", "in"), status=2).stderr)
        failing = f'[{operation.replace("pair", "in").replace("mine", "other")}, {{"do": "grow"}}]'
        self.assertIn("there is no operation 'grow'", self.forage("edit", tour, failing, status=2).stderr)
        self.assertEqual(made.read_text(), kept)
        self.assertFalse((self.here / "parts/other.iqrProcess").exists())
        said = self.forage("edit", tour, operation.replace("pair", "in").replace("mine", "other")).stderr
        self.assertIn("runs draw other random numbers", said)

    def test_mistakes(self):
        (self.here / "small.iqr").write_text(SMALL_SYSTEM)
        self.assertIn("there is no operation 'grow'", self.forage("edit", "small.iqr", '[{"do": "grow"}]', status=2).stderr)
        self.assertIn("error: this is not JSON", self.forage("edit", "small.iqr", '[{"do": }]', status=2).stderr)
        self.assertIn("absent.json", self.forage("edit", "small.iqr", "absent.json", status=2).stderr)
        self.assertIn("absent.iqr", self.forage("edit", "absent.iqr", "[]", status=2).stderr)
        self.assertIn("error: operation 'rename': 'id' is missing\n  hint: a text", self.forage("edit", "small.iqr", '{"do": "rename"}', status=2).stderr)
        self.assertIn(
            "operation 'rename': 'nmae' is not a member\n  hint: did you mean 'name'",
            self.forage("edit", "small.iqr", '{"do": "rename", "id": "a", "nmae": "B"}', status=2).stderr,
        )
        self.assertIn("operation 2: ", self.forage("edit", "small.iqr", '[{"do": "add_process", "name": "Q"}, {"do": "rename"}]', status=2).stderr)
        self.assertIn("control character", self.forage("edit", "small.iqr", r'{"do": "system", "author": "a\u0000b"}', status=2).stderr)
        self.assertIn("error: ", self.forage("edit", "small.iqr", "[]", "-o", "small.iqr/x.iqr", status=2).stderr)
        self.assertIn("does not end with .iqr", self.forage("edit", "small.iqr", "[]", "-o", "small.world", status=2).stderr)
        self.assertIn(
            "operation 2: there is no operation",
            self.forage("edit", "small.iqr", '[{"do": "add_process", "name": "Q"}, {"do": "grow"}]', "-o", "absent/x.iqr", status=2).stderr,
        )
        self.assertIn("control character", self.forage("edit", "small.iqr", r'{"do": "ports", "id": "p", "outputs": {"o\u0001": "a"}}', status=2).stderr)
        self.assertIn("a number is too large", self.forage("edit", "small.iqr", '{"do": "place", "id": "a", "x": 1e999, "y": 1}', status=2).stderr)
        with tempfile.TemporaryDirectory() as folder:
            operations = pathlib.Path(folder) / "operations.json"
            operations.write_text('[{"do": "remove",\n "ids": []]')
            self.assertIn(f"{operations}:2:11: error: ", self.forage("edit", "small.iqr", operations, status=2).stderr)
            operations.write_text('{"do": "parameter", "id": "a", "name": "threshold", "value": ' + "[" * 200000 + "]" * 200000 + "}")
            self.assertIn("too many lists", self.forage("edit", "small.iqr", operations, status=2).stderr)
        self.assertEqual((self.here / "small.iqr").read_text(), SMALL_SYSTEM)
        self.assertEqual([p.name for p in self.here.iterdir()], ["small.iqr"])


class Others(Cli):
    def test_help_lists_commands_and_options(self):
        text = self.forage("--help").stdout
        for word in ("run", "check", "types"):
            self.assertIn(word, text)
        text = self.forage("run", "--help").stdout
        for option in ("--world", "--cycles", "--seconds", "--trials", "--seed", "--set", "--record", "--record-every", "--output", "--realtime", "--quiet"):
            self.assertIn(option, text)

    def test_types_are_listed_and_described(self):
        self.assertIn("neuronLinearThreshold", self.forage("types").stdout)
        text = self.forage("types", "neuronLinearThreshold").stdout
        for word in ("excGain", "Default 1", "threshold", "vm", "act"):
            self.assertIn(word, text)
        self.assertIn("_motor", self.forage("types", "moduleGazeboBug").stdout)
        self.assertIn("did you mean", self.forage("types", "neuronLinearTreshold", status=2).stderr)

    def test_a_type_is_described_with_all_its_declarations(self):
        text = self.forage("types", "neuronLinearThreshold").stdout
        self.assertRegex(text, r"excIn +Excitation\n +inhIn +Inhibition\n +modIn +Modulation \(not read\)")
        self.assertRegex(text, r"vmPrs +Part of the potential kept per cycle. Default 0, usual range 0 to 1\.")
        self.assertRegex(self.forage("types", "synapseHebbian").stdout, r"postact +Postsynaptic activity")
        self.assertRegex(self.forage("types", "moduleCL").stdout, r"Reads from groups\n +action +Action: any size\. The action")

    def test_types_of_a_file_are_described(self):
        model = PROJECT / "systems/models/td_conditioning.iqr"
        self.assertRegex(self.forage("types", model).stdout, r"prediction\nThe prediction V and its error[^\n]*\n(.*\n)*\ntd\n(.*\n)*  trace")
        self.assertRegex(self.forage("describe", model).stdout, r"td \(synapse\): A trace[^\n]*\n      trace' = trace \+ delta \* \(pre - trace\)\n")
        types = json.loads(self.forage("describe", model, "--format", "json").stdout)["types"]
        self.assertEqual([t["name"] for t in types], ["prediction", "td"])
        self.assertEqual(types[1]["equations"][2], "output psp = weight' * pre'")
        self.assertIn("declares no types", self.forage("types", SYSTEM).stdout)

    def test_a_declared_type_is_written_as_a_plugin(self):
        model = PROJECT / "systems/models/oja.iqr"
        source = self.forage("convert", model, "-", "--as-plugin", "oja").stdout
        self.assertIn("FORAGE_PLUGIN(oja);", source)
        self.assertIn("did you mean 'oja'", self.forage("convert", model, "-", "--as-plugin", "oya", status=2).stderr)
        noise = self.here / "noise.iqr"
        noise.write_text('<System id="s" name="S"><NeuronType name="n"><Equations>output y = uniform() - 2 * uniform()</Equations></NeuronType></System>')
        source = self.forage("convert", noise, "-", "--as-plugin", "n").stdout
        self.assertIn("in.random[0] - 2.0 * in.random[1]", source, "numbers are drawn in the order of the text, as the type draws them")

    def test_a_system_is_described(self):
        text = self.forage("describe", SYSTEM).stdout
        self.assertTrue(text.startswith("Reactive foraging: 3 processes, 17 groups (3306 cells), 10 connections (133 synapses)\n"))
        self.assertIn("\n    US: 7 x 1, neuronLinearThreshold (excGain=5,", text)
        self.assertIn("-> Reactive Layer/US: excitatory, 64 synapses (list, 83 ns per cycle), synapseFixedWeight (weight=1), 'Light to US'", text)
        self.assertIn("      writes _target: Bug/Light\n", text)
        self.assertEqual(text.count(" -> "), 10)
        self.assertIn("weight=0.25", self.forage("describe", SYSTEM, "--set", "Light to US.weight=0.25").stdout)
        bad = self.here / "bad.iqr"
        bad.write_text(SMALL_SYSTEM.replace('name="excGain"', 'name="exGain"'))
        self.assertIn("did you mean 'excGain'", self.forage("describe", bad, status=2).stderr)

    def test_a_system_is_described_for_programs(self):
        system = json.loads(self.forage("describe", SYSTEM, "--json").stdout)
        self.assertEqual([p["name"] for p in system["processes"]], ["Bug", "Reactive Layer", "Selection"])
        light = system["connections"][0]
        self.assertEqual((light["source"], light["target"], light["synapses"]), ("Bug/Light", "Reactive Layer/US", 64))
        self.assertEqual(light["attenuation"], "Gaussian, 0 to 1, sigma 5")
        self.assertEqual(system["processes"][0]["module"]["writes"]["_target"], "Bug/Light")
        self.assertEqual(system["processes"][1]["groups"][0]["neuron"]["parameters"]["excGain"], "5")

    def awkward_system(self):
        """A system whose names have every character that is special in one of the formats."""
        awkward = self.here / "awkward.iqr"
        awkward.write_text(SMALL_SYSTEM.replace('"A"', r'"A|B*_&lt;$%#&amp;{}~^\/&quot;"'))
        return awkward

    def test_a_system_is_described_in_markdown(self):
        for system in (SYSTEM, self.awkward_system()):
            text = self.forage("describe", system, "--format", "markdown").stdout
            rows = [line for line in text.splitlines() if line.startswith("|")]
            self.assertIn("| Group | Size | Neuron | Values of its own |", rows)
            for row in rows:
                self.assertIn(len(re.findall(r"(?<!\\)\|", row)), (3, 5, 6), row)

    @unittest.skipUnless(shutil.which("pdflatex"), "pdflatex is not installed")
    def test_tables_for_papers_are_typeset(self):
        folder = pathlib.Path(SYSTEM).parent
        systems = ("models/gpr", "models/izhikevich", "models/hodgkin_huxley", "dac_foraging", "parts/tour")
        for system in (pathlib.Path(SYSTEM), self.awkward_system(), *(folder / f"{name}.iqr" for name in systems)):
            with self.subTest(system.name):
                (self.here / "tables.tex").write_text(self.forage("describe", system, "--latex").stdout)
                (self.here / "paper.tex").write_text(
                    r"\documentclass{article}\usepackage[T1]{fontenc}\usepackage{amsmath,array,booktabs,longtable}"
                    r"\begin{document}\input{tables}\end{document}"
                )
                done = subprocess.run(
                    ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "paper.tex"], cwd=self.here, capture_output=True, text=True, errors="replace"
                )
                self.assertEqual(done.returncode, 0, done.stdout)
                self.assertNotIn("Overfull \\hbox", done.stdout)
                self.assertTrue((self.here / "paper.pdf").exists())

    def test_descriptions_for_papers_have_all_values_in_force(self):
        models = pathlib.Path(SYSTEM).parent / "models"
        for format, equation, rows in (
            (
                "latex",
                r"\frac{\mathrm{d}v}{\mathrm{d}t} = \frac{0.04\,v^{2} + 5\,v + 140 - u + \mathit{exc}}{\mathit{ms}}",
                (r"$v$ at start & \hspace{0pt}$-$65 & \hspace{0pt}mV &", r"$\mathit{weight}$ & \hspace{0pt}1 &"),
            ),
            ("markdown", r"\frac{\mathrm{d}u}{\mathrm{d}t}", (r"| $v$ at start | -65 | mV |", r"| $\mathit{weight}$ | 1 |")),
        ):
            text = self.forage("describe", models / "izhikevich.iqr", "--format", format).stdout
            self.assertIn(equation, text)
            for row in rows:
                self.assertIn(row, text)
        gpr = self.forage("describe", models / "gpr.iqr", "--format", "markdown").stdout
        self.assertIn(r"| $\tau$ | 0.04 | s |", gpr)  # the same in all groups
        self.assertIn(r"| $\mathit{ceiling}$ | 1 |", gpr)  # a default
        self.assertIn(r"| $\mathit{modGain}$ | 0 (unless stated) |", gpr)
        self.assertIn(r"| BG/D2 | 6 x 1 | Leaky integrator | $\mathit{modGain}$ = -1 |", gpr)
        self.assertIn("| Cortex to D1 | Input/Cortex to BG/D1 | 6 excitatory | one to one | Fixed weight |", gpr)
        tour = self.forage("describe", models.parent / "parts/tour.iqr", "--format", "markdown").stdout
        self.assertIn(r"| $\tau$ | 0.05 | s | The constant of the system. |", tour)
        self.assertIn("| Pair.To the other | source, target, weight, from 0: 0 1 1; 1 0 1 |", tour)
        foraging = self.forage("describe", SYSTEM, "--format", "markdown").stdout
        self.assertIn("## Cells that connections list (column, row)", foraging)
        self.assertRegex(foraging, r"\| \(\d[^|]* to \(\d")
        self.assertIn("Gaussian ones min + (max - min)", foraging)

    def test_figures_have_panels(self):
        figure = ("plot", SYSTEM, "diagram", "connection:Light to US", "wiring:US to Approach", "--layout", "2x2")
        self.assertEqual(self.forage(*figure, "--plot-format", "svg").stdout, "figure.svg\n")
        self.assertEqual(self.forage(*figure, "--plot-format", "pdf", "--width", 180).stdout, "figure.pdf\n")
        pdf = (self.here / "figure.pdf").read_bytes()
        self.assertIn(b"/FontFile", pdf)
        # From 1.18 on, cairo packs the page's description.
        unpacked = [zlib.decompressobj().decompress(stream) for stream in re.findall(rb"stream\r?\n(x.*?)endstream", pdf, re.DOTALL)]
        width = float(re.search(rb"/MediaBox \[ ?0 0 ([0-9.]+)", pdf + b"".join(unpacked))[1])
        self.assertAlmostEqual(width, 180 / 25.4 * 72, delta=1)
        self.forage(*figure, "--width", 180)
        png = (self.here / "figure.png").read_bytes()
        self.assertAlmostEqual(int.from_bytes(png[16:20], "big"), 180 / 25.4 * 300, delta=1)
        self.assertEqual(sorted(p.name for p in self.here.iterdir()), ["figure.pdf", "figure.png", "figure.svg"])
        self.forage("plot", SYSTEM, "diagram", "--width", "600px")
        self.assertEqual(int.from_bytes((self.here / "diagram.png").read_bytes()[16:20], "big"), 600)
        movie = self.forage("plot", SYSTEM, "movie:Bug/Light", "--width", "600px", status=2)
        self.assertIn("a size of its own", movie.stderr)
        self.assertIn("3 plots do not fit into 1 x 2 panels", self.forage(*figure[:-1], "1x2", status=2).stderr)
        self.assertIn("write ROWSxCOLUMNS", self.forage(*figure[:-1], "2by2", status=2).stderr)

    @unittest.skipUnless(shutil.which("dot"), "Graphviz is not installed")
    def test_the_graph_is_drawn(self):
        for system, groups, connections in ((SYSTEM, 17, 10), (self.awkward_system(), None, None)):
            graph = self.forage("describe", system, "--dot").stdout
            drawn = subprocess.run(["dot", "-Tsvg"], input=graph, capture_output=True, text=True)
            self.assertEqual((drawn.returncode, drawn.stderr), (0, ""))
            if groups:
                self.assertEqual(drawn.stdout.count('class="node"'), groups)
                self.assertEqual(drawn.stdout.count('class="edge"'), connections)

    def test_every_command_has_help_with_an_example_that_names_it(self):
        for command in re.findall(r"^  (\w+) ", self.forage("--help").stdout.split("Subcommands:")[1], re.MULTILINE):
            text = self.forage(command, "--help").stdout
            self.assertRegex(text, rf"Example:\n  forage {command}\b")

    def test_completion_knows_commands_options_and_values(self):
        script = self.here / "c.bash"
        script.write_text(self.forage("completion", "bash").stdout)

        def complete(*words):
            text = f"source {script}; COMP_WORDS=({' '.join(map(shlex.quote, words))}); COMP_CWORD={len(words) - 1}; _forage; echo \"${{COMPREPLY[@]}}\""
            return subprocess.run(["bash", "-c", text], cwd=self.here, capture_output=True, text=True).stdout.split()

        self.assertEqual(complete("forage", "de"), ["describe"])
        self.assertEqual(complete("forage", "run", "--tri"), ["--trials", "--trial-timeout"])
        self.assertEqual(complete("forage", "run", "--format", "n"), ["npy", "npz"])
        self.assertEqual(complete("forage", "run", "c."), ["c.bash"])
        for shell in ("zsh", "fish"):
            text = self.forage("completion", shell).stdout
            for word in ("describe", "trial-timeout", "csv npy npz h5 dat"):
                self.assertIn(word, text)
            if shutil.which(shell):
                (self.here / "c").write_text(text)
                self.assertEqual(subprocess.run([shell, "-n", self.here / "c"], capture_output=True, text=True).stderr, "")
        self.assertIn("error:", self.forage("completion", "csh", status=2).stderr)

    def test_the_manual_page_has_every_option(self):
        text = self.forage("man").stdout
        for command in re.findall(r"^  (\w+) ", self.forage("--help").stdout.split("Subcommands:")[1], re.MULTILINE):
            self.assertIn(f".SS forage {command}\n", text)
            for option in re.findall(r"--[a-z-]+", self.forage(command, "--help").stdout.split("Options:")[1].split("\n\n")[0]):
                self.assertIn(option.replace("-", "\\-"), text)
        if shutil.which("mandoc"):
            done = subprocess.run(["mandoc", "-T", "lint", "-W", "error"], input=text, capture_output=True, text=True)
            self.assertEqual(done.stdout, "")

    def test_the_page_on_expressions_names_options_that_exist(self):
        page = (PROJECT / "docs/reference/expressions.md").read_text()
        named = set(re.findall(r"`(--[a-z-]+)`", page))
        self.assertGreaterEqual(named, {"--record", "--plot", "--until", "--schedule", "--set", "--clamp", "--add", "--multiply"})
        listed = set(re.findall(r"--[a-z-]+", self.forage("run", "--help").stdout))
        self.assertEqual(named - listed, set())

    def test_shipped_systems_have_no_mistakes(self):
        for system in (PROJECT / "systems").glob("*.iqr"):
            done = self.forage("check", system)
            self.assertIn("fine", done.stdout)
            self.assertEqual(done.stderr, "")

    def test_schema_is_current_and_accepts_the_shipped_systems(self):
        reference = PROJECT / "docs" / "reference"
        schema, experiments = reference / "iqr.rng", reference / "experiment.rng"
        self.assertEqual(self.forage("schema").stdout, schema.read_text(), "run: forage schema > docs/reference/iqr.rng")
        self.assertEqual(
            self.forage("schema", "--experiment").stdout, experiments.read_text(), "run: forage schema --experiment > docs/reference/experiment.rng"
        )
        if not shutil.which("xmllint"):
            self.skipTest("xmllint is absent")
        files = [*(PROJECT / "systems").rglob("*.iqr"), *SHARED.glob("original/*/*.iqr"), *SHARED.glob("original/*/*.iqrProcess")]
        for grammar, file in [*((schema, f) for f in files), *((experiments, f) for f in (PROJECT / "systems").glob("*/*.xml"))]:
            done = subprocess.run(["xmllint", "--nowarning", "--noout", "--relaxng", grammar, file], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
        bad = PROJECT / "tests" / "diagnostics" / "bad_systems" / "four_mistakes_of_four_kinds.iqr"
        done = subprocess.run(["xmllint", "--nowarning", "--noout", "--relaxng", schema, bad], capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)

    def test_commands_of_the_readme_and_of_pages_on_runs_work(self):
        commands = re.findall(r"\| `(forage .*?)`", (PROJECT / "README.md").read_text())
        for page in ("run-a-system", "why-nothing-happens"):
            commands += re.findall(r"^(?:build/release/bin/)?(forage .*)$", (PROJECT / f"docs/how-to/{page}.md").read_text(), re.MULTILINE)
        (self.here / "forage-out").mkdir()
        self.assertGreater(len(commands), 20)
        os.symlink(PROJECT / "systems", self.here / "systems")
        os.symlink(PROJECT / "docs", self.here / "docs")
        made = set()
        for command in commands:
            if command.startswith("forage new") and command in made:
                continue  # it does not overwrite what it made
            if ".mp4" in command and not shutil.which("ffmpeg"):
                continue
            made.add(command)
            with self.subTest(command):
                done = subprocess.run([FORAGE, *shlex.split(command)[1:]], cwd=self.here, capture_output=True, text=True, timeout=600)
                self.assertEqual(done.returncode, 1 if "--trial-timeout" in command else 0, done.stderr)
        # The film on top of the README is the one that its command makes.
        pictures.check(self, self.here / "forage-out/robot_learns.gif", PROJECT / "docs/pictures/robot_learns.gif", "rewrite it with ./tools/update-docs")

    def test_shipped_floors_are_what_their_script_draws(self):
        self.assert_made_by("worlds/make_floors.py")

    def test_tables_of_models_are_what_their_script_makes(self):
        self.assert_made_by("models/make_tables.py")

    def assert_made_by(self, script):
        done = subprocess.run([sys.executable, PROJECT / "systems" / script, "--check"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)


@unittest.skipUnless((SHARED / "original").exists(), "the original's files are absent")
class Original(Cli):
    FILES = SHARED / "original" / "DAC_files"

    def run_original(self, system, *arguments, **more):
        self.forage("run", self.FILES / system, "--world", self.FILES / "DAC_basic_arena.world", "-o", "out", *arguments, **more)
        return json.loads((self.here / "out/run.json").read_text())["result"]

    def test_the_tutorials_system_reaches_the_target_in_most_trials(self):
        result = self.run_original("DACReactiveBug.iqr", "--trials", 30, "--seed", 1)
        self.assertEqual(result["robots"][0]["trials"], 30)
        self.assertGreaterEqual(result["robots"][0]["at_target"], 25)

    def test_every_system_and_process_of_the_original_has_no_mistakes_and_runs(self):
        worlds = {"DAC_files": "DAC_basic_arena.world", "SDIC_challenge": "SDIC_one_robot_arena.world"}
        files = sorted(p for p in (SHARED / "original").rglob("*.iqr*"))
        self.assertGreaterEqual(len(files), 7)
        for file in files:
            world = ["--world", file.parent / worlds[file.parent.name]] if file.suffix == ".iqr" else []
            with self.subTest(file.name):
                warnings = re.findall(r": (?:warning|error): (.+)", self.forage("check", file, *world).stderr)
                twice = ["there is already a group 'Selection/Approach'"]
                self.assertEqual(warnings, twice if file.name == "DACBugBasicArena.iqr" else [])
                self.forage("run", file, *world, "--cycles", 1000, "-q", "-o", "out")
                self.assertEqual(json.loads((self.here / "out/run.json").read_text())["result"]["cycles"], 1000)

    def test_the_tutorials_incomplete_system_stands_still(self):
        result = self.run_original("DACReactiveBug_ex.iqr", "--trials", 30, status=1)
        self.assertEqual(result["robots"][0]["trials"], 0)
        self.assertIn("did not end", result["stopped"])


SMALL_SYSTEM = """<?xml version="1.0" encoding="UTF-8"?>
<System id="s" name="small" author="" date="" cylesPerSecond="25">
  <Process id="p" name="P" enableModule="true">
    <Module name="moduleReplay">
      <XRefHolder name="OutputToGroup"><XRef name="out" target="a"/></XRefHolder>
    </Module>
    <DiagramIcon x="0" y="0"/>
    <Group id="a" name="A">
      <Topology><TopologyRect hcount="2" vcount="1" cylinderHor="false" cylinderVert="false"/></Topology>
      <Neuron name="neuronLinearThreshold"><Parameter name="excGain" value="1"/></Neuron>
      <DiagramIcon x="0" y="0"/>
    </Group>
    <Group id="b" name="B">
      <Topology><TopologyRect hcount="2" vcount="1" cylinderHor="false" cylinderVert="false"/></Topology>
      <Neuron name="neuronLinearThreshold"/>
      <DiagramIcon x="0" y="0"/>
    </Group>
  </Process>
  <Connection id="c" name="B to A" source="b" target="a" type="excitatory">
    <Pattern><PatternForeach><All/><All/></PatternForeach></Pattern>
    <Arborization><ArbRect width="1" height="1" direction="RF" initialization_probability="1"/></Arborization>
    <AttenuationFunction><FunUniform value="0"/></AttenuationFunction>
    <DelayFunction><FunUniform value="0"/></DelayFunction>
    <Synapse name="synapseFixedWeight"><Parameter name="weight" value="0"/></Synapse>
  </Connection>
</System>
"""
WITHOUT_MODULE = re.sub(r"<Module.*?</Module>", "", SMALL_SYSTEM, flags=re.DOTALL)

if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
