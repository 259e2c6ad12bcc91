#!/usr/bin/env python3
"""Draws scenes with Conelight and with real Godot 3.2.3 and writes one HTML page: pictures, differences, figures.

SCENE is a .tscn or a folder of them; without any, the scenes of make_scenes.py. What Godot made is kept and used again
while the scene stays the same. A comment `; set NODE:PROPERTY=VALUE` in a scene is an edit that Godot makes while it
shows the scene; Conelight draws the final state.
"""
import argparse
import hashlib
import json
import re
import sys
from pathlib import Path

import conelight
import godot
import godot_project
import page
import pictures
import probe_data
import volumes
from given_data import scene_with_data
from make_scenes import write_scenes

ROOT = Path(__file__).resolve().parent.parent.parent
EDIT = re.compile(r"^; set ([^:]+):([^=]+)=(.*)$", re.M)


def options():
    parser = argparse.ArgumentParser(prog="tests/peer/report", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="*", type=Path)
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "build/peer/report.html")
    parser.add_argument("--program", type=Path, default=ROOT / "bin/conelight")
    parser.add_argument("--work", type=Path, default=ROOT / "build/peer", help="folder for what is kept")
    parser.add_argument("--size", default="480x270", help="WxH")
    parser.add_argument("--no-interchange", action="store_true", help="do not draw each program's data with the other")
    return parser.parse_args()


def scenes_of(paths, work):
    if not paths:
        write_scenes(work / "scenes")
        paths = [work / "scenes"]
    return [s.resolve() for p in paths for s in (sorted(p.glob("*.tscn")) if p.is_dir() else [p])]


def godot_run(scene, folder, size, recorder, records, **more):
    """godot.run() with its volumes recorded, or what it made last time of the same."""
    words = json.dumps([size, sorted(more.items()), godot_project.rendering_settings(scene, "")], default=str)
    words += godot.SCRIPT + volumes.SOURCE.read_text()
    key = hashlib.sha256(words.encode() + scene.read_bytes()).hexdigest()
    kept = folder.with_name(folder.name + ".json")
    if kept.exists():
        said = json.loads(kept.read_text())
        if said["key"] == key and Path(said["picture"]).exists():
            return {**said, "picture": Path(said["picture"]), "data": {n: Path(p) for n, p in said["data"].items()}}
    said = {"key": key, **godot.run(scene, folder, size, **more, extra=volumes.environment(recorder, records))}
    kept.write_text(json.dumps(said, default=str))
    return said


def compare(label, reference, picture, folder):
    difference = folder / ("difference_%s.png" % label.replace(" ", "_"))
    greatest = pictures.write_difference(reference, picture, difference)
    return {"label": label, "reference": reference, "picture": picture, "difference": difference,
            "flip": pictures.flip(reference, picture), "greatest": greatest}


def compare_scene(scene, folder, size, o):
    """All comparisons of one scene: {"name", "pictures": [...], "interchange": [...], "data": {...}, "times": {...}}."""
    edits = EDIT.findall(scene.read_text())
    folder.mkdir(parents=True, exist_ok=True)
    theirs, ours, shown = {}, {}, []
    for kind in ("high", "low", "off"):
        quality, mode = ("high", "off") if kind == "off" else (kind, "cones")
        records = [folder / ("volumes_%s_%s" % (program, kind)) for program in ("godot", "conelight")]
        theirs[kind] = godot_run(scene, folder / ("godot_" + kind), size, o.recorder, records[0], quality=quality,
                                 edits=edits, off=kind == "off")
        ours[kind] = conelight.run(o.program, scene, folder / "conelight", size, quality, edits, mode,
                                   volumes.environment(o.recorder, records[1]))
        shown.append(compare(kind, theirs[kind]["picture"], ours[kind]["picture"], folder))
    baked = conelight.bake(o.program, scene, folder / "conelight_data")
    data = {n: probe_data.match(baked[n], p) for n, p in theirs["high"]["data"].items() if n in baked}
    exchanged = [] if o.no_interchange else list(interchange(scene, folder, size, o, edits, theirs["high"], baked))
    times = {"Godot": {k: theirs["high"][k] for k in ("bake_ms", "frame_ms")},
             "Conelight": {k: ours["high"][k] for k in ("bake_ms", "relight_ms", "frame_ms")}}
    relit = volumes.match(folder / "volumes_conelight_high", folder / "volumes_godot_high")
    return {"name": scene.stem, "pictures": shown, "interchange": exchanged, "data": data, "times": times, "volumes": relit}


def interchange(scene, folder, size, o, edits, theirs, baked):
    given = scene_with_data(scene, folder / "with_our_data", {n: baked[n] for n in theirs["data"]})
    drawn = godot_run(given, folder / "godot_our_data", size, o.recorder, folder / "volumes_godot_our_data", edits=edits)
    yield compare("Godot draws our data", theirs["picture"], drawn["picture"], folder)
    given = scene_with_data(scene, folder / "with_godot_data", theirs["data"])
    drawn = conelight.run(o.program, given, folder / "conelight_godot_data", size, edits=edits)
    own = conelight.run(o.program, scene, folder / "conelight", size, edits=edits)
    yield compare("we draw Godot's data", own["picture"], drawn["picture"], folder)


def line_of(result):
    words = ["%s %.4f (%d)" % (p["label"], p["flip"], p["greatest"]) for p in result["pictures"] + result["interchange"]]
    words += ["%s: header %s, IoU %.5f, within 1 %.5f" % (n, "equal" if d["header"] else "DIFFERS", d["overlap"],
                                                         d["within_one"]) for n, d in result["data"].items()]
    words += ["volume bytes that differ %.5f %%" % (100 * share) for share in result["volumes"]]
    return "%-16s %s" % (result["name"], "; ".join(words))


def main():
    o = options()
    size = tuple(int(n) for n in o.size.split("x"))
    o.recorder = volumes.build_recorder(o.work)
    results, failed = [], 0
    for scene in scenes_of(o.scene, o.work):
        try:
            results.append(compare_scene(scene, o.work / "runs" / scene.stem, size, o))
            print(line_of(results[-1]), flush=True)
        except (godot.GodotFailed, conelight.ConelightFailed) as error:
            failed += 1
            print("%s: error: %s" % (scene.name, error), file=sys.stderr, flush=True)
    o.output.write_text(page.page(results))
    print("the page is", o.output)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
