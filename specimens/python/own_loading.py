# SPDX-License-Identifier: GPL-3.0-or-later
"""Loading by a rule of one's own: a saw-tooth, each tooth higher than the last, until the specimen is through.

  PYTHONPATH=build/release/python /usr/bin/python3 specimens/python/own_loading.py

The modulus of each unloading shows the damage. The platen slows down before it turns, over a stress wave's way through
the specimen: a speed that jumps sends a shock. What must come out stands below.
"""
import crackle

CASE = {"include": "specimens/guide_rock/circles_compression.toml",
        "packing": {"count": 150},
        "loading": {"axial_strain_rate": 0.0005, "rate_tolerance": None, "max_axial_strain": 0.02},
        "output": {"curve_rows": 2000, "frames": 1}}
TOOTH = 5e-4  # of strain, each higher by so much


class SawTooth:
    def __init__(self):
        self.top, self.sense, self.speed, self.slopes, self.start = TOOTH, 1.0, None, [], None

    def __call__(self, state):
        if self.speed is None:
            self.speed = state.platen_speed
        row = state.row()
        strain, stress = row["axial_strain"], row["axial_stress"]
        if self.sense > 0.0 and strain >= self.top:  # the top of a tooth: go back
            self.sense, self.start = -1.0, (strain, stress)
        elif self.sense < 0.0 and stress <= 0.3 * self.start[1]:  # its foot: on to the next
            self.slopes.append(((self.start[1] - stress) / (self.start[0] - strain), strain))
            self.sense, self.top = 1.0, self.top + TOOTH
            if len(self.slopes) == 4:
                state.stop()
        wanted = self.sense * self.speed
        state.platen_speed += 0.05 * (wanted - state.platen_speed)  # smoothly


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
