"""Measures scenes that are large in one way each, to find where cost grows faster than what is visible or changed.

usage: tests/bench/scale [NAME...] [--gi cones,auto] [--json FILE]   names: --help lists them

Each scene is made, loaded, baked, lit and drawn by one process. Printed are its parts, its length from start
to picture and its peak memory. A run that takes longer than --timeout or fails says so and the others go on.
"""
import argparse
import json
import sys
import tempfile
from pathlib import Path

from conelight import Conelight, ConelightFailed

ROOT = Path(__file__).resolve().parent.parent.parent
HEAD = """[gd_scene load_steps=6 format=2]

[sub_resource type="CubeMesh" id=1]
size = Vector3( 1, 1, 1 )

[sub_resource type="SpatialMaterial" id=2]
albedo_color = Color( 0.85, 0.85, 0.85, 1 )
roughness = 1.0

[sub_resource type="SpatialMaterial" id=3]
albedo_color = Color( 0.8, 0.3, 0.2, 1 )
roughness = 1.0

[sub_resource type="Environment" id=4]
background_mode = 1
ambient_light_color = Color( 0, 0, 0, 1 )

[sub_resource type="SphereMesh" id=5]
radial_segments = %(segments)d
rings = %(rings)d

[node name="Root" type="Spatial"]

[node name="World" type="WorldEnvironment" parent="."]
environment = SubResource( 4 )

"""


class SceneText:
    """A scene file in the making: boxes, lights, probes."""

    def __init__(self, segments=16, rings=8):
        self.parts, self.count = [HEAD % dict(segments=segments, rings=rings)], 0

    def node(self, kind, at, scale=(1, 1, 1), *lines):
        self.count += 1
        turn = "%g, 0, 0, 0, %g, 0, 0, 0, %g, %g, %g, %g" % (*scale, *at)
        self.parts.append(f'[node name="{kind}{self.count}" type="{kind}" parent="."]\n'
                          f"transform = Transform( {turn} )\n" + "".join(l + "\n" for l in lines) + "\n")

    def box(self, at, scale, material=2, mesh=1):
        self.node("MeshInstance", at, scale, "use_in_baked_light = true", f"mesh = SubResource( {mesh} )",
                  f"material/0 = SubResource( {material} )")

    def lamp(self, at, energy=1.0, reach=8.0, shadow=False):
        self.node("OmniLight", at, (1, 1, 1), f"light_energy = {energy:g}", f"omni_range = {reach:g}",
                  f"shadow_enabled = {str(shadow).lower()}")

    def probe(self, at, half, subdiv=1):
        self.node("GIProbe", at, (1, 1, 1), f"subdiv = {subdiv}", "extents = Vector3( %g, %g, %g )" % half)

    def room(self, at, size, height=4.0):
        """Floor, ceiling and three walls of a square room around `at` (the middle of its floor)."""
        x, y, z = at
        self.box((x, y - 0.1, z), (size, 0.2, size))
        self.box((x, y + height + 0.1, z), (size, 0.2, size))
        self.box((x - size / 2, y + height / 2, z), (0.2, height, size), 3)
        self.box((x + size / 2, y + height / 2, z), (0.2, height, size))
        self.box((x, y + height / 2, z - size / 2), (size, height, 0.2))

    def camera(self, at, far=200.0):
        self.node("Camera", at, (1, 1, 1), "current = true", "fov = 60.0", f"far = {far:g}")

    def text(self):
        return "".join(self.parts)


def simple_room(subdiv):
    s = SceneText()
    s.room((0, 0, 0), 5.0)
    s.box((0.8, 0.6, -0.5), (1.2, 1.2, 1.2))
    s.lamp((0, 3, 0), shadow=True)
    s.probe((0, 2, 0), (2.7, 2.7, 2.7), subdiv)
    s.camera((0, 2, 7))
    return s


def many_probes(rows=8):
    """rows^2 rooms, each with a probe and a lamp of its own."""
    s = SceneText()
    for i in range(rows * rows):
        x, z = i % rows * 6.0, -(i // rows) * 6.0
        s.room((x, 0, z), 5.0)
        s.lamp((x, 3, z))
        s.probe((x, 2, z), (2.7, 2.7, 2.7), 0)
    s.camera((rows * 3.0, 8, 14))
    return s


def many_lights(count=256):
    s = SceneText()
    s.room((0, 0, 0), 20.0)
    for i in range(count):
        s.lamp((i % 16 * 1.2 - 9, 3.5, i // 16 * 1.2 - 9), energy=0.1, reach=6.0)
    s.probe((0, 2, 0), (10.5, 2.7, 10.5))
    s.camera((0, 2, 12))
    return s


def many_triangles(millions=1):
    """Sixteen balls of 65,000 triangles each a million."""
    s = SceneText(segments=256, rings=126)
    s.room((0, 0, 0), 12.0)
    for i in range(16 * millions):
        s.box((i % 4 * 2.5 - 4, 0.9 + i // 16 * 1.8, i // 4 % 4 * 2.5 - 4), (0.8, 0.8, 0.8), 3, mesh=5)
    s.lamp((0, 3.5, 3), reach=16, shadow=True)
    s.probe((0, 2, 0), (6.5, 2.7, 6.5))
    s.camera((0, 2.5, 10))
    return s


def many_instances(count=10000):
    s = SceneText()
    s.room((0, 0, 0), 42.0)
    for i in range(count):
        s.box((i % 100 * 0.4 - 20, 0.1, i // 100 * 0.4 - 20), (0.2, 0.2 + 0.01 * (i % 37), 0.2), 2 + i % 2)
    s.lamp((0, 3.5, 0), reach=30, shadow=True)
    s.probe((0, 2, 0), (21.5, 2.7, 21.5))
    s.camera((0, 3, 22))
    return s


SCENES = {
    "probe_128": lambda: simple_room(1),
    "probe_512": lambda: simple_room(3),
    "probes_64": many_probes,
    "lights_16": lambda: many_lights(16),
    "lights_256": many_lights,
    "triangles_1m": many_triangles,
    "instances_1k": lambda: many_instances(1000),
    "instances_10k": many_instances,
}
PARTS = ["load_ms", "bake_ms", "relight_ms", "frame_ms", "gi_ms"]


def measure(ours, scene, mode):
    return ours.run("render", scene, "--gi", mode, *ours.size_words(), "-o", "{folder}/out.png", figures="--stats")


def main():
    a = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    a.add_argument("name", nargs="*", help="of " + ", ".join(SCENES))
    a.add_argument("--gi", default="cones,auto")
    a.add_argument("--json", type=Path)
    a.add_argument("--conelight", type=Path, default=ROOT / "bin/conelight")
    a.add_argument("--timeout", type=int, default=600, help="of one process [s]")
    o = a.parse_args()
    if set(o.name) - set(SCENES):
        a.error("expected names of " + ", ".join(SCENES))
    found = []
    print("%-14s %-6s" % ("scene", "gi") + "".join("%11s" % p for p in [*PARTS, "total_ms", "MiB"]))
    with tempfile.TemporaryDirectory(prefix="conelight_scale_") as work:
        ours = Conelight(o.conelight.resolve(), work, (480, 270), o.timeout)
        for name in o.name or SCENES:
            scene = Path(work) / f"{name}.tscn"
            scene.write_text(SCENES[name]().text())
            for mode in o.gi.split(","):
                try:
                    f = measure(ours, scene, mode)
                except ConelightFailed as e:
                    print(f"{name:14} {mode:6} {e}", file=sys.stderr)
                    continue
                found.append({"name": name, **f})
                values = [f[p] for p in PARTS] + [f["total_ms"], f["peak_mib"]]
                print("%-14s %-6s" % (name, mode) + "".join("%11s" % ("-" if v is None else f"{v:.1f}") for v in values),
                      flush=True)
    if o.json:
        o.json.write_text(json.dumps(found, indent=1) + "\n")


if __name__ == "__main__":
    main()
