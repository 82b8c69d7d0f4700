# SPDX-License-Identifier: GPL-3.0-or-later
"""Results in their folders: tests, campaigns, calibrations, decks' runs, particle files."""
from __future__ import annotations

import html
import json
import os
import weakref
from typing import TYPE_CHECKING, Any

from . import _engine
from ._case import given_or_shipped
from ._commands import words_of
from ._errors import InputError

if TYPE_CHECKING:
    from ._tests import _Path


# What few calls need is imported by them: an import of crackle is to cost a tenth of a second at most.


class Table(dict):
    """Columns by name, arrays of numpy or lists: table["axial_stress"], table.axial_stress; pandas.DataFrame(table)."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"found no column '{name}', expected one of {', '.join(self)}") from None

    def __dir__(self):
        return [*super().__dir__(), *self]

    def __repr__(self):
        rows = len(next(iter(self.values()))) if self else 0
        return f"<crackle.Table: {rows} rows of {', '.join(self)}>"

    def _repr_html_(self):
        shown = 10
        names = "".join(f"<th>{html.escape(name)}</th>" for name in self)
        rows = list(zip(*(column[:shown] for column in self.values())))
        body = "".join("<tr>" + "".join(f"<td>{html.escape(format(v, '.6g') if isinstance(v, float) else str(v))}</td>"
                                        for v in row) + "</tr>" for row in rows)
        total = len(next(iter(self.values()))) if self else 0
        rest = f"<p>{total} rows, the first {len(rows)} shown</p>" if total > len(rows) else ""
        return f"<table><thead><tr>{names}</tr></thead><tbody>{body}</tbody></table>{rest}"


def _run(command, operands, options, report=None):
    return _engine.run_command(command, words_of(options) + ["--"] + [os.fspath(one) for one in operands], report)


def _figure_text(command, operands, options):
    """An SVG by the program's own figures."""
    scratch = Temporary()
    output = os.path.join(scratch.name, "figure.svg")
    _run(command, operands, {**options, "output": output})
    with open(output, encoding="utf-8") as file:
        return file.read()


def _page_text(folder):
    scratch = Temporary()
    output = os.path.join(scratch.name, "page.html")
    _run("report", [folder], {"output": output})
    with open(output, encoding="utf-8") as file:
        return file.read()


def _particles_page(particles):
    """Of Particles, by `crackle view`."""
    scratch = Temporary()
    shown, output = os.path.join(scratch.name, "particles.dat"), os.path.join(scratch.name, "page.html")
    particles.write(shown)
    _run("view", [shown], {"output": output, "title": f"{len(particles)} bodies"})
    with open(output, encoding="utf-8") as file:
        return file.read()


def _frame_of(page, height):
    return (f'<iframe srcdoc="{html.escape(page, quote=True)}" style="width:100%;height:{height}px;border:0"'
            ' sandbox="allow-scripts allow-downloads"></iframe>')


def _image_of(svg):
    """An SVG as an image: names within it would collide with those of other figures on a page."""
    import base64

    return f'<img src="data:image/svg+xml;base64,{base64.b64encode(svg.encode()).decode()}">'


class Temporary:
    """A folder that goes with this object."""

    def __init__(self):
        import shutil
        import tempfile

        self.name = tempfile.mkdtemp(prefix="crackle-")
        self._removal = weakref.finalize(self, shutil.rmtree, self.name, ignore_errors=True)

    def keep(self):
        """The folder stays."""
        self._removal.detach()


setattr(_engine.Particles, "_repr_html_", lambda self: _frame_of(_particles_page(self), 500))


class Recording:
    """Particles in motion: cells, their bonds, and frame by frame where they are and what acts.

    cells: dict of arrays, shape (cells,): id, material, x, y (m, in the first frame), radius (m, 0 of polygons),
    platen; outline: a list of arrays of corners x, y (m).
    bonds: dict of arrays, shape (bonds,): i, j (indices of cells), x, y (m).
    frames: list of dicts: time (s), axial_strain, axial_stress, step, roles ("start", "peak", "end"), file.
    """

    def __init__(self, recording: _engine.Recording) -> None:
        self._recording = recording
        self._cells: Table | None = None
        self._bonds: Table | None = None

    @property
    def cells(self) -> Table:
        """Columns, a row a cell."""
        if self._cells is None:
            self._cells = Table(self._recording.cells)
        return self._cells

    @property
    def bonds(self) -> Table:
        """Columns, a row a bond."""
        if self._bonds is None:
            self._bonds = Table(self._recording.bonds)
        return self._bonds

    @property
    def frames(self) -> list[dict[str, Any]]:
        """What each frame is of."""
        return self._recording.frames

    def frame(self, which: int | str) -> Table:
        """Table of arrays of a frame, by number, or by role: "start", "peak", "end".

        By cell: ux, uy (m, since the first frame), angle (rad), vx, vy (m/s), rotation_rate (rad/s), stress_xx,
        stress_yy, stress_xy (N/m, compression positive), fragment. By bond: bond_normal_force, bond_shear_force (N),
        bond_state (0 intact, 1 slid, 2 broken, 3 touching again). Of other contacts: contact_i, contact_j, contact_x,
        contact_y, contact_normal_force, contact_shear_force. Empty where it is not recorded.
        """
        if isinstance(which, str):
            named = [k for k, head in enumerate(self.frames) if which in head["roles"]]
            if not named:
                raise InputError(f"frame: found no frame of '{which}', expected a number, start, peak or end")
            which = named[0]
        return Table(self._recording.frame(which))


class Result:
    """A test's results, from its folder.

    folder, summary (dict: summary.json, its own units within), curve, events, slips, emission (Table of arrays over the
    engine's memory, read-only; None where the test has none), recording (cells and frames).
    """

    def __init__(self, folder: _Path, *, temporary: Temporary | None = None) -> None:
        self.folder = os.fspath(folder)
        self._temporary = temporary  # the folder goes with this object
        self._results = _engine.read_results(self.folder)
        self.summary: dict[str, Any] = json.loads(self._results.summary)
        self._tables: dict[str, Table | None] = {}
        self._recording: Recording | None = None

    def _table(self, name: str) -> Any:
        if name not in self._tables:
            columns = getattr(self._results, name)
            self._tables[name] = None if columns is None else Table(columns)
        return self._tables[name]

    @property
    def curve(self) -> Table:
        """curve.csv: `crackle test --files` lists its columns with their units."""
        return self._table("curve")

    @property
    def events(self) -> Table:
        """events.csv, a row a bond break; `mode` 1 for shear, 0 for tension."""
        return self._table("events")

    @property
    def slips(self) -> Table | None:
        """slips.csv, or None."""
        return self._table("slips")

    @property
    def emission(self) -> Table | None:
        """ae.csv, `type` 0 to 3 for opening, shear, closing, none; or None."""
        return self._table("emission")

    @property
    def recording(self) -> Recording:
        """Its cells and frames (Recording)."""
        if self._recording is None:
            self._recording = Recording(_engine.read_recording(self.folder))
        return self._recording

    def figure(self, *what: str, **options: Any) -> str:
        """Text of an SVG figure, by `crackle plot`: what = "curve", "ae", "emission", "strain", "specimen" (default:
        curve and specimen); options as of plot()."""
        return _figure_text("plot", [self.folder], {**options, "what": list(what) or ["curve", "specimen"]})

    def page(self) -> str:
        """Text of the interactive page, by `crackle report`."""
        return _page_text(self.folder)

    def _repr_svg_(self):
        return self.figure()

    def _repr_html_(self):
        return (f"<p>{html.escape(self._line())}</p>{_image_of(self.figure())}"
                f"<details><summary>interactive page</summary>{_frame_of(self.page(), 700)}</details>")

    def _line(self):
        s = self.summary
        failed = s.get("failed")
        key = "peak_stress" if failed else "peak_stress_so_far"
        unit = "Pa" if s.get("material_units") == "area" else "N/m"
        stress = s.get(key)
        shown = "-" if stress is None else f"{stress:.4g} {unit}"
        return (f"{s['specimen']}, {s['kind']}: {'strength' if failed else 'largest stress so far'} {shown}, "
                f"{s.get('bonds_broken')} of {s.get('bonds_initial')} bonds broken, ended by {s.get('ended_by')}")

    def __repr__(self):
        return f"<crackle.Result: {self._line()}>"


def _numbers(column):
    """Of a column of texts, where all of it are numbers or nothing; else the texts."""
    try:
        return [float(one or "nan") for one in column]
    except ValueError:
        return column


class Campaign:
    """A campaign's folder: results (Table, a row a test), points() (Table, a row a point and figure), query(sql)."""

    def __init__(self, folder: _Path) -> None:
        self.folder = os.fspath(folder)
        self.ledger = os.path.join(self.folder, "campaign.sqlite")

    @property
    def results(self) -> Table:
        """The view `results` of campaign.sqlite, a row a test."""
        return self.query("SELECT * FROM results")

    def points(self, *figures: str) -> Table:
        """What the packings of each point say, by `crackle campaign show --csv`: a row a point and figure.

        figures: of summary.json, by default modulus, Poisson's ratio, strength and its strain. Columns: test, the axes,
        planned, done, gone_wrong, not_failed, figure, unit, packings, mean, standard_deviation, standard_error, low_95,
        high_95, and with companions what step and rate shift the mean by; nan where there is no number.
        """
        import csv
        import io

        _, text = _run("campaign show", [self.folder], {"csv": True, "figure": list(figures) or None})
        names, *rows = csv.reader(io.StringIO(text, newline=""))
        texts = {"test", "figure", "unit"}
        return Table({name: [row[k] for row in rows] if name in texts else _numbers([row[k] for row in rows])
                      for k, name in enumerate(names)})

    def query(self, sql: str) -> Table:
        """Table of what an SQL query of campaign.sqlite gives."""
        import sqlite3

        with sqlite3.connect(f"file:{self.ledger}?mode=ro", uri=True) as ledger:
            cursor = ledger.execute(sql)
            names = [column[0] for column in cursor.description]
            rows = cursor.fetchall()
        return Table({name: [row[k] for row in rows] for k, name in enumerate(names)})

    def figure(self, **options: Any) -> str:
        """Text of an SVG figure, by `crackle plot`; options as of plot()."""
        return _figure_text("plot", [self.folder], options)

    def page(self) -> str:
        """Text of the page, by `crackle report`."""
        return _page_text(self.folder)

    def _repr_html_(self):
        return _frame_of(self.page(), 700)

    def __repr__(self):
        return f"<crackle.Campaign: {self.folder}>"


class Calibration:
    """A calibration's folder: outcome (dict: calibration.json), cases (paths by test)."""

    def __init__(self, folder: _Path) -> None:
        self.folder = os.fspath(folder)
        with open(os.path.join(self.folder, "calibration.json"), encoding="utf-8") as file:
            self.outcome: dict[str, Any] = json.load(file)

    @property
    def cases(self) -> dict[str, str]:
        """Paths of the cases that it ends with, by test."""
        folder = os.path.join(self.folder, "cases")
        return {name[:-5]: os.path.join(folder, name) for name in sorted(os.listdir(folder)) if name.endswith(".toml")}

    def page(self) -> str:
        """Text of calibration.html."""
        with open(os.path.join(self.folder, "calibration.html"), encoding="utf-8") as file:
            return file.read()

    def _repr_html_(self):
        return _frame_of(self.page(), 700)

    def __repr__(self):
        return f"<crackle.Calibration: {self.folder}>"


def read(path: _Path) -> Result | Campaign | Calibration | Recording | _engine.Particles:
    """What a path holds: Result of a test's folder, Campaign, Calibration, Recording of a deck's run, Particles of a
    particle file. Raises InputError where it is none."""
    there = given_or_shipped(path)
    if os.path.isfile(there):
        return _engine.read_particles(there)
    if os.path.isfile(os.path.join(there, "calibration.json")):
        return Calibration(there)
    if os.path.isfile(os.path.join(there, "campaign.sqlite")):
        return Campaign(there)
    if os.path.isfile(os.path.join(there, "summary.json")):
        return Result(there)
    return Recording(_engine.read_recording(there))
