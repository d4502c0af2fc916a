"""Pictures, films and gamepads in runs: moduleVideo, moduleVideoRecorder, moduleJoystick.

    devices_test.py FORAGE_PROGRAM PROJECT_DIRECTORY [TEST...]
"""

import importlib.util
import os
import shutil
import signal
import struct
import subprocess
import sys
import unittest

from cli_test import FORAGE, PROJECT, Cli, wait_for
from waiting import wait_for_cycles

VIDEO = PROJECT / "systems/video"
DENOISING = VIDEO / "denoising.iqr"
spec = importlib.util.spec_from_file_location("make_pictures", VIDEO / "make_pictures.py")
make_pictures = importlib.util.module_from_spec(spec)
spec.loader.exec_module(make_pictures)


def system(module, groups, parameters="", outputs=()):
    """A system of one process with a module whose outputs are groups of these sizes, in files that name `module`."""
    cells = "".join(
        f'<Group id="{name}" name="{name}"><Topology><TopologyRect hcount="{w}" vcount="{h}"/></Topology>' '<Neuron name="neuronNumeric"/></Group>'
        for name, (w, h) in groups.items()
    )
    set_ = "".join(f'<Parameter name="{k}" value="{v}"/>' for k, v in parameters.items())
    ports = "".join(f'<XRef name="{port}" target="{name}"/>' for port, name in outputs)
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<System id="s" name="small" cylesPerSecond="25"><Process id="p" name="P"><Module name="{module}">{set_}
<XRefHolder name="OutputToGroup">{ports}</XRefHolder></Module>{cells}</Process></System>
"""


class Devices(Cli):
    def rows(self, group, *arguments, out="out"):
        self.forage("run", "small.iqr", "-o", out, "--record", f"P/{group}", *arguments)
        return [list(map(float, row[1:])) for row in self.table(f"{out}/P_{group}_act.csv")[1:]]

    def write(self, *arguments, **more):
        (self.here / "small.iqr").write_text(system(*arguments, **more))


class Video(Devices):
    RED = [("videoOutputRed", "A")]

    def small(self, size=(1, 1), outputs=RED, **parameters):
        names = {
            "file": "File Name",
            "loop": "Loop",
            "step": "Step",
            "cycles": "Cycles Per Picture",
            "hsv": "HSV",
            "grey": "Monochrome",
            "name": "DeviceName",
            "real": "Real Time",
            "fps": "FPS",
        }
        self.write("moduleVideo", {name: size for _, name in outputs}, {names[k]: v for k, v in parameters.items()}, outputs)

    def grey_folder(self, levels, name="pictures"):
        (self.here / name).mkdir()
        for number, level in enumerate(levels):
            (self.here / name / f"{number:03}.png").write_bytes(make_pictures.png([[(level,) * 3] * 4] * 3))

    def test_the_shipped_pictures_are_what_their_script_paints(self):
        self.assertEqual(subprocess.run([sys.executable, VIDEO / "make_pictures.py", "--check"], capture_output=True).returncode, 0)

    def test_pictures_are_shown_in_order_repeated_and_skipped(self):
        self.grey_folder([0, 51, 102, 153, 204])
        shown = lambda n, **parameters: (self.small(file="pictures", **parameters), [round(5 * row[0]) for row in self.rows("A", "--cycles", n)])[1]
        self.assertEqual(shown(8), [0, 0, 1, 2, 3, 4, 0, 1])  # a picture is received in the cycle after
        self.assertEqual(shown(9, cycles=3), [0, 0, 0, 0, 1, 1, 1, 2, 2])
        self.assertEqual(shown(7, step=2), [0, 0, 2, 4, 0, 2, 4])
        self.assertEqual(shown(8, loop="false"), [0, 0, 1, 2, 3, 4, 0, 0])

    def test_the_end_of_a_video_is_an_output(self):
        self.grey_folder([255, 255, 255])
        outputs = [*self.RED, ("End of video", "B")]
        self.small(outputs=outputs, file="pictures")
        self.assertEqual([row[0] for row in self.rows("B", "--cycles", 9)], [0, 0, 0, 0, 1, 0, 0, 1, 0])
        self.small(outputs=outputs, file="pictures", loop="false")
        self.assertEqual([row[0] for row in self.rows("B", "--cycles", 7)], [0, 0, 0, 0, 1, 1, 1])

    def test_colours_of_each_kind(self):
        (self.here / "pictures").mkdir()
        (self.here / "pictures/a.png").write_bytes(make_pictures.png([[(255, 51, 0)] * 2] * 2))
        outputs = list(zip(("videoOutputRed", "videoOutputGreen", "videoOutputBlue"), "ABC"))
        for parameters, expected in (({}, (1, 0.2, 0)), ({"hsv": "true"}, (0.2 / 6, 1, 1)), ({"grey": "true"}, (0.299 + 0.2 * 0.587,) * 3)):
            self.small(outputs=outputs, file="pictures", **parameters)
            for group, value in zip("ABC", expected):
                self.assertAlmostEqual(self.rows(group, "--cycles", 2)[1][0], value)

    def test_denoising_finds_the_disc(self):
        self.forage("run", DENOISING, "--cycles", 60, "-o", "out", "--record", "Denoising/Disc")
        rows = [list(map(float, row[1:])) for row in self.table("out/Denoising_Disc_act.csv")[1:]]
        film = (self.here / "out/Denoising_video.y4m").read_bytes()
        header, *pictures = film.split(b"FRAME\n")
        self.assertEqual(header, b"YUV4MPEG2 W192 H144 F25:1 Ip A1:1 Cmono\n")
        self.assertEqual([len(p) for p in pictures], [192 * 144] * 60)
        wrong = []
        clean_pictures = list(make_pictures.paint(clean=True))
        # Picture t arrives in cycle t + 1 and is decided two connections later, with a lag of about a cycle.
        for cycle in range(10, 60):
            clean = clean_pictures[(cycle - 4) % 40]
            disc = [pixel == make_pictures.DISC for row in clean for pixel in row]
            wrong.append(sum((value > 0) != d for value, d in zip(rows[cycle], disc)) / len(disc))
            # A cell of the film is 4 x 4 pixels.
            film_row = [pictures[cycle][4 * y * 192 + 4 * x] for y in range(36) for x in range(48)]
            self.assertTrue(all(abs(f - 255 * (v + 1) / 2) <= 0.51 for f, v in zip(film_row, rows[cycle])))
        self.assertLess(sum(wrong) / len(wrong), 0.03)  # 7 % of the pixels of the pictures are on the wrong side

    def resumed(self, *arguments):
        """Checks that a run that is stopped and resumed leaves the files of one that was not."""
        run = ["run", *map(str, arguments), "--record", "*"]
        self.forage(*run, "-o", "whole")
        process = subprocess.Popen([FORAGE, *run, "-o", "parts", "--checkpoint-every", "20", "-q"], cwd=self.here)
        wait_for(lambda: list((self.here / "parts").glob("*checkpoint*")) or process.poll() is not None)
        process.send_signal(signal.SIGTERM)
        self.assertIn(process.wait(timeout=600), (0, 128 + signal.SIGTERM))
        stopped = process.returncode != 0
        if stopped:
            self.forage("resume", "parts", "-q")
        for file in (self.here / "whole").iterdir():
            if file.name != "run.json":
                self.assertEqual(file.read_bytes(), (self.here / "parts" / file.name).read_bytes(), file.name)
        return stopped

    def test_a_run_with_pictures_is_resumed(self):
        self.assertTrue(self.resumed(DENOISING, "--cycles", 300))

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_a_film_has_the_numbers_of_its_pictures(self):
        subprocess.run(
            ["ffmpeg", "-v", "error", "-framerate", "25", "-i", VIDEO / "noisy_disc/%03d.png", "-c:v", "ffv1", "-pix_fmt", "bgr0", self.here / "film.mkv"],
            check=True,
            stdin=subprocess.DEVNULL,
        )

        def of(file):
            self.small(size=(48, 36), file=file, step=3)
            return self.rows("A", "--cycles", 30)

        self.assertEqual(of("film.mkv"), of(VIDEO / "noisy_disc"))
        self.small(size=(12, 9), file="film.mkv")
        self.resumed("small.iqr", "--cycles", 120)

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_a_text_is_no_film(self):
        """ffmpeg itself draws texts, and follows lists of films."""
        for name, text in {"key.asc": "secret\n" * 1000, "list.m3u8": "#EXTM3U\n#EXTINF:1,\nfilm.ts\n"}.items():
            (self.here / name).write_text(text)
            self.small(size=(64, 48), file=name)
            done = subprocess.run([FORAGE, "run", "small.iqr", "--cycles", "3", "-o", "out"], cwd=self.here, capture_output=True, text=True, timeout=600)
            self.assertNotEqual(done.returncode, 0)
            self.assertRegex(done.stderr, f"ffmpeg finds no pictures in '{name}'")

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_a_film_with_gaps_has_each_picture_once(self):
        subprocess.run(
            [
                "ffmpeg",
                "-v",
                "error",
                "-framerate",
                "25",
                "-i",
                VIDEO / "noisy_disc/%03d.png",
                "-vf",
                "setpts=N*N/25/TB",
                "-vsync",
                "vfr",
                "-frames:v",
                "5",
                "-c:v",
                "ffv1",
                "-pix_fmt",
                "bgr0",
                self.here / "gaps.mkv",
            ],
            check=True,
            stdin=subprocess.DEVNULL,
        )

        def of(file):
            self.small(size=(48, 36), file=file, loop="false")
            return self.rows("A", "--cycles", 6)

        self.assertEqual(of("gaps.mkv")[:5], of(VIDEO / "noisy_disc")[:5])

    def test_a_decoder_that_fails_is_not_the_end_of_the_film(self):
        (self.here / "bin").mkdir()
        program = self.here / "bin/ffmpeg"
        program.write_text("#!/bin/sh\nprintf 'P6 1 1 255 abc'\nexit 3\n")
        program.chmod(0o755)
        (self.here / "film.mkv").write_text("")
        self.small(file="film.mkv")
        done = subprocess.run(
            [FORAGE, "run", "small.iqr", "--cycles", "9"],
            cwd=self.here,
            capture_output=True,
            text=True,
            timeout=600,
            env={**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}"},
        )
        self.assertRegex(done.stderr, "ffmpeg cannot read '.*film.mkv' to its end")
        self.assertEqual(done.returncode, 1)

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_the_recorders_film_is_read_by_ffmpeg_and_by_the_module(self):
        self.forage("run", DENOISING, "--cycles", 20, "-o", "out", "--set", "Denoising.Scale=1", "--record", "Denoising/Disc")
        disc = [[(float(v) + 1) / 2 for v in row[1:]] for row in self.table("out/Denoising_Disc_act.csv")[1:]]
        self.small(size=(48, 36), file="out/Denoising_video.y4m", loop="false")
        shown = self.rows("A", "--cycles", 21, out="again")[1:]
        for a, b in zip(disc, shown):
            self.assertTrue(all(abs(x - y) < 0.01 for x, y in zip(a, b)))

    def test_in_real_time_the_clock_decides(self):
        self.grey_folder(range(0, 250, 5))
        self.small(file="pictures", real="true", fps="1000", loop="false")
        rows = [row[0] for row in self.rows("A", "--cycles", 20000)]
        self.assertEqual(rows[0], 0)
        self.assertEqual(rows[:-1], sorted(rows[: rows.index(max(rows))]) + rows[rows.index(max(rows)) : -1])  # they rise to the last

    def test_what_is_missing_is_named(self):
        (self.here / "empty").mkdir()
        (self.here / "text.mkv").write_text("no film")
        self.small(name="/dev/no_such_camera")
        said = self.forage("run", "small.iqr", "--cycles", 1, status=2).stderr
        self.assertIn("there is no camera '/dev/no_such_camera'; 'File Name' plays a film or a folder of pictures instead", said)
        self.forage("check", "small.iqr")  # a system can be checked without the camera
        for file, reason in (("nothing", "there is no film or folder"), ("empty", "has no .png files")):
            self.small(file=file)
            self.assertRegex(self.forage("run", "small.iqr", "--cycles", 1, status=2).stderr, rf"small\.iqr:2:\d+: error: .*{reason}")
        self.small(file="text.mkv")
        if shutil.which("ffmpeg"):
            self.assertIn("ffmpeg finds no pictures in", self.forage("run", "small.iqr", "--cycles", 1, status=1).stderr)
        none = subprocess.run(
            [FORAGE, "run", "small.iqr", "--cycles", "1"], cwd=self.here, capture_output=True, text=True, timeout=600, env={**os.environ, "PATH": "/nowhere"}
        )
        self.assertIn("the program ffmpeg is not installed (Debian and Ubuntu: apt-get install ffmpeg)", none.stderr)
        self.assertEqual(none.returncode, 2)

    def test_a_file_of_the_original(self):
        """The parameters and cross references that a file of the original has."""
        self.grey_folder([128])
        original = {
            "DeviceName": "/dev/video0",
            "Input": 1,
            "Standard": 5,
            "FPS": 25,
            "InfoWindow": "false",
            "ShowOutput": "true",
            "imgWidth": 160,
            "imgHeight": 120,
            "Brightness": 60,
            "Saturation": 60,
            "Contrast": 60,
            "AutoGain": 0,
            "HSV": "false",
            "Monochrome": "true",
        }
        outputs = list(zip(("videoOutputRed", "videoOutputGreen", "videoOutputBlue"), "ABC"))
        self.write("moduleVideo", {name: (40, 40) for name in "ABC"}, original, outputs)
        self.assertNotIn("warning", self.forage("check", "small.iqr").stderr)
        self.forage("run", "small.iqr", "--cycles", 3, "-o", "", "--set", "P.File Name=pictures")
        self.write("openCVvideo", {name: (48, 36) for name in "ABC"}, {"ShowOutput": "true", "Monochrome": "false", "HSV": "true"}, outputs)
        self.forage("run", "small.iqr", "--cycles", 3, "-o", "", "--set", "P.File Name=pictures")


def event(kind, code, value):
    return struct.pack("qqHHi", 0, 0, kind, code, value)


KEY, ABS = 1, 3
REPORT = event(0, 0, 0)
A_BUTTON = 0x130


class Gamepad(Devices):
    EVENTS = [
        event(ABS, 0, 32767) + REPORT,
        event(ABS, 0, 0) + event(ABS, 1, -32768) + REPORT,
        event(KEY, A_BUTTON, 1) + REPORT,
        event(KEY, A_BUTTON, 0) + event(ABS, 1, 0) + REPORT,
    ]
    AXES = [[0, 1] + [0] * 6, [0, 0, 1, 0] + [0] * 4, [0, 0, 1, 0] + [0] * 4, [0] * 8]

    def small(self, device):
        self.write("moduleJoystick", {"A": (2, 4), "B": (3, 1)}, {"DeviceName": self.here / device}, [("JSOutput", "A"), ("Buttons", "B")])

    def test_recorded_events_are_played_one_report_per_cycle(self):
        (self.here / "events").write_bytes(b"".join(self.EVENTS))
        self.small("events")
        rows = self.rows("A", "--cycles", 7)
        self.assertEqual(rows[1:], self.AXES + [self.AXES[-1]] * 2)
        self.assertEqual(self.rows("B", "--cycles", 6), [[0] * 3] * 3 + [[1, 0, 0]] + [[0] * 3] * 2)
        # The middle is a zone.
        self.assertEqual(self.rows("A", "--cycles", 3, "--set", "P.DeadZone=1")[1:], [[0] * 8] * 2)

    def test_records_of_a_joystick(self):
        (self.here / "js0").write_bytes(struct.pack("IhBB", 0, -32767, 0x82, 2) + struct.pack("IhBB", 0, 1, 1, 1))
        self.small("js0")
        self.assertEqual(self.rows("A", "--cycles", 2)[1], [0] * 4 + [1, 0, 0, 0])
        self.assertEqual(self.rows("B", "--cycles", 3)[2], [0, 1, 0])

    def test_a_pipe_gives_what_has_arrived(self):
        os.mkfifo(self.here / "pipe")
        end = os.open(self.here / "pipe", os.O_RDWR)
        self.addCleanup(os.close, end)
        os.write(end, b"".join(self.EVENTS[:3]))
        self.small("pipe")
        self.assertEqual(self.rows("A", "--cycles", 3)[1:], [self.AXES[1]] * 2)

    def test_a_missing_gamepad_is_named(self):
        self.small("nothing")
        self.forage("check", "small.iqr")
        said = self.forage("run", "small.iqr", "--cycles", 1, status=2).stderr
        self.assertIn("nothing' is not there; connect one, or set DeviceName to another device or to recorded events", said)

    def test_a_run_with_recorded_events_is_resumed(self):
        (self.here / "events").write_bytes(b"".join(event(ABS, 0, i % 32768) + event(KEY, A_BUTTON, i % 2) + REPORT for i in range(0, 6000, 3)))
        self.small("events")
        Video.resumed(self, "small.iqr", "--cycles", 1000)

    @unittest.skipUnless(os.access("/dev/uinput", os.W_OK), "there is no /dev/uinput, which makes virtual devices")
    def test_a_virtual_device(self):
        import fcntl

        UI_SET_EVBIT, UI_SET_KEYBIT, UI_SET_ABSBIT, UI_DEV_CREATE = 0x40045564, 0x40045565, 0x40045567, 0x5501
        device = os.open("/dev/uinput", os.O_WRONLY)
        self.addCleanup(os.close, device)
        for request, value in ((UI_SET_EVBIT, KEY), (UI_SET_EVBIT, ABS), (UI_SET_KEYBIT, A_BUTTON), (UI_SET_ABSBIT, 0)):
            fcntl.ioctl(device, request, value)
        ranges = [[0] * 64 for _ in range(4)]  # of 64 axes: highest, lowest, fuzz, flat
        ranges[0][0], ranges[1][0] = 200, 0
        os.write(device, struct.pack("80sHHHHi", b"forage test gamepad", 3, 1, 1, 1, 0) + struct.pack("256i", *sum(ranges, [])))
        before = set(os.listdir("/dev/input"))
        fcntl.ioctl(device, UI_DEV_CREATE)
        wait_for(lambda: any(n.startswith("event") for n in set(os.listdir("/dev/input")) - before))
        node = next(n for n in sorted(set(os.listdir("/dev/input")) - before) if n.startswith("event"))
        self.write("moduleJoystick", {"A": (2, 4), "B": (3, 1)}, {"DeviceName": f"/dev/input/{node}"}, [("JSOutput", "A"), ("Buttons", "B")])
        process = subprocess.Popen(
            [FORAGE, "run", "small.iqr", "--seconds", "3", "--realtime", "-q", "-o", "out", "--record", "P/A", "--record", "P/B"], cwd=self.here
        )
        wait_for_cycles(process)
        os.write(device, event(ABS, 0, 150) + event(KEY, A_BUTTON, 1) + REPORT)
        self.assertEqual(process.wait(timeout=600), 0)
        self.assertEqual(list(map(float, self.table("out/P_A_act.csv")[-1][1:3])), [0, 0.5])
        self.assertEqual(float(self.table("out/P_B_act.csv")[-1][1]), 1)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], defaultTest=["Video", "Gamepad"])
