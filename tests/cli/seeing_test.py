"""Recordings, read back with NumPy and h5py, and pictures.

    seeing_test.py FORAGE_PROGRAM PROJECT_DIRECTORY [TEST...]
"""

import filecmp
import html.parser
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import time
import unittest
import urllib.parse
import zlib

import pictures
from cli_test import FORAGE, SMALL_SYSTEM, SYSTEM, WORLD, Cli, wait_for

try:
    import h5py
    import numpy
except ImportError:
    h5py = numpy = None


def png_size(data):
    """Checks every chunk of a PNG file and returns its width and height."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, size = 8, None
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + length]
        assert struct.unpack(">I", data[at + 8 + length : at + 12 + length])[0] == zlib.crc32(kind + body), kind
        if kind == b"IHDR":
            size = struct.unpack(">II", body[:8])
        at += 12 + length
    return size


@unittest.skipUnless(numpy, "NumPy and h5py are absent")
class Formats(Cli):
    ARGUMENTS = (
        "--cycles",
        100,
        "-r",
        "Bug/Light",
        "-r",
        "Bug/Motor:vm(4..6,1..2)",
        "-r",
        "mean:Bug/Light(1..8,1)",
        "--record-every",
        3,
        "--record-from",
        10,
        "--record-until",
        90,
    )

    def csv(self, name, out="csv"):
        return numpy.array([[float(v) for v in row] for row in self.table(f"{out}/{name}")[1:]])

    def setUp(self):
        super().setUp()
        self.run_robot(*self.ARGUMENTS, out="csv")
        self.light = self.csv("Bug_Light_act.csv")
        self.motor = self.csv("Bug_Motor_vm_4..6_1..2_.csv")
        self.mean = self.csv("mean_Bug_Light_act_1..8_1_.csv")
        self.assertEqual(list(self.light[:, 0]), list(range(10, 91, 3)))
        self.assertEqual(self.table("csv/Bug_Motor_vm_4..6_1..2_.csv")[0], ["cycle", "x4_y1", "x5_y1", "x6_y1", "x4_y2", "x5_y2", "x6_y2"])
        numpy.testing.assert_allclose(self.mean[:, 1], self.light[:, 1:9].mean(axis=1), rtol=1e-14)

    def test_npy(self):
        self.run_robot(*self.ARGUMENTS, "--format", "npy")
        light = numpy.load(self.here / "out/Bug_Light_act.npy")
        self.assertEqual(light["act"].shape, (27, 1, 32))
        self.assertTrue((light["cycle"] == self.light[:, 0]).all())
        self.assertTrue((light["act"].reshape(27, 32) == self.light[:, 1:]).all())
        motor = numpy.load(self.here / "out/Bug_Motor_vm_4..6_1..2_.npy")
        self.assertTrue((motor["vm"].reshape(27, 6) == self.motor[:, 1:]).all())
        mean = numpy.load(self.here / "out/mean_Bug_Light_act_1..8_1_.npy")
        self.assertTrue((mean["act"] == self.mean[:, 1]).all())

    def test_npz(self):
        self.run_robot(*self.ARGUMENTS, "--format", "npz")
        self.assertEqual(sorted(p.name for p in (self.here / "out").iterdir()), ["recording.npz", "run.json", "trajectory.csv", "trajectory.png", "trials.csv"])
        arrays = numpy.load(self.here / "out/recording.npz")
        self.assertEqual(sorted(arrays), ["Bug/Light:act", "Bug/Motor:vm(4..6,1..2)", "mean:Bug/Light:act(1..8,1)"])
        self.assertTrue((arrays["Bug/Light:act"]["act"].reshape(27, 32) == self.light[:, 1:]).all())

    def test_hdf5(self):
        self.run_robot(*self.ARGUMENTS, "--format", "h5", "--seed", 1)
        with h5py.File(self.here / "out/recording.h5") as file:
            self.assertTrue((file["cycle"][:] == self.light[:, 0]).all())
            light = file["Bug/Light/act"]
            self.assertTrue((light[:].reshape(27, 32) == self.light[:, 1:]).all())
            self.assertTrue((file["Bug/Motor/vm(4..6,1..2)"][:].reshape(27, 6) == self.motor[:, 1:]).all())
            self.assertTrue((file["Bug/Light/act(1..8,1) mean"][:] == self.mean[:, 1]).all())
            self.assertEqual([d.label for d in light.dims], ["cycle", "row", "column"])
            self.assertEqual(light.dims[0][0], file["cycle"])
            text = {k: v.decode() if isinstance(v, bytes) else v for k, v in light.attrs.items() if k in ("name", "label", "unit")}
            self.assertEqual(text, {"name": "Bug/Light:act", "label": "Activity", "unit": "1"})
            self.assertEqual((file["Bug/Motor/vm(4..6,1..2)"].attrs["first_column"], file["cycle"].attrs["every"]), (4, 3))
            settings = {k: v.decode() if isinstance(v, bytes) else v for k, v in file.attrs.items()}
            self.assertEqual(settings["seed"], "1")
            self.assertIn("reactive_foraging.iqr", settings["system"])
            self.assertIn("seconds_per_cycle", settings["world"])

    def test_the_original_samplers_format(self):
        self.run_robot(*self.ARGUMENTS, "--format", "dat")
        lines = (self.here / "out/recording.dat").read_text().splitlines()
        self.assertRegex(lines[0], r'^# "Light"=\S+$')
        identifier = lines[0].split("=")[1]
        header = lines[3].split(";")
        self.assertEqual(header[:3], ["cycle", f"{identifier}_act_0", f"{identifier}_act_1"])
        self.assertEqual(header[-2:], [f"{identifier}_act_RangeAverage", ""])
        rows = [line.split(";") for line in lines[4:]]
        self.assertEqual([row[0] for row in rows], [str(3 * i) for i in range(27)])
        for row, numbers in zip(rows, self.light[:, 1:]):
            self.assertEqual(row[1:33], ["%g" % v for v in numbers])  # as C++ streams print a double

    def test_npz_files_are_drawn_as_csv_files(self):
        self.run_robot(*self.ARGUMENTS, "--format", "npz")
        for out in ("csv", "out"):
            self.forage("plot", out, "time:Bug/Light", "time:mean:Bug/Light(1..8,1)", "-o", out + "/seen")
        self.assertEqual(*(sorted((p.name, p.read_bytes()) for p in (self.here / out / "seen").iterdir()) for out in ("csv", "out")))
        self.assertEqual(len(self.forage("plot", "out/recording.npz", "-o", "all").stdout.split()), 4)  # the motors in space, too
        whole = (self.here / "out/recording.npz").read_bytes()
        (self.here / "half.npz").write_bytes(whole[: len(whole) // 2])
        self.assertIn("half.npz: error: this is not a recording: it is no archive", self.forage("plot", "half.npz", status=2).stderr)
        numpy.savez(self.here / "other.npz", a=numpy.zeros(3))
        self.assertIn("other.npz: error: this is not a recording: its records", self.forage("plot", "other.npz", status=2).stderr)

    def test_the_same_run_gives_the_same_bytes(self):
        for form in ("npy", "npz", "h5", "dat"):
            for out in ("a", "b"):
                self.run_robot(*self.ARGUMENTS, "--format", form, out=out)
                second = int(time.time())
                wait_for(lambda: form != "h5" or int(time.time()) > second)  # times that are kept are in whole seconds
            names = [p.name for p in (self.here / "a").iterdir()]
            self.assertEqual(filecmp.cmpfiles(self.here / "a", self.here / "b", names, shallow=False)[0], names)

    def test_the_format_follows_the_name_of_the_file(self):
        self.run_robot("--cycles", 5, "-r", "Bug/Light=all.h5", "-r", "Bug/GPS=all.h5", "-r", "Bug/GPS=gps.npy", "-r", "Bug/GPS")
        with h5py.File(self.here / "out/all.h5") as file:
            self.assertEqual(sorted(file["Bug"]), ["GPS", "Light"])
        self.assertEqual(len(numpy.load(self.here / "out/gps.npy")), 5)
        self.assertEqual(len(self.table("out/Bug_GPS_act.csv")), 6)

    def test_means_over_cycles(self):
        self.run_robot("--cycles", 100, "-r", "Bug/Light", "--record-every", 1, out="all")
        self.run_robot("--cycles", 100, "-r", "Bug/Light", "--record-every", 7, "--record-mean")
        means = self.csv("Bug_Light_act.csv", "out")
        self.assertEqual(list(means[:, 0]), list(range(0, 98, 7)))
        rows = self.csv("Bug_Light_act.csv", "all")[:98, 1:].reshape(14, 7, 32)
        numpy.testing.assert_allclose(means[:, 1:], rows.mean(axis=1), rtol=1e-13, atol=1e-15)

    def kill(self, form):
        command = [FORAGE, "run", SYSTEM, "--world", WORLD, "--seconds", "1000", "--realtime", "-r", "Bug/Light", "--format", form, "-o", f"killed_{form}"]
        process = subprocess.Popen(command, cwd=self.here, stdout=subprocess.PIPE)
        wait_for(lambda: any(self.rows_on_disk(p, form) > 10 for p in self.here.glob(f"killed_{form}/*.part")), process)
        process.send_signal(signal.SIGKILL)
        process.communicate(timeout=600)

    def rows_on_disk(self, file, form):
        """The rows of a recording of Bug/Light that is being written. They reach the disk within a second."""
        if form == "csv":
            return file.read_bytes().count(b"\n") - 1
        if form != "h5":
            return file.stat().st_size // (8 + 32 * 8)
        copy = shutil.copy(file, self.here / "copy.h5")  # who reads the file itself could lock it first
        try:
            with h5py.File(copy, swmr=True) as recording:
                return len(recording["cycle"])
        except (OSError, KeyError):  # not even its head is there
            return 0

    def test_rows_on_disk_remain_after_a_kill(self):
        self.run_robot("--cycles", 60, "-r", "Bug/Light", out="csv")
        light = self.csv("Bug_Light_act.csv")
        self.kill("csv")
        self.kill("npy")
        self.kill("h5")
        rows = [line.split(",") for line in (self.here / "killed_csv/Bug_Light_act.csv.part").read_text().splitlines(keepends=True)]
        self.assertGreater(len(rows), 10)
        self.assertEqual([float(v) for v in rows[9]], list(light[8]))
        array = numpy.load(self.here / "killed_npy/Bug_Light_act.npy.part")
        self.assertGreater(len(array), 10)
        self.assertTrue((array["act"].reshape(-1, 32) == light[: len(array), 1:]).all())
        with h5py.File(self.here / "killed_h5/recording.h5.part", swmr=True) as file:
            count = len(file["cycle"])
            self.assertGreater(count, 10)
            self.assertTrue((file["Bug/Light/act"][:count].reshape(-1, 32) == light[:count, 1:]).all())
        self.forage("plot", "killed_h5/recording.h5.part", "time", "-o", "pictures")
        self.forage("plot", "killed_csv")

    def test_an_interrupted_run_keeps_every_row(self):
        for form in ("npz", "h5"):
            command = [FORAGE, "run", SYSTEM, "--world", WORLD, "--seconds", "1000", "--realtime", "-r", "Bug/Light", "--format", form, "-o", "out"]
            process = subprocess.Popen(command, cwd=self.here, stdout=subprocess.PIPE, text=True)
            wait_for(lambda: any(self.rows_on_disk(p, form) > 10 for p in self.here.glob("out/*.part")), process)
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=600)
            cycles = json.loads((self.here / "out/run.json").read_text())["result"]["cycles"]
            if form == "npz":
                self.assertEqual(len(numpy.load(self.here / "out/recording.npz")["Bug/Light:act"]), cycles)
            else:
                with h5py.File(self.here / "out/recording.h5") as file:
                    self.assertEqual(len(file["cycle"]), cycles)

    def test_a_full_disk_is_reported(self):
        for form, name in (("npy", "Bug_Place_Cells_act.npy"), ("h5", "recording.h5")):
            command = f"ulimit -f 300; trap '' XFSZ; exec {FORAGE} run {SYSTEM} --world {WORLD} --cycles 5000 -o full --format {form} -r 'Bug/Place Cells'"
            done = subprocess.run(["bash", "-c", command], cwd=self.here, capture_output=True, text=True, timeout=600)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("error: cannot write", done.stderr)
            self.assertIn("trials.csv", [p.name for p in (self.here / "full").iterdir()])
            if form == "npy":
                self.assertGreater(len(numpy.load(self.here / "full" / name)), 3)
        command = f"ulimit -f 300; trap '' XFSZ; exec {FORAGE} run {SYSTEM} --world {WORLD} --cycles 95 -o packed --format npz -r 'Bug/Place Cells' -r 'Bug/Head Direction Cells'"
        done = subprocess.run(["bash", "-c", command], cwd=self.here, capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stderr, "error: cannot write '.*recording.npz': .*; its arrays are in files of their own, such as 'Bug/Place Cells:act'")
        self.assertFalse(list((self.here / "packed").glob("*.part")) + list((self.here / "packed").glob("*.npz")))
        for name in ("Bug_Place_Cells_act.npy", "Bug_Head_Direction_Cells_act.npy"):
            self.assertEqual(len(numpy.load(self.here / "packed" / name)), 95)


@unittest.skipUnless(numpy, "NumPy and h5py are absent")
class Claims(Cli):
    """HDF5 files that claim more than they hold, or that refer to other files."""

    def recording(self, change=None):
        """Writes a recording as Forage does, and then changes it."""
        with h5py.File(self.here / "x.h5", "w") as file:
            file.create_dataset("cycle", data=numpy.arange(100, dtype="u8"), maxshape=(None,), chunks=(100,))
            rows = file.create_dataset("P/A/act", data=numpy.ones((100, 2, 3)), maxshape=(None, 2, 3), chunks=(100, 2, 3))
            rows.attrs.update(name=numpy.bytes_("P/A:act"), label=numpy.bytes_("A"), group_id=numpy.bytes_("a"), first_column=1, first_row=1, numbered=0)
            if change:
                change(file)

    def draw(self, change):
        """What the program says about a changed recording."""
        self.recording(change)
        return subprocess.run(
            [FORAGE, "plot", "x.h5", "-o", "pictures"],
            cwd=self.here,
            capture_output=True,
            text=True,
            timeout=60,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (10**9, 10**9)),
        )

    def refused(self, change, why):
        done = self.draw(change)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, rf"x.h5: error: this is not a recording: {why}")
        self.assertFalse((self.here / "pictures").exists())

    def test_files_that_claim_more_than_they_hold_are_refused(self):
        def huge(file):
            for name in ("cycle", "P/A/act"):
                file[name].resize(10**11, axis=0)

        def cells(file):
            file["P"].create_dataset("B", shape=(100, 4000, 4000), chunks=(1, 100, 100))

        def copies(file):
            for i in range(1000):
                file[f"P/A/{i}"] = file["P/A/act"]

        for change in (huge, cells):
            self.refused(change, r"'/P/[AB].*' claims \d+ rows, and not all of them are there")
        self.refused(copies, r"it claims to hold \d+ bytes of numbers, and has \d+ bytes")

    def test_a_hole_in_a_file_holds_nothing(self):
        def huge(file):
            for name in ("cycle", "P/A/act"):
                file[name].resize(10**8, axis=0)

        self.recording(huge)
        os.truncate(self.here / "x.h5", 10**10)
        said = self.forage("plot", "x.h5", "-o", "pictures", status=2).stderr
        self.assertIn("'/P/A/act' claims 100000000 rows, and not all of them are there", said)

    def test_groups_are_not_nested_without_bound(self):
        self.refused(lambda file: file.create_group("/".join(["g"] * 3000)), "its groups are nested more than 32 deep")

        def circle(file):
            file["P/A/again"] = file["P"]

        self.refused(circle, "its groups are nested more than 32 deep")

        def many(file):
            for i in range(15):
                group = file.require_group(f"n{i}")
                group["a"] = group["b"] = file.require_group(f"n{i + 1}")

        self.refused(many, "it claims more groups than it can hold")

    def test_numbers_are_not_read_from_other_files(self):
        with h5py.File(self.here / "other.h5", "w") as other:
            other["cycle"], other["secret"] = numpy.arange(100, dtype="u8"), numpy.full((100, 2, 3), 5.0)

        def external(file):
            file["P"].create_dataset("B", shape=(100, 2, 3), dtype="f8", external=[("other.h5", 0, 4800)])

        def virtual(file):
            layout = h5py.VirtualLayout(shape=(100, 2, 3), dtype="f8")
            layout[:] = h5py.VirtualSource("other.h5", "secret", shape=(100, 2, 3))
            file.create_virtual_dataset("P/B", layout)

        for change in (external, virtual):
            self.refused(change, "the numbers of '/P/B' are in other files")

        def cycles(file):
            del file["cycle"]
            file["cycle"] = h5py.ExternalLink("other.h5", "cycle")

        self.refused(cycles, "'/cycle' is a link to another file; Forage does not follow it")

        def everything(file):
            del file["P"]
            file["P"] = h5py.SoftLink("/elsewhere")

        self.refused(everything, "'/P' is a link to another place; Forage does not follow it")

        def linked(file):
            file["P/B"] = h5py.ExternalLink("other.h5", "secret")
            file["P/C"] = h5py.SoftLink("/P/A/act")

        self.assertEqual(self.draw(linked).returncode, 0)
        self.assertEqual(sorted(p.name for p in (self.here / "pictures").iterdir()), ["space_P_A_act.png", "time_P_A_act.png"])

    def test_packed_numbers_are_refused_with_what_to_do(self):
        def packed(file):
            file["P"].create_dataset("B", data=numpy.zeros((100, 2, 3)), compression="gzip")

        self.refused(packed, "'/P/B' is compressed; 'h5repack -f NONE' unpacks a file")

    def test_what_holds_no_numbers_is_refused(self):
        def pairs(file):
            file["P"].create_dataset("B", data=numpy.zeros((100, 2, 3), dtype=[("a", "f8"), ("b", "i4")]))

        def lists(file):
            file["P"].create_dataset("B", shape=(100,), dtype=h5py.special_dtype(vlen="f8"))

        for change in (pairs, lists):
            self.refused(change, "'/P/B' does not hold numbers")

    def test_attributes_of_other_kinds_harm_nothing(self):
        def odd(file):
            attributes = file["P/A/act"].attrs
            attributes["first_row"] = numpy.full(7_000, 7)
            attributes["numbered"] = "yes"
            attributes["label"] = numpy.full(10_000, b"label")
            attributes["group_id"] = "text of any length"

        for value in (-1, 2**31 - 1):
            self.refused(lambda file, value=value: file["P/A/act"].attrs.modify("first_column", value), "'/P/A/act' has impossible cells")
        self.assertEqual(self.draw(odd).returncode, 0)


@unittest.skipUnless(numpy and shutil.which("gcc"), "NumPy, h5py or gcc is absent")
class NoLocks(Cli):
    """File systems without locks, as those of some clusters."""

    LIBRARY = r"""
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <sys/syscall.h>
#include <unistd.h>
int flock(int file, int operation) { (void)file, (void)operation; errno = ENOLCK; return -1; }
static int checked(int file, int command, void* argument) {
    if (command == F_SETLK || command == F_SETLKW) { errno = ENOLCK; return -1; }
    return (int)syscall(SYS_fcntl, file, command, argument);
}
#define FCNTL(name) int name(int file, int command, ...) { \
    va_list rest; va_start(rest, command); void* argument = va_arg(rest, void*); va_end(rest); \
    return checked(file, command, argument); }
FCNTL(fcntl)
FCNTL(fcntl64)
"""

    def test_hdf5_files_are_written_and_read_without_locks(self):
        (self.here / "locks.c").write_text(self.LIBRARY)
        subprocess.run(["gcc", "-shared", "-fPIC", "-o", "locks.so", "locks.c"], cwd=self.here, check=True)

        def forage(*arguments, **more):
            environment = {**os.environ, "LD_PRELOAD": str(self.here / "locks.so"), **more}
            return subprocess.run([FORAGE, *map(str, arguments)], cwd=self.here, capture_output=True, text=True, env=environment, timeout=600)

        run = ("run", SYSTEM, "--world", WORLD, "--cycles", 50, "-r", "Bug/Light", "--format", "h5", "-q", "-o")
        for command in ((*run, "out"), ("plot", "out/recording.h5", "-o", "pictures")):
            done = forage(*command)
            self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.here / "out/recording.h5", locking=False) as file:
            self.assertEqual(len(file["cycle"]), 50)
        for command in ((*run, "again"), ("plot", "out/recording.h5", "-o", "pictures")):
            done = forage(*command, HDF5_USE_FILE_LOCKING="TRUE")
            self.assertNotEqual(done.returncode, 0)
            self.assertIn("HDF5_USE_FILE_LOCKING=TRUE is set, and FALSE is needed without locks", done.stderr)


@unittest.skipUnless(numpy, "NumPy and h5py are absent")
class Tables(Cli):
    def test_results_of_an_experiment(self):
        (self.here / "x.xml").write_text(
            f"""<experiment>
  <world file="{WORLD}"/>
  <length trials="2" longest-trial="60"/>
  <seeds count="2"/>
  <sweep systems="{SYSTEM} {self.copied("ümlaut.iqr")}"/>
  <sweep parameter="Reactive Layer/US.threshold" values="0.2 1e3"/>
  <measure name="success" success="all"/>
  <measure name="it's light, ✓" first="max(Bug/Light) > 0.5"/>
  <measure name="seconds" first="cycle > 1000000"/>
</experiment>"""
        )
        self.forage("experiment", "x.xml", "-o", "out", "--table-format", "npy", "--table-format", "hdf5")
        header, *rows = self.table("out/results.csv")
        self.assertEqual(len(rows), 8)
        npy = numpy.load(self.here / "out/results.npy")
        with h5py.File(self.here / "out/results.h5") as file:
            hdf5 = file["table"][:]
        names = header[:-2] + ["seconds'", "remark"]
        self.assertEqual(list(npy.dtype.names), names)
        self.assertEqual(list(hdf5.dtype.names), names)
        for i, name in enumerate(names):
            texts = [row[i] for row in rows]
            if npy.dtype[name].kind == "U":
                self.assertEqual(npy[name].tolist(), texts)
                self.assertEqual([t.decode() for t in hdf5[name]], texts)
            else:
                numbers = [float(t) if t else numpy.nan for t in texts]
                numpy.testing.assert_array_equal(npy[name], numbers)
                numpy.testing.assert_array_equal(hdf5[name], numbers)
        self.assertEqual([n for n in names if npy.dtype[n].kind == "U"], ["run", "system", "status", "remark"])
        before = [(self.here / f"out/results.{end}").read_bytes() for end in ("npy", "h5")]
        self.forage("experiment", "x.xml", "-o", "out", "--merge", "--table-format", "npy", "--table-format", "hdf5")
        self.assertEqual([(self.here / f"out/results.{end}").read_bytes() for end in ("npy", "h5")], before)
        self.assertIn("--table-format", self.forage("experiment", "x.xml", "--table-format", "xls", status=2).stderr)

    def copied(self, name):
        return shutil.copy(SYSTEM, self.here / name)


class Mistakes(Cli):
    def test_wrong_selections_and_plots(self):
        for arguments, message in (
            (["-r", "Bug/Light(1..40,1)"], "has not all of the cells (1..40,1)"),
            (["-r", "Bug/Light=a.csv", "-r", "Bug/GPS=a.csv"], "a .csv file holds one source"),
            (["-r", "Bug/Light=../a.csv"], "is not a plain file name"),
            (["-r", "Bug/Light", "--format", "xls"], "--format"),
            (["-p", "spice:Bug/Light"], "did you mean 'space'"),
            (["-p", "space:Bug/Ligth"], "did you mean 'Bug/Light'"),
            (["-p", "space:Bug/Light@9..1"], "cycles are N, A..B or A..B/STEP"),
            (["-p", "space:Bug/Light;block=3"], "is not an option of a plot"),
            (["-p", "connection:Light to UR"], "did you mean 'Light to US'"),
            (["-p", "diagram:Bugg"], "did you mean 'Bug'"),
            (["-p", "time:Bug/Light", "--plot-format", "gif"], "--plot-format"),
        ):
            done = self.run_robot("--cycles", 1, *arguments, status=2)
            self.assertIn("error:", done.stderr)
            self.assertIn(message, done.stderr)
        self.assertEqual(list(self.here.iterdir()), [])

    def test_recordings_without_rows(self):
        for arguments, hint in (
            (["--record-from", 9], "begin in cycle 9"),
            (["--record-from", 4, "--record-until", 2], "--record-until 2 is before"),
            (["--record-every", 7, "--record-mean"], "a mean needs all cycles"),
        ):
            for form in ("csv", "npz", "h5"):
                done = self.run_robot("--cycles", 5, "-r", "Bug/Light", "-r", "Bug/GPS", "--format", form, *arguments)
                self.assertIn("warning: no row was recorded of 'Bug/Light:act', 'Bug/GPS:act': the run had 5 cycles", done.stderr)
                self.assertIn(hint, done.stderr)
        self.assertNotIn("warning", self.run_robot("--cycles", 5, "-r", "Bug/Light", "--record-from", 4).stderr)

    def test_plots_of_cycles_that_were_not_run(self):
        done = self.run_robot("--cycles", 5, "-p", "space:Bug/Light@7", "-p", "time:Bug/Light", status=1)
        self.assertIn("none of these cycles is there; there are 5 of 0 to 4", done.stderr)
        self.assertIn("time_Bug_Light.png", [p.name for p in (self.here / "out").iterdir()])
        self.run_robot("--cycles", 5, "-r", "Bug/Light", out="rows")
        said = self.forage("plot", "rows", "space:Bug/Light@7", status=2).stderr
        self.assertEqual(said.count("'space:Bug/Light@7'"), 1, said)
        self.assertIn("the recording ends before cycle 9\n  hint: its last cycle is 4", self.forage("plot", "rows", "space:Bug/Light@0,9").stderr)
        self.assertIn("'sum' is not a function of cells here", self.forage("plot", "rows", "time:sum(Bug/Light)", status=2).stderr)
        self.forage("plot", "rows", "time:max(Bug/Light)")

    def test_a_mistake_in_one_table_leaves_no_picture_of_another(self):
        self.run_robot("--cycles", 20, "-r", "Bug/Light")
        (self.here / "out/trajectory.png").unlink()
        with open(self.here / "out/trajectory.csv", "a") as file:
            file.write("9,20,0,0,0\n")
        self.assertIn("trials.csv has no trial 9", self.forage("plot", "out", status=2).stderr)
        self.assertFalse(list((self.here / "out").glob("*.png")))

    def test_nothing_to_plot(self):
        self.assertIn("absent: error: there is no such file", self.forage("plot", "absent", status=2).stderr)
        (self.here / "empty").mkdir()
        self.assertIn("there is no such recording", self.forage("plot", "empty", "time:Bug/Light", status=2).stderr)
        self.assertIn("which system?", self.forage("plot", "empty", "diagram", status=2).stderr)
        (self.here / "a.csv").write_text("time,x\n")
        self.assertIn("its first column is not 'cycle'", self.forage("plot", "a.csv", status=2).stderr)


class Pictures(Cli):
    PLOTS = ("time:Bug/Light", "time:mean:Bug/Light", "time:Bug/GPS", "space:Bug/Light@40", "space:Bug/Place Cells@0..80/10")

    def test_a_run_and_its_recording_give_the_same_pictures(self):
        for form in ("png", "svg", "pdf"):
            plots = [a for p in self.PLOTS for a in ("-p", p)]
            self.run_robot("--trials", 2, *plots, "-p", "diagram", "-r", "Bug/Light", "-r", "Bug/GPS", "-r", "Bug/Place Cells=cells.h5", "--plot-format", form)
            made = sorted(p.name for p in (self.here / "out").iterdir() if p.suffix == "." + form)
            self.assertEqual(len(made), 7)
            self.forage("plot", "out", *self.PLOTS, "diagram", "trajectory", "-o", "again", "--plot-format", form)
            self.assertEqual(filecmp.cmpfiles(self.here / "out", self.here / "again", made, shallow=False), (made, [], []))

    def test_recorded_weights_have_the_axes_of_a_connection(self):
        picture = "space:CS to Response:weight@40"
        self.forage(
            "run", pathlib.Path(SYSTEM).parent / "cookbook/hebbian_association.iqr", "--cycles", 50, "-p", picture, "-r", "CS to Response:weight", "-o", "out"
        )
        made = next((self.here / "out").glob("space*.png"))
        self.forage("plot", "out", picture, "-o", "again")
        self.assertEqual(made.read_bytes(), (self.here / "again" / made.name).read_bytes())

    def test_without_arguments_all_available_pictures_are_drawn(self):
        self.run_robot("--cycles", 50, "-r", "Bug/Light", "-r", "Bug/Place Cells")
        done = self.forage("plot", "out", "-o", "pictures")
        self.assertEqual(
            done.stdout.split(), [f"pictures/{n}.png" for n in ("time_Bug_Light_act", "time_Bug_Place_Cells_act", "space_Bug_Place_Cells_act", "trajectory")]
        )
        self.assertEqual(self.forage("plot", SYSTEM, "-o", "pictures").stdout, "pictures/diagram.png\n")

    def test_a_trajectory_is_always_drawn_and_needs_a_world(self):
        self.run_robot("--cycles", 50, "-p", "trajectory")
        self.forage("plot", "out", "trajectory", "-o", "again")
        self.assertTrue(filecmp.cmp(self.here / "out/trajectory.png", self.here / "again/trajectory.png", shallow=False))
        (self.here / "small.iqr").write_text(SMALL_SYSTEM.replace('enableModule="true"', 'enableModule="false"'))
        self.forage("run", "small.iqr", "--cycles", 5, "-o", "small")
        self.assertIn("results of a run in a world", self.forage("plot", "small", "trajectory", status=2).stderr)

    def test_a_trajectory_of_some_trials(self):
        self.run_robot("--trials", 4, "-p", "trajectory@2..3", "-p", "trajectory", "-p", "trajectory@1..4")
        pictures = [(self.here / "out" / f"trajectory{trials}.png").read_bytes() for trials in ("", "_1..4", "_2..3")]
        self.assertEqual(pictures[0], pictures[1])
        self.assertNotEqual(pictures[0], pictures[2])
        self.forage("plot", "out", "trajectory@2..3", "-o", "again")
        self.assertEqual((self.here / "again/trajectory_2..3.png").read_bytes(), pictures[2])
        said = self.run_robot("--trials", 2, "-p", "trajectory@3..4", out="short").stderr  # none of these trials: no picture
        self.assertEqual([p.name for p in (self.here / "short").glob("*.png")], [])
        self.assertIn("warning: 'trajectory@3..4': the run ended before trial 3..4\n  hint: the run had 2 trials", said)
        said = self.run_robot("--trials", 2, "-p", "trajectory@1..7/2", "-p", "space:Bug/Light@0,5,9000,100000..100100/30", out="short").stderr
        self.assertIn("'trajectory@1..7/2': the run ended before trial 3..7\n", said)
        self.assertIn("the run ended before cycle 9000, 100000..100090\n  hint: the last cycle was ", said)
        self.assertIn("ended before trial 5\n", self.forage("plot", "out", "trajectory@3..5/2").stderr)
        self.assertIn("there are no trials 7..9", self.forage("plot", "out", "trajectory@7..9", status=2).stderr)
        self.assertIn("'3..1' is not a trial", self.forage("plot", "out", "trajectory@3..1", status=2).stderr)

    def test_a_trajectory_of_damaged_tables_is_refused_with_the_place(self):
        self.run_robot("--trials", 2)
        tables = {name: (self.here / "out" / name).read_text() for name in ("trials.csv", "trajectory.csv")}
        for name, old, new, place in (
            ("trajectory.csv", r"\A(.*\n.*\n\d+,\d+,)[^,]+", r"\g<1>x1", "trajectory.csv:3:[0-9]+: error: 'x1' is not a number"),
            ("trajectory.csv", r"\A(.*\n.*\n\d+,\d+,)[^,]+", r"\g<1>nan", "trajectory.csv:3:[0-9]+: error: 'nan' is not a finite number"),
            ("trajectory.csv", r"\A(.*\n)\d+", r"\g<1>7", "trajectory.csv:2:1: error: trials.csv has no trial 7"),
            ("trajectory.csv", r"\A(.*\n.*\n\d+),\d+", r"\g<1>", "trajectory.csv:3:1: error: 4 fields in this row, not 5"),
            ("trajectory.csv", r"\A(.*\n.*\n\d+,\d+)(.|\n)*", r"\g<1>", "trajectory.csv:3:1: error: the file ends within this row"),
            ("trajectory.csv", r"\Atrial,cycle,x,", "trial,cycle,u,", "trajectory.csv:1:1: error: there is no column 'x'"),
            ("trajectory.csv", r"\A(.|\n)*", "", "trajectory.csv: error: it is empty"),
            ("trials.csv", r"\btarget\b|\bmissed\b", "lost", "trials.csv:2:[0-9]+: error: 'lost' is not an outcome of a trial"),
            ("trials.csv", r"\A(.*\n)(?:[^,\n]*,){7}[^,]+", r"\g<1>1,2,3,4,5,6,target,-", "trials.csv:2:[0-9]+: error: '-' is not a number"),
        ):
            changed = re.sub(old, new, tables[name], count=1)
            self.assertNotEqual(changed, tables[name])
            (self.here / "out" / name).write_text(changed)
            done = self.forage("plot", "out", "trajectory", "-o", "again", status=2)
            self.assertRegex(done.stderr, f"(?m)^out/{place}")
            self.assertFalse((self.here / "again/trajectory.png").exists())
            (self.here / "out" / name).write_text(tables[name])
        self.forage("plot", "out", "trajectory", "-o", "again")
        (self.here / "out/trials.csv").unlink()
        self.assertIn("out/trials.csv: error: ", self.forage("plot", "out", "trajectory", status=2).stderr)

    def test_learned_weights_are_drawn_as_receptive_fields(self):
        system = pathlib.Path(SYSTEM).parent / "cookbook/hebbian_association.iqr"
        plot = "wiring:CS to Response@0,65,159"
        self.forage("run", system, "--cycles", 160, "-p", plot, "-r", "CS to Response:weight", "-o", "out")
        picture = (self.here / "out/wiring_CS_to_Response_0_65_159.png").read_bytes()
        self.forage("plot", system, "wiring:CS to Response", "-o", "one")
        heights = [png_size(p)[1] for p in (picture, (self.here / "one/wiring_CS_to_Response.png").read_bytes())]
        self.assertEqual(heights[0], 3 * heights[1])
        self.forage("plot", "out", plot, "-o", "again")
        self.assertEqual((self.here / "again/wiring_CS_to_Response_0_65_159.png").read_bytes(), picture)

    def test_a_time_plot_of_many_cells_takes_little_memory(self):
        system = re.sub("<Module.*</Module>", "", SMALL_SYSTEM, flags=re.DOTALL)
        (self.here / "large.iqr").write_text(system.replace('hcount="2" vcount="1"', 'hcount="100" vcount="50"'))
        most = 600 << 20
        done = subprocess.run(
            [FORAGE, "run", "large.iqr", "--cycles", "4000", "-p", "time:P/A", "--as", "svg", "-o", "out"],
            cwd=self.here,
            capture_output=True,
            text=True,
            timeout=600,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (most, most)),
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess((self.here / "out/time_P_A.svg").stat().st_size, 10 << 20)

    def test_a_movie(self):
        self.run_robot("--cycles", 300, "-p", "movie:Bug/Place Cells@0..290/10", "-p", "movie:Bug/Light")
        movie = (self.here / "out/movie_Bug_Place_Cells_0..290_10.gif").read_bytes()
        width, height = struct.unpack("<HH", movie[6:10])
        self.assertEqual(pictures.frames(movie), 30)
        self.assertTrue(400 < width < 1000 and 300 < height < 1000)
        frames = pictures.frames((self.here / "out/movie_Bug_Light.gif").read_bytes())
        self.assertTrue(60 <= frames <= 120)

    def test_a_recording_is_drawn_from_its_file(self):
        self.run_robot("--cycles", 50, "-r", "Bug/Motor")
        self.forage("plot", "out/Bug_Motor_act.csv", "space@10,20", "time:(4..6,1)", "-o", "pictures", status=2)
        self.forage("plot", "out/Bug_Motor_act.csv", "space@10,20", "time:Bug/Motor(4..6,1)", "-o", "pictures")
        self.assertEqual(len(list((self.here / "pictures").iterdir())), 2)

    def test_connections_and_diagrams_of_every_shipped_system(self):
        for system in ("reactive_foraging", "reactive_foraging_exercise"):
            path = f"{SYSTEM[:SYSTEM.rindex('/')]}/{system}.iqr"
            names = re.findall(r'<Connection [^>]*?name="([^"]*)"', pathlib.Path(path).read_text())
            self.forage("plot", path, "diagram", "diagram:Bug", *(f"connection:{n}" for n in set(names)), "-o", system)
            for picture in (self.here / system).iterdir():
                png_size(picture.read_bytes())

    def test_svg_is_xml_and_shows_every_group(self):
        self.forage("plot", SYSTEM, "diagram", "--plot-format", "svg")
        text = (self.here / "diagram.svg").read_text()
        if shutil.which("xmllint"):
            self.assertEqual(subprocess.run(["xmllint", "--noout", "--nonet", self.here / "diagram.svg"]).returncode, 0)
        self.assertIn("<svg", text)

    def test_a_page_shows_everything_and_fetches_nothing(self):
        self.run_robot("--trials", 3, "-p", "time:Bug/Light", "-p", "space:Bug/Place Cells@5", "-r", "Bug/Light")
        (self.here / "out/a <b> & 100% #1.png").write_bytes(b"")
        self.assertIn("out/index.html", self.forage("view", "out").stdout)
        page = (self.here / "out/index.html").read_text()
        self.assertNotRegex(page, r"<script|https?:|//")
        for name in re.findall(r'(?:src|href)="\./([^"]*)"', page):
            self.assertTrue((self.here / "out" / urllib.parse.unquote(name)).exists(), name)
        for picture in ("trajectory", "time_Bug_Light", "space_Bug_Place_Cells_5"):
            self.assertIn(f'<img src="./{picture}.png"', page)
        self.assertEqual(page.count("<td>target</td>") + page.count("<td>missed</td>"), 3)
        self.assertIn("<tr><th>seed</th><td>1</td></tr>", page)
        self.assertLess(len(page), 20000)  # the recording's numbers are not on it
        parser = html.parser.HTMLParser()
        parser.feed(page)
        self.assertIn("error:", self.forage("view", "absent", status=2).stderr)

    def test_a_system_without_layout_has_a_diagram(self):
        (self.here / "small.iqr").write_text(SMALL_SYSTEM.replace('<DiagramIcon x="0" y="0"/>', ""))
        self.forage("plot", "small.iqr", "--lenient", status=2)
        (self.here / "small.iqr").write_text(SMALL_SYSTEM)
        self.forage("plot", "small.iqr", "diagram", "connection:B to A")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
