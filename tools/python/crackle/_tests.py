# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands as functions: the options of `crackle COMMAND --help` are keywords, with their units and defaults."""
from __future__ import annotations

import json
import operator
import os
from typing import TYPE_CHECKING, Any

from . import _engine
from ._case import given_or_shipped, read_case, read_joints
from ._commands import words_of
from ._errors import InputError, tell
from ._progress import reporting
from ._results import Calibration, Campaign, Result, Temporary, _run

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    _Path = str | os.PathLike[str]
    _Case = dict[str, Any] | _Path | _engine.Case
    _Results = Result | Campaign | _Path
    _Progress = bool | Callable[[str, str, float], Any] | None


def pack(*, count: int | None = None, height_to_width: float | None = None, width: float | None = None,
         height: float | None = None, radius_min: float | None = None, radius_max: float | None = None,
         lognormal_median: float | None = None, lognormal_deviation: float | None = None, sieve: _Path | None = None,
         mean_overlap: float | None = None, void_ratio: float | None = None, seed: int | None = None,
         threads: int | None = None, density: float | None = None, normal_stiffness: float | None = None,
         shear_stiffness: float | None = None, friction_angle: float | None = None, output: _Path | None = None,
         force: bool = False, progress: _Progress = None) -> _engine.Particles:
    """Packs random circles between four smooth walls to mechanical equilibrium, as `crackle pack`.

    Give count, or width and height (m); sizes: radius_min and radius_max (m), lognormal_median (m) and
    lognormal_deviation, or sieve (CSV file); the target mean_overlap (m) or void_ratio. Of the file's material: density
    (kg/m2), normal_stiffness, shear_stiffness (N/m), friction_angle (degrees). The same seed gives the same bytes,
    whatever the threads.

    Returns Particles; with output the file is written, too (InputError where it is there, unless force is true).
    """
    options = dict(count=count, height_to_width=height_to_width, width=width, height=height, radius_min=radius_min,
                   radius_max=radius_max, lognormal_median=lognormal_median, lognormal_deviation=lognormal_deviation,
                   sieve=sieve, mean_overlap=mean_overlap, void_ratio=void_ratio, seed=seed, threads=threads,
                   density=density, normal_stiffness=normal_stiffness, shear_stiffness=shear_stiffness,
                   friction_angle=friction_angle)
    _refuse_replacing(output, force, sieve)
    with reporting(progress) as report:
        made = _engine.pack(words_of(options), report)
    if output is not None:
        made.write(os.fspath(output), force)
    return made


def mesh(particles: _engine.Particles | _Path | Sequence[Sequence[float]], *, kind: str | None = None,
         thick: float | None = None, inset: float | None = None, boundary: str | None = None, merge: bool = False,
         joints: _Path | None = None, domain: Sequence[float] | None = None, bounding_box: bool = False,
         density: float | None = None, normal_stiffness: float | None = None,
         shear_stiffness: float | None = None, friction_angle: float | None = None, output: _Path | None = None,
         force: bool = False, progress: _Progress = None) -> _engine.Particles:
    """Makes polygons of the centres of circles, as `crackle mesh`.

    particles: Particles, the path of a particle file, or a sequence of centres x, y (m; with domain = (x1, x2, y1, y2)
    or bounding_box). kind: "delaunay" or "voronoi"; thick: gap between facing edges, m (default: thick of the particles);
    inset, m; boundary: "domain" or "centres"; merge: give the place of cells that the inset destroys to neighbours;
    joints: a file of joints (`crackle joints`), whose traces become edges.

    Returns Particles; with output the file is written, too.
    """
    inputs: list[str] = []
    if joints is not None:
        joints = given_or_shipped(joints)
        inputs = _engine.files_of_joints(joints) if output is not None else []
    if isinstance(particles, _engine.Particles):
        _refuse_replacing(output, force, *inputs)
        name, text = "particles", particles.text()
    elif isinstance(particles, (str, os.PathLike)):
        name = given_or_shipped(particles)
        _refuse_replacing(output, force, name, *inputs)
        text = _engine.read_text(name)
    else:
        _refuse_replacing(output, force, *inputs)
        name = "centres"
        try:
            text = "".join(f"{float(x)!r} {float(y)!r}\n" for x, y in particles)
        except (TypeError, ValueError):
            raise InputError(f"centres: found a {type(particles).__name__}, expected Particles, a path, or pairs of "
                             "numbers x, y in m") from None
    options = dict(kind=kind, thick=thick, inset=inset, boundary=boundary, merge=merge, joints=joints,
                   domain=None if domain is None else [float(one) for one in domain], bounding_box=bounding_box,
                   density=density, normal_stiffness=normal_stiffness, shear_stiffness=shear_stiffness,
                   friction_angle=friction_angle)
    with reporting(progress) as report:
        made = _engine.mesh(name, text, words_of(options), report)
    if output is not None:
        made.write(os.fspath(output), force)
    return made


def joints(case: _Case, *, seed: int | None = None, box_width: float | None = None, box_height: float | None = None,
           grain: float | None = None, traces: _Path | None = None, output: _Path | None = None,
           columns: int | None = None, width: float | None = None, font: str | None = None,
           font_size: float | None = None, dpi: int | None = None, title: str | None = None,
           force: bool = False) -> dict[str, Any]:
    """Traces of joints in the box of a specimen, asked for and reached, as `crackle joints --json`.

    case: a case that has joints, or a dict, a TOML text or a file of nothing else; seed: in place of joints.seed;
    box_width, box_height: of the box, m, where the case has none; grain: mean spacing of grains, m, whose mesh the
    traces are for. traces: a file to write, a trace a line (x1 y1 x2 y2 ..., m); output: a figure to write, .svg, .pdf
    or .png, width in mm. Returns a dict, its own units within.
    """
    options = dict(seed=seed, box_width=box_width, box_height=box_height, grain=grain, traces=traces, output=output,
                   columns=columns, width=width, font=font, font_size=font_size, dpi=dpi, title=title, force=force,
                   json=True)
    path = given_or_shipped(case) if isinstance(case, (str, os.PathLike)) else ""
    name = path if os.path.exists(path) else "case"
    _, text = _engine.run_joints(read_joints(case), name, words_of(options))
    return json.loads(text)


def _refuse_replacing(output, force, *inputs):
    """Before the work: output is there and not to be replaced, or is one of the inputs."""
    if output is not None:
        _engine.refuse_replacing(os.fspath(output), bool(force), [os.fspath(one) for one in inputs if one is not None])


class Elastic(dict):
    """What `crackle elastic --json` prints, its own units within, and `bonds`: an array, shape (bonds,): body_i, body_j
    (ids), position (x, y in m), strength (N), overlap, closing (m), normal_force, shear_force (N, at the strain asked
    for; shear on body_i along the normal from i to j turned by +90 degrees), break_strain, slip_strain (inf: never);
    notices: a list of what to know, such as what it leaves out of the case."""

    bonds: Any = None
    notices: Sequence[str] = ()


def elastic(case: _Case, *, strain: float = 1e-4, modes: int = 0, progress: _Progress = None) -> Elastic:
    """Small-strain moduli, first break and slip, stable time step, by a sparse solve, as `crackle elastic`.

    strain: axial, at which bonds gives forces; modes: lowest vibration modes to find. Returns Elastic.
    """
    with reporting(progress) as report:
        text, bonds, notices = _engine.elastic(read_case(case), strain, modes, report)
    found = Elastic(json.loads(text))
    found.bonds, found.notices = bonds, notices
    return found


def check(case: _Case, *, threads: int | None = None, progress: _Progress = None) -> dict[str, Any]:
    """What a test would give and cost, as `crackle test --check --json`: a dict, its own units within."""
    with reporting(progress) as report:
        return json.loads(_engine.check(read_case(case), _threads(threads), report))


def _threads(threads):
    if threads is None:
        return 0
    return _number("threads", threads, 2**31, "a whole number >= 1")


def _every(every):
    if isinstance(every, str) and every in ("row", "rows"):
        return 0
    return _number("every", every, 2**63, "\"row\" or a number of steps >= 1")


def _number(name, value, beyond, expected):
    """A whole number >= 1 that the engine's type holds, of numpy as well."""
    try:
        number = 0 if isinstance(value, bool) else operator.index(value)
    except TypeError:
        number = 0
    if not 1 <= number < beyond:
        raise InputError(f"{name}: found {value!r}, expected {expected}")
    return number


def _options(folder, force=False, verify=False, profile=False, long=False, threads=None):
    options = _engine.TestOptions()
    options.folder = os.fspath(folder)
    options.force, options.verify, options.profile = bool(force), bool(verify), bool(profile)
    options.endless, options.threads = bool(long), _threads(threads)
    return options


def test(case: _Case, output: _Path | None = None, *, force: bool = False, verify: bool = False,
         profile: bool = False, threads: int | None = None, long: bool = False, allow_unstable: bool = False,
         every: int | str = "row", call: Callable[[_engine.State], Any] | None = None,
         progress: _Progress = None) -> Result:
    """Runs one virtual test, as `crackle test CASE -o OUT`, to the same bytes.

    case: a dict, a TOML text or the path of a file. output: folder for the results; None: a folder that goes with the
    Result, but stays where the test is not run to its end (the exception names it). force: replace results
    that are there; verify: run the companions, too, for the errors of strength and strain; profile: time the phases of
    a step; threads: no result depends on them; long: run it although it takes more than a day; allow_unstable: accept a
    time step above the stable bound.

    call: is called with the State of the test at every judged row (curve.csv has output.curve_rows of them), or every
    so many steps: every = "row" or a number; not at the row by which the test ends of itself. It may read arrays, set
    state.platen_speed, and end the test by state.stop(). What it raises ends the test as Ctrl-C does: what was written
    is kept, and `resume` goes on.

    Returns Result. Raises InputError, UnstableRun (results up to there are kept), KeyboardInterrupt.
    """
    steps = _every(every)
    asked = read_case(case)
    temporary = None
    if output is None:
        temporary = Temporary()
        output = os.path.join(temporary.name, "test")
    options = _options(output, force, verify, profile, long, threads)
    options.command = "crackle.test"
    try:
        with reporting(progress) as report:
            folder, _, _ = _engine.run_test(asked, options, bool(allow_unstable), report, call, steps)
    except BaseException as error:
        begun = os.path.isfile(os.path.join(output, "case.toml"))
        if temporary is not None and begun:
            temporary.keep()
        if begun and (temporary is not None or isinstance(error, KeyboardInterrupt)):
            tell(error, f"what was written is kept in {os.fspath(output)}: crackle.read reads it, crackle.resume goes "
                        "on with a test that was interrupted")
        raise
    return Result(folder, temporary=temporary)


def resume(folder: _Path, *, verify: bool = False, threads: int | None = None, long: bool = False,
           every: int | str = "row", call: Callable[[_engine.State], Any] | None = None,
           progress: _Progress = None) -> Result:
    """Goes on with a test that was interrupted, as `crackle test --resume OUT`; keywords as of test(). Returns
    Result."""
    options = _options(folder, False, verify, False, long, threads)
    with reporting(progress) as report:
        folder, _, _ = _engine.resume_test(options, report, call, _every(every))
    return Result(folder)


def campaign(plan: _Path, output: _Path, *, workers: int | None = None, verify: bool = False, retry: bool = False,
             shard: str | tuple[int, int] | None = None, long: bool = False, progress: _Progress = None) -> Campaign:
    """Runs a table of tests on several processors, as `crackle campaign PLAN -o DIR`. Stopped at any moment, the same
    call goes on.

    plan: path of a TOML file (`crackle campaign --keys` lists its keys). workers: processes that run tests; by default
    one a processor lent. verify: run each test at half the step and half the rate, too; retry: run those again that have
    gone wrong; shard: (I, N), run share I of N; long: run tests although they take more than a day.

    Returns Campaign. Raises InputError, KeyboardInterrupt (what has been run is kept).
    """
    if shard is not None and not isinstance(shard, str):
        shard = f"{shard[0]}/{shard[1]}"
    options = dict(output=os.fspath(output), workers=workers, verify=verify, retry=retry, shard=shard, long=long)
    _run_long("campaign", plan, options, progress)
    return Campaign(output)


def calibrate(rock: _Path, output: _Path, *, workers: int | None = None, long: bool = False,
              progress: _Progress = None) -> Calibration:
    """Finds the free keys of a rock from its laboratory values, as `crackle calibrate ROCK -o DIR`. Stopped at any
    moment, the same call goes on.

    rock: path of a TOML file (`crackle calibrate --keys` lists its keys). workers: processes that run tests; by default
    one a processor lent. long: run tests although they take more than a day.

    Returns Calibration, whether or not all targets were reached. Raises InputError, KeyboardInterrupt (what has been
    run is kept).
    """
    _run_long("calibrate", rock, dict(output=os.fspath(output), workers=workers, long=long), progress)
    return Calibration(output)


def _run_long(command, file, options, progress):
    """A command that goes on where it was stopped."""
    try:
        with reporting(progress) as report:
            code, _ = _run(command, [given_or_shipped(file)], options, report)
        if code not in (0, 1):
            raise KeyboardInterrupt
    except InputError:
        raise
    except BaseException as error:  # Ctrl-C, or what progress raised
        tell(error, f"what was run is kept in {options['output']}: the same call goes on")
        raise


def _folder(one):
    if hasattr(one, "folder"):
        return one.folder
    if isinstance(one, (str, os.PathLike)):
        return given_or_shipped(one)
    raise InputError(f"results: found a {type(one).__name__}, expected Results, Campaigns or paths of folders")


def envelope(*folders: _Results, figure: str | None = None, strain: float | None = None, output: _Path | None = None,
             columns: int | None = None, width: float | None = None, font: str | None = None,
             font_size: float | None = None, dpi: int | None = None, title: str | None = None,
             force: bool = False) -> dict[str, Any]:
    """Mohr-Coulomb and Hoek-Brown from tests and campaigns at several confinements, as `crackle envelope --json`.

    folders: paths, Results or Campaigns. figure: stress of summary.json that is taken for the strength ("peak_stress"),
    "largest_stress" of tests that harden; strain: the stress at this axial strain in its place. output: a figure to write, .svg, .pdf or .png. Returns a dict, its own units
    within.
    """
    options = dict(figure=figure, strain=strain, output=output, columns=columns, width=width, font=font,
                   font_size=font_size, dpi=dpi, title=title, force=force, json=True)
    _, text = _run("envelope", [_folder(one) for one in folders], options)
    return json.loads(text)


def plot(*results: _Results, output: _Path, what: str | Sequence[str] | None = None,
         at: str | float | Sequence[str | float] | None = None, columns: int | None = None,
         width: float | None = None, font: str | None = None, font_size: float | None = None, dpi: int | None = None,
         title: str | None = None, magnify: float | None = None, labels: str | Sequence[str] | None = None,
         figure: str | Sequence[str] | None = None, test: str | Sequence[str] | None = None,
         measured: _Path | None = None, units: str | None = None, bodies: int | Sequence[int] | None = None,
         force: bool = False) -> None:
    """Draws a figure for a paper, as `crackle plot OUT... -o FIGURE`: .svg, .pdf or .png.

    results: Results, Campaigns or their folders, or folders of decks' runs. what: words of "curve", "ae", "emission",
    "strain", "specimen", of a campaign of "curve", "axes", "scatter", of a deck of "energy", "displacement", "height",
    "velocity", "force", "curve"; at: strains, or "start", "peak", "end"; width in mm; magnify: displacements are drawn
    this many times as large; of decks units: "si", "cgs" or "mm-g-s", what its units are called, bodies: their numbers.
    """
    def many(value):
        return [value] if isinstance(value, (str, float, int)) else value
    options = dict(output=os.fspath(output), what=many(what), at=many(at), columns=columns, width=width, font=font,
                   font_size=font_size, dpi=dpi, title=title, magnify=magnify, labels=many(labels), figure=many(figure),
                   test=many(test), measured=measured, units=units, bodies=many(bodies), force=force)
    _run("plot", [_folder(one) for one in results], options)


def view(*particles: _engine.Particles | Result | _Path, output: _Path, title: str | None = None,
         frames: int | None = None, seed: int | None = None, units: str | None = None,
         progress: _Progress = None) -> None:
    """Writes a page to look at particles, moving or not, as `crackle view IN... -o view.html`.

    particles: Particles, Results, or paths of particle files and of folders of tests and decks' runs. frames: show at
    most this many of each, evenly chosen; seed: of the circles that a particle file of mode 0 leaves to chance; units:
    "si", "cgs" or "mm-g-s", what those of particle files and decks are called.
    """
    options = dict(output=os.fspath(output), title=title, frames=frames, seed=seed, units=units)
    scratch = Temporary()
    shown = []
    for number, one in enumerate(particles, 1):
        if isinstance(one, _engine.Particles):
            shown.append(os.path.join(scratch.name, f"particles_{number}.dat"))
            one.write(shown[-1])
        else:
            shown.append(_folder(one))
    with reporting(progress) as report_to:
        _run("view", shown, options, report_to)


def report(*results: _Results, output: _Path, title: str | None = None, frames: int | None = None,
           test: str | Sequence[str] | None = None, measured: _Path | None = None, progress: _Progress = None) -> None:
    """Writes a self-contained page of results, as `crackle report OUT... -o report.html`.

    results: Results or their folders, or one Campaign. frames: show at most so many of a test, evenly chosen; of a
    campaign, test: those of its tests that are shown; measured: CSV file with axial_strain and axial_stress, drawn over
    the curves of its test.
    """
    options = dict(output=os.fspath(output), title=title, frames=frames, test=test, measured=measured)
    with reporting(progress) as report_to:
        _run("report", [_folder(one) for one in results], options, report_to)

