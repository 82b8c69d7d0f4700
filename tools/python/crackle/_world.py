# SPDX-License-Identifier: GPL-3.0-or-later
"""A specimen in its apparatus, or loose particles, that Python steps and loads itself."""
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
    case's rate; of a case with rate_tolerance at the first, which nothing changes but `platen_speed`.
    World(particles, walls=True): particles at rest, as `pack`, `mesh` and `read` give them, without bonds.

    threads: of the steps; no result depends on them. Properties and methods: State. Raises InputError.
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
        """Bonds the contact points between bodies of ids i and j, as add_bonds. Returns how many."""
        return self.add_bonds([(i, j)], gap)
