# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenes whose bytes are compared: all shipped cases and decks, and one small case of each kind."""

import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
FACES = ROOT / "specimens/rocks/faces"

# Small cases: a shipped case, and keys that make it small or use another part of the program.
CIRCLES = "[packing]\ncount = 60\n[output]\nframes = 3\n"
LOGNORMAL = '[packing]\ncount = 60\nsizes = "lognormal"\nradius_median = 0.02\nradius_log_deviation = 0.25\nradius_min = 0.01\nradius_max = 0.04\n[output]\nframes = 3\n'
SMALL = {
    "circles_tension": f'include = "circles_tension.toml"\n{CIRCLES}',
    "circles_compression": f'include = "circles_compression.toml"\n{CIRCLES}[loading]\nmax_axial_strain = 0.004\n',
    "circles_consistent": f'include = "circles_compression.toml"\n{CIRCLES}[loading]\nmax_axial_strain = 0.004\n[numerics]\nintegrator = "consistent"\n',
    "circles_lognormal": f'include = "circles_tension.toml"\n{LOGNORMAL}',
    "delaunay_tension": f'include = "delaunay_tension.toml"\n{CIRCLES}',
    "voronoi_compression": f'include = "voronoi_compression.toml"\n{CIRCLES}[loading]\nmax_axial_strain = 0.01\n',
    "granite_tension": 'include = "granite_tension.toml"\n[packing]\nwidth = 0.018\nheight = 0.036\n[output]\nframes = 3\n',
    "sandstone_compression": 'include = "sandstone_compression.toml"\n[packing]\nwidth = 0.018\nheight = 0.036\n[output]\nframes = 3\n'
                             '[loading]\nmax_axial_strain = 0.004\n',
    "granite_normal_strengths": 'include = "granite_tension.toml"\n[packing]\nwidth = 0.018\nheight = 0.036\n[output]\nframes = 3\n'
                                '[bond]\nstrength_distribution = "normal"\n',
    "granite_lognormal_strengths": 'include = "granite_tension.toml"\n[packing]\nwidth = 0.018\nheight = 0.036\n[output]\nframes = 3\n'
                                   '[bond]\nstrength_distribution = "lognormal"\n',
    "face_compression": 'include = "faces/granite_compression.toml"\n[packing]\nwidth = 0.018\nheight = 0.036\n[output]\nframes = 3\n'
                        '[loading]\nmax_axial_strain = 0.005\n',
}
SMALL_DECKS = ("wave_chain", "triangle", "clump", "random_packing", "controlled_segment_force", "embankment")
PACKING = "pack --count 300 --lognormal-median 0.01 --lognormal-deviation 0.3 --mean-overlap 1e-5 -o in_gm.dat"


def scenes(small):
    """{name: ({name of a file or folder: its text, or the path of its original}, commands of crackle that run in the scene's folder)}"""
    found = {
        "packing": ({}, [PACKING]),
        "delaunay_mesh": ({}, [PACKING, "mesh in_gm.dat --kind delaunay --thick 5e-4 --merge -o mesh.dat"]),
        "voronoi_mesh": ({}, [PACKING, "mesh in_gm.dat --kind voronoi --thick 5e-4 --merge -o mesh.dat"]),
    }
    shipped = [case for folder in ("guide_rock", "rocks") for case in sorted((ROOT / "specimens" / folder).glob("*.toml"))]
    for name, text in SMALL.items() if small else ((case.stem, None) for case in shipped if "[loading]" in case.read_text()):
        files = {case.name: case for case in shipped} | {"faces": FACES}
        if small:
            files[f"small_{name}.toml"] = text
            name = "small_" + name
        found[name] = (files, [f"test {name}.toml -o out -q", f"elastic {name}.toml --json"])
    for case in sorted(FACES.glob("*_*.toml")) if not small else ():
        found[f"faces_{case.stem}"] = ({"faces": FACES}, [f"test faces/{case.name} -o out -q", f"elastic faces/{case.name} --json"])
    for deck in sorted((ROOT / "specimens/demseg").iterdir()):
        if deck.is_dir() and (not small or deck.name in SMALL_DECKS):
            found[f"deck_{deck.name}"] = ({"deck": deck}, ["run deck -o out -q"])
    return found
