#!/usr/bin/env python3
"""Runs clang-tidy on every source file of the layers and programs, on all cores; remembers clean files, so that a
repeat reads only changes. Tests are compiled with the same warnings but not linted: doctest's macros are not ours.

usage: tests/lint.py [FILE...]
A file is remembered by the hash of its preprocessed text together with .clang-tidy, in build/lint/.
"""
import concurrent.futures
import hashlib
import json
import os
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CACHE = ROOT / "build" / "lint"


def command_of(entry):
    words = shlex.split(entry["command"])
    while words and Path(words[0]).name in ("ccache",):
        words.pop(0)
    return [w for w in words if w not in ("-c",)]


def key_of(entry, config):
    words = command_of(entry)
    out = words.index("-o")
    words = words[:out] + words[out + 2:]
    text = subprocess.run(words + ["-E", "-P"], cwd=ROOT, capture_output=True, check=False).stdout
    return hashlib.sha256(config + text).hexdigest()


def lint(entry, config):
    mark = CACHE / key_of(entry, config)
    if mark.exists():
        return entry["file"], ""
    run = subprocess.run(["clang-tidy-14", "--quiet", "-p", str(ROOT), entry["file"]], cwd=ROOT, capture_output=True,
                         text=True, check=False)
    if run.returncode == 0:
        mark.touch()
        return entry["file"], ""
    return entry["file"], run.stdout + run.stderr


def main():
    CACHE.mkdir(parents=True, exist_ok=True)
    subprocess.run(["scons", "-Q", "--silent", "compiledb", "glad", "shaders"], cwd=ROOT, check=True)
    entries = {e["file"]: e for e in json.loads((ROOT / "compile_commands.json").read_text())
               if not e["file"].startswith(("build/", "tests/"))}
    wanted = sys.argv[1:] or sorted(entries)
    unknown = [n for n in wanted if n not in entries]
    if unknown:
        print(f"lint: expected source files of the layers or of demo, found {', '.join(unknown)}")
        return 1
    config = (ROOT / ".clang-tidy").read_bytes()
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, text in pool.map(lambda n: lint(entries[n], config), wanted):
            if text:
                failed += 1
                print(text)
    print(f"lint: {len(wanted)} files, {failed} with faults")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
