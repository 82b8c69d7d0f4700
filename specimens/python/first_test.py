# SPDX-License-Identifier: GPL-3.0-or-later
"""A first test: the DEMseg guide's example rock, made of circles, is pulled until it breaks.

  PYTHONPATH=build/release/python /usr/bin/python3 specimens/python/first_test.py

The expected output is at the end of this file.
"""
import crackle

result = crackle.test("specimens/guide_rock/circles_tension.toml")

summary, curve, events = result.summary, result.curve, result.events
print(f"Young's modulus {summary['youngs_modulus']:.5g} N/m")
print(f"strength {summary['peak_stress']:.5g} N/m at a strain of {summary['peak_strain']:.4g}")
print(f"{len(curve.axial_strain)} rows; the largest stress of the curve is {curve.axial_stress.max():.5g} N/m")
print(f"{len(events.energy)} bonds broke, {int(events.mode.sum())} in shear; they took {events.energy.sum():.4g} J")

#> Young's modulus 5.9467e+06 N/m
#> strength 5866.4 N/m at a strain of 0.00154
#> 586 rows; the largest stress of the curve is 5866.4 N/m
#> 57 bonds broke, 0 in shear; they took 0.2411 J
