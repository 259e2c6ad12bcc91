"""Runs a scene in Conelight: picture, baked probe data, timings."""
import json
import os
import subprocess
from pathlib import Path


class ConelightFailed(Exception):
    pass


def call(program, *words, extra=None):
    done = subprocess.run([str(program), *map(str, words)], capture_output=True, text=True,
                          env={**os.environ, **(extra or {})})
    if done.returncode:
        raise ConelightFailed((done.stderr.strip().splitlines() or [f"exit status {done.returncode}"])[-1])


def overrides(edits):
    """The state after all edits, as --set options. edits: (node, property, value as text)."""
    last = {(node, name): value for node, name, value in edits}
    return [word for (node, name), value in last.items() for word in ("--set", f"{node}:{name}={value}")]


def run(program, scene, folder, size, quality="high", edits=(), mode="cones", extra=None):
    """Returns {"picture": Path, "bake_ms", "relight_ms", "frame_ms", ...}."""
    folder.mkdir(parents=True, exist_ok=True)
    picture, stats = folder / f"{mode}_{quality}.png", folder / f"{mode}_{quality}.json"
    call(program, "render", scene, "-q", "--gi", mode, "--quality", quality, "--size", "%dx%d" % tuple(size), "-o", picture,
         "--stats", stats, *overrides(edits), extra=extra)
    return {"picture": picture, **json.loads(stats.read_text())}


def bake(program, scene, folder):
    """Bakes every probe as Godot does; returns {probe's name: Path}."""
    folder.mkdir(parents=True, exist_ok=True)
    call(program, "bake", scene, "-q", "--compat", "-o", folder)
    return {p.stem: p for p in sorted(Path(folder).glob("*.tres"))}
