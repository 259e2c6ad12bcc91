#!/usr/bin/env python3
"""Fails on an #include that points up the layers, and on a top-level folder that is none of the layers.

Reads every #include "..." of every .h and .cpp; the allowed directions are those of the table below.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MAY_INCLUDE = {
    "core": {"core"},
    "servers": {"servers", "core"},
    "drivers": {"drivers", "servers", "core", "gen"},
    "scene": {"scene", "servers", "core"},
    "modules": {"modules", "scene", "servers", "core"},
    "demo": {"demo", "modules", "scene", "drivers", "servers", "core"},
    "tests": {"tests", "demo", "modules", "scene", "drivers", "servers", "core", "gen"},
}
# Raw GL calls live below drivers/gles3 and the contexts that load them; JSON and command line only in programs.
ONLY_IN = [
    (re.compile(r"^(glad|GLES3?|GL|EGL|GLFW)/"), ("drivers/", "tests/drivers/")),
    (re.compile(r"^CLI/"), ("demo/",)),
    (re.compile(r"^nlohmann/"), ("demo/", "tests/")),
]
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)


def top_folders():
    """Without hidden ones and what the build makes. Not asked of git: a plain copy of the files is checked too."""
    return sorted(f for f in ROOT.iterdir() if f.is_dir() and not f.name.startswith((".", "__")) and
                  f.name not in ("build", "bin"))


def files():
    return sorted(str(f.relative_to(ROOT)) for top in top_folders() for f in top.rglob("*")
                  if f.suffix in (".h", ".cpp"))


def faults(name, text):
    layer = name.split("/")[0]
    for match in INCLUDE.finditer(text):
        kind, target = match.groups()
        line = text.count("\n", 0, match.start(1)) + 1
        if kind == '"':
            to = target.split("/")[0]
            if "/" not in target:
                yield f"{name}:{line}: error: expected a path from the root, found \"{target}\""
            elif to not in MAY_INCLUDE.get(layer, set()):
                yield f"{name}:{line}: error: {layer} may not include {to} (\"{target}\")"
        for pattern, places in ONLY_IN:
            if pattern.match(target) and not name.startswith(places):
                yield f"{name}:{line}: error: <{target}> belongs in {' or '.join(places)}"


def main():
    names = files()
    found = [f for n in names for f in faults(n, (ROOT / n).read_text(encoding="utf-8"))]
    for top in top_folders():
        if top.name not in MAY_INCLUDE:
            found.append(f"{top.name}: error: expected one of {', '.join(MAY_INCLUDE)}, found another top-level folder")
    print("\n".join(found) if found else f"layers: {len(names)} files, no upward include")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
