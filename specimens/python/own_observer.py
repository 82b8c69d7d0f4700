# SPDX-License-Identifier: GPL-3.0-or-later
"""A custom measure: the fabric tensor of the bonds as a function of strain.

  PYTHONPATH=build/release/python /usr/bin/python3 specimens/python/own_observer.py

F = (1/N) sum n n over the normals n of the N intact bonds. Its anisotropy, 2 (F1 - F2) with its eigenvalues F1 >= F2,
is 0 if the normals have no preferred direction and 2 if all are parallel (Satake, in: Deformation and Failure of
Granular Materials, 1982). In tension, bonds along the direction of loading break first, and the major axis turns away
from it. The expected output is at the end of this file.
"""
import numpy

import crackle

CASE = {"include": "specimens/guide_rock/circles_tension.toml", "packing": {"count": 150},
        "loading": {"axial_strain_rate": 0.005}, "output": {"frames": 1}}


def fabric(contacts):
    """@return anisotropy, and the angle of the major axis from x in degrees"""
    normal = contacts["normal"][contacts["bonded"]]
    n = numpy.column_stack([normal["x"], normal["y"]])
    values, axes = numpy.linalg.eigh(n.T @ n / len(n))
    return 2.0 * (values[1] - values[0]), numpy.degrees(numpy.arctan2(axes[1, 1], axes[0, 1])) % 180.0


if __name__ == "__main__":
    seen = []

    def look(state):
        seen.append((state.axial_strain, state.bonds_broken, *fabric(state.contacts())))

    crackle.test(CASE, every=500, call=look)
    for strain, broken, anisotropy, angle in seen[:: max(1, len(seen) // 6)]:
        print(f"strain {strain:.2e}  {broken:4d} broken  anisotropy {anisotropy:.3f}  "
              f"major axis at {angle:.0f} degrees")

#> strain 0.00e+00     0 broken  anisotropy 0.149  major axis at 90 degrees
#> strain 9.55e-04     4 broken  anisotropy 0.128  major axis at 93 degrees
#> strain 1.91e-03    16 broken  anisotropy 0.093  major axis at 105 degrees
#> strain 2.86e-03    24 broken  anisotropy 0.083  major axis at 111 degrees
#> strain 3.82e-03    25 broken  anisotropy 0.084  major axis at 114 degrees
#> strain 4.77e-03    34 broken  anisotropy 0.087  major axis at 111 degrees
#> strain 5.73e-03    35 broken  anisotropy 0.097  major axis at 111 degrees
#> strain 6.68e-03    41 broken  anisotropy 0.093  major axis at 112 degrees
