#!/bin/sh
# What a new user does with the installed packages, in an empty folder.
set -e
cp -r /usr/share/forage/systems .
forage run systems/reactive_foraging.iqr --world systems/worlds/basic_arena.world --trials 30 -o forage-out | tee said
grep -q "30 of 30" said
test -s forage-out/trajectory.png
forage tutorial 1.1
OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n 2 forage-mpi systems/light_threshold.xml -o mpi
forage experiment systems/light_threshold.xml -o whole
cmp mpi/results.csv whole/results.csv
forage new neuron leaky
python3 -c 'import forage
with forage.open("systems/dac_foraging.iqr", world="systems/worlds/basic_arena.world") as run:
    run.run(trials=1)
    run.plot("trajectory").save("path.png")'
test -s path.png
cd leaky
forage build-plugin leaky.cpp
python3 -c 'import forage
plugin = forage.build_plugin(open("leaky.cpp").read())
assert len(plugin.types) == 1, plugin.types'
forage run example.iqr --cycles 20 --record Example/Cells
rm -rf plugins
cmake -B build
cmake --build build
ctest --test-dir build --output-on-failure
