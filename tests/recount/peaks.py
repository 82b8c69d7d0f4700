# SPDX-License-Identifier: GPL-3.0-or-later
"""Peak, failure and largest stress of a curve (specimens/measures/METHODS.md), only from its rows."""


def find_fall(way, stress, share):
    """Row of the peak: the largest stress before it stays below a share of the peak for a tenth of the strain travelled to the peak and for
    ten rows. Second, the row at which this is known; None if no such fall follows. Both are None without stress."""
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
