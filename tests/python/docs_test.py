"""The examples of the how-to are executed in order, and print what it says."""
import contextlib
import io
import re

import pytest

from conftest import PROJECT, SYSTEMS

BLOCK = re.compile(r"^```(python|text)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize(
    "page, needed",
    [
        ("adaptive", ["pandas", "scipy"]),
        ("python", []),
        ("python-learning", []),
        ("python-models", ["pandas", "scipy"]),
        ("python-types", []),
        ("from-other-tools", []),
    ],
)
def test_a_page_is_followed_to_its_end(page, needed, tmp_path, monkeypatch):
    for package in needed:
        pytest.importorskip(package)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "systems").symlink_to(SYSTEMS)
    text = (PROJECT / f"docs/how-to/{page}.md").read_text()
    blocks = BLOCK.findall(text)
    names, printed = {"__name__": "__main__"}, ""
    for language, content in blocks:
        if language == "text":
            assert printed == content
            printed = ""
        else:
            assert printed == "", "what is printed is not shown"
            with contextlib.redirect_stdout(io.StringIO()) as out:
                exec(compile(content, f"{page}.md", "exec"), names)
            printed = out.getvalue()
    assert printed == "" and len(blocks) > {"from-other-tools": 2, "adaptive": 3}.get(page, 5)  # that page has one model


def test_brian2_counts_the_same_spikes(tmp_path, monkeypatch):
    """The programs in the page for users of other tools compute the same model."""
    pytest.importorskip("brian2", reason="needs python3-brian")
    monkeypatch.chdir(tmp_path)
    text = (PROJECT / "docs/how-to/from-other-tools.md").read_text()
    brian = next(block for block in re.findall(r"^```py\n(.*?)^```$", text, re.MULTILINE | re.DOTALL) if "brian2" in block)
    names = {}
    exec(compile(brian, "brian2", "exec"), names)
    assert f"```text\n{[int(count) for count in names['counts']]}\n```" in text


def programs(page, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)


def run_program(text, names, here, monkeypatch):
    """What a program prints."""
    monkeypatch.chdir(here)
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(compile(text, "program", "exec"), names)
    return out.getvalue()


@pytest.mark.parametrize("model", [0, 1, 2])
def test_models_print_the_same_numbers_in_brian2(model, tmp_path, monkeypatch):
    page = (PROJECT / "docs/how-to/same-model-elsewhere.md").read_text()
    for name, text in re.findall(r"Save this as `([^`]+)`:\n\n```(?:xml|csv)\n(.*?)^```", page, re.MULTILINE | re.DOTALL):
        (tmp_path / name).write_text(text)
    expected = programs(page, "text")[model]
    assert run_program("import forage\n" + programs(page, "python")[model], {}, tmp_path, monkeypatch) == expected
    brian2 = pytest.importorskip("brian2", reason="needs python3-brian")
    brian2.start_scope()
    monkeypatch.setattr(brian2.prefs.codegen, "target", "numpy")
    assert run_program(programs(page, "py")[model], {}, tmp_path, monkeypatch) == expected
