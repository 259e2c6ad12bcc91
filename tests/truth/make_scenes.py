#!/usr/bin/env python3
"""Writes the scenes of tests/truth/scenes, each built to show one thing that global illumination gets wrong.

usage: make_scenes.py [FOLDER]
"""
import struct
import sys
import zlib
from pathlib import Path

import numpy as np

from scene_text import Scene, rotation

WHITE, GREY, RED, GREEN, BLUE = (.73, .73, .73), (.4, .4, .4), (.65, .05, .05), (.12, .45, .15), (.1, .15, .6)


def neon_room():
    """Emissive strips of pure colours in a room: light from emission alone, saturated bounces."""
    s = Scene()
    grey, white = s.material(GREY), s.material(WHITE)
    s.shell((6, 3, 6), grey)
    for name, tint, center, size in (("Magenta", (1, .05, .6), (-2.97, 2.2, -.5), (.06, .12, 4.4)),
                                     ("Cyan", (.05, .8, 1), (.4, 2.2, -2.97), (4, .12, .06)),
                                     ("Orange", (1, .4, .05), (2.97, .4, 0), (.06, .12, 4.8))):
        s.box(name, s.material((0, 0, 0), tint, 8), center, size)
    s.box("Plinth", white, (-.6, .4, -1), (1, .8, 1), rotation(25))
    s.sphere("Ball", white, (-.6, 1.3, -1), .5)
    s.camera((1.8, 1.6, 2.6), (-.8, 1.1, -1.6), 65)
    s.probe("Probe", (0, 1.5, 0), (3.4, 1.9, 3.4))
    return s


def bright_corridor():
    """A long closed corridor of bright walls, lit at its far end: needs dozens of bounces."""
    s = Scene()
    bright = s.material((.85, .84, .82))
    s.shell((2, 2.4, 12), {**dict.fromkeys(("floor", "ceiling", "left", "right", "front"), bright),
                           "back": s.material((.8, .5, .3))})
    s.box("Baffle", bright, (-.4, 1.2, -2.5), (1.2, 2.4, .2))
    s.omni("Lamp", (0, 1.9, -4.6), (1, .95, .85), 3, 6)
    s.camera((.5, 1.5, 5.6), (0, 1.1, -2), 60)
    s.probe("Probe", (0, 1.2, 0), (1.4, 1.6, 6.4))
    return s


def two_rooms():
    """Light reaches the room in view only through a door."""
    s = Scene()
    white, red, blue = s.material(WHITE), s.material(RED), s.material(BLUE)
    s.shell((8, 2.8, 4), {**dict.fromkeys(("floor", "ceiling", "back", "front"), white), "left": red, "right": blue})
    s.box("WallBack", white, (0, 1.4, -1.25), (.2, 2.8, 1.5))
    s.box("WallFront", white, (0, 1.4, 1.25), (.2, 2.8, 1.5))
    s.box("Lintel", white, (0, 2.4, 0), (.2, .8, 1))
    s.box("Crate", white, (2, .4, -.9), (.8, .8, .8), rotation(30))
    s.omni("Lamp", (-2.2, 2.2, .8), (1, .9, .75), 5, 8)
    s.camera((3.7, 1.6, 1.7), (.6, 1, -.7), 70)
    s.probe("Probe", (0, 1.4, 0), (4.4, 1.8, 2.4))
    return s


def stairs():
    """Many edges where floor and wall meet, under a spot light."""
    s = Scene()
    white = s.material(WHITE)
    s.shell((5, 4, 5), {**dict.fromkeys(("floor", "ceiling", "back", "front"), white), "left": s.material(GREEN),
                        "right": s.material((.6, .5, .1))})
    for i in range(10):
        s.box(f"Step{i}", white, (-1.9 + .34 * i, .12 * (i + 1), -1.2), (.34, .24 * (i + 1), 1.6))
    s.spot("Spot", (-1.6, 3.8, 1.6), (.2, .6, -1.2), (1, .97, .9), 4, 9, 34)
    s.camera((.6, 1.9, 2.4), (-.3, 1.2, -1.2), 70)
    s.probe("Probe", (0, 2, 0), (2.9, 2.4, 2.9))
    return s


def many_boxes():
    """Sixty boxes of a few voxels each."""
    s = Scene()
    white = s.material(WHITE)
    s.shell((5, 3, 5), white)
    colors = [s.material(c) for c in (WHITE, RED, GREEN, BLUE, (.7, .6, .1))]
    random = np.random.default_rng(7)
    for i in range(60):
        size = random.uniform(.12, .45, 3)
        x, z = -2 + .5 * (i % 9) + random.uniform(-.1, .1), -2.2 + .55 * (i // 9) + random.uniform(-.1, .1)
        s.box(f"Box{i}", colors[i % len(colors)], (x, size[1] / 2, z), size, rotation(random.uniform(0, 90)))
    s.omni("Lamp", (.8, 2.5, -.6), (1, .95, .9), .8, 7)
    s.camera((0, 2, 2.4), (0, .3, -.8), 65)
    s.probe("Probe", (0, 1.5, 0), (2.9, 1.9, 2.9))
    return s


def sphere_room():
    """Curved walls: voxels and normals are never in line."""
    s = Scene()
    inside = s.resource("SphereMesh", "flip_faces = true\nradius = 1.0\nheight = 2.0\nradial_segments = 64\nrings = 32")
    white = s.material(WHITE)
    s.mesh("Room", inside, white, np.eye(3) * 3, (0, 0, 0))
    s.sphere("Red", s.material(RED), (-1, -1.2, -.8), .9)
    s.sphere("Blue", s.material(BLUE), (1.1, -1.6, -.6), .7)
    s.omni("Lamp", (.4, 1.6, -.3), (1, 1, 1), .45, 6)
    s.camera((0, .2, 2.7), (0, -.5, -1), 75)
    s.probe("Probe", (0, 0, 0), (3.2, 3.2, 3.2))
    return s


def glossy_room():
    """Plastic and metal, from sharp to blurred reflections; sun on the outside of the walls that these must not show."""
    s = Scene()
    s.light_specular = 1
    s.shell((4, 3, 4), {**dict.fromkeys(("ceiling", "front"), s.material(WHITE)),
                        "floor": s.material((.5, .45, .4), gloss=(.3, 0)), "back": s.material(WHITE, gloss=(.55, 0)),
                        "left": s.material(RED, gloss=(.15, 0)), "right": s.material(GREEN)})
    s.box("Metal", s.material((.9, .7, .4), gloss=(.25, 1)), (-.8, .8, -.7), (1, 1.6, 1), rotation(25))
    s.sphere("Ball", s.material((.7, .7, .75), gloss=(.45, 1)), (.8, .6, -.2), .6)
    s.omni("Lamp", (.3, 2.5, .6), (1, .95, .85), .6, 7)
    s.sun("Sun", (-.5, -1, -.4), energy=4)
    s.camera((.2, 1.6, 1.8), (-.1, .9, -1), 75)
    s.probe("Probe", (0, 1.5, 0), (2.6, 2.1, 2.6))
    return s


def cornell(world=(np.eye(3), np.zeros(3)), probe_world=None):
    """A box room with two blocks and a lamp; the laws turn, mirror, move and scale it."""
    s = Scene(world)
    white = s.material(WHITE)
    s.shell((4, 4, 4), {**dict.fromkeys(("floor", "ceiling", "back"), white), "left": s.material(RED),
                        "right": s.material(GREEN)}, sides=("floor", "ceiling", "back", "left", "right"))
    s.box("Tall", white, (-.75, 1.2, -.7), (1.2, 2.4, 1.2), rotation(18))
    s.box("Short", white, (.75, .6, .6), (1.2, 1.2, 1.2), rotation(-18))
    s.omni("Lamp", (.3, 3.2, .2), (1, .95, .85), 1, 8)
    s.camera((0, 2, 7.2), (0, 2, 0), 40)
    if probe_world is not None:
        s.basis, s.origin = probe_world
    s.probe("Probe", (0, 2, 0), (2.5, 2.5, 2.5))
    return s


def rotated_room():
    """Room and probe turned by 30, 20 and 10 degrees: nothing may depend on the axes of the world."""
    return cornell((rotation(30, 20, 10), np.array([3., 1, -2])))


def sky_window():
    """Only the sky, through a window: occlusion and bounces of ambient light."""
    s = Scene()
    wall, floor = s.material((.75, .73, .7)), s.material((.45, .3, .2))
    s.shell((5, 3, 5), {**dict.fromkeys(("ceiling", "back", "right", "front"), wall), "floor": floor},
            sides=("floor", "ceiling", "back", "right", "front"))
    for name, center, size in (("Low", (-2.7, .45, 0), (.4, .9, 5)), ("High", (-2.7, 2.7, 0), (.4, .6, 5)),
                               ("Near", (-2.7, 1.65, 1.75), (.4, 1.5, 1.5)),
                               ("Far", (-2.7, 1.65, -1.75), (.4, 1.5, 1.5))):
        s.box(name, wall, center, size)
    s.box("Bed", s.material(RED), (.8, .3, -1.4), (2, .6, 1.4))
    s.sky((.5, .7, 1), 4)
    s.camera((2.1, 1.6, 2.2), (-.8, 1, -1.2), 65)
    s.probe("Probe", (0, 1.5, 0), (3, 2, 3))
    return s


def eight_lamps():
    """Eight coloured lamps round a pillar."""
    s = Scene()
    white = s.material(WHITE)
    s.shell((6, 3, 6), white)
    s.box("Pillar", white, (0, 1.5, -.6), (.8, 3, .8), rotation(20))
    s.sphere("Ball", white, (1.4, .6, -.4), .6)
    for i in range(8):
        angle = 2 * np.pi * i / 8
        tint = [.5 + .5 * np.cos(angle + shift) for shift in (0, 2.1, 4.2)]
        s.omni(f"Lamp{i}", (2.2 * np.cos(angle), .6 + 1.6 * (i % 2), 2.2 * np.sin(angle) - .2), tint, .35, 3.5)
    s.camera((0, 1.6, 2.9), (0, 1.1, -1), 75)
    s.probe("Probe", (0, 1.5, 0), (3.4, 1.9, 3.4))
    return s


def large_hall():
    """Thirty metres in one probe: voxels of a quarter of a metre."""
    s = Scene()
    stone = s.material((.6, .57, .5))
    s.shell((30, 8, 14), {**dict.fromkeys(("floor", "back", "front"), stone), "left": s.material(RED),
                          "right": s.material(BLUE)}, sides=("floor", "back", "front", "left", "right"))
    s.box("RoofLeft", stone, (-9.2, 8.2, 0), (12.4, .4, 14.8))
    s.box("RoofRight", stone, (9.2, 8.2, 0), (12.4, .4, 14.8))
    for i in range(6):
        for side in (-1, 1):
            s.box(f"Column{i}{'LR'[side > 0]}", stone, (-12.5 + 5 * i, 4, side * 4), (.8, 8, .8))
    s.box("Block", s.material(WHITE), (-3, 1, -1), (2, 2, 2), rotation(35))
    s.sun("Sun", (-.5, -1, -.25), (1, .95, .85), 4)
    s.sky((.3, .45, .7), 1)
    s.camera((13.5, 2.4, .5), (-4, 2.4, -1.5), 65)
    s.probe("Probe", (0, 4.1, 0), (15.5, 4.6, 7.5))
    return s


def textured_room():
    """Walls of strong texture: bounced light takes the mean colour, pixels the texel's."""
    s = Scene()
    white = s.material(WHITE)
    checks = s.material((1, 1, 1), texture="res://checks.png", uv_scale=3)
    s.shell((5, 3, 5), {**dict.fromkeys(("ceiling", "front", "right"), white), "floor": checks, "left": checks,
                        "back": white})
    s.box("Box", checks, (.8, .5, -1), (1, 1, 1), rotation(30))
    s.sphere("Ball", white, (-.8, .6, -.9), .6)
    s.omni("Lamp", (0, 2.5, .4), (1, 1, 1), .9, 7)
    s.camera((1.6, 1.6, 2.3), (-.5, 1, -1.2), 65)
    s.probe("Probe", (0, 1.5, 0), (2.9, 1.9, 2.9))
    return s


def slats():
    """A blind of slats thinner than a voxel before a bright panel."""
    s = Scene()
    white = s.material(WHITE)
    s.shell((5, 3, 5), {**dict.fromkeys(("floor", "ceiling", "front", "back"), white), "left": s.material(GREEN),
                        "right": white})
    s.box("Panel", s.material((0, 0, 0), (1, .9, .75), 3), (0, 1.6, -2.47), (3.4, 1.8, .06))
    for i in range(16):
        s.box(f"Slat{i}", white, (0, .65 + .125 * i, -2), (3.6, .015, .12), rotation(0, 35))
    s.box("Crate", white, (-.9, .4, -.5), (.8, .8, .8), rotation(20))
    s.camera((1.4, 1.5, 2.3), (-.4, 1.1, -1.6), 65)
    s.probe("Probe", (0, 1.5, 0), (2.9, 1.9, 2.9))
    return s


SCENES = (neon_room, bright_corridor, two_rooms, stairs, many_boxes, sphere_room, glossy_room, rotated_room, sky_window,
          eight_lamps, large_hall, textured_room, slats)


def png(rgb):
    """Bytes of an 8-bit RGB PNG, [height, width, 3]."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + row.tobytes() for row in rgb)
    header = struct.pack(">IIBBBBB", rgb.shape[1], rgb.shape[0], 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def checks():
    """Orange and slate squares of 16 texels in a 64 x 64 picture."""
    at = np.indices((64, 64)) // 16
    odd = (at.sum(axis=0) % 2).astype(bool)
    return np.where(odd[..., None], np.array([210, 120, 40]), np.array([70, 80, 110])).astype(np.uint8)


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent / "scenes")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "checks.png").write_bytes(png(checks()))
    for make in SCENES:
        (folder / f"{make.__name__}.tscn").write_text(make().text(), encoding="utf-8")


if __name__ == "__main__":
    main()
