# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the files of a test (specimens/results/FILES.md): case, specimen, curve, events, frames, summary.

Uses only numpy and the standard library, no code of the program."""

import base64
import csv
import json
import math
import re
import tomllib
import zlib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np


class Unreadable(Exception):
    """Raised for a file that is missing or differs from FILES.md; the message names it and a remedy."""


@dataclass
class Body:
    """One rigid body: a circle, a clump of circles, or a polygon (corners counter-clockwise)."""

    id: int
    material: int
    circles: np.ndarray | None = None  # rows x, y, radius [m]
    corners: np.ndarray | None = None  # rows x, y [m]


@dataclass
class Deck:
    """A specimen in the layout of in_gm.dat (solver/demseg/FORMATS.md)."""

    materials: list[dict]
    x1: float
    x2: float
    y1: float
    y2: float
    thick: float
    bodies: list[Body] = field(default_factory=list)

    @property
    def width(self):
        return self.x2 - self.x1

    @property
    def height(self):
        return self.y2 - self.y1


def read_deck(path):
    if not path.is_file():
        return None
    words = iter(path.read_text().split())

    def real():
        return float(next(words))

    def whole():
        return int(next(words))

    for _ in range(3):
        whole()
    for _ in range(3):
        real()
    names = ("density", "normal_stiffness", "shear_stiffness", "normal_damping", "shear_damping", "friction_angle")
    materials = [{name: real() for name in names} for _ in range(whole())]
    deck = Deck(materials, real(), real(), real(), real(), real())
    circles, small, large = whole(), whole(), whole()
    for number in range(circles + small + large):
        body = Body(whole(), whole() - 1)
        elements = whole()
        for _ in range(3):
            real()
        if number < circles:
            rows = []
            for _ in range(elements):
                whole()
                radius = real()
                rows.append((real(), real(), radius))
                real()
            body.circles = np.array(rows)
        else:
            rows = []
            for _ in range(elements):
                whole()
                rows.append((real(), real()))
                real(), real()
            corners = np.array(rows)
            x, y = corners.T
            if np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) < 0:
                corners = corners[::-1]
            body.corners = corners
        deck.bodies.append(body)
    return deck


def read_table(path):
    """Columns of a CSV file by name: numbers as arrays, words as lists."""
    with path.open(newline="") as lines:
        rows = list(csv.reader(lines))
    head, rows = rows[0], rows[1:]
    table = {}
    for k, name in enumerate(head):
        column = [row[k] for row in rows]
        try:
            table[name] = np.array([float(word) for word in column])
        except ValueError:
            table[name] = column
    return table


_types = {"Float64": "<f8", "Float32": "<f4", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1"}
_array = re.compile(r"<DataArray ([^>]*)>([^<]*)</DataArray>")
_attribute = re.compile(r'(\w+)="([^"]*)"')


def _unpack(text, kind):
    """Decodes an inline VTK array: a header with the sizes of blocks, followed by the blocks, compressed with zlib."""
    text = text.strip()
    count = int.from_bytes(base64.b64decode(text[:12])[:8], "little")
    header_letters = 4 * math.ceil(8 * (3 + count) / 3)
    header = np.frombuffer(base64.b64decode(text[:header_letters])[: 8 * (3 + count)], "<u8")
    data = base64.b64decode(text[header_letters:])
    blocks, at = [], 0
    for size in header[3:]:
        blocks.append(zlib.decompress(data[at : at + int(size)]))
        at += int(size)
    return np.frombuffer(b"".join(blocks), _types[kind])


def read_vtp(path):
    """Arrays of a .vtp file by name. Field data are numbers; arrays with three components have a row for each point or cell."""
    arrays = {}
    text = path.read_text()
    for attributes, values in _array.findall(text):
        a = dict(_attribute.findall(attributes))
        if a.get("format") == "binary":
            array = _unpack(values, a["type"])
        else:
            array = np.array([float(word) for word in values.split()])
        if int(a.get("NumberOfComponents", 1)) == 3:
            array = array.reshape(-1, 3)
        name = a["Name"]
        arrays[name if name not in arrays else "polygon " + name] = array
    return arrays


@dataclass
class Frame:
    """One frame: particles, contacts and cracks, each with the array names of FILES.md."""

    row: int
    particles: dict
    contacts: dict
    cracks: dict

    def __getattr__(self, name):
        if name in ("axial_strain", "axial_stress", "time"):
            return float(self.particles[name][0])
        raise AttributeError(name)


class Results:
    """All results in an output folder."""

    def __init__(self, folder):
        self.folder = Path(folder)
        for name in ("case.toml", "curve.csv", "events.csv", "summary.json"):
            if not (self.folder / name).is_file():
                raise Unreadable(f"{self.folder}: found no {name}, expected the results of crackle test; check the path")
        self.case = tomllib.loads((self.folder / "case.toml").read_text())
        try:
            self.summary = json.loads((self.folder / "summary.json").read_text())
        except json.JSONDecodeError as error:
            raise Unreadable(f"{self.folder}/summary.json: found broken JSON ({error}), expected that of a test; "
                             "run the test again") from error
        self.curve = read_table(self.folder / "curve.csv")
        self.events = read_table(self.folder / "events.csv")
        slips = self.folder / "slips.csv"
        self.slips = read_table(slips) if slips.is_file() else None
        emission = self.folder / "ae.csv"
        self.emission = read_table(emission) if emission.is_file() else None
        if len(self.curve.get("step", [])) < 2:
            raise Unreadable(f"{self.folder}/curve.csv: found fewer than two rows, expected those of a test that was loaded; "
                             "--resume goes on with it")
        self.circles = read_deck(self.folder / "specimen_circles.dat")
        self.polygons = read_deck(self.folder / "specimen_polygons.dat")
        if self.circles is None and self.polygons is None:
            raise Unreadable(
                f"{self.folder}: found neither specimen_circles.dat nor specimen_polygons.dat, expected one; "
                "these are results of an older version: run the test again"
            )

    @property
    def specimen(self):
        return self.polygons or self.circles

    def key(self, table, name, otherwise=None):
        return self.case.get(table, {}).get(name, otherwise)

    def frame_rows(self):
        files = sorted((self.folder / "frames").glob("particles_*.vtp"), key=lambda f: int(f.stem.split("_")[1]))
        if not files:
            raise Unreadable(f"{self.folder}/frames: found no frame, expected those of the test; run it again")
        return [int(f.stem.split("_")[1]) for f in files]

    def particles(self, row):
        return read_vtp(self.folder / f"frames/particles_{row:05d}.vtp")

    def contacts(self, row):
        return read_vtp(self.folder / f"frames/contacts_{row:05d}.vtp")

    def joints(self, row):
        """Faces on the traces of a jointed specimen."""
        return read_vtp(self.folder / f"frames/joints_{row:05d}.vtp")

    def frame(self, row):
        read = [read_vtp(self.folder / f"frames/{kind}_{row:05d}.vtp") for kind in ("particles", "contacts", "cracks")]
        return Frame(row, *read)
