# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads results from their folders: tests, campaigns, calibrations, decks' runs, particle files."""
from __future__ import annotations

import html
import json
import os
import weakref
from typing import TYPE_CHECKING, Any

from . import _engine
from ._case import given_or_shipped
from ._commands import words_of
from ._errors import InputError, SystemFailure, printable

if TYPE_CHECKING:
    from ._tests import _Path


# Modules that few functions need are imported in these functions, so that importing crackle takes at most a tenth of a second.


class Table(dict):
    """Columns by name as numpy arrays or lists: table["axial_stress"], table.axial_stress, pandas.DataFrame(table)."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"found no column '{name}', expected one of {', '.join(self)}") from None

    def __dir__(self):
        return [*super().__dir__(), *self]

    def __repr__(self):
        rows = len(next(iter(self.values()))) if self else 0
        return printable(f"<crackle.Table: {rows} rows of {', '.join(self)}>")

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
    code, text = _engine.run_command(command, words_of(options) + ["--"] + [os.fspath(one) for one in operands], report)
    if code == 4:
        raise SystemFailure(f"{command}: tests of the campaign ended with a system error and are excluded from all means; "
                            "repeat the call that made the campaign to run them again")
    return code, text


def _figure_text(command, operands, options):
    """Text of an SVG figure drawn by the program."""
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
    """Page that shows Particles, made by `crackle view`."""
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
    """An SVG as an image element, since its internal names would collide with those of other figures on a page."""
    import base64

    return f'<img src="data:image/svg+xml;base64,{base64.b64encode(svg.encode()).decode()}">'


class Temporary:
    """A folder that is removed together with this object."""

    def __init__(self):
        import shutil
        import tempfile

        self.name = tempfile.mkdtemp(prefix="crackle-")
        self._removal = weakref.finalize(self, shutil.rmtree, self.name, ignore_errors=True)

    def keep(self):
        """Keeps the folder when this object is deleted."""
        self._removal.detach()


setattr(_engine.Particles, "_repr_html_", lambda self: _frame_of(_particles_page(self), 500))


def _read(folder, name):
    """Text of a file in a folder. Raises InputError if there is no such file or it is not UTF-8."""
    path = os.path.join(folder, name)
    try:
        with open(path, encoding="utf-8") as file:
            return file.read()
    except (FileNotFoundError, IsADirectoryError, NotADirectoryError) as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}), expected a file") from None
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: found the byte {error.object[error.start]:#04x} at {error.start}, expected UTF-8; "
                         "the file is damaged, recreate it") from None


def _not_a_number(word):
    raise ValueError(f"found {word}")


def _read_object(folder, name):
    """The JSON object in a file of a folder. Raises InputError if the file is missing or contains no object."""
    text = _read(folder, name)
    try:
        value = json.loads(text, parse_constant=_not_a_number)
    except (ValueError, RecursionError):
        value = None
    if not isinstance(value, dict):
        raise InputError(f"{os.path.join(folder, name)}: found no JSON object, expected one written by crackle; the file is "
                         "damaged, recreate it")
    return value


# SQLite pragmas that only read.
_LOOKING_PRAGMAS = ("index_info", "index_list", "table_info", "table_list", "table_xinfo")


def _reading_alone(action, first, second, *_):
    """SQLite authorizer that allows only reading: no ATTACH, VACUUM INTO, or pragma that changes a setting."""
    import sqlite3

    reads = (action in (sqlite3.SQLITE_SELECT, sqlite3.SQLITE_READ, sqlite3.SQLITE_RECURSIVE)
             or (action == sqlite3.SQLITE_FUNCTION and second != "load_extension")
             or (action == sqlite3.SQLITE_PRAGMA and first in _LOOKING_PRAGMAS))
    return sqlite3.SQLITE_OK if reads else sqlite3.SQLITE_DENY


class Recording:
    """Particles in motion: cells, their bonds, and frames with positions and forces.

    cells: dict of arrays, shape (cells,): id, material, x, y (m, in the first frame), radius (m, 0 for polygons),
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
        """Table with a row per cell."""
        if self._cells is None:
            self._cells = Table(self._recording.cells)
        return self._cells

    @property
    def bonds(self) -> Table:
        """Table with a row per bond."""
        if self._bonds is None:
            self._bonds = Table(self._recording.bonds)
        return self._bonds

    @property
    def frames(self) -> list[dict[str, Any]]:
        """Time, strain, stress, step and roles of each frame."""
        return self._recording.frames

    def frame(self, which: int | str) -> Table:
        """Table of a frame, given by its number or its role: "start", "peak", "end".

        By cell: ux, uy (m, since the first frame), angle (rad), vx, vy (m/s), rotation_rate (rad/s), stress_xx,
        stress_yy, stress_xy (N/m, compression positive), fragment. By bond: bond_normal_force, bond_shear_force (N),
        bond_state (0 intact, 1 slid, 2 broken, 3 touching again). For other contacts: contact_i, contact_j, contact_x,
        contact_y, contact_normal_force, contact_shear_force. Quantities that were not recorded are empty.
        """
        if isinstance(which, str):
            named = [k for k, head in enumerate(self.frames) if which in head["roles"]]
            if not named:
                raise InputError(f"frame: found no frame of '{which}', expected a number, start, peak or end")
            which = named[0]
        return Table(self._recording.frame(which))


class Result:
    """Results of a test, read from its folder.

    folder, summary (dict of summary.json, which states units), recording (cells and frames). curve, events, slips and
    emission are Tables of read-only arrays over the engine's memory, or None if the test has none.
    """

    def __init__(self, folder: _Path, *, temporary: Temporary | None = None) -> None:
        self.folder = os.fspath(folder)
        self._temporary = temporary  # removes the folder together with this object
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
        """Columns of curve.csv; `crackle test --files` lists them with their units."""
        return self._table("curve")

    @property
    def events(self) -> Table:
        """Columns of events.csv, a row per bond break; `mode` is 1 for shear, 0 for tension."""
        return self._table("events")

    @property
    def slips(self) -> Table | None:
        """Columns of slips.csv; None if the test has no such file."""
        return self._table("slips")

    @property
    def emission(self) -> Table | None:
        """Columns of ae.csv; None if the test has none. `type` is 0 for opening, 1 for shear, 2 for closing, 3 for none."""
        return self._table("emission")

    @property
    def recording(self) -> Recording:
        """Recording with the cells and frames of the test."""
        if self._recording is None:
            self._recording = Recording(_engine.read_recording(self.folder))
        return self._recording

    def figure(self, *what: str, **options: Any) -> str:
        """Text of an SVG figure from `crackle plot`: what = "curve", "ae", "emission", "strain", "specimen" (default:
        curve and specimen); options as in plot()."""
        return _figure_text("plot", [self.folder], {**options, "what": list(what) or ["curve", "specimen"]})

    def page(self) -> str:
        """Text of the interactive page from `crackle report`."""
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
        return printable(f"<crackle.Result: {self._line()}>")


def _numbers(column):
    """Numbers of a column of texts if all are numbers or empty; otherwise the texts."""
    try:
        return [float(one or "nan") for one in column]
    except ValueError:
        return column


class Campaign:
    """A campaign's folder: results (Table, a row per test), points() (Table, a row per point and figure), query(sql)."""

    def __init__(self, folder: _Path) -> None:
        self.folder = os.fspath(folder)
        self.ledger = os.path.join(self.folder, "campaign.sqlite")

    @property
    def results(self) -> Table:
        """Table of the view `results` in campaign.sqlite, a row per test."""
        return self.query("SELECT * FROM results")

    def points(self, *figures: str) -> Table:
        """Statistics over the packings of each point from `crackle campaign show --csv`: a row per point and figure.

        figures: names in summary.json, by default modulus, Poisson's ratio, strength and its strain. Columns: test, the axes,
        planned, done, gone_wrong, failed_by_system, not_failed, figure, unit, packings, mean, standard_deviation,
        standard_error, low_95, high_95. After a campaign with verify=True there are also the shifts of the mean by time step
        and rate. Missing numbers are nan.
        """
        import csv
        import io
        import re

        _, text = _run("campaign show", [self.folder], {"csv": True, "figure": list(figures) or None})
        names, *rows = csv.reader(io.StringIO(text, newline=""))
        texts = {"test", "figure", "unit"}
        # The program puts an apostrophe before cells that a spreadsheet would read as a formula; it is removed here.
        rows = [[re.sub(r"^'(?='*[=+\-@\t\r])", "", cell) for cell in row] for row in rows]
        return Table({name: [row[k] for row in rows] if name in texts else _numbers([row[k] for row in rows])
                      for k, name in enumerate(names)})

    def query(self, sql: str) -> Table:
        """Table with the result of an SQL query of campaign.sqlite, a single statement that only reads. Raises InputError if
        the statement is invalid or does more than read, or if a row has changed since it was written."""
        import contextlib
        import sqlite3
        import urllib.parse

        if not os.path.isfile(self.ledger):
            raise InputError(f"{self.ledger}: no such file, expected the ledger of a campaign")
        _engine.check_campaign(self.folder)
        address = f"file:{urllib.parse.quote(os.path.abspath(self.ledger))}?mode=ro"
        try:
            with contextlib.closing(sqlite3.connect(address, uri=True)) as ledger:
                ledger.set_authorizer(_reading_alone)
                cursor = ledger.execute(sql)
                if cursor.description is None:
                    raise InputError(f"query: found '{sql:.60}', expected a SELECT")
                names = [column[0] for column in cursor.description]
                rows = cursor.fetchall()
        except InputError:
            raise
        except (sqlite3.Error, sqlite3.Warning, ValueError) as error:
            system = (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_CANTOPEN, sqlite3.SQLITE_FULL, sqlite3.SQLITE_IOERR,
                      sqlite3.SQLITE_LOCKED, sqlite3.SQLITE_NOMEM)
            if (getattr(error, "sqlite_errorcode", None) or 0) & 0xff in system:
                raise
            raise InputError(f"{self.ledger}: found '{error}', expected an undamaged ledger and a single SELECT "
                             "statement on its tables") from error
        return Table({name: [row[k] for row in rows] for k, name in enumerate(names)})

    def figure(self, **options: Any) -> str:
        """Text of an SVG figure from `crackle plot`; options as in plot()."""
        return _figure_text("plot", [self.folder], options)

    def page(self) -> str:
        """Text of the page from `crackle report`."""
        return _page_text(self.folder)

    def _repr_html_(self):
        return _frame_of(self.page(), 700)

    def __repr__(self):
        return printable(f"<crackle.Campaign: {self.folder}>")


class Calibration:
    """A calibration's folder: outcome (dict: calibration.json), cases (paths by test)."""

    def __init__(self, folder: _Path) -> None:
        self.folder = os.fspath(folder)
        self.outcome: dict[str, Any] = _read_object(self.folder, "calibration.json")

    @property
    def cases(self) -> dict[str, str]:
        """Paths of the calibrated cases, by test."""
        folder = os.path.join(self.folder, "cases")
        return {name[:-5]: os.path.join(folder, name) for name in sorted(os.listdir(folder)) if name.endswith(".toml")}

    def page(self) -> str:
        """Text of calibration.html."""
        return _read(self.folder, "calibration.html")

    def _repr_html_(self):
        return _frame_of(self.page(), 700)

    def __repr__(self):
        return printable(f"<crackle.Calibration: {self.folder}>")


def read(path: _Path) -> Result | Campaign | Calibration | Recording | _engine.Particles:
    """Reads results. Returns a Result for a test's folder, a Campaign or Calibration for theirs, a Recording for the run of a deck,
    and Particles for a particle file. Raises InputError for any other path."""
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
