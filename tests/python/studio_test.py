"""The studio says of each action how to do it in Python: it gives the same run."""
import difflib
import os
import shlex
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
            [
                {"do": "add_group", "process": process.id, "name": "Ear", "width": 3, "height": 2, "x": 5, "y": 6},
                {"do": "rename", "id": group.id, "name": "Nose"},
            ],
            [{"do": "add_connection", "source": group.id, "target": "Ear", "kind": "inhibitory"}],
            [
                {"do": "type", "id": "Ear", "part": "neuron", "type": "neuronIntegrateFire"},
                {"do": "parameter", "id": "Ear", "name": "threshold", "value": 0.25},
            ],
            [
                {"do": "pattern", "id": connection, "pattern": tuples},
                {"do": "delay", "id": connection, "delay": {"type": "FunUniform", "values": {"value": 2}}},
            ],
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


def test_edits_are_repeated_in_the_shell_and_what_has_no_form_says_so(tmp_path, command):
    file, copy, third = tmp_path / "edited.iqr", tmp_path / "copy.iqr", tmp_path / "third.iqr"
    file.write_bytes((SYSTEMS / "cookbook/oscillator.iqr").read_bytes())
    copy.write_bytes(file.read_bytes())
    system = forage.System.read(file)
    group = system.groups[0]
    with Studio(os.environ["FORAGE"], str(file)) as studio:
        page = Page(studio)
        page.do("pause")
        page.do("edit", operations=[{"do": "rename", "id": group.id, "name": "Écho '1'"}])
        page.do("edit", operations=[{"do": "system", "author": "Ada"}])
        part = page.do("edit", operations=[{"do": "use_part", "file": str(SYSTEMS / "parts/half_centre.iqrProcess")}])["ids"][0]
        page.do("edit", operations=[{"do": "use_part", "file": str(SYSTEMS / "parts/gates.iqrProcess")}])
        page.do("edit", operations=[{"do": "dissolve", "id": part}])
        page.do("save")
        page.do("save", file=str(third))
        written = [(m["python"], m["shell"]) for m in page.messages if m["type"] == "action"]
        text = page.do("document")["text"]
        seen = len(page.messages)
        page.do("undo")
        page.do("item_text", item=group.id, text=page.do("item", item=group.id)["text"].replace("Écho", "Oh"))
        page.do("text_edit", text=text)
        page.do("edit", operations=[{"do": "system", "note": "x" * 150_000}])  # too long for the shell
        page.do("digest")
        assert [(m["python"], m["shell"]) for m in page.messages[seen:] if m["type"] == "action"] == [("", "")] * 4
        page.close()
    assert third.read_text() == text == file.read_text()
    for path in (file, third):
        path.unlink()
    for python, shell in written:
        exec(python, {"system": system})
        if shell:
            command(*(word.replace(str(file), str(copy)) for word in shlex.split(shell)[1:]))
    assert copy.read_text() == third.read_text() == text
    assert forage.System.read(file) == system


def test_undo_after_a_copy_elsewhere_leads_to_the_same_files(tmp_path):
    (tmp_path / "sub").mkdir()
    file = tmp_path / "edited.iqr"
    file.write_bytes((SYSTEMS / "cookbook/oscillator.iqr").read_bytes())
    process = forage.System.read(file).processes[0]
    process.save(tmp_path / "link.iqrProcess")
    with Studio(os.environ["FORAGE"], str(file)) as studio:
        page = Page(studio)
        page.do("edit", operations=[{"do": "remove", "ids": [process.id]}])
        page.do("import", file=str(tmp_path / "link.iqrProcess"), link=True)
        page.do("edit", operations=[{"do": "system", "author": "Ada"}])
        page.do("save", file=str(tmp_path / "sub/n.iqr"))
        assert 'path="../link.iqrProcess"' in page.do("document")["text"]
        page.do("undo")
        found = page.do("document")
        assert found["readable"] and found["running_is_current"]
        assert 'path="../link.iqrProcess"' in found["text"] and "Ada" not in found["text"]
        page.do("redo")
        assert "Ada" in page.do("document")["text"]
        page.close()


def test_edits_of_a_world_are_repeated_in_python_and_the_shell(tmp_path, command, monkeypatch):
    monkeypatch.setenv("FORAGE_MODEL_PATH", str(SYSTEMS / "worlds/models"))
    mine, other = tmp_path / "mine.world", tmp_path / "other"
    other.mkdir()
    mine.write_bytes((SYSTEMS / "worlds/basic_arena.world").read_bytes())
    (other / mine.name).write_bytes(mine.read_bytes())
    with Studio(os.environ["FORAGE"], str(SYSTEMS / "dac_foraging.iqr"), "--world", str(mine)) as studio:
        page = Page(studio)
        page.do("pause")
        kinds = {i["kind"]: i["id"] for i in page.do("world_document")["items"]}
        for members in (
            {"operations": [{"do": "add", "kind": "pillar", "x": 0.5, "y": 0.25}, {"do": "add", "kind": "wall", "x": 1, "y": 1, "width": 0.5}]},
            {"operations": [{"do": "move", "id": kinds["light"], "x": -1, "y": 0.5}], "run": True},
            {"operations": [{"do": "set", "id": kinds["start"], "property": "name", "value": "Reset_7"}]},
            {"operations": [{"do": "remove", "id": "Reset_7"}]},
        ):
            page.do("world_edit", **members)
        actions = [m for m in page.messages if m["type"] == "action"]
        page.do("world_save")
        page.do("world_save", file=str(tmp_path / "third.world"))
        save = page.last("action")
        page.close()
    assert len(actions) == 4
    assert all(len(a["shell"]) < 2000 for a in actions)
    wanted = mine.read_bytes()
    mine.write_bytes((other / mine.name).read_bytes())
    for action in actions:
        exec(action["python"], {"forage": forage})
    assert mine.read_bytes() == wanted
    for action in actions:
        words = shlex.split(action["shell"])
        command(*words[1:2], words[2].replace(str(tmp_path), str(other)), *words[3:])
    assert (other / mine.name).read_bytes() == wanted
    third = tmp_path / "third.world"
    assert third.read_bytes() == wanted
    third.unlink()
    command(*shlex.split(save["shell"].splitlines()[0])[1:])
    assert save["shell"].splitlines()[1] == f"--world '{third}'"
    assert third.read_bytes() == wanted
    third.unlink()
    names = {"forage": forage}
    exec(save["python"], names)
    names["run"].close()
    assert third.read_bytes() == wanted


def test_a_file_is_edited_and_keeps_what_is_not_touched(tmp_path):
    file, copy = tmp_path / "a.iqr", tmp_path / "b.iqr"
    text = (SYSTEMS / "cookbook/oscillator.iqr").read_text().replace("<System", "<!-- mine -->\n<System", 1)
    file.write_text(text)
    group = forage.System.read(file).groups[0]
    place = {"do": "place", "id": group.id, "x": 123, "y": 45}
    assert forage.edit_file(file, place, save_as=copy) == [None]
    assert file.read_text() == text
    changed = [line for line in difflib.ndiff(text.splitlines(), copy.read_text().splitlines()) if line[0] != " "]
    assert len(changed) == 1 and changed[0][0] == "+" and 'x="123"' in changed[0], changed
    for operations, name, message in (
        ([place, {"do": "grow"}], file, "there is no operation 'grow'"),
        (place, tmp_path / "c.txt", "neither a system nor a world"),
        (place, tmp_path / "none.iqr", "none.iqr"),
    ):
        with pytest.raises(forage.InputError, match=message):
            forage.edit_file(name, operations)
    with pytest.raises(forage.InputError, match="does not end with .iqr"):
        forage.edit_file(file, place, save_as=tmp_path / "b.world")
    assert file.read_text() == text


def test_operations_are_carried_out_all_or_none():
    system = forage.System("some")
    assert system.edit({"do": "add_process", "name": "P", "id": "p"}) == ["p"]
    before = system.copy()
    for operations, message in (
        ([{"do": "add_group", "process": "p", "name": "G"}, {"do": "rename", "id": "none", "name": "x"}], "none"),
        ([{"do": "grow"}], "there is no operation 'grow'"),
        ([{"name": "P"}], "do"),
        ([{"do": "rename", "id": "p", "name": " "}], "cannot be empty"),
        ([float("nan")], "not JSON"),
        ([[1]], "an operation is an object"),
    ):
        with pytest.raises(forage.InputError, match=message):
            system.edit(operations)
        assert system == before
    with pytest.raises(TypeError):
        system.edit([{"do": object()}])


def test_a_process_becomes_a_part_in_python(tmp_path):
    system = forage.System.read(SYSTEMS / "parts/tour.iqr")
    groups = [g.id for g in system.groups]
    assert system.edit([{"do": "dissolve", "id": "race"}, {"do": "make_part", "id": "race", "file": str(tmp_path / "race.iqrProcess")}]) == [None, None]
    assert [g.id for g in system.groups] == groups
    with pytest.raises(forage.InputError, match="gives the group 'done'"):
        system.edit({"do": "make_part", "id": "in", "file": str(tmp_path / "in.iqrProcess")})
    system.edit({"do": "remove", "ids": ["memory"]})
    with pytest.warns(forage.InputWarning, match="runs draw other random numbers"):
        assert "in.drive" in system.edit({"do": "make_part", "id": "in", "file": str(tmp_path / "in.iqrProcess")})[0]
    with pytest.raises(forage.InputError, match="exists"):
        system.edit([{"do": "dissolve", "id": "in"}, {"do": "make_part", "id": "in", "file": str(tmp_path / "in.iqrProcess")}])


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


def options_of(actions):
    return [word for action in actions for word in shlex.split(action["shell"])]


def test_parameters_moves_and_trials_are_options_of_a_run(command):
    with Studio(os.environ["FORAGE"], str(SYSTEMS / "dac_foraging.iqr"), "--world", str(WORLD)) as studio:
        page = Page(studio)
        page.do("pause")
        robot = page.last("world")["robots"][0]["name"]
        page.do("move", robot=robot, x=0.25, y=-1.5, heading=1)
        page.do("set", assignments=["Bug/Motor.excGain=0.5"])
        for name, members in (
            ("move", {"robot": robot, "x": 0.5, "y": -0.5}),
            ("set", {"assignments": ["Bug/Light.threshold=0.25", "Bug/Motor.excGain=0.75"]}),
            ("begin_trial", {}),
            ("begin_trial", {"start": 0}),
            ("move", {"robot": robot, "x": -1e-7, "y": 0.1, "heading": -2.5}),
            ("undo", {}),
        ):
            page.do("step", cycles=40)
            page.do(name, **members)
        page.do("step", cycles=40)
        page.do("pause")
        wanted = page.do("digest")["digest"]
        actions = [m for m in page.messages if m["type"] == "action"]
        page.close()
    assert len(actions) == 8
    printed = command("run", SYSTEMS / "dac_foraging.iqr", "--world", WORLD, *options_of(actions), "--cycles", 280, "--hash", "-o", "")
    assert wanted in printed
    assert wanted not in command("run", SYSTEMS / "dac_foraging.iqr", "--world", WORLD, "--cycles", 280, "--hash", "-o", "")


def test_a_recording_is_options_of_a_run_and_probes(tmp_path, command, dac):
    file = tmp_path / "page" / "light.csv"
    file.parent.mkdir()
    with Studio(os.environ["FORAGE"], str(SYSTEMS / "dac_foraging.iqr"), "--world", str(WORLD)) as studio:
        page = Page(studio)
        page.do("step", cycles=23)
        page.do("sample", file=str(file), sources=["Bug/Light"], every=5)
        page.do("step", cycles=100)
        page.do("sample_stop")
        page.do("step", cycles=20)
        page.do("sample", file=str(tmp_path / "page/motor.npy"), sources=["mean(Bug/Motor)"], cycles=10)
        page.do("step", cycles=20)
        page.do("sample", file=str(tmp_path / "page/none.csv"), sources=["Bug/Light"])
        page.do("sample_stop")
        begin, end, bounded, its_end, none, end_of_none = [m for m in page.messages if m["type"] == "action"]
        page.close()
    assert [a["command"] for a in (begin, end, bounded, its_end)] == ["sample", "sample_stop"] * 2
    assert its_end["cycle"] == 153 and its_end["shell"] == bounded["shell"]
    assert none["shell"] and not end_of_none["shell"]  # not a row
    for action, name in ((end, "light.csv"), (bounded, "motor.npy")):
        options = [word.replace(str(file.parent), str(tmp_path / "run")) for word in options_of([action])]
        command("run", SYSTEMS / "dac_foraging.iqr", "--world", WORLD, "--cycles", 163, *options)
        assert (tmp_path / "run" / name).read_bytes() == (file.parent / name).read_bytes()
    assert "--record-until" not in begin["shell"]
    names = {"run": dac}
    dac.run(cycles=23)
    exec(begin["python"], names)
    dac.run(cycles=100)
    exec(end["python"], names)
    rows = [line.split(",") for line in file.read_text().splitlines()[1:]]
    (recorded,) = names["recorded"]
    assert recorded.cycles.tolist() == [int(row[0]) for row in rows]
    assert recorded.data.reshape(len(rows), -1).tolist() == [[float(value) for value in row[1:]] for row in rows]
    assert dac.probes == []


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
