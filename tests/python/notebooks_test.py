"""The notebooks run to their end, hold no outputs in the project, and show pictures."""
import json
import os
import pathlib
import re

import pytest

from conftest import PROJECT

NOTEBOOKS = sorted((PROJECT / "docs/notebooks").glob("*.ipynb"))
PAGES = pathlib.Path(os.environ["PYTHONPATH"]).parent / "notebooks"  # of the build


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_a_notebook_is_kept_without_outputs(file):
    """So a change can be read: the bytes are those of json.dump, and ids are numbers in order."""
    text = file.read_text()
    cells = json.loads(text)["cells"]
    assert text == json.dumps(json.loads(text), indent=1, ensure_ascii=False) + "\n"
    assert [cell["id"] for cell in cells] == [f"cell-{number}" for number in range(1, len(cells) + 1)]
    assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in cells if cell["cell_type"] == "code")


@pytest.mark.skipif(not PAGES.exists(), reason="needs python3-ipykernel, -nbconvert, -pandas, -xarray, -matplotlib and -h5py")
@pytest.mark.parametrize("name", [file.stem for file in NOTEBOOKS])
def test_a_notebook_ran_to_its_end_for_the_site_of_the_docs_and_drew_pictures(name):
    cells = json.loads((PAGES / f"{name}.ipynb").read_text())["cells"]
    outputs = [output for cell in cells if cell["cell_type"] == "code" for output in cell["outputs"]]
    assert not [output["text"] for output in outputs if output["output_type"] == "stream" and output["name"] == "stderr"]
    data = [output.get("data", {}) for output in outputs]
    pictures = [shown for shown in data if any(kind.startswith("image/") for kind in shown) or re.search("<(img|video)", "".join(shown.get("text/html", "")))]
    assert len(pictures) >= 2
    page = (PAGES / f"{name}.md").read_text()
    drawn = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", page)
    assert len(drawn) + len(re.findall("<(?:img|video)", page)) >= 2 and all((PAGES / picture).stat().st_size > 1000 for picture in drawn)
    answers = sum("answer" in cell["metadata"].get("tags", []) for cell in cells)
    assert answers == page.count("<details><summary>Answer</summary>") >= 1
