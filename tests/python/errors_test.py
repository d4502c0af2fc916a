"""Diagnostics as exceptions."""
import pickle

import pytest

import forage
from conftest import PROJECT, SMALL


def test_an_error_knows_its_place_and_its_hint(tmp_path):
    text = (SMALL).read_text()
    broken = tmp_path / "broken.iqr"
    broken.write_text(text.replace("neuronLinearThreshold", "neuronLinearThresholds"))
    with pytest.raises(forage.InputError) as caught:
        forage.open(broken)
    error = caught.value
    assert isinstance(error, ValueError)
    line = next(n for n, l in enumerate(broken.read_text().splitlines(), 1) if "neuronLinearThresholds" in l)
    assert (error.file, error.line) == (str(broken), line) and error.column > 0
    assert "did you mean 'neuronLinearThreshold'?" in error.hint
    assert str(error).startswith(f"{broken}:{line}:{error.column}: error: ")
    assert error.diagnostics[0].severity == "error" and str(error.diagnostics[0]) in str(error) + "\n"
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) and again.line == line


@pytest.mark.parametrize("path", sorted((PROJECT / "tests/diagnostics/bad_systems").glob("*.iqr"))[:40], ids=lambda p: p.stem)
@pytest.mark.filterwarnings("ignore::forage.InputWarning")
def test_every_broken_system_is_an_input_error(path):
    try:
        forage.open(path).close()
    except forage.InputError as error:
        assert error.diagnostics and any(d.severity == "error" for d in error.diagnostics)
        assert str(error)


def test_arguments_have_no_place():
    with pytest.raises(forage.InputError) as caught:
        forage.open(SMALL, settings={"Nowhere.x": 1})
    assert caught.value.file is None and caught.value.line is None


def test_a_missing_file_is_an_input_error():
    with pytest.raises(forage.InputError, match="there is no such file"):
        forage.open("nowhere.iqr")
    with pytest.raises(TypeError):
        forage.open(3)
