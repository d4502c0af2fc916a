#!/usr/bin/env python3
"""Executes notebooks of the docs, and makes pages of the site of them: NAME.md, with its pictures in NAME_files, and NAME.ipynb with
its outputs.

usage: notebook_pages.py FOLDER NOTEBOOK...

FOLDER is replaced. The notebooks run in a folder of their own, so they leave nothing in the project.
"""
import pathlib
import shutil
import sys
import tempfile

import nbformat
from nbconvert import MarkdownExporter
from nbconvert.preprocessors import ExecutePreprocessor

PROJECT = pathlib.Path(__file__).resolve().parent.parent


def executed(file, folder):
    """The notebook with its outputs; `folder` takes what it writes."""
    (folder / "systems").symlink_to(PROJECT / "systems")
    here = folder / "docs/notebooks"
    here.mkdir(parents=True)
    notebook = nbformat.reads(file.read_text(), as_version=4)
    ExecutePreprocessor(timeout=600, kernel_name="python3").preprocess(notebook, {"metadata": {"path": str(here)}})
    return notebook


def write_page(notebook, name, folder):
    page, resources = MarkdownExporter().from_notebook_node(notebook, {"unique_key": name, "output_files_dir": f"{name}_files"})
    (folder / f"{name}.md").write_text(page)
    (folder / f"{name}.ipynb").write_text(nbformat.writes(notebook))
    for picture, content in resources["outputs"].items():
        (folder / picture).parent.mkdir(exist_ok=True)
        (folder / picture).write_bytes(content)


def main(folder, *files):
    out = pathlib.Path(folder)
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    for file in map(pathlib.Path, files):
        with tempfile.TemporaryDirectory() as place:
            write_page(executed(file, pathlib.Path(place)), file.stem, out)


if __name__ == "__main__":
    main(*sys.argv[1:])
