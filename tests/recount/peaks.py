# SPDX-License-Identifier: GPL-3.0-or-later
"""Peak, failure and largest stress of a curve (specimens/measures/METHODS.md), from its rows alone."""


def find_fall(way, stress, share):
    """Largest row before the stress stays below a share of it for a tenth of the way there and for ten rows, and the row that
    shows it. The second is None where no such fall follows, the first too where there is no stress."""
    peak, below = None, None
    for k in range(len(stress)):
        if stress[k] > (stress[peak] if peak is not None else 0.0):
            peak, below = k, None
        elif peak is None or stress[k] >= share * stress[peak]:
            below = None
        else:
            below = k if below is None else below
            if way[k] - way[below] >= 0.1 * way[peak] and k - below >= 10:
                return peak, k
    return peak, None
