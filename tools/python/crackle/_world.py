# SPDX-License-Identifier: GPL-3.0-or-later
"""A specimen in its apparatus, or loose particles, stepped and loaded from Python."""
from __future__ import annotations

from typing import TYPE_CHECKING

from . import _engine
from ._case import read_case
from ._progress import reporting
from ._tests import _threads

if TYPE_CHECKING:
    from ._tests import _Case, _Progress


class World(_engine.World):
    """A world that is stepped by `step(count)`.

    World(case): the specimen of a case, bonded in its apparatus, at the start of loading. The driving part moves at the
    case's rate. With rate_tolerance it moves at the initial rate, until `platen_speed` is set.
    World(particles, walls=True): particles at rest, as `pack`, `mesh` and `read` give them, without bonds.

    threads: number of threads; results do not depend on it. Properties and methods: see State. Raises InputError.
    """

    def __init__(self, case: _Case | _engine.Particles, *, threads: int | None = None, walls: bool = True,
                 progress: _Progress = None) -> None:
        if isinstance(case, _engine.Particles):
            super().__init__(case, _threads(threads) or 1, bool(walls))
            return
        asked = read_case(case)
        with reporting(progress) as report:
            super().__init__(asked, _threads(threads), report)

    def add_bond(self, i: int, j: int, gap: float = 0.0) -> int:
        """Bonds the contact points between the bodies with ids i and j, like add_bonds(). Returns the number of new bonds."""
        return self.add_bonds([(i, j)], gap)
