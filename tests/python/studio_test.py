"""The studio says of each action how to do it in Python: it gives the same run."""
import os
import sys

import pytest

import forage
from conftest import PROJECT, SYSTEMS, WORLD, open_dac

sys.path.insert(0, str(PROJECT / "tests/support"))
from studio_client import Page, Studio  # noqa: E402


def test_what_a_page_does_is_repeated_in_python(dac):
    with Studio(os.environ["FORAGE"], str(SYSTEMS / "dac_foraging.iqr"), "--world", str(WORLD)) as studio:
        page = Page(studio)
        page.do("pause")
        robot = page.last("world")["robots"][0]["name"]
        motor = [0.0] * 81
        motor[36] = 1.0
        for command, members in (
            ("set", {"assignments": ["Bug/Light.threshold=0.25", "Bug/Motor.excGain=0.5"]}),
            ("manipulate", {"group": "Bug/Motor", "mode": "add", "patterns": [motor], "every": 2}),
            ("manipulate", {"group": "Bug/Light", "patterns": [[0.5] * 32]}),
            ("undo", {}),
            ("manipulate", {"group": "Bug/Light", "patterns": [[0.5] * 32, [0.1] * 32, [0.3] * 32], "step": 2, "backwards": True, "times": 3}),
            ("move", {"robot": robot, "x": 0.5, "y": -0.5}),
            ("begin_trial", {}),
            ("revoke", {"group": "Bug/Motor"}),
            ("begin_trial", {"start": 0}),
        ):
            page.do("step", cycles=30)
            page.do(command, **members)
        page.do("step", cycles=30)
        page.do("pause")
        wanted = page.do("digest")
        actions = [m for m in page.messages if m["type"] == "action"]
        page.close()
    assert len(actions) == 9
    names = {"run": dac}
    for action in actions:
        dac.run(cycles=action["cycle"] - dac.cycle) if action["cycle"] > dac.cycle else None
        exec(action["python"], names)
    dac.run(cycles=wanted["cycle"] - dac.cycle)
    assert dac.digest() == wanted["digest"]


def test_a_restart_with_another_seed_is_repeated_in_python():
    with Studio(os.environ["FORAGE"], str(SYSTEMS / "dac_foraging.iqr"), "--world", str(WORLD)) as studio:
        page = Page(studio)
        page.do("restart", seed=7)
        page.do("step", cycles=20)
        wanted = page.do("digest")["digest"]
        python = page.last("action")["python"]
        page.close()
    names = {"forage": forage}
    exec(python, names)
    with names["run"] as run:
        run.run(cycles=20)
        assert run.digest() == wanted


def test_an_edit_is_repeated_in_python(tmp_path):
    file = tmp_path / "edited.iqr"
    file.write_bytes((SYSTEMS / "cookbook/oscillator.iqr").read_bytes())
    system = forage.System.read(file)
    process, group = system.processes[0], system.groups[0]
    connection = system.connections[0].id
    tuples = {"form": "tuples", "tuples": [{"source": [[1, 1]], "target": [[1, 1]]}]}
    with Studio(os.environ["FORAGE"], str(file)) as studio:
        page = Page(studio)
        page.do("pause")
        made = []
        for operations in (
            [{"do": "add_process", "name": "More \"cells\"", "x": 10, "y": 20}],
            [{"do": "add_group", "process": process.id, "name": "Ear", "width": 3, "height": 2, "x": 5, "y": 6}, {"do": "rename", "id": group.id, "name": "Nose"}],
            [{"do": "add_connection", "source": group.id, "target": "Ear", "kind": "inhibitory"}],
            [{"do": "type", "id": "Ear", "part": "neuron", "type": "neuronIntegrateFire"}, {"do": "parameter", "id": "Ear", "name": "threshold", "value": 0.25}],
            [{"do": "pattern", "id": connection, "pattern": tuples}, {"do": "delay", "id": connection, "delay": {"type": "FunUniform", "values": {"value": 2}}}],
            [{"do": "set", "id": process.id, "property": "enabled", "value": True}, {"do": "set", "id": "Ear", "property": "note", "value": "hears"}],
            [{"do": "place", "id": "Ear", "x": 70, "y": 80}],
            [{"do": "add_comment", "process": process.id, "text": "as it was", "x": 1, "y": 2}],
            [{"do": "system", "author": "Ada"}],
            [{"do": "remove", "ids": [connection]}],
        ):
            for o in operations:  # ids that an operation before has made
                for member in ("id", "target"):
                    o[member] = made[0] if o.get(member) == "Ear" else o.get(member)
                    if o[member] is None:
                        del o[member]
            ids = page.do("edit", operations=operations)["ids"]
            made += [i for o, i in zip(operations, ids) if o["do"] == "add_group"]
        text = page.do("document")["text"]
        actions = [m["python"] for m in page.messages if m["type"] == "action"]
        page.close()
    assert len(actions) == 10
    for python in actions:
        exec(python, {"system": system})
    assert system == forage.System.parse(text, path=file)
    assert system[f"{process.name}/Ear"].params["threshold"] == 0.25


def test_operations_are_carried_out_all_or_none():
    system = forage.System("some")
    assert system.edit({"do": "add_process", "name": "P", "id": "p"}) == ["p"]
    before = system.copy()
    for operations, message in (
        ([{"do": "add_group", "process": "p", "name": "G"}, {"do": "rename", "id": "none", "name": "x"}], "none"),
        ([{"do": "grow"}], "there is no operation 'grow'"),
        ([{"name": "P"}], "do"),
        ([{"do": "rename", "id": "p", "name": " "}], "cannot be empty"),
        ([float("nan")], "not a list"),
    ):
        with pytest.raises(forage.InputError, match=message):
            system.edit(operations)
        assert system == before
    with pytest.raises(TypeError):
        system.edit([{"do": object()}])


def test_robots_are_moved_and_begin_trials(dac):
    name = "Bug"
    with pytest.raises(forage.InputError, match="no robot and no movable object"):
        dac.move("nothing", 0, 0)
    with pytest.raises(forage.InputError, match="within 10 km"):
        dac.move(name, 1e6, 0)
    dac.move(name, 0.5, -0.5, heading=1.0)
    dac.run(cycles=5)
    dac.begin_trial()
    dac.step()
    assert dac.trial == 2
    with pytest.raises(forage.InputError, match="no start pose 99"):
        dac.begin_trial(start=99)
    with pytest.raises(forage.InputError, match="no robot .Bgu'"):
        dac.begin_trial(robot="Bgu")
    with forage.open(SYSTEMS / "cookbook/oscillator.iqr") as without, pytest.raises(forage.InputError, match="no world"):
        without.move(name, 0, 0)


def test_the_options_of_a_manipulation_are_those_of_the_page(command):
    with Studio(os.environ["FORAGE"], str(SYSTEMS / "dac_foraging.iqr"), "--world", str(WORLD)) as studio:
        page = Page(studio)
        page.do("step", cycles=50)
        page.do("manipulate", group="Bug/Motor", patterns=[[0.25] * 81])
        page.do("step", cycles=50)
        page.do("revoke", group="Bug/Motor")
        option = page.last("action")["shell"] if page.do("pause") == {} else None
        page.do("step", cycles=50)
        wanted = page.do("digest")["digest"]
        page.close()
    assert option == "--clamp 'Bug/Motor=0.25; from cycle 50; until cycle 100'"
    name, value = option.split(" ", 1)
    printed = command("run", SYSTEMS / "dac_foraging.iqr", "--world", WORLD, name, value.strip("'"), "--cycles", 150, "--hash", "-o", "")
    assert wanted in printed
    with open_dac() as run:
        run.run(cycles=150)
        assert run.digest() != wanted
