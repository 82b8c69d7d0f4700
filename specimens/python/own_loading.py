# SPDX-License-Identifier: GPL-3.0-or-later
"""Custom loading: the strain follows a saw-tooth, with four teeth of growing height.

  PYTHONPATH=build/release/python /usr/bin/python3 specimens/python/own_loading.py

The modulus of each unloading shows the damage. The platen's speed changes gradually, because a jump would send a shock
wave through the specimen. The expected output is at the end of this file.
"""
import crackle

CASE = {"include": "specimens/guide_rock/circles_compression.toml",
        "packing": {"count": 150},
        "loading": {"axial_strain_rate": 0.0005, "rate_tolerance": None, "max_axial_strain": 0.02},
        "output": {"curve_rows": 2000, "frames": 1}}
TOOTH = 5e-4  # height of the first tooth, and increase from tooth to tooth, in strain


class SawTooth:
    def __init__(self):
        self.top, self.sense, self.speed, self.slopes, self.start = TOOTH, 1.0, None, [], None

    def __call__(self, state):
        if self.speed is None:
            self.speed = state.platen_speed
        row = state.row()
        strain, stress = row["axial_strain"], row["axial_stress"]
        if self.sense > 0.0 and strain >= self.top:  # top of a tooth: unload
            self.sense, self.start = -1.0, (strain, stress)
        elif self.sense < 0.0 and stress <= 0.3 * self.start[1]:  # foot of a tooth: load to the next top
            self.slopes.append(((self.start[1] - stress) / (self.start[0] - strain), strain))
            self.sense, self.top = 1.0, self.top + TOOTH
            if len(self.slopes) == 4:
                state.stop()
        wanted = self.sense * self.speed
        state.platen_speed += 0.05 * (wanted - state.platen_speed)  # change the speed gradually


if __name__ == "__main__":
    saw = SawTooth()
    result = crackle.test(CASE, every=100, call=saw)
    print(f"ended by {result.summary['ended_by']} after {result.summary['bonds_broken']} breaks")
    for number, (slope, strain) in enumerate(saw.slopes, 1):
        print(f"unloading {number}: modulus {slope:.4g} N/m, down to a strain of {strain:.3g}")

#> ended by caller after 9 breaks
#> unloading 1: modulus 5.226e+06 N/m, down to a strain of 0.000154
#> unloading 2: modulus 5.205e+06 N/m, down to a strain of 0.000304
#> unloading 3: modulus 5.208e+06 N/m, down to a strain of 0.000477
#> unloading 4: modulus 4.879e+06 N/m, down to a strain of 0.000716
