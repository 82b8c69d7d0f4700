# SPDX-License-Identifier: GPL-3.0-or-later
"""A parameter study in ten lines: the effect of friction on the compressive strength.

  PYTHONPATH=build/release/python /usr/bin/python3 specimens/python/parameter_study.py

For many packings and processors, use crackle.campaign. The expected output is at the end of this file.
"""
import crackle

for angle in (10.0, 20.0, 30.0):
    case = {"include": "specimens/guide_rock/circles_compression.toml",
            "packing": {"count": 100},
            "material": {"friction_angle": angle},
            "loading": {"axial_strain_rate": 0.02},
            "output": {"frames": 1}}
    summary = crackle.test(case).summary
    print(f"friction angle {angle:.0f} degrees: strength {summary['peak_stress'] / 1e3:.4g} kN/m")

#> friction angle 10 degrees: strength 7.933 kN/m
#> friction angle 20 degrees: strength 11.5 kN/m
#> friction angle 30 degrees: strength 14.54 kN/m
