# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands as functions; the options of `crackle COMMAND --help` are keywords with the same units and defaults."""
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
    """Packs random circles between four smooth walls to mechanical equilibrium, like `crackle pack`.

    Give count, or width and height (m). Give sizes by radius_min and radius_max (m), lognormal_median (m) and
    lognormal_deviation, or sieve (CSV file). Give the target mean_overlap (m) or void_ratio. Material of the file: density
    (kg/m2), normal_stiffness, shear_stiffness (N/m), friction_angle (degrees). The same seed gives the same bytes for
    any number of threads.

    Returns Particles. With output the file is written, too (InputError if it exists, unless force is true).
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
    """Makes polygons from the centres of circles, like `crackle mesh`.

    particles: Particles, the path of a particle file, or a sequence of centres x, y (m; with domain = (x1, x2, y1, y2)
    or bounding_box). kind: "delaunay" or "voronoi". thick: gap between facing edges, m (default: thick of the
    particles). inset, m. boundary: "domain" or "centres". merge: merge cells that the inset destroys into neighbours.
    joints: a file of joints (`crackle joints`), whose traces become edges.

    Returns Particles. With output the file is written, too.
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


def specimen(case: _Case, *, threads: int | None = None, progress: _Progress = None) -> _engine.Particles:
    """Makes the specimen of a case: packed or read, cut to the shape of its test, meshed if the case has a mesh.

    Nothing is bonded yet: World(case) does that. threads: number of threads; results do not depend on it.
    Returns Particles. Raises InputError.
    """
    with reporting(progress) as report:
        return _engine.specimen(read_case(case), _threads(threads), report)


def joints(case: _Case, *, seed: int | None = None, box_width: float | None = None, box_height: float | None = None,
           grain: float | None = None, traces: _Path | None = None, output: _Path | None = None,
           columns: int | None = None, width: float | None = None, font: str | None = None,
           font_size: float | None = None, dpi: int | None = None, title: str | None = None,
           force: bool = False) -> dict[str, Any]:
    """Generates or reads traces of joints in the box of a specimen, like `crackle joints --json`.

    case: a case that has joints, or a dict, a TOML text or a file with joints only. seed: replaces joints.seed.
    box_width, box_height: size of the box, m, if the case states none. grain: mean spacing of the grains, m; prepares
    the traces as for a mesh of such grains. traces: a file to write, one trace per line (x1 y1 x2 y2 ..., m). output: a figure to
    write, .svg, .pdf or .png, width in mm. Returns a dict of requested and reached amounts, which states units.
    """
    options = dict(seed=seed, box_width=box_width, box_height=box_height, grain=grain, traces=traces, output=output,
                   columns=columns, width=width, font=font, font_size=font_size, dpi=dpi, title=title, force=force,
                   json=True)
    path = given_or_shipped(case) if isinstance(case, (str, os.PathLike)) else ""
    name = path if os.path.exists(path) else "case"
    _, text = _engine.run_joints(read_joints(case), name, words_of(options))
    return json.loads(text)


def _refuse_replacing(output, force, *inputs):
    """Refuses an output that exists and must not be replaced, or that is one of the inputs. Called before any work is done."""
    if output is not None:
        _engine.refuse_replacing(os.fspath(output), bool(force), [os.fspath(one) for one in inputs if one is not None])


class Elastic(dict):
    """The object that `crackle elastic --json` prints, which states units, with two attributes.

    bonds: an array of shape (bonds,) with the fields body_i, body_j (ids), position (x, y in m), strength (N), overlap,
    closing (m), normal_force, shear_force (N), break_strain and slip_strain (inf: never). Forces are those at the
    requested strain. The shear force acts on body_i, along the normal from i to j turned by +90 degrees.
    notices: a list of texts, for example on parts of the case that the solution ignores."""

    bonds: Any = None
    notices: Sequence[str] = ()


def elastic(case: _Case, *, strain: float = 1e-4, modes: int = 0, progress: _Progress = None) -> Elastic:
    """Computes small-strain moduli, first break and slip and stable time step by a sparse solve, like `crackle elastic`.

    strain: axial strain for the forces in `bonds`; modes: number of lowest vibration modes to find. Returns Elastic.
    """
    with reporting(progress) as report:
        text, bonds, notices = _engine.elastic(read_case(case), strain, modes, report)
    found = Elastic(json.loads(text))
    found.bonds, found.notices = bonds, notices
    return found


def check(case: _Case, *, threads: int | None = None, progress: _Progress = None) -> dict[str, Any]:
    """Estimates results and cost of a test, like `crackle test --check --json`. Returns a dict, which states units."""
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
    """Checks that a value is a whole number (of Python or numpy) from 1 to below `beyond`, and returns it as an int."""
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
    """Runs one virtual test, like `crackle test CASE -o OUT`, with identical results.

    case: a dict, a TOML text or the path of a file. output: folder for the results. If None, a temporary folder is
    removed together with the Result, but kept if the test does not run to its end; the exception then names it. force:
    replace existing results. verify: also run companion tests, to state errors of strength and strain. profile: time the
    phases of a step. threads: number of threads; results do not depend on it. long: run the test even if it takes more
    than a day. allow_unstable: accept a time step above the stability limit.

    call: a function called with the State of the test. every = "row": at each row that is used to judge peak and failure
    (curve.csv has about output.curve_rows of them); every = N: at each multiple of N steps. It is not called at the row at
    which the test ends by itself. It may read arrays, set state.platen_speed, and end the test with state.stop(). If it raises an
    exception, the test ends as by Ctrl-C: results so far are kept, and resume() continues it.

    Returns Result. Raises InputError, UnstableRun (results so far are kept), KeyboardInterrupt.
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
            tell(error, f"results so far are kept in {os.fspath(output)}; crackle.read reads them, and crackle.resume "
                        "resumes an interrupted test")
        raise
    return Result(folder, temporary=temporary)


def resume(folder: _Path, *, verify: bool = False, threads: int | None = None, long: bool = False,
           every: int | str = "row", call: Callable[[_engine.State], Any] | None = None,
           progress: _Progress = None) -> Result:
    """Resumes an interrupted test, like `crackle test --resume OUT`. Keywords are those of test(). Returns Result."""
    options = _options(folder, False, verify, False, long, threads)
    with reporting(progress) as report:
        folder, _, _ = _engine.resume_test(options, report, call, _every(every))
    return Result(folder)


def campaign(plan: _Path, output: _Path, *, workers: int | None = None, verify: bool = False, retry: bool = False,
             shard: str | tuple[int, int] | None = None, long: bool = False, progress: _Progress = None) -> Campaign:
    """Runs a table of tests on several processors, like `crackle campaign PLAN -o DIR`. If stopped, the same call resumes it.

    plan: path of a TOML file (`crackle campaign --keys` lists its keys). workers: processes that run tests; by default
    one per available processor. verify: also run each test at half the time step and at half the rate. retry: repeat
    tests that ended without a result because of their case; tests that ended with a system error are always repeated.
    shard: (I, N) runs share I of N. long: run tests even if they take more than a day.

    Returns Campaign. Raises InputError, SystemFailure if tests ended with a system error (the same call repeats them),
    KeyboardInterrupt (finished tests are kept).
    """
    if shard is not None and not isinstance(shard, str):
        shard = f"{shard[0]}/{shard[1]}"
    options = dict(output=os.fspath(output), workers=workers, verify=verify, retry=retry, shard=shard, long=long)
    _run_long("campaign", plan, options, progress)
    return Campaign(output)


def calibrate(rock: _Path, output: _Path, *, workers: int | None = None, retry: bool = False, long: bool = False,
              progress: _Progress = None) -> Calibration:
    """Finds values for the free keys of a rock from laboratory results, like `crackle calibrate ROCK -o DIR`. If stopped, the same call resumes it.

    rock: path of a TOML file (`crackle calibrate --keys` lists its keys). workers: processes that run tests; by default
    one per available processor. retry: repeat tests that ended without a result because of their case. long: run
    tests even if they take more than a day.

    Returns Calibration, whether or not all targets were reached. Raises InputError, SystemFailure if tests ended with
    a system error (the same call repeats them), KeyboardInterrupt (finished tests are kept).
    """
    _run_long("calibrate", rock, dict(output=os.fspath(output), workers=workers, retry=retry, long=long),
              progress)
    return Calibration(output)


def _run_long(command, file, options, progress):
    """Runs a command that resumes where it was stopped."""
    try:
        with reporting(progress) as report:
            code, _ = _run(command, [given_or_shipped(file)], options, report)
        if code not in (0, 1):
            raise KeyboardInterrupt
    except InputError:
        raise
    except BaseException as error:  # Ctrl-C, or an exception raised by progress
        tell(error, f"finished work is kept in {options['output']}; the same call resumes")
        raise


def _folder(one):
    if hasattr(one, "folder"):
        return one.folder
    if isinstance(one, (str, os.PathLike)):
        return given_or_shipped(one)
    raise InputError(f"results: found a {type(one).__name__}, expected Results, Campaigns or paths of folders")


def envelope(*folders: _Results, figure: str | None = None, strain: float | None = None, measured: _Path | None = None,
             output: _Path | None = None, columns: int | None = None, width: float | None = None, font: str | None = None,
             font_size: float | None = None, dpi: int | None = None, title: str | None = None,
             force: bool = False) -> dict[str, Any]:
    """Fits Mohr-Coulomb and Hoek-Brown to tests and campaigns at several confinements, like `crackle envelope --json`.

    folders: paths, Results or Campaigns. figure: key of summary.json whose stress is used as the strength: "peak_stress", or
    "largest_stress" for specimens that harden. strain: use the stress at this axial strain as the strength instead.
    measured: a table of measured strengths. output: a figure to write, .svg, .pdf or .png. Returns a dict, which states units.
    """
    options = dict(figure=figure, strain=strain, measured=measured, output=output, columns=columns, width=width, font=font,
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
    """Draws a figure for a paper (.svg, .pdf or .png), like `crackle plot OUT... -o FIGURE`.

    results: Results, Campaigns or their folders, or folders of decks' runs. what: words among "curve", "ae",
    "emission", "strain", "specimen" and "forces". A campaign has "curve", "axes" and "scatter"; a deck has "energy", "displacement",
    "height", "velocity", "force" and "curve". at: strains, or "start", "peak", "end". width in mm. magnify:
    magnification of displacements. For the run of a deck, units ("si", "cgs" or "mm-g-s") names its units, and bodies lists the
    ids of the bodies to draw.
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
    """Writes a page that shows particles at rest or in motion, like `crackle view IN... -o view.html`.

    particles: Particles, Results, or paths of particle files and of folders of tests and decks' runs. frames: largest
    number of frames of each, evenly spaced. seed: seed of the circles that a particle file of mode 0 draws. units: "si",
    "cgs" or "mm-g-s", the names of the units of particle files and decks.
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
    """Writes a self-contained page of results, like `crackle report OUT... -o report.html`.

    results: Results or their folders, or one Campaign. frames: largest number of frames per test, evenly spaced. For
    a campaign, test names the tests to show, and measured is a CSV file with axial_strain and axial_stress, drawn over the
    curves of its test.
    """
    options = dict(output=os.fspath(output), title=title, frames=frames, test=test, measured=measured)
    with reporting(progress) as report_to:
        _run("report", [_folder(one) for one in results], options, report_to)

