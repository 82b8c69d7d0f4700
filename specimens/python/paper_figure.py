# SPDX-License-Identifier: GPL-3.0-or-later
"""A figure for a paper, made with matplotlib: curve, breaks and the broken specimen, as wide as a journal's column.

  PYTHONPATH=build/release/python /usr/bin/python3 specimens/python/paper_figure.py

Writes paper_figure.pdf. For figures without matplotlib, see result.figure("curve", "specimen") and crackle.plot.
"""
import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot
from matplotlib.collections import PolyCollection

import crackle

COLUMN = 88.0 / 25.4  # inches

if __name__ == "__main__":
    result = crackle.test({"include": "specimens/rocks/granite_tension.toml",
                           "packing": {"width": 0.03, "height": 0.06}, "loading": {"rate_tolerance": 0.05}})
    curve, events, cells = result.curve, result.events, result.recording.cells
    end = result.recording.frame("end")

    pyplot.rcParams.update({"font.size": 8, "font.family": "DejaVu Sans"})
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(COLUMN, 0.75 * COLUMN), width_ratios=(3, 2),
                                            layout="constrained")
    left.plot(1e3 * curve.axial_strain, 1e-6 * curve.axial_stress, "k", linewidth=0.8)
    left.set(xlabel="axial strain, 10$^{-3}$", ylabel="axial stress, MPa")
    breaks = left.twinx()
    breaks.step([0.0, *1e3 * events.axial_strain], range(len(events.axial_strain) + 1), "C3", where="post",
                linewidth=0.8)
    breaks.set_ylabel("bonds broken", color="C3")
    breaks.set_ylim(0)
    left.set_ylim(0)

    moved = []
    for k, outline in enumerate(cells.outline):  # platens are open chains, which have no area to fill
        if not cells.platen[k]:
            moved.append([(x + end.ux[k], y + end.uy[k]) for x, y in outline])
    right.add_collection(PolyCollection(moved, facecolors="0.85", edgecolors="k", linewidths=0.2))
    right.plot(events.x, events.y, "C3.", markersize=1.0)
    right.set_aspect("equal")
    right.autoscale_view()
    right.set_axis_off()
    figure.savefig("paper_figure.pdf")
    print(f"paper_figure.pdf: {len(curve.axial_strain)} rows, {len(events.x)} breaks, {len(moved)} cells")

#> paper_figure.pdf: 205 rows, 203 breaks, 294 cells
