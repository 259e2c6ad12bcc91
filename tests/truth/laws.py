#!/usr/bin/env python3
"""Laws that hold whatever the scene looks like, on pictures: sealed rooms, scenes turned, mirrored, moved and scaled,
sizes of voxels, seams of probes, still scenes, numbers of threads and moving lights. Prints a line a law; fails if one
does not hold.

usage: tests/truth/run laws [--only WORD] [--program CONELIGHT] [--orientations N]
The laws on light transport itself are doctests: bin/tests -ns -ts='servers/radiosity*' runs the slow ones too.
"""
import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import pictures
from conelight import Conelight
from make_scenes import cornell
from scene_text import Scene, rotation

VOXEL, INNER = .1, 2.0  # of the sealed rooms [m]: 128 voxels are 12.8 m
LIGHTS = ("omni", "spot", "sun", "sky", "panel")


def draw(program, folder, scene, *options):
    """Linear radiance of a scene; gi auto."""
    path, out = Path(folder) / "scene.tscn", Path(folder) / "out.exr"
    path.write_text(scene.text(), encoding="utf-8")
    program.render(path, [out], "--gi", "auto", *options)
    return pictures.load(out)


def orientations(count):
    """Bases that turn +y to the neighbours of a cube of 27, spread over all 26."""
    directions = [np.array(d, float) for d in np.ndindex(3, 3, 3) if d != (1, 1, 1)]
    for k in np.linspace(0, 25, count).round().astype(int):
        d = directions[k] - 1
        d /= np.linalg.norm(d)
        yield rotation(np.degrees(np.arctan2(d[0], d[2])), np.degrees(np.arccos(d[1])), 14 * k)


def room(basis, thick_voxels, light, camera):
    """A sealed room with light of one kind outside; the camera within or without."""
    s = Scene((basis, np.zeros(3)))
    white = s.material((.73, .73, .73))
    s.shell((INNER, INNER, INNER), white, thick_voxels * VOXEL)
    s.box("Ground", white, (0, -.3 - thick_voxels * VOXEL, 0), (6, .4, 6))
    above = INNER + .8
    if light == "omni":
        s.omni("Light", (.3, above, .2), energy=4, reach=6)
    elif light == "spot":
        s.spot("Light", (.3, above, .2), (0, INNER, 0), energy=4, reach=6, angle=50)
    elif light == "sun":
        s.sun("Light", (.3, -1, .2), energy=2)
    elif light == "sky":
        s.sky((1, 1, 1), 1)
    else:
        s.box("Light", s.material((0, 0, 0), (1, 1, 1), 8), (0, above, 0), (1, .1, 1))
    if camera == "inside":
        s.camera((.8, 1.6, .8), (-.5, .2, -.5), 80)
    else:
        s.camera((2.4, 3.6, 2.4), (0, 1.2, 0), 40)
    s.basis = np.eye(3)
    s.probe("Probe", (0, 0, 0), (6.4, 3.2, 3.2))
    return s


def sealed(program, folder, args):
    """Mean radiance seen inside over that seen on the room from outside."""
    for thick in (4, 2, 1, .5, .25):
        bar = 1e-3 if thick >= .5 else 1e-2
        for light in LIGHTS:
            outside = pictures.luminance(draw(program, folder, room(np.eye(3), thick, light, "outside"))).mean()
            worst = 0
            for basis in orientations(args.orientations):
                inside = draw(program, folder, room(basis, thick, light, "inside"))
                worst = max(worst, pictures.luminance(np.abs(inside)).mean() / outside)
            yield f"sealed room, walls of {thick} voxels, {light}", worst, bar


def placed(program, folder, _):
    """Mean luminance of one scene however it is placed, its own probe with it."""
    def mean(basis, origin=(0, 0, 0)):
        world = np.asarray(basis, float), np.array(origin, float)
        return pictures.luminance(draw(program, folder, cornell(world))).mean()
    expected = mean(np.eye(3))
    for name, basis, origin in (("turned", rotation(30, 20, 10), (0, 0, 0)), ("turned over", rotation(110, 160, 45), (0, 0, 0)),
                                ("mirrored", np.diag([-1, 1, 1]), (0, 0, 0)), ("moved", np.eye(3), (210, -70, 33)),
                                ("ten times as large", np.eye(3) * 10, (0, 0, 0)),
                                ("a tenth as large", np.eye(3) / 10, (0, 0, 0))):
        yield f"a scene {name}", abs(mean(basis, origin) / expected - 1), .02


def voxels(program, folder, _):
    """Mean luminance at other subdivisions, and with voxels of twice and half the size."""
    def mean(subdiv, grow):
        s = cornell()
        s.nodes.pop()
        s.probe("Probe", (0, 2, 0), np.array([2.5, 2.5, 2.5]) * grow, subdiv=subdiv)
        return pictures.luminance(draw(program, folder, s)).mean()
    expected = mean(1, 1)
    for name, subdiv, grow in (("64", 0, 1), ("256", 2, 1), ("128, voxels twice as large", 1, 2)):
        yield f"subdivision {name}", abs(mean(subdiv, grow) / expected - 1), .05


def seam(program, folder, _):
    """The step in a wall where one of two overlapping probes takes over, against the same wall in one probe."""
    def row(probes):
        s = Scene()
        white = s.material((.73, .73, .73))
        s.shell((10, 3, 4), white, sides=("floor", "ceiling", "back", "left", "right"))
        s.omni("Lamp", (0, 2.4, .6), energy=1, reach=7)
        s.camera((0, 1.5, 5), (0, 1.5, 0), 50)
        for number, (x, half) in enumerate(probes):
            s.probe(f"Probe{number}", (x, 1.5, 0), (half, 2, 2.6))
        picture = pictures.luminance(draw(program, folder, s))
        return picture[picture.shape[0] // 2 - 8:picture.shape[0] // 2 + 8].mean(axis=0)
    ratio = row([(-2.4, 3.4), (2.4, 3.4)]) / row([(0, 5.8)])
    yield "seam of two probes, step from pixel to pixel", np.abs(np.diff(np.log(ratio))).max(), .02
    yield "two probes instead of one, anywhere in a wall", np.abs(np.log(ratio)).max(), .02


def still(program, folder, _):
    """Bytes of the picture after one frame, three frames, and with one and two threads."""
    first = draw(program, folder, cornell())
    for name, options in (("frame 2", ("--frames", 2)), ("frame 3", ("--frames", 3)), ("one thread", ("--threads", 1)),
                          ("two threads", ("--threads", 2))):
        other = draw(program, folder, cornell(), *options)
        yield f"still scene, {name}: pixels that differ", float((first != other).any(axis=2).sum()), 0


def motion(program, folder, _):
    """A lamp that jumps, swings and is switched, sixty frames a second (moving_light.cpp): how far frames are from the
    picture of the same lamp at rest."""
    shoot = program.program.with_name("moving_light")
    if not shoot.exists():
        print(f"skipped motion: no program {shoot}; build it by `scons {shoot.name}`")
        return
    subprocess.run([shoot, folder], check=True)

    def picture(name):
        return pictures.load(Path(folder) / f"{name}.png")

    def apart(name, settled):
        return float(pictures.flip_map(picture(name), picture(settled)).mean())

    def differing(name, settled):
        return float((picture(name) != picture(settled)).any(axis=2).sum())
    yield "still scene, the next frame: pixels that differ", differing("still_1", "still_0"), 0
    yield "a lamp 100 times off and on: pixels that differ", differing("switched", "still_0"), 0
    yield "a lamp that jumped, 8 frames later: FLIP to rest", apart("jump_08", "jump_settled"), .02
    yield "a lamp that jumped, 12 frames later: pixels that differ", differing("jump_12", "jump_settled"), 0
    swings = [p.stem.removesuffix("_settled") for p in Path(folder).glob("swing_*_settled.png")]
    yield "a lamp that swings at 2 m/s: FLIP of the worst frame to rest", max(apart(n, n + "_settled") for n in swings), .02


LAWS = {"sealed": sealed, "placed": placed, "voxels": voxels, "seam": seam, "still": still, "motion": motion}


def main():
    p = argparse.ArgumentParser(prog="tests/truth/run laws", description=__doc__.split("\n\n")[0])
    p.add_argument("--only", choices=LAWS, help="one law")
    p.add_argument("--program", type=Path, help="the conelight to measure (default: bin/conelight)")
    p.add_argument("--orientations", type=int, default=26, help="of the sealed rooms, 1 to 26")
    p.add_argument("--size", default="160x90", metavar="WxH")
    args = p.parse_args()
    program = Conelight(args.program, args.size.split("x"))
    broken = 0
    with tempfile.TemporaryDirectory() as folder:
        for name, law in LAWS.items():
            if args.only in (None, name):
                for what, found, bar in law(program, folder, args):
                    broken += found > bar
                    print(f"{'holds ' if found <= bar else 'BROKEN'} {what}: {found:.3g} (at most {bar:g})", flush=True)
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
