#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that VTK reads every file of a test's frames with the expected contents.

  CRACKLE_PROGRAM    the program
  FRAME_ARRAYS       tests/support/frame_arrays_main.cpp
Three small specimens are loaded until they fail: circles, triangles, Voronoi cells.
- Every array of every file is the same by VTK's reader and by our own (minimum, maximum, sum).
- At the end of the test, arrays agree with the solver's state in the checkpoint, and cracks with events.csv.
- A picture rendered by VTK covers the same area as the discs and outlines of that state, and as the figure of `crackle plot`.
Needs Debian's python3-vtk9 and python3-numpy, and xvfb for VTK's window.
"""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

CASE = """
[packing]
count = 60
radius_min = 1.3e-2
radius_max = 2.7e-2
mean_overlap = 7.74e-5
seed = 3
[material]
density = 2500
normal_stiffness = 1.0e7
shear_stiffness = 2.5e6
friction_angle = 27
damping_ratio = 0.3
{mesh}
[loading]
kind = "{kind}"
axial_strain_rate = 0.05
max_axial_strain = 0.012
[output]
frames = 12
"""
MESH = '[mesh]\nkind = "{}"\nthick = 1.0e-3\n[bond]\nthick = 1.08e-3\n'
SPECIMENS = {"circles": CASE.format(mesh="", kind="compression"),
             "delaunay": CASE.format(mesh=MESH.format("delaunay"), kind="compression"),
             "voronoi": CASE.format(mesh=MESH.format("voronoi"), kind="tension")}
ARRAYS = {"particles": {"id", "radius", "material", "angle", "displacement", "velocity", "rotation_rate", "stress_xx", "stress_yy",
                        "stress_xy", "fragment"},
          "contacts": {"body_i", "body_j", "normal_force", "shear_force", "state", "age"},
          "cracks": {"body_i", "body_j", "time", "mode", "energy", "orientation", "strength", "opening"}}
PIXELS = 900  # width and height of a picture
TOLERANCE = 1e-12  # error relative to the values of an array
# Forces are computed from positions and rotations, so their error is k_n times the rounding of coordinates and of
# accumulated rotations.
STATE_TOLERANCE = 1e-9


def read(file):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    assert reader.GetErrorCode() == 0, f"{file}: VTK cannot read it"
    return reader.GetOutput()


def described(values):
    values = numpy.asarray(values, dtype=float).ravel()
    if values.size == 0:
        return [0.0, 0.0, 0.0, 0.0]
    return [values.min(), values.max(), math.fsum(values), math.fsum(abs(values))]


def arrays_of(data):
    """Cell data by name, as numpy arrays."""
    cells = data.GetCellData()
    return {cells.GetArrayName(k): vtk_to_numpy(cells.GetArray(k)) for k in range(cells.GetNumberOfArrays())}


def view_of(shapes):
    """(centre x, centre y, half the side) of a square picture around discs and polygons."""
    low = numpy.min([numpy.min(s, axis=0) if s.ndim == 2 else s[:2] - s[2] for s in shapes], axis=0)
    high = numpy.max([numpy.max(s, axis=0) if s.ndim == 2 else s[:2] + s[2] for s in shapes], axis=0)
    return (*(0.5 * (low + high)), 0.52 * max(high - low))


def covered_by(shapes, view):
    """Silhouette by our own code: a pixel is covered if its centre lies in a disc (x, y, r) or a convex polygon (corners)."""
    x0, y0, half = view
    step = 2.0 * half / PIXELS
    picture = numpy.zeros((PIXELS, PIXELS), dtype=bool)
    for shape in shapes:
        low, high = ((shape[:2] - shape[2], shape[:2] + shape[2]) if shape.ndim == 1 else
                     (shape.min(axis=0), shape.max(axis=0)))
        columns = numpy.arange(max(0, int((low[0] - x0 + half) / step)), min(PIXELS, int((high[0] - x0 + half) / step) + 2))
        rows = numpy.arange(max(0, int((low[1] - y0 + half) / step)), min(PIXELS, int((high[1] - y0 + half) / step) + 2))
        x, y = numpy.meshgrid(x0 - half + (columns + 0.5) * step, y0 - half + (rows + 0.5) * step)
        if shape.ndim == 1:
            inside = (x - shape[0]) ** 2 + (y - shape[1]) ** 2 <= shape[2] ** 2
        else:
            inside = numpy.ones_like(x, dtype=bool)
            for (ax, ay), (bx, by) in zip(shape, numpy.roll(shape, -1, axis=0)):  # counter-clockwise
                inside &= (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0.0
        picture[numpy.ix_(rows, columns)] |= inside
    return picture


def drawn_by_plot(folder, picture):
    """Pixels of our figure: particles with edges, particles without edges, cracks. Rows are in VTK's order. Particles are warm grey (light
    inside, dark edges), platens and letters cold grey."""
    subprocess.run([os.environ["CRACKLE_PROGRAM"], "plot", folder, "--what", "specimen", "--at", "end", "--width", "85", "--dpi", "900",
                    "-o", picture, "--quiet"], check=True)
    reader = vtkPNGReader()
    reader.SetFileName(str(picture))
    reader.Update()
    image = reader.GetOutput()
    columns, rows, _ = image.GetDimensions()
    colours = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, -1).astype(int)
    warmth = colours[:, :, 0] - colours[:, :, 2]
    covered = (warmth >= 9) & (warmth <= 40)
    full = covered.sum(axis=1)
    specimen = (full >= 0.1 * full.max())[:, None]  # without the key below
    covered &= specimen
    return covered, covered & (colours[:, :, 0] > 215), ((warmth < -15) | (warmth > 40)) & specimen


def extent_of(picture):
    """First row, first column and height of the covered area."""
    rows, columns = numpy.nonzero(picture)
    return rows.min(), columns.min(), rows.max() + 1 - rows.min()


def laid_over(silhouette, picture, other):
    """The picture, moved and scaled such that the silhouette's first row, first column and height agree with those of the other."""
    (first_row, first_column, height), (onto_row, onto_column, as_high) = extent_of(silhouette), extent_of(other)
    row, column = numpy.indices(other.shape)
    from_row = numpy.floor(first_row + (row + 0.5 - onto_row) * height / as_high).astype(int)
    from_column = numpy.floor(first_column + (column + 0.5 - onto_column) * height / as_high).astype(int)
    inside = (from_row >= 0) & (from_row < picture.shape[0]) & (from_column >= 0) & (from_column < picture.shape[1])
    moved = numpy.zeros_like(other)
    moved[inside] = picture[from_row[inside], from_column[inside]]
    return moved


def render(file, view, picture):
    """Renders the polygons of a particles file white on black, and saves the white pixels. Needs an X server."""
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  the window's implementation
    from vtkmodules.vtkCommonDataModel import vtkPolyData
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter
    data = read(file)
    polygons = vtkPolyData()
    polygons.SetPoints(data.GetPoints())
    polygons.SetPolys(data.GetPolys())
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(polygons)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    renderer = vtkRenderer()
    renderer.SetBackground(0.0, 0.0, 0.0)
    renderer.AddActor(actor)
    window = vtkRenderWindow()
    window.SetMultiSamples(0)
    window.SetSize(PIXELS, PIXELS)
    window.AddRenderer(renderer)
    x0, y0, half = view
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(x0, y0, 0.0)
    camera.SetPosition(x0, y0, 1.0)
    camera.SetParallelScale(half)
    camera.SetClippingRange(0.1, 10.0)
    window.Render()
    shot = vtkWindowToImageFilter()
    shot.SetInput(window)
    shot.ReadFrontBufferOff()
    shot.Update()
    image = shot.GetOutput()
    columns, rows, _ = image.GetDimensions()
    colours = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, -1)
    numpy.save(picture, colours[:, :, 0] > 127)


def rendered(file, view, folder):
    """The picture, rendered in a separate process under Xvfb."""
    picture = folder / "rendered.npy"
    subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24", sys.executable, __file__, "--render", file,
                    json.dumps([float(v) for v in view]), picture], check=True)
    return numpy.load(picture)


class VtkFrames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.state = {}
        for name, case in SPECIMENS.items():
            (cls.folder / f"{name}.toml").write_text(case, encoding="utf-8")
            subprocess.run([os.environ["CRACKLE_PROGRAM"], "test", f"{name}.toml", "-o", name, "--quiet"], cwd=cls.folder, check=True)
            cls.state[name] = cls.ours("state", cls.folder / name)

    @staticmethod
    def ours(mode, *paths):
        arrays = subprocess.run([os.environ["FRAME_ARRAYS"], mode, *paths], check=True, capture_output=True, text=True)
        return json.loads(arrays.stdout)

    def files(self, name):
        """Entries of the collection in order: (time, part, path)."""
        frames = self.folder / name / "frames"
        return [(float(entry.get("timestep")), int(entry.get("part")), frames / entry.get("file"))
                for entry in ElementTree.parse(frames / "frames.pvd").iter("DataSet")]

    def last(self, name, part):
        return read(self.files(name)[-3:][part][2])

    def expect_alike(self, what, got, expected, tolerance=TOLERANCE):
        """Differences between two descriptions of an array."""
        largest = max(abs(expected[0]), abs(expected[1]))
        for which, scale, k in (("minimum", largest, 0), ("maximum", largest, 1), ("sum", expected[3], 2)):
            self.assertLessEqual(abs(got[k] - expected[k]), tolerance * scale,
                                 f"{what}: {which}: got {got[k]!r}, expected {expected[k]!r}")

    def test_the_collection_lists_every_file_once_in_order_of_time(self):
        for name in SPECIMENS:
            files = self.files(name)
            self.assertEqual({path for _, _, path in files}, set((self.folder / name / "frames").glob("*.vtp")))
            self.assertEqual([part for _, part, _ in files], [0, 1, 2] * (len(files) // 3))
            times = [time for time, part, _ in files if part == 0]
            self.assertEqual(times, sorted(set(times)))
            self.assertGreaterEqual(len(times), 3)

    def test_every_array_of_every_file_is_what_our_reader_reads(self):
        compared = 0
        for name in SPECIMENS:
            files = self.files(name)
            ours = self.ours("read", *(path for _, _, path in files))
            for time, _, path in files:
                data, expected = read(path), ours[str(path)]
                counts = [data.GetNumberOfPoints(), data.GetNumberOfLines(), data.GetNumberOfPolys(),
                          sum(data.GetCell(k).GetNumberOfPoints() for k in range(data.GetNumberOfCells()))]
                self.assertEqual(counts, expected["counts"], path.name)
                arrays = arrays_of(data)
                self.assertEqual(set(arrays), ARRAYS[path.name.split("_")[0]], path.name)
                self.assertEqual(set(arrays), set(expected["cells"]), path.name)
                for array, values in arrays.items():
                    self.assertEqual(len(values), data.GetNumberOfCells(), f"{path.name}: {array}")
                    self.expect_alike(f"{path.name}: {array}", described(values), expected["cells"][array])
                    compared += 1
                points = vtk_to_numpy(data.GetPoints().GetData()) if counts[0] else []
                self.expect_alike(f"{path.name}: points", described(points), expected["points"])
                fields = data.GetFieldData()
                self.assertEqual({fields.GetArrayName(k): fields.GetArray(k).GetValue(0) for k in range(fields.GetNumberOfArrays())},
                                 expected["fields"])
                self.assertEqual(expected["fields"]["time"], time)
        print(f"  {compared} arrays compared")
        self.assertGreater(compared, 500)

    def test_the_last_frame_is_the_solvers_state(self):
        for name in SPECIMENS:
            state = self.state[name]
            particles, contacts = arrays_of(self.last(name, 0)), arrays_of(self.last(name, 1))
            for array, expected in state["particles"].items():
                tolerance = STATE_TOLERANCE if array.startswith("stress") else TOLERANCE
                self.expect_alike(f"{name}: {array}", described(particles[array]), expected, tolerance)
            touching = contacts["state"] != 2
            self.assertFalse(contacts["normal_force"][~touching].any(), "forces of broken bonds that do not touch")
            for array, expected in state["contacts"].items():
                self.expect_alike(f"{name}: {array}", described(contacts[array][touching]), expected, STATE_TOLERANCE)
            counts = [int((contacts["state"] == k).sum()) for k in range(5)]
            print(f"  {name}: intact, slid, broken, touching again, loose: {counts}")
            self.assertEqual(sum(counts[:4]), state["bonds"])

    def test_cracks_and_ages_are_those_of_the_events(self):
        for name in SPECIMENS:
            with (self.folder / name / "events.csv").open(encoding="utf-8", newline="") as file:
                events = list(csv.DictReader(file))
            self.assertGreater(len(events), 5)
            for time, part, path in self.files(name):
                if part == 2:
                    so_far = sum(float(event["time"]) <= time for event in events)
                    self.assertEqual(read(path).GetNumberOfCells(), so_far, path.name)
            cracks, contacts = arrays_of(self.last(name, 2)), arrays_of(self.last(name, 1))
            for column in ("time", "energy", "strength", "orientation", "body_i", "body_j"):
                self.assertEqual([float(event[column]) for event in events], list(cracks[column]), f"{name}: {column}")
            self.assertEqual([event["mode"] == "shear" for event in events], list(cracks["mode"] == 1))
            end = self.state[name]["time"]
            ages = contacts["age"][(contacts["state"] == 2) | (contacts["state"] == 3)]
            self.assertEqual(sorted(ages), sorted(end - float(event["time"]) for event in events))
            self.assertTrue((contacts["age"][contacts["state"] < 2] == end).all())

    def test_a_picture_by_vtk_covers_what_the_particles_cover_and_what_our_figure_draws(self):
        for name in SPECIMENS:
            state = self.state[name]
            shapes = [numpy.array(shape) for shape in state["discs"] + state["polygons"]]
            view = view_of(shapes)
            by_vtk = rendered(self.files(name)[-3][2], view, self.folder)
            particles = covered_by(shapes, view)
            overlap = (particles & by_vtk).sum() / (particles | by_vtk).sum()
            figure, inside, cracks = drawn_by_plot(self.folder / name, self.folder / f"{name}.png")
            with_edges, without, hidden = (laid_over(figure, part, by_vtk) for part in (figure, inside, cracks))
            beyond, missing = (without & ~by_vtk).mean() / by_vtk.mean(), (by_vtk & ~with_edges & ~hidden).mean() / by_vtk.mean()
            print(f"  {name}: {by_vtk.sum()} pixels by VTK, intersection over union with the particles {overlap:.4f}; of our figure {beyond:.4f} "
                  f"beyond, {missing:.4f} missing")
            self.assertGreater(by_vtk.mean(), 0.2)
            self.assertGreaterEqual(overlap, 0.98)
            # The areas that VTK fills end in the middle of the edges that our figure draws; a pixel is a five-hundredth
            # of the height.
            self.assertLess(beyond, 0.01)
            self.assertLess(missing, 0.01)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--render"]:
        render(sys.argv[2], json.loads(sys.argv[3]), sys.argv[4])
    else:
        unittest.main()
