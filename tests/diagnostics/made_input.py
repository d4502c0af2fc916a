"""Cases that are too large or too odd to keep as files: each function makes its files in the given directory.

CASES: name -> function of the directory, which returns what to run there.
"""

import dataclasses
import os
import resource
import zipfile

CASES = {}
UNPRIVILEGED = 65534


@dataclasses.dataclass
class Case:
    arguments: list
    status: int = 2
    popen: dict = dataclasses.field(default_factory=dict)


def case(make):
    CASES[make.__name__] = make
    return make


def command(kind, file):
    return {
        "system": ["check", file],
        "world": ["check", "system.iqr", "--world", file],
        "experiment": ["experiment", file, "-q", "-o", "out"],
        "clamp": ["run", "system.iqr", "-o", "", "--clamp", file],
        "drive": ["run", "replay.iqr", "-o", "", "--replay", file],
        "patterns": ["run", "system.iqr", "-o", "", "--clamp", f"P/A={file}"],
        "weights": ["check", "learning.iqr", "--set", "Adaptive.read=true", "--set", f"Adaptive.File Name={file}"],
        "recording": ["plot", file, "-o", "out"],
    }[kind]


SYSTEM = '<System id="s" name="S" author="" date="" cylesPerSecond="0">'
SOUND = {
    "system": "system.iqr",
    "world": "world.world",
    "experiment": "experiment.xml",
    "clamp": "table.csv",
    "drive": "table.csv",
    "patterns": "patterns.txt",
    "weights": "weights.weights",
}
ENDING = {"system": ".iqr", "world": ".world", "experiment": ".xml", "recording": ".csv"}


def written(kind, *pieces):
    """A case with a file of these pieces, each a text or (text, times). The file is written piece by piece, because the
    system counts the peak memory of this program as memory of the programs that it starts."""

    def make(here):
        name = "input" + ENDING.get(kind, ".txt")
        with open(here / name, "w") as file:
            for piece in pieces:
                text, times = piece if isinstance(piece, tuple) else (piece, 1)
                while times > 0:
                    some = min(times, max(1, (1 << 20) // len(text)))
                    file.write(text * some)
                    times -= some
        return Case(command(kind, name))

    return make


def add_kinds():
    for kind in [*SOUND, "recording"]:

        def device(here, kind=kind):
            name = "endless" + ENDING.get(kind, ".txt")
            (here / name).symlink_to("/dev/zero")
            return Case(command(kind, name))

        def circle(here, kind=kind):
            name = "circle" + ENDING.get(kind, ".txt")
            (here / name).symlink_to(name)
            return Case(command(kind, name))

        def sparse(here, kind=kind):
            name = "sparse" + ENDING.get(kind, ".txt")
            with open(here / name, "wb") as file:
                file.truncate(10**10)
            return Case(command(kind, name))

        def one_line(here, kind=kind):
            name = "line" + ENDING.get(kind, ".txt")
            with open(here / name, "wb") as file:
                for _ in range(80):
                    file.write(b"x" * (1 << 20))
            return Case(command(kind, name))

        def pipe(here, kind=kind):
            name = "pipe" + ENDING.get(kind, ".txt")
            os.mkfifo(here / name)
            return Case(command(kind, name))

        CASES[f"{kind}_a_pipe_that_nobody_writes_into"] = pipe
        CASES[f"{kind}_without_an_end"] = device
        CASES[f"{kind}_linked_to_itself"] = circle
        CASES[f"{kind}_of_ten_gigabytes_of_nothing"] = sparse
        CASES[f"{kind}_of_one_line_of_eighty_megabytes"] = one_line
    for kind in SOUND:

        def unreadable(here, kind=kind):
            os.chmod(here / SOUND[kind], 0)
            return Case(command(kind, SOUND[kind]), popen=as_nobody(here))

        CASES[f"{kind}_unreadable"] = unreadable


def as_nobody(here):
    """Runs as another user, because root can read every file."""
    if os.geteuid() != 0:
        return {}
    for path in (here.parent, here):
        os.chmod(path, 0o755)
    return {"user": UNPRIVILEGED, "group": UNPRIVILEGED, "extra_groups": []}


def no_space():
    """As a full disk: no byte can be written to a file; what is said goes through a pipe. (restore_signals would bring
    SIGXFSZ back, which kills.)"""
    return {"restore_signals": False, "preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))}


M = 1_000_000
WORLD = '<sdf version="1.4"><world name="w">'
EXPERIMENT = '<experiment><system file="system.iqr"/><length cycles="5"/>'
for name, made in {
    "system_nested_a_million_deep": ("system", SYSTEM, ("<Process>", M)),
    "system_of_a_million_mistakes": ("system", SYSTEM, ("\n<Proces/>", M), "</System>"),
    "system_of_two_million_elements": ("system", SYSTEM, ("<P/>", 2 * M), "</System>"),
    "system_of_eight_million_declarations": ("system", ("<!a>", 8 * M - 50_000), SYSTEM, "</System>"),
    "system_of_a_million_references": ("system", SYSTEM, "<Note>", ("&lt;", M), "&x;</Note></System>"),
    "system_with_a_value_of_thirty_megabytes": ("system", '<System id="s" name="', ("x", 30 * M), '"><P/></System>'),
    "system_with_a_name_of_thirty_megabytes": ("system", "<", ("x", 30 * M), "/>"),
    "system_with_a_million_equal_attributes": ("system", "<System ", ('a="" ', M), "/>"),
    "world_nested_a_million_deep": ("world", WORLD, ('<model name="m">', M)),
    "world_of_a_million_elements": ("world", WORLD, ('<model name="m"/>', M), "</world></sdf>"),
    "world_with_a_pose_of_a_megabyte": ("world", WORLD, '<model name="m"><pose>', ("0 ", M // 2), '</pose><link name="l"/></model></world></sdf>'),
    "world_with_a_uri_of_a_megabyte": ("world", WORLD, "<include><uri>model://", ("x", M), "</uri></include></world></sdf>"),
    "experiment_nested_a_million_deep": ("experiment", "<experiment>", ("<note>", M)),
    "experiment_with_a_condition_nested_very_deeply": (
        "experiment",
        EXPERIMENT,
        '<at when="',
        ("(", M),
        'cycle 1" parameter="P/A.threshold" value="1"/></experiment>',
    ),
    "experiment_with_a_condition_of_a_million_parts": (
        "experiment",
        EXPERIMENT,
        '<at when="',
        ("cycle 1 or ", M),
        'cycle 1" parameter="P/A.threshold" value="1"/></experiment>',
    ),
    "experiment_with_a_million_seeds": ("experiment", EXPERIMENT, '<seeds list="', ("1 ", M), '"/></experiment>'),
    "experiment_with_a_million_bad_seeds": ("experiment", EXPERIMENT, '<seeds list="', ("x ", M), '"/></experiment>'),
    "experiment_with_ten_thousand_cells_outside": ("experiment", EXPERIMENT, '<clamp group="P/A" cells="', ("(9,9)=1 ", 10_000), '"/></experiment>'),
    "clamp_of_a_million_bad_values": ("clamp", "0,P,A", (",x", M), "\n"),
    "clamp_of_a_million_bad_rows": ("clamp", ("x\n", M)),
    "clamp_of_ten_thousand_rows_for_nobody": ("clamp", ("0,P,Z,1\n", 10_000)),
    "patterns_of_a_million_words": ("patterns", ("x ", M)),
    "weights_of_a_million_words": ("weights", ("x,", M)),
    "weights_of_a_million_numbers": ("weights", ("1,\n", M)),
    "recording_of_a_million_columns": ("recording", "cycle", (",x1_y1", M), "\n"),
    "recording_of_ten_million_columns": ("recording", "cycle", (",1", 10 * M), "\n"),
}.items():
    CASES[name] = written(*made)
add_kinds()


def npy(rows, height, width):
    """The head of a recording, which has no rows."""
    head = f"{{'descr': [('cycle', '<u8'), ('act', '<f8', ({height}, {width}))], 'fortran_order': False, 'shape': ({rows},), }}".encode().ljust(117) + b"\n"
    return b"\x93NUMPY\x01\x00" + len(head).to_bytes(2, "little") + head


def npz(here, bytes_of_rows, claimed=None):
    """An archive of a packed recording. It claims another size of it."""
    rows = bytes_of_rows // 24
    with zipfile.ZipFile(here / "input.npz", "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        with archive.open("P.npy", "w") as file:
            file.write(npy(rows, 2, 1))
            for _ in range(rows // 1000):
                file.write(bytes(24_000))
        size = archive.getinfo("P.npy").file_size
    if claimed is not None:
        data = (here / "input.npz").read_bytes()
        (here / "input.npz").write_bytes(data.replace(size.to_bytes(4, "little"), claimed.to_bytes(4, "little")))
    return Case(command("recording", "input.npz"))


@case
def recording_npz_that_holds_two_hundred_megabytes(here):
    return npz(here, 200 * M)


@case
def recording_npz_that_claims_less_than_it_holds(here):
    return npz(here, 200 * M, 100)


@case
def recording_npz_that_claims_four_gigabytes(here):
    return npz(here, 24_000, 4 * 10**9)


@case
def recording_npy_that_claims_a_trillion_rows(here):
    (here / "input.npy").write_bytes(npy(10**12, 2, 1) + bytes(240))
    return Case(command("recording", "input.npy"))


@case
def recording_npy_that_claims_a_row_of_sixteen_million_cells(here):
    (here / "input.npy").write_bytes(npy(1, 4096, 4096) + bytes(240))
    return Case(command("recording", "input.npy"))


@case
def at_parentheses_very_deep(here):
    return Case(["run", "system.iqr", "-o", "", "--cycles", "5", "--schedule", "(" * 60_000 + "cycle 5: P/A.threshold=1"])


@case
def at_parts_very_many(here):
    return Case(["run", "system.iqr", "-o", "", "--cycles", "5", "--schedule", " or ".join(["cycle 5"] * 10_000) + ": P/A.threshold=1"])


@case
def until_of_nots_and_signs(here):
    return Case(["run", "system.iqr", "-o", "", "--cycles", "5", "--until", "!" * 100_000])


@case
def a_model_of_the_world_unreadable(here):
    os.chmod(here / "models/robot/model.sdf", 0)
    return Case(command("world", "world.world"), popen=as_nobody(here))


@case
def a_directory_that_may_not_be_written(here):
    os.chmod(here, 0o555)
    return Case(["run", "system.iqr", "--cycles", "5", "-o", "out"], popen={**as_nobody(here)})


@case
def a_full_disk_for_a_recording(here):
    return Case(["run", "system.iqr", "--cycles", "5", "-q", "-o", "out", "--record", "P/A"], 1, no_space())


@case
def a_full_disk_for_a_file(here):
    return Case(["convert", "system.iqr", "out.iqr"], 1, no_space())


@case
def a_full_disk_for_an_experiment(here):
    return Case(["experiment", "experiment.xml", "-q", "-o", "out", "-j", "1"], 1, no_space())


@case
def a_full_disk_for_a_page(here):
    return Case(["view", "models"], 1, no_space())


@case
def an_answer_that_cannot_be_printed(here):
    return Case(["describe", "system.iqr"], 1, {"stdout": os.open("/dev/full", os.O_WRONLY)})


def in_the_way(*names):
    """Makes folders with the names of files that will be written."""

    def make(here):
        for name in names:
            (here / "out" / name).mkdir(parents=True)

    return make


@case
def a_folder_in_the_way_of_the_record_of_a_run(here):
    in_the_way("run.json")(here)
    return Case(["run", "system.iqr", "--cycles", "5", "-o", "out"])


@case
def a_folder_in_the_way_of_a_recording(here):
    in_the_way("P_A_act.csv")(here)
    return Case(["run", "system.iqr", "--cycles", "5", "-o", "out", "--record", "P/A"])


@case
def a_folder_in_the_way_of_a_trajectory(here):
    in_the_way("trajectory.csv")(here)
    return Case(["run", "system.iqr", "--world", "world.world", "--cycles", "5", "-o", "out"])


@case
def a_folder_in_the_way_of_an_experiments_table(here):
    in_the_way("summary.csv", "runs")(here)
    return Case(["experiment", "experiment.xml", "-q", "-o", "out"])


@case
def a_name_that_steers_the_terminal(here):
    return Case(["check", "red\x1b[31m\nsystem.iqr"])


@case
def a_type_whose_name_steers_the_terminal(here):
    return Case(["new", "neuron", "a\x1b[2J\u009b31m\x7f"])


@case
def results_with_nothing_to_draw(here):
    (here / "out").mkdir()
    return Case(["plot", "out"])


def model(here, name, text):
    folder = here / "models" / name
    folder.mkdir()
    (folder / "model.config").write_text(f"<model><name>{name}</name><sdf version='1.4'>model.sdf</sdf></model>")
    (folder / "model.sdf").write_text(f'<sdf version="1.4"><model name="{name}">{text}</model></sdf>')


def world_with(here, text):
    (here / "input.world").write_text((here / "world.world").read_text().replace("</world>", text + "</world>"))
    return Case(command("world", "input.world"))


@case
def a_world_of_a_trillion_models_in_forty_files(here):
    for i in range(40):
        model(here, f"m{i}", "".join(f"<include><name>{n}</name><uri>model://m{i + 1}</uri></include>" for n in "ab"))
    model(here, "m40", '<link name="l"><collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision></link>')
    return world_with(here, "<include><uri>model://m0</uri></include>")


@case
def a_world_of_two_thousand_robots(here):
    robot = "<include><name>r{0}</name><uri>model://robot</uri><pose>{1} {2} 0 0 0 0</pose></include>"
    return world_with(here, "".join(robot.format(i, i % 40 * 2 - 40, i // 40 * 2 + 20) for i in range(2000)))
