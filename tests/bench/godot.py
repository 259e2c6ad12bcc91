"""Drives real Godot 3.2.3 (Debian's godot3) on one display that all its runs share."""
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "peer"))
from godot_project import GodotFailed, add_imported, copy_project, write_project

# What every script starts with. Frames are told apart by all their bytes.
COMMON = """extends Spatial
var root
var probes = []
var lights = []
func look_through(n):
	if n is GIProbe:
		probes.append(n)
	if n is Light and n.visible:
		lights.append(n)
	for c in n.get_children():
		look_through(c)
func open():
	root = load("res://%(scene)s").instance()
	add_child(root)
	look_through(root)
func bake(subdiv):
	var t = OS.get_ticks_usec()
	for p in probes:
		if subdiv >= 0:
			p.subdiv = subdiv
		p.bake(root, false)
	return (OS.get_ticks_usec() - t) / 1000.0
func frames(n):
	for i in range(n):
		yield(get_tree(), "idle_frame")
func picture():
	return hash(get_viewport().get_texture().get_data().get_data())
func timed_frames(n):
	var times = []
	for i in range(n):
		var t = OS.get_ticks_usec()
		yield(get_tree(), "idle_frame")
		times.append((OS.get_ticks_usec() - t) / 1000.0)
	times.sort()
	return times[n / 2]
func finish(figures):
	var f = File.new()
	f.open("res://bench_out.json", File.WRITE)
	f.store_string(to_json(figures))
	f.close()
	get_tree().quit()
"""
# From nothing to the first picture that has its indirect light: that of frame %(frames)d.
START = """
func _ready():
	open()
	bake(%(subdiv)d)
	yield(frames(%(frames)d), "completed")
	var img = get_viewport().get_texture().get_data()
	img.flip_y()
	img.save_png("res://bench_out.png")
	finish({})
"""
# At which frame that picture comes: the last one that differs from the one before.
SETTLE = """
func _ready():
	open()
	bake(%(subdiv)d)
	var last = 0
	var before = 0
	for i in range(1, 61):
		yield(get_tree(), "idle_frame")
		var now = picture()
		if now != before:
			last = i
		before = now
	finish({"frames": last})
"""
BAKE = """
func _ready():
	open()
	var times = {}
	for s in %(subdivs)s:
		times[str(64 << s)] = bake(s)
	finish(times)
"""
FRAME = """
func _ready():
	open()
	bake(%(subdiv)d)
	yield(frames(25), "completed")
	var with_gi = yield(timed_frames(%(frames)d), "completed")
	for p in probes:
		p.hide()
	yield(frames(4), "completed")
	var without = yield(timed_frames(%(frames)d), "completed")
	finish({"frame": with_gi, "off": without})
"""
# The first change is watched for long, the others for twice as long as that one took.
RELIGHT = """
func _ready():
	open()
	bake(%(subdiv)d)
	lights[0].shadow_enabled = false
	yield(frames(60), "completed")
	var energy = lights[0].light_energy
	var window_ms = %(window_ms)d
	var latencies = []
	for k in range(4):
		lights[0].light_energy = energy * (1.25 if k %% 2 == 0 else 1.0)
		var t = OS.get_ticks_usec()
		var before = picture()
		var last = 0.0
		var n = 0
		while (OS.get_ticks_usec() - t) / 1000.0 < window_ms or n < 12:
			yield(get_tree(), "idle_frame")
			var now = picture()
			if now != before:
				last = (OS.get_ticks_usec() - t) / 1000.0
			before = now
			n += 1
		latencies.append(last)
		window_ms = max(2.0 * last, 200.0)
	latencies.sort()
	finish({"relight": (latencies[1] + latencies[2]) / 2.0})
"""


class Display:
    """One Xvfb for all runs: its start is not part of any time."""

    def __enter__(self):
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1920x1200x24"],
                                       pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as answer:
            self.name = ":" + answer.readline().strip()
        if self.name == ":":
            raise GodotFailed("Xvfb did not start")
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()


def timed(command, folder, log, seconds, **variables):
    """Runs a command with caches and settings of its own, empty ones if `folder` is new.

    Returns (exit status, wall milliseconds, most resident memory in MiB).
    """
    home = folder / "home"
    home.mkdir(parents=True, exist_ok=True)
    environment = {**os.environ, "HOME": str(home), "XDG_CACHE_HOME": str(home), "XDG_DATA_HOME": str(home),
                   "XDG_CONFIG_HOME": str(home), "MESA_SHADER_CACHE_DIR": str(home), **variables}
    with open(log, "wb") as out:
        begin = time.perf_counter()
        process = subprocess.Popen(["timeout", str(seconds), *command], stdout=out, stderr=out, env=environment)
        _, status, usage = os.wait4(process.pid, 0)
        wall_ms = (time.perf_counter() - begin) * 1000.0
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, wall_ms, usage.ru_maxrss / 1024.0


class Godot:
    def __init__(self, display, work, size, seconds):
        self.display, self.work, self.size, self.seconds = display, Path(work), size, seconds
        self.count = 0

    def run(self, scene, script, quality="high", size=None, **words):
        """Returns {"wall_ms", "peak_mib"} and what the script found. Each run starts with cold caches."""
        self.count += 1
        folder = self.work / f"godot_{self.count}"
        inside = copy_project(scene, folder)
        text = (COMMON + script) % dict(scene=inside, **words)
        write_project(scene, folder, "bench", text, size or self.size, quality)
        add_imported(folder, self.work / f"imported_{scene.stem}")
        log = self.work / f"godot_{self.count}.log"
        status, wall_ms, peak_mib = timed(["godot3", "--path", str(folder)], folder, log, self.seconds,
                                          DISPLAY=self.display.name)
        out = folder / "bench_out.json"
        if not out.exists():
            raise GodotFailed(f"{scene}: Godot ended with status {status}: {log.read_text(errors='replace')[-800:]}")
        figures = json.loads(out.read_text())
        shutil.rmtree(folder)
        return {"wall_ms": wall_ms, "peak_mib": peak_mib, **figures}
