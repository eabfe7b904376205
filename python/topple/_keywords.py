"""Types of the keywords. Written by write_keywords.py from the library's tables: change these."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Mapping, Sequence, TypedDict, Union

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Numbers = Union[float, str, Sequence[float], NDArray[Any]]
    Path = Union[str, os.PathLike[str]]


class Block(TypedDict, total=False):
    """The block and its plates."""

    # a block of the paper's Table 1: 1 caryatid, 2 server cabinet, 3 hospital cabinet
    object: int
    # B [m], half the width of the base, between the edges on which the block really stands (too large a value
    # is unsafe); give two of half_width, height, slenderness and size
    half_width: Numbers
    # H [m], height of the centre of mass above the base: half the height of a uniform block
    height: Numbers
    # λ, H/B, the height of the centre of mass over half the width
    slenderness: Numbers
    # R [m], half the diagonal, the root of B² + H²
    size: Numbers
    # M [kg], mass; needed with plates, stiffnesses and forces. Otherwise it has no influence on the motion;
    # by default 1, without plates
    mass: Numbers
    # J_C [kg m²], moment of inertia about the centre of mass; by default the uniform rectangle's, M (B² +
    # H²)/3
    inertia: Numbers
    # ε, e/B: offset of the centre of mass to the right, divided by B; by default 0
    eccentricity: Numbers
    # e [m], offset of the centre of mass to the right, in place of eccentricity; less than B
    offset: Numbers
    # m_h [kg], mass of the plate that moves horizontally only; by default 0
    plate_h: Numbers
    # m_v [kg], mass of the plate that moves in both directions; by default 0
    plate_v: Numbers


class Base(TypedDict, total=False):
    """The base."""

    # directions in which the base moves: dual, horizontal, vertical, none
    isolation: str
    # what presses on a friction pendulum: follows or constant
    pressure: str
    # T_h [s], period of the horizontal isolation with its initial stiffness, before it yields
    t_h: Numbers
    # T_v [s], period of the vertical isolation
    t_v: Numbers
    # ψ, stiffness after yielding divided by the initial stiffness; by default 0.25
    psi: Numbers
    # ξ_h, horizontal viscous damping ratio, relative to the initial stiffness; by default 0.05
    xi_h: Numbers
    # ξ_v, vertical viscous damping ratio; by default 0.1
    xi_v: Numbers
    # α_y, yield displacement divided by PGA_h/ω_h²: the strength of the base grows with the peak of the
    # motion; by default 0.1
    alpha_y: Numbers
    # u_y [m], yield displacement, in place of alpha_y: a base that stays the same when the motion grows
    u_y: Numbers
    # F_y [N], k_h u_y, in place of alpha_y: the force at which the base yields
    yield_force: Numbers
    # n, exponent of the Bouc-Wen law; by default 2
    bouc_wen_n: Numbers
    # k_1 [N/m], stiffness of a bilinear device before it yields, in place of t_h
    k1: Numbers
    # k_2 [N/m], stiffness of a bilinear device after it has yielded, in place of psi; at most the one before
    k2: Numbers
    # Q_d [N], force of a bilinear device at zero displacement, in place of alpha_y; its yield displacement is
    # Q_d/(k_1 - k_2)
    qd: Numbers
    # R_d [m], radius of a friction pendulum, with mu in place of t_h and psi
    radius: Numbers
    # μ_d, friction coefficient of a friction pendulum; u_y is the displacement before it slides, 0.0005 m
    # unless given
    mu: Numbers
    # d [m], horizontal displacement at which the base meets its end stop; with stop_stiffness; by default
    # none
    stop_gap: Numbers
    # k_s [N/m], stiffness of the end stop
    stop_stiffness: Numbers
    # ξ_s, damping ratio of the end stop with the mass above, M + m_h + m_v; the stop never pulls; by default
    # 0
    stop_xi: Numbers
    # v_c [m], displacement from the static position at which the vertical spring's force is twice that of its
    # initial stiffness: it hardens by the cube; by default none
    v_hardening: Numbers
    # v_0 [m], static deflection of the vertical isolation, for the column max_v; the motion does not depend
    # on it; by default g/ω_v²
    static_deflection: Numbers


class Pulse(TypedDict, total=False):
    """The pulse."""

    # one-sine, one-cosine, half-sine, rectangle, ricker, mavroeidis-papageorgiou, ...
    shape: str
    # Ω [rad/s], circular frequency of the pulse: its period is 2π/Ω
    omega: Numbers
    # A_h [m/s²], horizontal amplitude of the pulse: its largest acceleration
    a_h: Numbers
    # A_v [m/s²], vertical amplitude of the pulse; by default 0
    a_v: Numbers
    # N, cycles of a one-sine or one-cosine pulse; by default 1
    cycles: Numbers
    # γ, number of cycles of a pulse of Mavroeidis & Papageorgiou, under its envelope; by default 2
    gamma: Numbers
    # ν [rad], phase of the cosine of a Mavroeidis & Papageorgiou pulse: with 0 the velocity is largest in the
    # middle of the pulse, with π/2 it is zero there; by default 0
    phase: Numbers


class Record(TypedDict, total=False):
    """The record."""

    # horizontal record: a path, an array, or a trace or a stream as obspy's; a stream may hold the vertical,
    # too
    horizontal: Any
    # vertical record, positive up: as horizontal
    vertical: Any
    # channel of the horizontal record's file, where it has several: its number or direction
    horizontal_channel: str
    # channel of the vertical record's file
    vertical_channel: str
    # time between samples, s, where the record does not tell
    dt: float
    # g, m/s2 or cm/s2, where the record does not tell
    units: str
    # second horizontal component, at a right angle to the first; ``azimuth`` turns both
    horizontal_2: Path
    # channel of its file
    horizontal_2_channel: str
    # turn the horizontal components to this azimuth, degrees from north over east
    azimuth: float
    # azimuth of ``horizontal``, where its file does not tell
    horizontal_azimuth: float
    # azimuth of ``horizontal_2``, where its file does not tell
    horizontal_2_azimuth: float
    # record that follows, such as an aftershock: its horizontal component
    join: Path
    # its vertical component
    join_vertical: Path
    # zeros between both records, s; by default 30
    join_gap: float
    # put the base on a floor, a linear oscillator of this period, s
    floor_period: float
    # damping of the floor's oscillator, as a share of the critical one; by default 0.05
    floor_damping: float
    # factor on the oscillator's acceleration relative to the ground; by default 1
    floor_factor: float
    # none or line: what is subtracted from the velocity of each component, the line nearest to it
    baseline: str
    # SF, factor on both components; by default 1
    scale: Numbers
    # PGA_h [m/s²], scale both components so that the horizontal peak is this
    pga: Numbers


class Run(TypedDict, total=False):
    """Duration and criteria."""

    # critical-angle or quarter-turn
    overturn: str
    # accept numbers that are not plausible
    force: bool
    # key of the first axis, which runs fastest
    x: str
    # key of the second axis
    y: str
    # t_max [s], simulated time; by default 30, or a record's duration
    t_max: Numbers
    # φ_0 [rad], rotation of the block at the start, positive about the left corner; by default 0
    tilt: Numbers
    # μ, friction coefficient between block and base: cells in which the block would slide are marked; the
    # model has no sliding; by default none
    friction: Numbers
    # η_φ, angular velocity after an impact divided by that before, instead of the law; only without
    # isolation; by default the law's
    restitution: Numbers
    # r, factor on the law's angular velocity after an impact; the linear momenta are kept; a factor with
    # which an impact would raise the energy is refused; by default 1
    restitution_factor: Numbers


class Settings(TypedDict, total=False):
    """How a scene is run."""

    # auto, gpu, cpu or reference
    backend: str
    # the GPU, or several of them, by the numbers of ``topple adapters``
    adapter: int | Sequence[int]
    # f32 or f64
    precision: str
    # largest step, s
    step: float
    # run cells of doubt again in f64 with half the step
    resolve: bool
    # leave out no part of the model that a scene does not need
    full_model: bool
    # run the cells beside a boundary again in f64 with half the step; replace those that change
    repair: bool
    # columns of the map, by their names: a cell runs no longer than these need; by default all
    columns: str | Sequence[str]
    # cells that the reference runs again; 0 for none; by default as many as 30 s allow, 128 at most
    verify: int
    # directory: the map is written there as map.zarr, and opened lazily
    out: Path
    # go on from what an interrupted call left in ``out``
    resume: bool
    # shard ``k/n`` of the grid, left in ``out`` for `merge`
    tile: str
    # threads of the CPU; by default as many as it has cores
    threads: int


class Method(TypedDict, total=False):
    """How a motion is integrated."""

    # auto, gpu, cpu or reference
    backend: str
    # f32 or f64
    precision: str
    # largest step, s
    step: float
    # leave out no part of the model that a scene does not need
    full_model: bool


class Refining(TypedDict, total=False):
    """How its map is refined."""

    # halve the cells beside boundaries so many times; the result is the leaves, as `open` gives them
    refine: int
    # with ``refine``: share of its range by which a number between cells that ran may be off
    smooth: float


class Uncertain(TypedDict, total=False):
    """Numbers that are not known."""

    # numbers that are not known: ``{"eccentricity": "normal(0.1,0.02)"}``, or texts
    # ``"eccentricity=normal(0.1,0.02)"``; normal(MEAN,DEVIATION), uniform(LOW,HIGH) or
    # lognormal(MEDIAN,BETA), cut off at two more numbers LOW,HIGH; the result is probabilities
    vary: str | Sequence[str] | Mapping[str, str]
    # each cell's axes have any value in its pixel; the result is probabilities
    pixel: bool
    # with ``vary`` or ``pixel``: sweeps that tell the probabilities, best a power of two; by default 64
    samples: int
    # with ``vary`` or ``pixel``: seed of the sweeps' points, up to 4294967295; by default 0
    seed: int
    # tell in ``attrs`` how sharp the boundaries are: basin entropy, uncertainty exponent, dimension
    sharpness: bool


class PulseCall(Block, Base, Pulse, Run, Settings, Refining, Uncertain, total=False):
    """Keywords of a call under pulses."""

    title: str


class RecordCall(Block, Base, Record, Run, Settings, Refining, Uncertain, total=False):
    """Keywords of a call under a record."""

    title: str


class SuiteCall(Block, Base, Run, Settings, total=False):
    """Keywords of a call under a suite of records."""

    title: str


class CellCall(Block, Base, Pulse, Record, Run, Method, total=False):
    """Keywords of a call of one cell."""

    title: str


class AnyCall(Block, Base, Pulse, Record, Run, Settings, Refining, Uncertain, total=False):
    """Keywords of a call under anything."""

    title: str
