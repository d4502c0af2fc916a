"""The notebooks run to their end, hold no outputs in the project, and show pictures."""
import json

import pytest

from conftest import PROJECT, SYSTEMS

NOTEBOOKS = sorted((PROJECT / "docs/notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_a_notebook_is_kept_without_outputs(file):
    """So a change can be read: the bytes are those of json.dump, and ids are numbers in order."""
    text = file.read_text()
    cells = json.loads(text)["cells"]
    assert text == json.dumps(json.loads(text), indent=1, ensure_ascii=False) + "\n"
    assert [cell["id"] for cell in cells] == [f"cell-{number}" for number in range(1, len(cells) + 1)]
    assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in cells if cell["cell_type"] == "code")


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_a_notebook_runs_to_its_end(file, tmp_path):
    pytest.importorskip("ipykernel", reason="needs python3-ipykernel")
    preprocessors = pytest.importorskip("nbconvert.preprocessors", reason="needs python3-nbconvert")
    nbformat = pytest.importorskip("nbformat")
    (tmp_path / "systems").symlink_to(SYSTEMS)
    folder = tmp_path / "docs/notebooks"
    folder.mkdir(parents=True)
    notebook = nbformat.reads(file.read_text(), as_version=4)
    preprocessors.ExecutePreprocessor(timeout=120, kernel_name="python3").preprocess(notebook, {"metadata": {"path": str(folder)}})
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    assert not [output.text for output in outputs if output.output_type == "stream" and output.name == "stderr"]
    data = [output.get("data", {}) for output in outputs]
    pictures = [shown for shown in data if any(kind.startswith("image/") for kind in shown) or "<img" in shown.get("text/html", "")]
    assert len(pictures) >= 2
