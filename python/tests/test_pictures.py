"""Pictures: classes, shares and colours are the command's."""

import re

import matplotlib
import matplotlib.pyplot
import numpy as np
import pytest

import topple
from topple import _animation, _plot

matplotlib.use("agg")

SCENE = {"object": 1, "eccentricity": 0.2, "t_h": 1.75, "t_v": 0.75, "omega": "0.2:15:40", "a_h": "0.1:15:40"}


@pytest.fixture(scope="module")
def map():
    return topple.pulse(**SCENE, backend="cpu", verify=0)


def test_the_legend_is_the_commands(command, map, tmp_path):
    flags = [text for key, value in SCENE.items() for text in ("--" + key.replace("_", "-"), str(value))]
    command("pulse", *flags, "--backend", "cpu", "--verify", "none", "--out", tmp_path)
    words = re.findall(r">([^<>]+)<", (tmp_path / "map.svg").read_text(encoding="utf-8"))
    legend = map.topple.plot().get_legend()
    told = [re.sub(r"\s+", " ", text.get_text()) for text in legend.get_texts()]
    shared = [text.rsplit(": ", 1) for text in told if text.endswith("%")]
    assert len(shared) >= 5
    for label, share in shared:
        assert label in words and share in words, (label, share)
    assert "with dots: over the right corner" in told


def test_cells_have_their_colours(map):
    ax = map.topple.plot()
    mesh = ax.collections[0]
    shown = mesh.cmap(mesh.norm(mesh.get_array()))[..., :3].reshape(map.outcome.shape + (3,))
    # The paper's: green stands, red overturns without an impact.
    stays = np.asarray(map.outcome == map.outcome.flag_meanings.split().index("full_contact"))
    assert np.allclose(shown[stays] * 255, [0xD6, 0xF4, 0xB8])
    left = map.outcome.flag_meanings.split().index("overturned_left")
    direct = np.asarray((map.outcome == left) & (map.impacts == 0))
    assert direct.any() and np.allclose(shown[direct] * 255, [0xC6, 0x1F, 0x1A])
    assert ax.get_xlabel() == "Ω [rad/s]" and ax.get_ylabel() == "$A_{h}$ [m/s²]"


def pixels(figure):
    """The colours of a figure as it is drawn."""
    figure.canvas.draw()
    return np.asarray(figure.canvas.buffer_rgba())[..., :3].reshape(-1, 3)


def test_a_picture_has_the_title_the_width_and_the_letters_asked_for(map):
    ax = map.topple.plot(title="Mine", width=90, font_size=6)
    assert ax.get_title() == "Mine" and np.isclose(ax.figure.get_figwidth() * 25.4, 90)
    ax.figure.canvas.draw()
    texts = [ax.title, ax.xaxis.label, *ax.get_xticklabels(), *ax.get_legend().get_texts(), ax.get_legend().get_title()]
    assert len(texts) > 8 and {text.get_fontsize() for text in texts} == {6.0}
    # What is drawn is in the figure, its legend too.
    legend = ax.get_legend().get_window_extent()
    assert legend.x0 >= 0 and legend.y0 >= 0 and legend.x1 <= ax.figure.bbox.x1
    assert matplotlib.rcParams["font.size"] == 10.0
    motion = map.topple.history(omega=9.0, a_h=8.4).topple.plot(title="Moves", width=120, palette="grey")
    assert motion[0].get_title() == "Moves" and np.isclose(motion[0].figure.get_figwidth() * 25.4, 120)
    curves = map.isel(a_h=20).topple.plot(title="A line", palette="grey")
    assert curves.child_axes[0].get_title() == "A line"


@pytest.mark.parametrize("column", ["outcome", "zeta"])
def test_a_grey_picture_has_no_colour(map, column):
    assert np.ptp(pixels(map.topple.plot(column).figure), axis=1).max() > 100
    assert np.ptp(pixels(map.topple.plot(column, palette="grey").figure), axis=1).max() == 0
    # Classes of one grey differ by lines, in the legend too.
    if column == "outcome":
        legend = map.topple.plot(palette="grey").get_legend()
        faces = [(patch.get_facecolor(), patch.get_hatch()) for patch in legend.get_patches()]
        assert len(set(faces)) == len(faces) > 5 and len({face for face, _ in faces}) < len(faces)


def test_dots_are_seen_on_dark_colours(map):
    dark = map.copy(deep=True)
    dark.outcome[:] = map.outcome.flag_meanings.split().index("overturned_right")
    dark.impacts[:] = 30
    # Few pixels of white beside dots, were they black.
    shares = {}
    for impacts in (1, 30):
        dark.impacts[:] = impacts
        ax = dark.topple.plot()
        inside = ax.get_window_extent()
        ax.figure.canvas.draw()
        all_of = np.asarray(ax.figure.canvas.buffer_rgba())[..., :3]
        height = all_of.shape[0]
        part = all_of[int(height - inside.y1) + 5 : int(height - inside.y0) - 5, int(inside.x0) + 5 : int(inside.x1) - 5]
        shares[impacts] = (part.min(axis=2) > 200).mean()
    assert min(shares.values()) > 0.01, shares


def test_a_quantity_and_a_line(map):
    assert "long_name" in map.zeta.attrs and map.topple.plot("zeta").get_title()
    ax = map.isel(a_h=20).topple.plot()
    curve = next(line for line in ax.lines if line.get_label().startswith("ζ"))
    stands = np.asarray(map.outcome.isel(a_h=20) < 2)
    assert np.array_equal(np.isfinite(curve.get_ydata()), stands)
    strip = ax.child_axes[0].collections[0]
    kinds, _ = _plot.classes(map.isel(a_h=20))
    assert np.array_equal(np.ravel(strip.get_array()), kinds) and len(set(kinds.tolist())) > 2
    box = strip.get_window_extent()
    assert box.height > 5.0 and box.width > 100.0
    assert np.array_equal(curve.get_ydata()[stands], map.zeta.isel(a_h=20).values[stands].astype(float))


def test_what_a_picture_refuses(map):
    with pytest.raises(ValueError, match="^column: nothing"):
        map.topple.plot("nothing")
    more = topple.pulse(**(SCENE | {"omega": "1:9:3", "a_h": "1:9:3", "t_h": [1.0, 2.0]}), backend="cpu", verify=0)
    with pytest.raises(ValueError, match="^axes: t_h, a_h, omega"):
        more.topple.plot()
    assert more.sel(t_h=2.0).topple.plot().get_legend().get_title().get_text().replace("\xa0", " ").count("T_h = 2 s") == 1
    with pytest.raises(ValueError, match="^t_h: the map has lost this axis"):
        more.max("t_h").topple.plot()
    with pytest.raises(ValueError, match="^column: outcome has no picture"):
        more.mean("t_h").topple.plot()
    with pytest.raises(ValueError, match="^axes: none"):
        map.isel(omega=0, a_h=0).topple.plot()
    with pytest.raises(ValueError, match="^column: status"):
        map.topple.plot("status")
    with pytest.raises(ValueError, match="^omega: missing"):
        map.topple.history(a_h=4.0)
    for asked, problem in (
        ({"width": 3}, "^width: a picture is 40 to 600 mm wide, not 3"),
        ({"font_size": 300}, "^font_size: letters are of 4 to 40 pt, not 300"),
        ({"font_size": 20, "width": 60}, "^width: letters of 20 pt need a picture that is 163 mm wide"),
        ({"palette": "green"}, "^palette: no palette is called green; there are colour, grey"),
        ({"title": ""}, "^title: must be one line of text"),
        ({"width": 90, "ax": matplotlib.pyplot.figure().gca()}, "^width: the figure of ax has a width"),
    ):
        with pytest.raises(ValueError, match=problem):
            map.topple.plot(**asked)
    with pytest.raises(ValueError, match="^speed: "):
        map.topple.animate({"omega": 9.0, "a_h": 8.0}, speed=0.0)


def test_what_has_no_value_is_in_the_legend(map):
    texts = [text.get_text() for text in map.topple.plot("t_uplift").get_legend().get_texts()]
    assert texts == ["overturned", "does not lift"]
    # All that stand have a rocking index.
    assert [text.get_text() for text in map.topple.plot("zeta").get_legend().get_texts()] == ["overturned"]
    unresolved = map.copy(deep=True)
    unresolved.outcome[3, 4] = map.outcome.flag_meanings.split().index("unresolved")
    texts = [text.get_text() for text in unresolved.topple.plot("t_uplift").get_legend().get_texts()]
    assert texts[-1] == "unresolved"


def test_cells_beyond_the_model_are_hatched():
    scene = SCENE | {"friction": 0.3}
    found = topple.pulse(**scene, backend="cpu", verify=0)
    hatched = _plot.beyond(found)
    assert np.array_equal(hatched, np.asarray((found.min_contact <= 0) | (found.friction_demand > 0.3)))
    assert hatched.any() and not hatched.all()
    axis = topple.pulse(**(scene | {"friction": [0.3, 5.0], "a_h": 8.0}), backend="cpu", verify=0)
    assert _plot.beyond(axis).any() and axis["outcome"].dims == ("friction", "omega")
    assert _plot.beyond(axis)[1].sum() <= _plot.beyond(axis)[0].sum()


def test_a_cell_moves(map, tmp_path):
    cell = {"omega": 9.0, "a_h": 8.4}
    whole = topple.history(**(SCENE | cell))
    motion = map.topple.history(**cell)
    assert np.array_equal(motion.phi.values, whole.phi.values)
    map.isel(omega=0).topple.history(a_h=1.0)
    place = tmp_path / "block.gif"
    topple.history(**(SCENE | cell | {"t_max": 1.0})).topple.animate(speed=4.0).save(place, writer="pillow")
    assert place.read_bytes()[:3] == b"GIF"


@pytest.mark.parametrize("phi", [0.0, 0.3, -0.3])
def test_a_turned_block_keeps_its_corner(phi):
    block = {"half_width": 0.4, "height": 1.0}
    outline = _animation.corners(block, 0.1, 0.2, phi)
    # The corner about which it turns stays where it is, and no edge changes its length.
    pivot = outline[0] if phi >= 0 else outline[1]
    assert np.allclose(pivot, [0.1 + (-0.4 if phi >= 0 else 0.4), 0.2])
    edges = np.linalg.norm(np.diff(outline, axis=0), axis=1)
    assert np.allclose(edges, [0.8, 2.0, 0.8])
    assert outline[:, 1].min() >= 0.2 - 1e-12
