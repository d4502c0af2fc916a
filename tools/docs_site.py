"""Makes README.md, CHANGELOG.md, CONTRIBUTING.md and the notebooks pages of the site (a hook of mkdocs), and links to other files of the project plain text.

FORAGE_NOTEBOOKS is the folder that notebook_pages.py has filled; without it, the pages of notebooks show no outputs. FORAGE_SITE_STUDIO is the
folder of the site that has the studio (tools/web): exercises, commands and links to systems lead there.
"""

import json
import os
import pathlib
import re
import urllib.parse

from mkdocs.structure.files import File

PROJECT = pathlib.Path(__file__).resolve().parent.parent
PAGES = {
    "README.md": "index.md",
    "CHANGELOG.md": "changelog.md",
    "CONTRIBUTING.md": "contributing.md",
    "CODE_OF_CONDUCT.md": "code-of-conduct.md",
    "SECURITY.md": "security.md",
}
STUDIO = os.environ.get("FORAGE_SITE_STUDIO")
SETUP = re.compile(r"<!-- studio\n.*?-->", re.DOTALL)
RUN = re.compile(r"forage run systems/([\w/]+\.iqr)(?:[^\n]* --world systems/worlds/(\w+\.world))?")
LINK = re.compile(r"(!?)\[([^\]]*)\]\((?!https?:|#)([^)#\s]+)(#[^)\s]*)?\)")


def notebook_page(file):
    """The texts and the code of a notebook."""
    cells = json.loads(file.read_text())["cells"]
    return "\n\n".join(f"```python\n{text}\n```" if kind == "code" else text for kind, text in ((c["cell_type"], "".join(c["source"])) for c in cells))


def add_notebooks(files, config):
    made = os.environ.get("FORAGE_NOTEBOOKS")
    for file in sorted(pathlib.Path(config["docs_dir"], "notebooks").glob("*.ipynb")):
        pictures = sorted(pathlib.Path(made, f"{file.stem}_files").glob("*")) if made else []
        for name in [f"{file.stem}.md"] + [f"{file.stem}_files/{picture.name}" for picture in pictures]:
            page = File(f"notebooks/{name}", config["docs_dir"], config["site_dir"], config["use_directory_urls"])
            page.abs_src_path = f"{made}/{name}" if made else str(file)
            files.append(page)


def on_files(files, config):
    add_notebooks(files, config)
    for page in PAGES.values():
        files.append(File(page, config["docs_dir"], config["site_dir"], config["use_directory_urls"]))
    return files


def on_page_read_source(page, config):
    for name, made in PAGES.items():
        if page.file.src_path == made:
            return (PROJECT / name).read_text()
    source = pathlib.Path(page.file.abs_src_path)
    if page.file.src_path.startswith("notebooks/"):
        text = notebook_page(source) if source.suffix == ".ipynb" else source.read_text()
        return f"{text}\n\n---\n\n[Download this page as a notebook]({pathlib.Path(page.file.src_path).stem}.ipynb)\n"
    return None


def studio(page, **asked):
    """The address of the studio, from a page, with what it is to open."""
    up = "../" * page.file.src_path.count("/")
    return f"{up}{STUDIO}index.html?" + urllib.parse.urlencode({k: v for k, v in asked.items() if v}, safe="/:")


def button(page, **asked):
    return f'<a class="md-button" href="{studio(page, **asked)}">Try it here</a>'


def with_exercises(markdown, page):
    """Each set-up of the tutorial as a button."""
    part, numbers = pathlib.Path(page.file.src_path).stem, iter(range(1, 1000))
    return SETUP.sub(lambda _: button(page, exercise=f"{part}:{next(numbers)}"), markdown)


def with_button(block, page):
    """A block of code, with a button when it runs one of the small systems of the cookbook and the models."""
    run = RUN.search(block)
    if not STUDIO or not run or not page.file.src_path.startswith(("cookbook/", "reference/models", "reference/parts")):
        return block
    return f"{block}\n\n{button(page, system=run[1], world=run[2])}\n"


def on_page_markdown(markdown, page, config, files):
    """Links go from the place of the page's file in the project to that of its target on the site."""
    source = next((name for name, made in PAGES.items() if made == page.file.src_path), f"docs/{page.file.src_path}")

    def moved(match):
        picture, text, path, part = match.groups()
        if source.startswith("docs/notebooks/") and "_files/" in path:  # a picture that the notebook has drawn
            return match.group(0)
        target = os.path.normpath(os.path.join(os.path.dirname(source), path))
        if not (PROJECT / target).exists():
            raise SystemExit(f"{source}: there is no {target}")
        on_site = PAGES.get(target, target[5:] if target.startswith("docs/") else None)
        if on_site is None and STUDIO and target.startswith("systems/") and target.endswith(".iqr"):
            return f'<a href="{studio(page, system=target[8:])}" title="Open it in the browser">{text}</a>'
        if on_site is None:
            return match.group(0) if picture else text
        here = os.path.dirname(page.file.src_path)
        return f"{picture}[{text}]({os.path.relpath(on_site, here or '.')}{part or ''})"

    # Blocks of code are not changed. What is folded is Markdown, too, but in the outputs of notebooks only answers are.
    folded = "<details><summary>" + ("Answer" if source.startswith("docs/notebooks/") else "")
    markdown = markdown.replace(folded, folded.replace("<details><summary>", '<details markdown="1">\n<summary markdown="span">'))
    if STUDIO:
        markdown = with_exercises(markdown, page)
    pieces = re.split(r"(```.*?```)", markdown, flags=re.DOTALL)
    return "".join(with_button(p, page) if i % 2 else LINK.sub(moved, p) for i, p in enumerate(pieces))
