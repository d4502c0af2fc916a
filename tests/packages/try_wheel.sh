#!/bin/sh
# What a new user does with the wheel, in an empty folder of a system with python3-venv and python3-numpy. All libraries are resolved at once, so none may be missing.
set -e
export LD_BIND_NOW=1
python3 -m venv --system-site-packages env
env/bin/pip install -q --no-index ./forage-*.whl
env/bin/python -m forage.demo | tee said
grep -q "reached the light in 30 of" said
test -s forage-out/trajectory.png
env/bin/python - <<'EOF'
import pathlib
import forage, numpy
print("NumPy", numpy.__version__)
world = "own.world"  # in a folder without models
open(world, "w").write((forage.SYSTEMS / "worlds/basic_arena.world").read_text())
with forage.open(forage.SYSTEMS / "dac_foraging.iqr", world=world, seed=1) as run:
    probe = run.probe("Bug/Light", every=10)
    run.run(trials=2)
    assert probe.data.shape[1:] == (1, 32) and probe.data.max() > 0, probe.data
    assert "glyph" in run.plot("trajectory", format="svg").data.decode(), "no letters"
open("recorded.xml", "w").write(f"""<experiment><system file="{forage.SYSTEMS}/cookbook/oscillator.iqr"/><length cycles="20"/>
    <record column="{forage.open(forage.SYSTEMS / 'cookbook/oscillator.iqr').groups[0]}" format="h5"/></experiment>""")
forage.experiment("recorded.xml", directory="results")
assert list(pathlib.Path("results").rglob("*.h5")), "nothing is recorded as HDF5"
try:
    forage.build_plugin("")
    raise SystemExit("types in C++ need headers")
except forage.InputError as error:
    assert "headers of Forage" in str(error) or pathlib.Path("/usr/include/forage").exists(), error
EOF
