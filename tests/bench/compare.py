"""Measures Conelight and real Godot 3.2.3 in turn, on the same scenes, subdivisions and sizes.

usage: tests/bench/run [SCENE...] [--runs N] [--measure WHAT,...] [--size WxH] [--json FILE]

Each run of a measure starts one process of each, one after the other, and every second run the other way
round, so that what else the machine does falls on both. Printed are medians over the runs with the least
and the most, and ours divided by Godot's. Without SCENE: the oracle's Cornell box below $CONELIGHT_SHARED
if that is set, else demo/scenes/cornell.tscn. Scenes that are not complete in themselves bring their project.
"""
import argparse
import json
import os
import platform
import signal
import sys
import tempfile
from pathlib import Path

import scenes
from conelight import Conelight
from godot import BAKE, FRAME, RELIGHT, SETTLE, START, Display, Godot
from table import Row, print_table

ROOT = Path(__file__).resolve().parent.parent.parent
MODES = ["cones", "auto"]


class Bench:
    """The measures. Each is a list of runs; a run returns {row's name: (ours, Godot's)}, None for neither."""

    def __init__(self, ours, godot, work):
        self.ours, self.godot, self.work = ours, godot, work

    def in_turn(self, run, *both):
        """Calls the two, Godot first in every second run; returns ours, Godot's."""
        if run % 2 == 0:
            return both[0](), both[1]()
        theirs = both[1]()
        return both[0](), theirs

    def start(self, scene, run):
        """Process start to exit: load, bake, light, draw, write the picture; shader caches are empty."""
        if run == 0:
            self.settled_at = self.godot.run(scene, SETTLE, subdiv=-1)["frames"]
        godot = lambda: self.godot.run(scene, START, subdiv=-1, frames=self.settled_at)["wall_ms"]
        size = self.ours.size_words()
        ours = lambda: {m: self.ours.run("render", scene, "--gi", m, *size, "-o", "{folder}/out.png")["wall_ms"]
                        for m in MODES}
        mine, theirs = self.in_turn(run, ours, godot)
        return {f"start to picture, {m}": (mine[m], theirs) for m in MODES}

    def bake(self, scene, run):
        def ours(cells):
            figures = self.ours.run("bake", scene, "--compat", "--subdiv", str(cells), "-o", "{folder}", figures="--json")
            return sum(p["bake_ms"] for p in figures["probes"])
        cells = [64, 128, 256]
        mine, theirs = self.in_turn(run, lambda: {c: ours(c) for c in cells},
                                    lambda: self.godot.run(scene, BAKE, subdivs="[0, 1, 2]"))
        return {f"bake at {c}": (mine[c], theirs[str(c)]) for c in cells}

    def relight(self, scene, run):
        """From the change of one light's energy until all its light is there."""
        rows = {}
        for lights in (1, 16):
            lit = scenes.with_lights(scene, self.work / "scenes", lights)
            if lit is None:
                continue
            for index, cells in enumerate([64, 128, 256]):
                if lights == 16 and cells != 128:
                    continue
                words = [*self.ours.subdivision(lit, index), "--size", "64x36", "--runs", "5"]
                ours = lambda: {m: self.ours.run("bench", lit, "--gi", m, *words, figures="--json")["relight_ms"]
                                for m in MODES}
                godot = lambda: self.godot.run(lit, RELIGHT, size=(64, 36), subdiv=index,
                                               window_ms=[2000, 4000, 12000][index])["relight"]
                mine, theirs = self.in_turn(run, ours, godot)
                rows.update({f"relight 1 of {lights} at {cells}, {m}": (mine[m], theirs) for m in MODES})
        return rows

    def frame(self, scene, run):
        size = [*self.ours.size_words(), "--runs", "9"]

        def ours():
            draw = lambda *words: self.ours.run("bench", scene, *words, *size, figures="--json")
            found = {"low": draw("--gi", "cones", "--quality", "low"), "high": draw("--gi", "cones"),
                     "auto": draw("--gi", "auto")}
            found["off"] = {"frame_ms": found["auto"]["frame_ms"] - found["auto"]["gi_ms"]}
            return found
        def godot():
            return {q: self.godot.run(scene, FRAME, quality=q, subdiv=-1, frames=21) for q in ("low", "high")}
        mine, theirs = self.in_turn(run, ours, godot)
        high, low = theirs["high"], theirs["low"]
        return {"frame, no GI": (mine["off"]["frame_ms"], high["off"]),
                "frame, cones low": (mine["low"]["frame_ms"], low["frame"]),
                "frame, cones high": (mine["high"]["frame_ms"], high["frame"]),
                "frame, auto (Godot: high)": (mine["auto"]["frame_ms"], high["frame"]),
                "GI's share, cones low": (mine["low"]["gi_ms"], low["frame"] - low["off"]),
                "GI's share, cones high": (mine["high"]["gi_ms"], high["frame"] - high["off"]),
                "GI's share, auto (Godot: high)": (mine["auto"]["gi_ms"], high["frame"] - high["off"])}

    def memory(self, scene, run):
        """Most resident memory [MiB] of load, bake, light and draw."""
        rows = {}
        for index, cells in ((1, 128), (2, 256)):
            words = [*self.ours.subdivision(scene, index), *self.ours.size_words(), "-o", "{folder}/out.png"]
            ours = lambda: {m: self.ours.run("render", scene, "--gi", m, *words)["peak_mib"] for m in MODES}
            godot = lambda: self.godot.run(scene, START, subdiv=index, frames=10)["peak_mib"]
            mine, theirs = self.in_turn(run, ours, godot)
            rows.update({f"peak memory at {cells}, {m}": (mine[m], theirs) for m in MODES})
        return rows


MEASURES = ["start", "bake", "relight", "frame", "memory"]


def default_scenes():
    shared = os.environ.get("CONELIGHT_SHARED")
    oracle = Path(shared or "") / "oracle/scenes/cornell_omni.tscn"
    return [oracle if shared and oracle.exists() else ROOT / "demo/scenes/cornell.tscn"]


def arguments():
    a = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    a.add_argument("scene", nargs="*", type=Path)
    a.add_argument("--runs", type=int, default=7)
    a.add_argument("--measure", default=",".join(MEASURES), help="of " + ", ".join(MEASURES))
    a.add_argument("--size", default="480x270")
    a.add_argument("--json", type=Path, help="also write every single value here")
    a.add_argument("--conelight", type=Path, default=ROOT / "bin/conelight")
    a.add_argument("--timeout", type=int, default=600, help="of one process [s]")
    o = a.parse_args()
    wrong = set(o.measure.split(",")) - set(MEASURES)
    if wrong or o.runs < 1:
        a.error(f"expected --runs of at least 1 and measures of {', '.join(MEASURES)}")
    return o


def measure_all(bench, options, rows):
    """Adds to `rows` as it goes: what was measured before an interruption counts."""
    for scene in [s.resolve() for s in options.scene or default_scenes()]:
        for run in range(options.runs):
            for name in options.measure.split(","):
                print(f"{scene.stem}: {name}, run {run + 1} of {options.runs}", file=sys.stderr, flush=True)
                for row, (ours, godot) in getattr(bench, name)(scene, run).items():
                    rows.setdefault((scene.stem, row), Row(scene.stem, row)).add(ours, godot)


def main():
    o = arguments()
    size = tuple(int(v) for v in o.size.split("x"))
    with tempfile.TemporaryDirectory(prefix="conelight_bench_") as work, Display() as display:
        bench = Bench(Conelight(o.conelight.resolve(), work, size, o.timeout), Godot(display, work, size, o.timeout),
                      Path(work))
        load = os.getloadavg()[0]
        rows = {}
        signal.signal(signal.SIGTERM, signal.default_int_handler)
        try:
            measure_all(bench, o, rows)
        except KeyboardInterrupt:
            print("interrupted: fewer runs than asked for", file=sys.stderr)
    about = {"machine": platform.platform(), "cores": os.cpu_count(), "load_before": load,
             "load_after": os.getloadavg()[0], "size": size, "runs": o.runs}
    print(f"{about['cores']} cores, load {load:.1f} before and {about['load_after']:.1f} after, {o.size}, {o.runs} runs")
    print_table(rows.values())
    if o.json:
        o.json.write_text(json.dumps({**about, "rows": [r.as_json() for r in rows.values()]}, indent=1) + "\n")


if __name__ == "__main__":
    main()
