"""A block in motion, by matplotlib."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from ._colours import known_colours, rgb

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation

#: Frames a second.
RATE = 25
#: Height of the plates and between them, m.
PLATE, BETWEEN = 0.05, 0.3
#: The bends of a spring.
ZIGZAG = np.array([0.0, 0.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 0.0, 0.0])


def corners(block: dict[str, float], u: float, v: float, phi: float) -> np.ndarray:
    """The corners of the block, m: it turns about the left one for phi > 0, about the right one for phi < 0."""
    b, height = block["half_width"], 2.0 * block["height"]
    outline = np.array([(-b, 0.0), (b, 0.0), (b, height), (-b, height)])
    pivot = np.array([-b if phi >= 0.0 else b, 0.0])
    # phi > 0 about the left corner turns it to the left: anticlockwise.
    turn = np.array([[np.cos(phi), -np.sin(phi)], [np.sin(phi), np.cos(phi)]])
    turned: np.ndarray = (outline - pivot) @ turn.T + pivot + np.array([u, v])
    return turned


def of(motion: Any, speed: float) -> FuncAnimation:
    """The animation of a history."""
    import matplotlib.pyplot as plt
    from matplotlib.animation import FuncAnimation
    from matplotlib.patches import Polygon, Rectangle

    if not speed > 0.0:
        raise ValueError(f"speed: {speed} must be above 0")
    block = json.loads(motion.attrs["block"])
    t, u, v, phi = (np.asarray(motion[name]) for name in ("t", "u", "v", "phi"))
    v = v + motion.attrs["static_deflection"]
    frames = max(int(np.ceil(t[-1] * RATE / speed)), 1)
    at = np.linspace(0.0, t[-1], frames + 1)
    now = {name: np.interp(at, t, values) for name, values in (("u", u), ("v", v), ("phi", phi))}

    figure, (above, below) = plt.subplots(2, 1, figsize=(4.8, 6.4), height_ratios=(3, 1), layout="constrained")
    half = max(1.5 * block["half_width"], 0.3)
    reach = 2.1 * np.hypot(block["half_width"], block["height"])
    aside = reach + float(np.abs(u).max())
    above.set(aspect="equal", xlim=(-aside, aside), ylim=(-0.05 * reach, reach + BETWEEN + 2.0 * PLATE))
    above.axhline(0.0, color="black", linewidth=1.0)
    steel, stone = "#9aa3ad", "#f2e2c0"
    plates = [above.add_patch(Rectangle((-half, 0.0), 2.0 * half, PLATE, facecolor=steel)) for _ in range(2)]
    springs = [above.plot([], [], color="black", linewidth=0.8)[0] for _ in range(2)]
    body = above.add_patch(Polygon(np.zeros((4, 2)), closed=True, facecolor=stone, edgecolor="black"))
    above.set(xlabel="x [m]", ylabel="y [m]")
    title = above.set_title("")
    curve, marked, _ = (rgb(colour) for colour in known_colours()["curves"])
    below.plot(t, phi, color=curve, linewidth=1.0)
    below.set(xlabel="t [s]", ylabel="φ [rad]", xlim=(0.0, t[-1]))
    (mark,) = below.plot([0.0], [0.0], "o", color=marked, markersize=4)

    def draw(frame: int) -> list[Any]:
        u, v, phi = (float(now[name][frame]) for name in ("u", "v", "phi"))
        plates[0].set_xy((u - half, 0.0))
        plates[1].set_xy((u - half, PLATE + BETWEEN + v))
        for spring, x in zip(springs, (-0.6 * half, 0.6 * half)):
            ends = (PLATE, PLATE + BETWEEN + v)
            spring.set_data(u + x + 0.04 * ZIGZAG, np.linspace(*ends, ZIGZAG.size))
        body.set_xy(corners(block, u, 2.0 * PLATE + BETWEEN + v, phi))
        title.set_text(f"t = {at[frame]:.2f} s")
        mark.set_data([at[frame]], [phi])
        return [*plates, *springs, body, title, mark]

    draw(0)
    # The layout is made once: for each frame anew it would take most of the time.
    figure.canvas.draw()
    figure.set_layout_engine("none")
    return FuncAnimation(figure, draw, frames=frames + 1, interval=1000.0 / RATE, blit=False)
