"""Runs a scene in real Godot 3.2.3 (Debian's godot3 under Xvfb): picture, baked probe data, timings."""
import json
import os
import shutil
import subprocess
from pathlib import Path

PROJECT = """config_version=4
[application]
config/name="peer"
run/main_scene="res://peer_main.tscn"
[display]
window/size/width=%d
window/size/height=%d
[rendering]
%s
"""
FORCED = {"quality/driver/driver_name": '"GLES3"', "quality/filters/msaa": "0"}
USUAL = {"quality/shadow_atlas/size": "4096", "quality/directional_shadow/size": "4096"}
MAIN = """[gd_scene load_steps=2 format=2]

[ext_resource path="res://peer_main.gd" type="Script" id=1]

[node name="Main" type="Spatial"]
script = ExtResource( 1 )
"""
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


# What Godot shows only after its editor has made files of its own from it.
IMPORTED = {".png", ".jpg", ".jpeg", ".webp", ".tga", ".hdr", ".exr", ".gltf", ".glb", ".obj", ".dae"}
PATIENCE_S = "900"


class GodotFailed(Exception):
    pass


def project_root(scene):
    """The nearest folder upward that holds a project.godot, else the scene's own."""
    for folder in scene.parents:
        if (folder / "project.godot").exists():
            return folder
    return scene.parent


def copy_project(scene, folder):
    """The scene alone if it is complete in itself, else its whole project; returns its path in `folder`."""
    shutil.rmtree(folder, ignore_errors=True)
    root = project_root(scene)
    if "[ext_resource" in scene.read_text():
        shutil.copytree(root, folder, ignore=shutil.ignore_patterns(".git"))
    else:
        (folder / scene.relative_to(root)).parent.mkdir(parents=True)
        shutil.copy(scene, folder / scene.relative_to(root))
    return scene.relative_to(root)


def rendering_settings(scene, quality):
    """Those of the scene's own project, which Conelight follows, too; but what a comparison needs."""
    own, project = dict(USUAL), project_root(scene) / "project.godot"
    section = ""
    for line in project.read_text().splitlines() if project.exists() else []:
        name, equals, value = line.partition("=")
        if line.startswith("["):
            section = line.strip()
        elif equals and section == "[rendering]":
            own[name] = value
    own.update(FORCED, **{"quality/voxel_cone_tracing/high_quality": "true" if quality == "high" else "false"})
    return "\n".join("%s=%s" % setting for setting in own.items())


def call(folder, *words, variables=()):
    """Runs Godot on the project in `folder`, where its caches and settings stay, too."""
    command = ["xvfb-run", "-a", "-s", "-screen 0 1920x1200x24", "env", *variables, "timeout", PATIENCE_S, "godot3", "--path",
               str(folder), *words]
    return subprocess.run(command, capture_output=True, text=True, env={**os.environ, "HOME": str(folder)})


def add_imported(folder, kept):
    """Gives the project in `folder` what the editor imports of its textures and models; `kept`: where that is kept."""
    made = folder / ".import"
    if made.exists() or not any(p.suffix.lower() in IMPORTED for p in folder.rglob("*")):
        return
    if kept.exists():
        shutil.copytree(kept, made)
        return
    done = call(folder, "--editor", "--quit")  # it may crash at its end, when all is imported
    if not made.exists():
        raise GodotFailed(f"{folder}: nothing was imported: {done.stdout[-600:]}{done.stderr[-600:]}")
    shutil.copytree(made, kept)


def run(scene, folder, size, quality="high", edits=(), off=False, extra=None):
    """Draws `scene` (Path) with a copy of its project in `folder`; bakes the probes that have no data.

    edits: (node, property, value as text), made one after the other while the scene is shown.
    extra: more of Godot's environment.
    Returns {"picture": Path, "bake_ms", "frame_ms", "data": {probe's name: Path}}.
    """
    inside = copy_project(scene, folder)
    words = dict(scene=inside, edits=json.dumps([list(e) for e in edits]), off="true" if off else "false")
    (folder / "project.godot").write_text(PROJECT % (*size, rendering_settings(scene, quality)))
    add_imported(folder, folder.parent / "imported")
    (folder / "peer_main.gd").write_text(SCRIPT % words)
    (folder / "peer_main.tscn").write_text(MAIN)
    done = call(folder, variables=["%s=%s" % v for v in (extra or {}).items()])
    if not (folder / "peer_out.json").exists():
        raise GodotFailed(f"{scene}: Godot ended with status {done.returncode}: {done.stdout[-600:]}{done.stderr[-600:]}")
    figures = json.loads((folder / "peer_out.json").read_text())
    data = {p.stem[len("peer_data_"):]: p for p in sorted(folder.glob("peer_data_*.tres"))}
    return {"picture": folder / "peer_out.png", "data": data, "log": done.stdout + done.stderr, **figures}
