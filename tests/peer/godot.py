"""Runs a scene in real Godot 3.2.3 (Debian's godot3 under Xvfb): picture, baked probe data, timings."""
import json

from godot_project import GodotFailed, add_imported, call, copy_project, write_project

# Godot's relight takes some frames: a picture is taken when that many have been drawn after the last edit.
SCRIPT = """extends Spatial
var edits = %(edits)s
func probes_of(n, out):
	if n is GIProbe:
		out.append(n)
	for c in n.get_children():
		probes_of(c, out)
func frames(n):
	for i in range(n):
		yield(get_tree(), "idle_frame")
func _ready():
	var scene = load("res://%(scene)s")
	if scene == null:
		get_tree().quit()
		return
	var root = scene.instance()
	add_child(root)
	var probes = []
	probes_of(root, probes)
	var r = {"bake_ms": 0.0, "frame_ms": 0.0}
	for p in probes:
		if p.data != null:
			continue
		var t = OS.get_ticks_usec()
		p.bake(root, false)
		r["bake_ms"] += (OS.get_ticks_usec() - t) / 1000.0
		ResourceSaver.save("res://peer_data_" + p.name + ".tres", p.data)
	if %(off)s:
		for p in probes:
			p.hide()
	yield(frames(40), "completed")
	for e in edits:
		root.get_node(e[0]).set(e[1], str2var(e[2]))
		yield(frames(4), "completed")
	if edits.size() > 0:
		yield(frames(40), "completed")
	var times = []
	for i in range(15):
		var t = OS.get_ticks_usec()
		yield(get_tree(), "idle_frame")
		times.append((OS.get_ticks_usec() - t) / 1000.0)
	times.sort()
	r["frame_ms"] = times[7]
	var img = get_viewport().get_texture().get_data()
	img.flip_y()
	img.save_png("res://peer_out.png")
	var f = File.new()
	f.open("res://peer_out.json", File.WRITE)
	f.store_string(to_json(r))
	f.close()
	get_tree().quit()
"""


def run(scene, folder, size, quality="high", edits=(), off=False, extra=None):
    """Draws `scene` (Path) with a copy of its project in `folder`; bakes the probes that have no data.

    edits: (node, property, value as text), made one after the other while the scene is shown.
    extra: more of Godot's environment.
    Returns {"picture": Path, "bake_ms", "frame_ms", "data": {probe's name: Path}}.
    """
    inside = copy_project(scene, folder)
    words = dict(scene=inside, edits=json.dumps([list(e) for e in edits]), off="true" if off else "false")
    write_project(scene, folder, "peer", SCRIPT % words, size, quality)
    add_imported(folder, folder.parent / "imported")
    done = call(folder, variables=["%s=%s" % v for v in (extra or {}).items()])
    if not (folder / "peer_out.json").exists():
        raise GodotFailed(f"{scene}: Godot ended with status {done.returncode}: {done.stdout[-600:]}{done.stderr[-600:]}")
    figures = json.loads((folder / "peer_out.json").read_text())
    data = {p.stem[len("peer_data_"):]: p for p in sorted(folder.glob("peer_data_*.tres"))}
    return {"picture": folder / "peer_out.png", "data": data, "log": done.stdout + done.stderr, **figures}
