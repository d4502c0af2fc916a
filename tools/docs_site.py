"""Makes README.md, CHANGELOG.md and CONTRIBUTING.md pages of the site (a hook of mkdocs), and links to other files of the project plain text."""

import os
import pathlib
import re

from mkdocs.structure.files import File

PROJECT = pathlib.Path(__file__).resolve().parent.parent
PAGES = {"README.md": "index.md", "CHANGELOG.md": "changelog.md", "CONTRIBUTING.md": "contributing.md", "CODE_OF_CONDUCT.md": "code-of-conduct.md", "SECURITY.md": "security.md"}
LINK = re.compile(r"(!?)\[([^\]]*)\]\((?!https?:|#)([^)#\s]+)(#[^)\s]*)?\)")


def on_files(files, config):
    for page in PAGES.values():
        files.append(File(page, config["docs_dir"], config["site_dir"], config["use_directory_urls"]))
    return files


def on_page_read_source(page, config):
    for name, made in PAGES.items():
        if page.file.src_path == made:
            return (PROJECT / name).read_text()
    return None


def on_page_markdown(markdown, page, config, files):
    """Links go from the place of the page's file in the project to that of its target on the site."""
    source = next((name for name, made in PAGES.items() if made == page.file.src_path), f"docs/{page.file.src_path}")

    def moved(match):
        picture, text, path, part = match.groups()
        target = os.path.normpath(os.path.join(os.path.dirname(source), path))
        if not (PROJECT / target).exists():
            raise SystemExit(f"{source}: there is no {target}")
        on_site = PAGES.get(target, target[5:] if target.startswith("docs/") else None)
        if on_site is None:
            return match.group(0) if picture else text
        here = os.path.dirname(page.file.src_path)
        return f"{picture}[{text}]({os.path.relpath(on_site, here or '.')}{part or ''})"

    # Blocks of code are left as they are.
    # What is folded is Markdown, too.
    markdown = markdown.replace("<details><summary>", '<details markdown="1">\n<summary markdown="span">')
    pieces = re.split(r"(```.*?```)", markdown, flags=re.DOTALL)
    return "".join(p if i % 2 else LINK.sub(moved, p) for i, p in enumerate(pieces))
