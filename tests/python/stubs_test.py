"""The stubs say what is there, and the examples of the docs are programs without mistakes of types."""
import importlib.util
import json
import os
import re
import subprocess
import sys

import pytest

import forage
from conftest import PROJECT

PACKAGE = os.environ["PYTHONPATH"]
# Some packages are imported when they are needed. The fallback for gymnasium is not annotated. Examples declare no types of their
# functions, and give a name to several things.
CONFIGURATION = """[mypy]
ignore_missing_imports = True
[mypy-forage._spaces]
ignore_errors = True
[mypy-docs.*]
allow_redefinition = True
disallow_untyped_defs = False
disallow_incomplete_defs = False
disallow_untyped_calls = False
"""
# The metaclass and the constructor are pybind11's; annotations use names that are imported for mypy only. Private functions take
# arguments without names. typing.MutableMapping is positional where collections.abc.MutableMapping is not.
ALLOWED = r"""forage(\._forage)?\._?[A-Z]\w*(\.[A-Z]\w*)?
forage(\._forage)?\._?[A-Z]\w*(\.[A-Z]\w*)?\.__init__
forage\._\w+\.(Any|Sequence|DTypeLike|NDArray|numpy)
forage\._forage\._(Draws|Experiment)\.\w+
forage\._forage\._[a-z_]+
forage(\._forage)?\.(System\.)?(Parameters|Constants)\.(get|pop|setdefault|update)
"""
PROGRAM = """
import forage
import numpy

with forage.open("a.iqr", world="a.world", settings={"Bug/Light.threshold": 0.5}, observe=["Bug/Light"]) as run:
    light = run["Bug/Light"]
    act: numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.float64]] = light.act
    probe = run.probe("Bug/Light", every=10)
    @run.on_cycle(every=100)
    def note(run: forage.Run) -> None:
        run.params["Bug/Light.threshold"] = 0.3
    with light.clamp(0.5):
        held: bool = run.run_until("trial 3", cycles=100)
    recording: forage.Recording = probe.take()
    state: bytes = run.save_state()
try:
    forage.resume(state).run(seconds=1, progress=True)
except forage.InputError as error:
    print(error.file, error.line, error.column, error.hint)

with forage.System("a") as system:
    a = system.add_process("P").add_group("A", 3, threshold=0.5)
    connection = system.connect(a, "P/A", pattern=forage.Pattern.foreach(), delay=3, weight=0.5)
    connection.attenuation = 0.5  # type: ignore[assignment]
    connection.source = a
a.params["threshold"] = 1
table = forage.sweep(system, values={"P/A.threshold": [0, 1]}, seeds=2, cycles=3, measure={"act": lambda run: run["P/A"].act.max()})
where: str | None = forage.experiment("a.xml", jobs=2).directory
print(table["act"], table.to_pandas(), where)
"""


MODULES = [
    PROJECT / f"tools/python/forage/{name}.py"
    for name in ("_errors", "_experiment", "_optimise", "_picture", "_recording", "_rollouts", "_types", "demo", "gym")
]


def write_examples(folder):
    """A module per page and notebook. Blocks of pages that import nothing are equations, and those named py are programs of other tools."""
    folder.mkdir()
    (folder / "__init__.py").touch()
    for file in [*PROJECT.glob("docs/**/*.md"), *PROJECT.glob("docs/notebooks/*.ipynb")]:
        text = file.read_text()
        if file.suffix == ".md":
            blocks = re.findall(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
        else:
            blocks = ["".join(cell["source"]) for cell in json.loads(text)["cells"] if cell["cell_type"] == "code"]
        program = "\n".join(blocks) + "\n"
        if "import " in program:
            (folder / f"{re.sub('[^a-z]', '_', file.stem)}.py").write_text(program)


@pytest.fixture(scope="module")
def checks(tmp_path_factory):
    """Both checks, which run at the same time: most of theirs is reading the stubs of NumPy, which mypy keeps in the folder of the build."""
    if importlib.util.find_spec("mypy") is None:
        pytest.skip("mypy is not installed")
    folder = tmp_path_factory.mktemp("stubs")
    for name, text in {"mypy.ini": CONFIGURATION, "allowed": ALLOWED, "program.py": PROGRAM}.items():
        (folder / name).write_text(text)

    write_examples(folder / "docs")

    def start(module, *arguments):
        return subprocess.Popen(
            [sys.executable, "-m", module, *arguments],
            cwd=folder,
            env={**os.environ, "MYPYPATH": PACKAGE},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )

    cache = os.path.join(os.path.dirname(PACKAGE), "mypy_cache")
    return {
        "strict": start("mypy", "--strict", "--config-file", "mypy.ini", "--cache-dir", cache, "program.py", "docs", *MODULES),
        "stubs": start("mypy.stubtest", "--mypy-config-file", "mypy.ini", "--allowlist", "allowed", "--ignore-unused-allowlist", "forage"),
    }


@pytest.mark.parametrize("check", ["strict", "stubs"])
def test_programs_the_docs_and_the_package_are_strict_and_stubs_agree_with_it(check, checks):
    said, _ = checks[check].communicate()
    assert checks[check].returncode == 0, said


def test_everything_has_a_docstring():
    missing = []
    for name in forage.__all__:
        thing = getattr(forage, name)
        members = [(f"{name}.{m}", v) for m, v in vars(thing).items() if not m.startswith("_")] if isinstance(thing, type) else []
        for path, member in [(name, thing), *members]:
            if type(member).__name__ != "member_descriptor" and not (getattr(member, "__doc__", None) or "").strip():
                missing.append(path)
    assert not missing
