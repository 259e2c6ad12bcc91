"""Drives our own program the way tests/bench/godot.py drives Godot."""
import json
import shutil
import subprocess
from pathlib import Path

from godot import timed


class ConelightFailed(Exception):
    pass


class Conelight:
    def __init__(self, program, work, size, seconds):
        self.program, self.work, self.size, self.seconds = str(program), Path(work), size, seconds
        self.count = 0

    def run(self, command, scene, *options, figures=None):
        """Returns {"wall_ms", "peak_mib"} and the JSON of `figures` ("--stats" or "--json"). Cold caches."""
        self.count += 1
        folder = self.work / f"conelight_{self.count}"
        folder.mkdir(parents=True)
        out = folder / "figures.json"
        words = [self.program, command, str(scene), "-q", *(o.replace("{folder}", str(folder)) for o in options)]
        if figures:
            words += [figures, str(out)]
        log = self.work / f"conelight_{self.count}.log"
        status, wall_ms, peak_mib = timed(words, folder, log, self.seconds)
        if status != 0:
            raise ConelightFailed(f"{' '.join(words)}: status {status}: {log.read_text(errors='replace')[-800:]}")
        found = json.loads(out.read_text()) if figures else {}
        shutil.rmtree(folder)
        return {**found, "wall_ms": wall_ms, "peak_mib": peak_mib}

    def size_words(self, size=None):
        return ["--size", "%dx%d" % (size or self.size)]

    def subdivision(self, scene, index):
        """Options that give all probes 64 << index cells along their longest axes."""
        answer = subprocess.run([self.program, "inspect", str(scene), "--tree", "--json"], capture_output=True,
                                text=True, check=True)
        probes = [n["path"] for n in json.loads(answer.stdout)["nodes"] if n["type"] == "GIProbe"]
        return [w for path in probes for w in ("--set", f"{path}:subdiv={index}")]
