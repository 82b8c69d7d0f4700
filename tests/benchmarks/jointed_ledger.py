# SPDX-License-Identifier: GPL-3.0-or-later
"""Shared by tests/benchmarks/jaeger, jointed_rock and welded_traces: rows of a campaign, and the stress at which a plane slips."""

import math
import sqlite3
import sys
from pathlib import Path


def rows_of(folder, plan):
    """Rows of a campaign of specimens/plans/`plan`.toml as dictionaries, without refused specimens. All have a largest stress, Pa."""
    file = Path(folder) / "campaign.sqlite"
    if not file.exists():
        sys.exit(f"{file}: found no such file, expected that of a campaign of specimens/plans/{plan}.toml")
    with sqlite3.connect(f"file:{file}?mode=ro", uri=True) as ledger:
        ledger.row_factory = sqlite3.Row
        rows = ledger.execute("select * from results where state is not 'refused'").fetchall()
    for row in rows:
        if row["largest_stress"] is None:
            sys.exit(f"{file}: found a test without a stress, {row['test']} of row {row['row']}; see crackle campaign show")
    return rows


def slip_stress(angle, pressure, cohesion, friction):
    """Strength of a plane at `angle` degrees from the platens (Jaeger 1960): p + 2 (c + p f)/((1 - f tan b) sin 2b), b = 90 - angle;
    infinite if it does not slip. @param friction  tangent of the friction angle"""
    if not 0.0 < angle < 90.0:
        return math.inf
    b = math.radians(90.0 - angle)
    left = (1.0 - friction * math.tan(b)) * math.sin(2.0 * b)
    return pressure + 2.0 * (cohesion + pressure * friction) / left if left > 1e-9 else math.inf
