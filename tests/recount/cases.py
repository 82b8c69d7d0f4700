# SPDX-License-Identifier: GPL-3.0-or-later
"""The cases that recount_test.py runs, assembled from parts."""

rock = """
[packing]
count = 80
height_to_width = 2.0
radius_min = 1.333e-2
radius_max = 2.667e-2
mean_overlap = 7.74e-5
seed = 3
[material]
density = 2500.0
normal_stiffness = 1.0e7
shear_stiffness = 2.5e6
friction_angle = 27.0
damping_ratio = 0.2
"""
output = '[output]\nframe_precision = "double"\nframes = 12\n'
voronoi = '[mesh]\nkind = "voronoi"\nthick = 1e-3\n[bond]\nthick = 1.08e-3\n'
triangles = '[mesh]\nkind = "delaunay"\nboundary = "domain"\nthick = 1e-3\n[bond]\nthick = 1.08e-3\n'
minerals = '''
[minerals]
seed = 5
[[mineral]]
name = "quartz"
area_share = 0.3
normal_stiffness = 2.0e7
shear_stiffness = 6.0e6
density = 2650.0
damping_ratio = 0.1
[[mineral]]
name = "feldspar"
[[mineral]]
name = "mica"
area_share = 0.2
friction_angle = 15.0
[[mineral_pair]]
between = ["quartz", "mica"]
normal_stiffness = 5.0e6
friction_angle = 20.0
[[mineral_pair]]
between = ["feldspar", "feldspar"]
shear_stiffness = 3.0e6
'''
minerals_of_an_area = '''
[minerals]
seed = 5
[[mineral]]
name = "quartz"
area_share = 0.4
contact_modulus = 2.0e10
stiffness_ratio = 2.0
tensile_strength = 1.5e7
cohesion = 4.0e7
[[mineral]]
name = "mica"
area_share = 0.2
friction_angle = 20.0
residual_friction_angle = 10.0
cohesion = 2.5e7
[[mineral]]
name = "feldspar"
[[mineral_pair]]
between = ["quartz", "mica"]
contact_modulus = 5.0e9
stiffness_ratio = 3.0
tensile_strength = 4.0e6
cohesion = 1.2e7
residual_friction_angle = 5.0
[[mineral_pair]]
between = ["feldspar", "feldspar"]
cohesion = 2.0e7
friction_angle = 30.0
'''
squeezed = '[loading]\nkind = "compression"\nmax_axial_strain = 0.02\n'
pulled = '[loading]\nkind = "tension"\nmax_axial_strain = 0.005\n'
rate = "axial_strain_rate = 0.02\n"
bonded = 'platens = "bonded"\n'
friction = 'platens = "frictional"\nplaten_friction_angle = 15.0\n'

# Coulomb bonds between the same bodies, and stiffnesses and strengths per area.
packing = rock[: rock.index("[material]")]
area = """[material]
units = "area"
density = 2500.0
contact_modulus = 1.0e10
stiffness_ratio = 2.5
friction_angle = 35.0
damping_ratio = 0.2
"""
strengths = "tensile_strength = 1.0e7\ncohesion = 3.0e7\nresidual_friction_angle = 25.0\n"
cells, wedges = (text[: text.index("[bond]")] for text in (voronoi, triangles))
cohesive = '[bond]\nlaw = "coulomb"\n'


def scattered(distribution, cv):
    return f'strength_distribution = "{distribution}"\nstrength_cv = {cv}\nstrength_seed = 7\n'


# Faces: a rock with pressures in its cells, a share of bending and a second slope; without pressures; of two minerals.
faces = """[material]
units = "area"
density = 2500.0
youngs_modulus = 1.0e10
poissons_ratio = 0.26
stiffness_ratio = 1.6
friction_angle = 50.0
friction_knee = 3e6
friction_angle_beyond = 15.0
residual_friction_angle = 15.0
tensile_strength = 3e6
cohesion = 5e6
moment_share = 0.7
damping_ratio = 0.2
"""
softening = "residual_cohesion = 1e6\nsoftening_slip = 2e-4\nresidual_tensile_strength = 1e6\nsoftening_opening = 2e-4\n"
faces_without_pressure = """[material]
units = "area"
density = 2500.0
youngs_modulus = 1.0e10
poissons_ratio = 0.2
friction_angle = 40.0
residual_friction_angle = 25.0
tensile_strength = 3e6
cohesion = 6e6
damping_ratio = 0.2
"""
faces_of_minerals = """[minerals]
seed = 5
[[mineral]]
name = "quartz"
area_share = 0.4
youngs_modulus = 2.0e10
tensile_strength = 5e6
cohesion = 2e7
[[mineral]]
name = "mica"
area_share = 0.2
poissons_ratio = 0.2
friction_angle = 20.0
friction_angle_beyond = 10.0
residual_friction_angle = 10.0
[[mineral]]
name = "feldspar"
[[mineral_pair]]
between = ["quartz", "quartz"]
tensile_strength = 8e6
friction_angle = 30.0
[[mineral_pair]]
between = ["quartz", "feldspar"]
cohesion = 1.5e7
"""
by_faces = '[bond]\nlaw = "face"\n'
factors = "tensile_factor = 1.0\ncohesion_factor = 3.0\nrange = 0.05\n" + scattered("lognormal", 0.3)
circles_every_step = rock[len(packing) :] + cohesive + factors + squeezed + "axial_strain_rate = 0.3\n"

# Joints at 60 degrees through the middle of specimens with 80 particles (0.2556 m wide) and with 16 to 24.
joint = '[joints]\nseed = 1\n[[joint_set]]\nname = "plane"\nangle = 60.0\nspacing = 10.0\nthrough = [0.128, 0.256]\n'
gaps = joint.replace("spacing = 10.0", 'length = "gaps"\nlength_mean = 0.1\ngap_mean = 0.1\nspacing = 10.0')
joint_of_few = joint.replace("0.128, 0.256", "0.07, 0.14")
weak = """tensile_strength = 2.0e6
cohesion = 6.0e6
friction_angle = 30.0
residual_friction_angle = 20.0
normal_stiffness = 1.0e12
shear_stiffness = 4.0e11
"""
weaker = "strength_factor = 0.05\nresidual_friction_angle = 15.0\n"
open_faces = "bonded = false\nfriction_angle = 25.0\n"
dilating = "dilation_angle = 5.0\ndilation_slip = 2e-4\n"
wide_gaps = cells.replace("1e-3", "5e-3")  # slips stay below the gaps
jointed = packing + area + strengths
touching = cohesive + "range = 0.05\n"  # circles
a_row_a_step = '[output]\nframe_precision = "double"\nframes = 60000\ncurve_rows = 60000\n'
