"""Pictures and films are those of the command line; notebooks show every object."""
import base64
import copy
import re
import shutil
from html import escape

import pytest

import forage
from conftest import SYSTEMS, WORLD, open_dac

PICTURES = [
    "time:Bug/Light",
    "time:mean(Bug/Light)",
    "space:Bug/Light@100,200",
    "movie:Bug/Motor@0..100/10",
    "diagram",
    "diagram:Bug",
    "connection:Light to US",
    "trajectory",
]
FILES = [
    "time_Bug_Light.png",
    "time_mean_Bug_Light.png",
    "space_Bug_Light_100_200.png",
    "movie_Bug_Motor_0..100_10.gif",
    "diagram.png",
    "diagram_Bug.png",
    "connection_Light_to_US.png",
    "trajectory.png",
]


def test_pictures_are_those_of_the_command_line(dac, command, tmp_path):
    arguments = [a for picture in PICTURES for a in ("--plot", picture)]
    command("run", SYSTEMS / "dac_foraging.iqr", "--world", WORLD, "--cycles", 400, "-o", tmp_path / "out", *arguments)
    written = {file.name: file.read_bytes() for file in (tmp_path / "out").iterdir() if file.suffix in (".png", ".gif")}
    for source in ("Bug/Light", "mean(Bug/Light)", "Bug/Motor"):
        dac.probe(source)
    dac.run(cycles=400)
    drawn = {dac.plot(picture).data for picture in PICTURES}
    assert drawn == set(written.values()) and len(drawn) == len(PICTURES)


def test_pictures_have_formats_and_are_saved(dac, tmp_path):
    dac.run(cycles=10)
    png, svg = dac.plot("trajectory"), dac.diagram()
    assert png._repr_png_().startswith(b"\x89PNG") and png._repr_html_() is None
    assert base64.b64encode(svg.data).decode() in svg._repr_html_() and svg._repr_png_() is None
    assert dac.diagram("Bug", format="pdf").data.startswith(b"%PDF")
    svg.save(tmp_path / "diagram.svg")
    assert (tmp_path / "diagram.svg").read_bytes() == svg.data
    assert dac.plot("space:Bug/Light").data  # the last cycle needs no probe
    twin = copy.copy(dac)
    assert twin.plot("trajectory").data == png.data
    dac.probe("Bug/Motor")
    dac.run(cycles=10)
    movie = dac.plot("movie:Bug/Motor")
    assert movie.data.startswith(b"GIF89a") and "data:image/gif;base64," in movie._repr_html_() and movie._repr_png_() is None


def test_a_diagram_is_in_the_page_that_a_notebook_exports(dac):
    """nbconvert removes what it does not know from SVG that is part of the page."""
    nbconvert, v4 = pytest.importorskip("nbconvert"), pytest.importorskip("nbformat.v4")
    html = dac.diagram()._repr_html_()
    shown = v4.new_output("execute_result", {"text/html": html, "text/plain": "a diagram"})
    page, _ = nbconvert.HTMLExporter().from_notebook_node(v4.new_notebook(cells=[v4.new_code_cell("dac.diagram()", outputs=[shown])]))
    assert re.search('src="[^"]*"', html)[0] in page  # versions write the attributes in another order


def test_what_cannot_be_drawn_says_why(dac):
    for picture, message in (
        ("time:Bug/Light", "is not recorded"),
        ("time:Bug/Ligth", "'Bug' has no group 'Ligth'|there is no group"),
        ("curve:success", "results of several runs"),
        ("nothing:x", "nothing"),
        ("connection:None", "None"),
        ("diagram:None", "there is no process 'None'"),
    ):
        with pytest.raises(forage.InputError, match=message):
            dac.plot(picture)
    with pytest.raises(forage.InputError, match="format"):
        dac.plot("diagram", format="gif")
    with pytest.raises(forage.InputError, match="there is no robot 7"):
        dac.plot("trajectory", robot=7)
    with forage.open(SYSTEMS / "cookbook/oscillator.iqr") as run:
        with pytest.raises(forage.InputError, match="needs a world"):
            run.plot("trajectory")
        with pytest.raises(forage.InputError, match="needs a world"):
            run.film("film.gif")


def test_a_film_is_that_of_the_command_line(dac, command, tmp_path):
    with dac.film(tmp_path / "robot.gif", groups=["Bug/Motor"]) as film:
        dac.run(cycles=30)
        assert not film.closed and "not complete" in repr(film)
    assert film.frames > 1 and film.closed and "data:image/gif;base64" in film._repr_html_()
    command("run", SYSTEMS / "dac_foraging.iqr", "--world", WORLD, "--cycles", 30, "--video", tmp_path / "other.gif", "--video-group", "Bug/Motor", "-o", "")
    assert (tmp_path / "robot.gif").read_bytes() == (tmp_path / "other.gif").read_bytes()
    film.close()
    (tmp_path / "folder.gif").mkdir()
    for name in ("film.avi", tmp_path / "folder.gif"):
        with pytest.raises(forage.InputError):
            dac.film(name)


@pytest.mark.skipif(not shutil.which("ffmpeg"), reason="ffmpeg is not installed")
def test_notebooks_show_films_of_ffmpeg(dac, tmp_path):
    with dac.film(tmp_path / "robot.mp4") as film:
        dac.run(cycles=20)
    assert '<video controls style="max-width: 100%" src="data:video/mp4;base64' in film._repr_html_()
    with pytest.raises(forage.InputError, match="there is no group"):
        dac.film(tmp_path / "robot.gif", groups=["Bug/Nothing"])


def test_a_film_is_completed_with_its_run(tmp_path):
    with open_dac() as run:
        film = run.film(tmp_path / "robot.gif")
        run.run(cycles=10)
        twin = copy.copy(run)
        assert film.frames == 0
    assert film.closed and film.frames > 1 and (tmp_path / "robot.gif").stat().st_size > 1000
    twin.run(cycles=10)
    assert [file.name for file in tmp_path.iterdir()] == ["robot.gif"]


def test_notebooks_show_every_object(dac, tmp_path):
    dac.run(cycles=3)
    shown = [dac, dac["Bug/Light"], dac.probe("Bug/Light"), dac.params, dac["Bug/Motor"].clamp(0), dac.film(tmp_path / "a.gif")]
    for thing in shown:
        html = thing._repr_html_()
        assert html.startswith("<") and escape(repr(thing).split("'")[0]) in html
    assert "Bug/Light" in dac._repr_html_() and "neuronLinearThreshold" in dac._repr_html_()
    assert "<script" not in dac.params._repr_html_()
    probe = dac.probe("Bug/Light")
    dac.run(cycles=50)
    rows = probe.take()._repr_html_()
    assert rows.count("<tr>") == 21 and "<td style=\"text-align: right\">52</td>" in rows
    dac.close()
    for thing in shown:
        assert thing._repr_html_() and repr(thing)
