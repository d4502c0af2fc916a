"""The studio says of each action how to do it in Python: it gives the same run."""
import difflib
import os
import re
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


def repeat(forms, system, command, file, copy):
    """Does what a page has done once more, in Python and in the shell."""
    class Ignored(dict):
        params = {}

    for python, shell in forms:
        exec(python, {"system": system, "run": Ignored()})
        for line in shell.splitlines():
            words = shlex.split(line)
            if words[0] == "forage":
                assert words[1] == "edit"
                command("edit", *(word.replace(str(file), str(copy)) for word in words[2:]))


def test_changes_of_the_text_and_undo_are_repeated_in_python_and_the_shell(tmp_path, command):
    file, copy = tmp_path / "edited.iqr", tmp_path / "copy.iqr"
    file.write_bytes((SYSTEMS / "cookbook/oscillator.iqr").read_bytes())
    copy.write_bytes(file.read_bytes())
    part = tmp_path / "part.iqrProcess"
    system = forage.System.read(file)
    group, process = system.groups[0], system.processes[0]
    process.save(part)
    with Studio(os.environ["FORAGE"], str(file)) as studio:
        page = Page(studio)
        page.do("pause")
        actions = page.messages
        page.do("item_text", item=group.id, text=page.do("item", item=group.id)["text"].replace(group.name, "Écho '1'"))
        text = page.do("document")["text"]
        page.do("text_edit", text=text.replace("oscillator", "swing", 1))
        page.do("text_edit", text=text.replace("<!-- Fires", "<!-- It fires"))
        page.do("text_edit", text=text[:-9])  # is not XML, so nothing does the same
        page.do("text_edit", text=text)
        page.do("undo")
        page.do("undo")
        page.do("edit", operations=[{"do": "remove", "ids": [group.id]}])
        page.do("undo")
        page.do("redo")
        page.do("undo")
        page.do("import", file=str(part))
        page.do("edit", operations=[{"do": "rename", "id": process.id, "name": "Last"}])
        text = page.do("document")["text"]
        forms = [(m["python"], m["shell"]) for m in actions if m["type"] == "action"]
        page.close()
    assert [python == "" for python, _ in forms].count(True) == 2, forms  # the text that is not XML, and undo back to it
    repeat(forms, system, command, file, copy)
    assert copy.read_text() == text
    # With all that the original requires, as a file may leave that out.
    system.save(tmp_path / "python.iqr", original=True)
    forage.System.parse(text, path=file).save(tmp_path / "studio.iqr", original=True)
    assert (tmp_path / "python.iqr").read_text().splitlines() == (tmp_path / "studio.iqr").read_text().splitlines()


class Editing:
    """A page that edits a copy of a system, and the file and the System that do what its log says."""

    def __init__(self, folder, command, source, *options):
        self.file, self.copy, self.command = folder / "edited.iqr", folder / "copy.iqr", command
        self.file.write_bytes(source.read_bytes())
        self.copy.write_bytes(source.read_bytes())
        self.system = forage.System.read(self.file)
        self.options = [str(o) for o in options]

    def __enter__(self):
        self.studio = Studio(os.environ["FORAGE"], str(self.file), *self.options).__enter__()
        self.page = Page(self.studio)
        self.page.do("pause")
        self.seen = len(self.page.messages)
        return self

    def __exit__(self, *exception):
        self.page.close()
        return self.studio.__exit__(*exception)

    def edit(self, **operation):
        return self.page.do("edit", operations=[operation])

    def forms(self):
        """Those of the actions since the last call."""
        self.page.do("digest")
        new, self.seen = self.page.messages[self.seen:], len(self.page.messages)
        return [(m["python"], m["shell"]) for m in new if m["type"] == "action"]

    def follow(self):
        """Repeats what the log says, which is what the page has now; returns the forms."""
        forms, text = self.forms(), self.page.do("document")["text"]
        repeat(forms, self.system, self.command, self.file, self.copy)
        assert self.copy.read_text() == text
        assert self.system == forage.System.parse(text, path=self.file)
        return forms


def test_undo_in_a_large_system_is_repeated_in_python_and_the_shell(tmp_path, command):
    """Of what is at the element of the system, around which is all of its text."""
    with Editing(tmp_path, command, SYSTEMS / "dac_foraging.iqr", "--world", WORLD) as e:
        removed = e.system.connections[3].id
        for operation in (
            {"do": "system", "author": "Ada", "note": "é"},
            {"do": "remove", "ids": [removed]},
            {"do": "remove", "ids": [p.id for p in e.system.processes]},
        ):
            e.edit(**operation)
            e.follow()
            e.page.do("undo")
            e.page.do("redo")
            e.page.do("undo")
            forms = e.follow()
            assert all(python and shell for python, shell in forms), forms
        e.edit(do="rename", id=removed, name="Last")
        assert len(e.follow()) == 1


def test_what_is_too_long_for_a_form_is_part_of_the_next_one(tmp_path, command):
    with Editing(tmp_path, command, SYSTEMS / "dac_foraging.iqr", "--world", WORLD) as e:
        connection = e.system.connections[3].id
        e.page.do("set", assignments=["Bug/Light.threshold=0.25"])
        e.edit(do="system", note="x" * 150_000)
        e.edit(do="rename", id=connection, name="Other")
        forms = e.forms()
        assert forms[1:] == [("", "")] * 2 and forms[0][1] == "--set 'Bug/Light.threshold=0.25'"
        e.edit(do="system", note="short")
        (python, shell), = e.forms()
        assert "Other" in python and "Other" in shell and "0.25" in shell
        repeat([(python, shell)], e.system, command, e.file, e.copy)
        e.follow()


def test_forms_go_on_from_a_file_that_is_saved_without_one(tmp_path, command):
    other = tmp_path / "other.iqr"
    with Editing(tmp_path, command, SYSTEMS / "dac_foraging.iqr", "--world", WORLD) as e:
        e.edit(do="system", note="x" * 150_000)
        e.page.do("save", file=str(other))
        assert e.forms() == [("", ""), (f'system = forage.System.read("{other}")', "")]
        written = other.read_text()
        e.edit(do="rename", id=e.system.connections[3].id, name="Other")
        e.page.do("restart", seed=3)
        (python, shell), (python_begin, shell_begin) = e.forms()
        command(*shlex.split(shell)[1:])
        assert other.read_text() == e.page.do("document")["text"] != written
        assert shell_begin == "--seed 3"
        names = {"forage": forage, "system": forage.System.parse(written, path=other)}
        exec(python, names)
        exec(python_begin, names)
        with names["run"] as run:
            run.run(cycles=20)
            e.page.do("step", cycles=20)
            assert run.digest() == e.page.do("digest")["digest"]


def test_a_text_that_is_not_xml_is_saved_under_another_name(tmp_path, command):
    other = tmp_path / "other.iqr"
    with Editing(tmp_path, command, SYSTEMS / "cookbook/oscillator.iqr") as e:
        text = e.page.do("document")["text"]
        e.page.do("text_edit", text=text[:-12])
        e.page.do("save", file=str(other))
        e.page.do("text_edit", text=text)
        assert e.forms() == [("", "")] * 3
        e.page.do("save")
        e.edit(do="system", author="Ada")
        (python, shell), (_, edit) = e.forms()
        assert (python, shell) == (f'system = forage.System.read("{other}")', "")
        command(*shlex.split(edit)[1:])
        assert other.read_text() == e.page.do("document")["text"]


def test_undo_after_a_copy_elsewhere_leads_to_the_same_files(tmp_path, command):
    (tmp_path / "sub").mkdir()
    with Editing(tmp_path, command, SYSTEMS / "cookbook/oscillator.iqr") as e:
        e.system.processes[0].save(tmp_path / "link.iqrProcess")
        e.edit(do="remove", ids=[e.system.processes[0].id])
        e.page.do("import", file=str(tmp_path / "link.iqrProcess"), link=True)
        e.edit(do="system", author="Ada")
        e.page.do("save", file=str(tmp_path / "sub/n.iqr"))
        assert 'path="../link.iqrProcess"' in e.page.do("document")["text"]
        e.page.do("undo")
        found = e.page.do("document")
        assert found["readable"] and found["running_is_current"]
        assert 'path="../link.iqrProcess"' in found["text"] and "Ada" not in found["text"]
        e.page.do("redo")
        assert "Ada" in e.page.do("document")["text"]


def test_a_parameter_and_a_comment_in_one_edit_are_repeated(tmp_path, command):
    with Editing(tmp_path, command, SYSTEMS / "cookbook/oscillator.iqr") as e:
        text = e.page.do("document")["text"]
        e.page.do("text_edit", text=text.replace("<System", "<!-- mine -->\n<System", 1).replace('"0.5"', '"0.25"', 1))
        e.follow()
        assert "mine" in e.system.to_xml()


def test_a_correction_with_a_parameter_is_repeated(tmp_path, command):
    with Editing(tmp_path, command, SYSTEMS / "cookbook/oscillator.iqr") as e:
        text = e.page.do("document")["text"]
        type_name = re.search(r'<Neuron name="(\w+)"', text)[1]
        parameter = next(p for p in e.page.do("parameters", item=e.system.groups[0].id)["parameters"] if p["kind"] == "real")
        e.page.do("text_edit", text=text.replace(type_name, "neuronNone", 1))
        assert not e.page.do("document")["running_is_current"]
        e.follow()
        e.page.do("set", assignments=[parameter["assignment"] + "=0.25"])  # while another system runs
        e.page.do("undo")
        e.page.do("undo")
        forms = e.follow()
        assert ["system." in python for python, _ in forms] == [False, False, True], forms
        e.page.do("text_edit", text=text.replace(type_name, "neuronNone", 1))
        group = e.system.groups[0].id
        e.page.do("edit", operations=[{"do": "type", "id": group, "part": "neuron", "type": type_name}, {"do": "parameter", "id": group, "name": parameter["name"], "value": 0.5}])
        e.follow()


def test_a_system_with_mistakes_has_forms_after_it_is_saved(tmp_path, command):
    source = tmp_path / "wrong.iqr"
    good = (SYSTEMS / "cookbook/oscillator.iqr").read_text()
    source.write_text(good.replace("</System>", ""))
    with Studio(os.environ["FORAGE"], str(source)) as studio:
        page = Page(studio)
        page.do("text_edit", text=good)
        page.do("edit", operations=[{"do": "system", "author": "Ada"}])
        page.do("save")
        forms = [(m["python"], m["shell"]) for m in page.messages if m["type"] == "action"]
        assert forms == [("", "")] * 2 + [(f'system = forage.System.read("{source}")', "")]
        page.do("edit", operations=[{"do": "system", "author": "Bob"}])
        action = page.last("action")
        page.close()
    copy = tmp_path / "copy.iqr"
    copy.write_bytes(source.read_bytes())
    command("edit", *(word.replace(str(source), str(copy)) for word in shlex.split(action["shell"])[2:]))
    system = forage.System.read(source)
    exec(action["python"], {"system": system})
    assert system == forage.System.read(copy) and system.author == "Bob"


def test_a_parameter_gets_into_the_file_with_the_next_edit_or_when_it_is_saved(tmp_path, command):
    file, copy, third = tmp_path / "edited.iqr", tmp_path / "copy.iqr", tmp_path / "third.iqr"
    file.write_bytes((SYSTEMS / "dac_foraging.iqr").read_bytes())
    copy.write_bytes(file.read_bytes())
    system = forage.System.read(file)
    group = system["Bug/Light"]
    with Studio(os.environ["FORAGE"], str(file), "--world", str(WORLD)) as studio:
        page = Page(studio)
        page.do("pause")
        page.do("edit", operations=[{"do": "rename", "id": group.id, "name": "Eyes"}])
        page.do("set", assignments=["Bug/Eyes.threshold=0.25", "Bug.enableModule=false"])
        page.do("edit", operations=[{"do": "place", "id": group.id, "x": 5, "y": 6}])
        page.do("set", assignments=["Bug/Motor.excGain=0.5"])
        page.do("undo")
        page.do("undo")  # the place
        page.do("set", assignments=["Bug/Motor.excGain=0.75"])
        page.do("save")
        saved = file.read_text()
        page.do("set", assignments=["Bug/Motor.excGain=0.8"])
        page.do("save", file=str(third))
        page.do("edit", operations=[{"do": "rename", "id": group.id, "name": "Light"}])
        text = page.do("document")["text"]
        actions = [m for m in page.messages if m["type"] == "action"]
        page.close()
    assert [a["title"] for a in actions if a["command"] == "save"] == ["save edited.iqr", "save as third.iqr"]
    assert "place" in actions[2]["shell"] and "threshold" in actions[2]["shell"], actions[2]
    written = third.read_text()
    third.unlink()
    forms = [(a["python"], a["shell"]) for a in actions if "system." in a["python"]]
    assert len(forms) == 6, [(a["title"], a["python"]) for a in actions]
    save = next(i for i, (python, _) in enumerate(forms) if "system.save" in python)
    repeat(forms[: save + 1], system, command, file, copy)
    assert copy.read_text() == saved
    assert forage.System.read(file) == forage.System.parse(saved, path=file)  # Python has saved it there
    for python, shell in forms[save + 1 : -1]:
        command(*(word.replace(str(file), str(copy)) for word in shlex.split(shell)[1:]))
        assert third.read_text() == written
        exec(python, {"system": system})
    exec(forms[-1][0], {"system": system})
    assert system == forage.System.parse(text, path=third)


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
        page.do("undo")
        page.do("redo")
        page.do("undo")
        actions = [m for m in page.messages if m["type"] == "action"]
        page.do("world_save")
        page.do("world_save", file=str(tmp_path / "third.world"))
        save = page.last("action")
        page.close()
    assert len(actions) == 7
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
        ({"do": "replace", "parts": [{"old": "</System>", "new": ""}]}, file, "a.iqr"),
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
