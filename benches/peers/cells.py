"""The cells that the peers solve, and the table that they give back."""

import csv
from types import SimpleNamespace

import numpy as np

GRAVITY = 9.81
COLUMNS = ["scene", "method", "precision", "step", "tolerance", "threads", "seconds_a_cell",
           "start_seconds", "runs", "cell", "outcome", "zeta", "switches"]
# As many switches of a cell as topple compares.
SWITCHES = 8


def read(directory):
    """Scenes by name, each a list of cells; and the record as an array (samples, 2)."""
    scenes = {}
    with open(f"{directory}/cells.csv", newline="") as file:
        for row in csv.DictReader(file):
            cell = SimpleNamespace(**{k: v if k == "scene" else float(v) for k, v in row.items()})
            scenes.setdefault(cell.scene, []).append(derive(cell))
    record = np.genfromtxt(f"{directory}/record.csv", delimiter=",", skip_header=1)
    return scenes, record


def derive(c):
    """The numbers of equations (9)-(21) that a right-hand side needs, beside a cell's parameters."""
    c.recorded = bool(c.recorded)
    mass_v = c.mass + c.plate_v
    mass_h = mass_v + c.plate_h
    c.moves_h, c.moves_v = c.t_h > 0, c.t_v > 0
    c.mu_h = c.mass / mass_h if c.moves_h else 0.0
    c.mu_v = c.mass / mass_v if c.moves_v else 0.0
    c.omega_h = 2 * np.pi / c.t_h if c.moves_h else 0.0
    c.omega_v = 2 * np.pi / c.t_v if c.moves_v else 0.0
    c.u_y = c.alpha_y * abs(c.a_h) / c.omega_h**2 if c.moves_h else 0.0
    c.rho2 = c.inertia / c.mass
    c.v0 = -GRAVITY / c.omega_v**2 if c.moves_v else 0.0
    c.pulse_end = c.t_max if c.recorded else 2 * np.pi / c.omega
    return c


def arm(c, side):
    """b = B + s e."""
    return c.half_width + side * c.offset


def impact(c, side, du, dv, dphi):
    """Velocities after an impact into rocking about the corner `side`, (16)-(18)."""
    b, other = arm(c, side), arm(c, -side)
    kappa_h, kappa_v = 1 - c.mu_h, 1 - c.mu_v
    d = c.rho2 + c.height**2 * kappa_h + b * b * kappa_v
    width = 2 * c.half_width
    eta_u = width * b * c.height * c.mu_h * kappa_v / d
    eta_v = width * c.mu_v * (c.height**2 * kappa_h + c.rho2) / d
    eta_phi = (c.rho2 + c.height**2 * kappa_h - b * other * kappa_v) / d
    return du - eta_u * dphi, dv - side * eta_v * dphi, eta_phi * dphi


def critical(c, side):
    """Critical angle of section 2.6."""
    return np.arctan2(arm(c, side), c.height)


def switch(kind, t, y):
    """A switch as the table holds it; y is u, u', v, v', z, phi, phi'."""
    return " ".join([kind, repr(float(t))] + [repr(float(x)) for x in y])


def write(path, rows):
    """The table."""
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS)
        table.writeheader()
        table.writerows(rows)
