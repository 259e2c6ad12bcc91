"""Runs the conelight program."""
import json
import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


class Failed(Exception):
    """A run that ended with an error: its last line."""


class Conelight:
    def __init__(self, program=None, size=(480, 270)):
        self.program = Path(program or os.environ.get("CONELIGHT", ROOT / "bin" / "conelight"))
        if not self.program.exists():
            raise SystemExit(f"expected the program conelight, found nothing at {self.program}: build it by `scons`")
        self.size = "x".join(map(str, size))

    def run(self, *options):
        got = subprocess.run([str(self.program), *map(str, options)], capture_output=True, text=True, check=False)
        if got.returncode:
            raise Failed((got.stderr.strip().splitlines() or [f"exit status {got.returncode}"])[-1])

    def render(self, scene, outputs, *options, stats=None):
        """Draws a scene into one or more files. @return the run's figures where `stats` names a file for them"""
        files = [word for path in outputs for word in ("-o", path)]
        more = ("--stats", stats) if stats else ()
        self.run("render", scene, "-q", "--size", self.size, *files, *more, *options)
        return json.loads(Path(stats).read_text()) if stats else {}

    def has_reference(self):
        try:
            self.run("reference", "--help")
        except Failed:
            return False
        return True

    def reference(self, scene, output, spp, seed=0):
        self.run("reference", scene, "-q", "--size", self.size, "--spp", spp, "--seed", seed, "-o", output)
