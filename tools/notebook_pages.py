#!/usr/bin/env python3
"""Executes notebooks of the docs, and makes pages of the site of them: NAME.md, with its pictures in NAME_files, and NAME.ipynb with
its outputs.

usage: notebook_pages.py FOLDER NOTEBOOK...

FOLDER is replaced. The notebooks run one after the other in a folder of their own, so they find the files of those before, and leave nothing in the project.
A cell with the tag "answer" is folded on its page, with its outputs.
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
    """The notebook with its outputs, run in the folder."""
    notebook = nbformat.reads(file.read_text(), as_version=4)
    ExecutePreprocessor(timeout=600, kernel_name="python3").preprocess(notebook, {"metadata": {"path": str(folder)}})
    return notebook


def with_folded_answers(notebook):
    """A notebook in which the answers of exercises are between the tags of HTML that fold them."""
    folded = nbformat.from_dict({**notebook, "cells": []})
    for cell in notebook["cells"]:
        fold = ["<details><summary>Answer</summary>", "</details>"] if "answer" in cell["metadata"].get("tags", []) else []
        folded["cells"] += [cell if text is None else nbformat.v4.new_markdown_cell(text) for text in (fold[:1] + [None] + fold[1:])]
    return folded


def write_page(notebook, name, folder):
    page, resources = MarkdownExporter().from_notebook_node(with_folded_answers(notebook), {"unique_key": name, "output_files_dir": f"{name}_files"})
    (folder / f"{name}.md").write_text(page)
    (folder / f"{name}.ipynb").write_text(nbformat.writes(notebook))
    for picture, content in resources["outputs"].items():
        (folder / picture).parent.mkdir(exist_ok=True)
        (folder / picture).write_bytes(content)


def main(folder, *files):
    out = pathlib.Path(folder)
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    with tempfile.TemporaryDirectory() as place:
        (pathlib.Path(place) / "systems").symlink_to(PROJECT / "systems")
        here = pathlib.Path(place) / "docs/notebooks"
        here.mkdir(parents=True)
        for file in map(pathlib.Path, files):
            write_page(executed(file, here), file.stem, out)


if __name__ == "__main__":
    main(*sys.argv[1:])
