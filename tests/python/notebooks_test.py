"""The notebooks run to their end, hold no outputs in the project, and show pictures."""
import json
import re

import pytest

from conftest import PROJECT

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
def test_a_notebook_runs_to_its_end(file, tmp_path, monkeypatch):
    """So it does for the site of the docs, whose pages show its pictures."""
    pytest.importorskip("ipykernel", reason="needs python3-ipykernel")
    pytest.importorskip("nbconvert", reason="needs python3-nbconvert")
    monkeypatch.syspath_prepend(PROJECT / "tools")
    import notebook_pages

    notebook = notebook_pages.executed(file, tmp_path)
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    assert not [output.text for output in outputs if output.output_type == "stream" and output.name == "stderr"]
    data = [output.get("data", {}) for output in outputs]
    pictures = [shown for shown in data if any(kind.startswith("image/") for kind in shown) or "<img" in shown.get("text/html", "")]
    assert len(pictures) >= 2
    notebook_pages.write_page(notebook, file.stem, tmp_path)
    page = (tmp_path / f"{file.stem}.md").read_text()
    drawn = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", page)
    assert len(drawn) + page.count("<img") >= 2 and all((tmp_path / picture).stat().st_size > 1000 for picture in drawn)
