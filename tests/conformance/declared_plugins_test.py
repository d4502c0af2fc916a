"""Types that a system declares compute the same numbers, bit for bit, when they are written as plugins.

usage: declared_plugins_test.py FORAGE PROJECT
"""
import pathlib
import re
import subprocess
import sys
import tempfile

FORAGE, PROJECT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()

# Of each model: its types, what is given to it, and what is recorded.
MODELS = {
    "izhikevich": (["izhikevich"], "Net/Current(1,1)=14; every 7", ["Net/Cells:v", "Net/Cells:spike"]),
    "tsodyks_markram": (["membrane", "dynamic"], "Net/Pre(1,1)=1; every 7", ["Net/Depressed:V", "Facilitating:weight"]),
    "bcm": (["unit", "bcm"], "Net/In(1,1)=1; every 7", ["Net/Unit:theta", "In to Unit:weight"]),
}


def forage(*arguments, **options):
    subprocess.run([FORAGE, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL, **options)


def recorded(system, clamp, sources, out, *options):
    records = [word for i, source in enumerate(sources) for word in ("--record", f"{source}={i}.csv")]
    forage("run", system, "--cycles", 300, "--clamp", clamp, "-o", out, *records, *options)
    return [(out / f"{i}.csv").read_bytes() for i in range(len(sources))]


def check(model, types, clamp, sources, here):
    system = PROJECT / "systems/models" / f"{model}.iqr"
    plugins = []
    for name in types:
        forage("convert", system, here / f"{name}.cpp", "--as-plugin", name)
        forage("build-plugin", here / f"{name}.cpp", "-o", here / f"{name}.so")
        plugins += ["--plugin", here / f"{name}.so"]
    for table in system.parent.glob(f"{model}*.csv"):
        (here / table.name).write_bytes(table.read_bytes())
    without = here / f"{model}.iqr"
    without.write_text(re.sub(r"<(NeuronType|SynapseType).*?</\1>", "", system.read_text(), flags=re.DOTALL))
    assert recorded(system, clamp, sources, here / "types") == recorded(without, clamp, sources, here / "plugins", *plugins), model


with tempfile.TemporaryDirectory() as here:
    for model, (types, clamp, sources) in MODELS.items():
        folder = pathlib.Path(here, model)
        folder.mkdir()
        check(model, types, clamp, sources, folder)
