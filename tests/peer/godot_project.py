"""Godot projects for comparisons: a copy of a scene with what it needs, and a main scene of our own."""
import os
import shutil
import subprocess

PROJECT = """config_version=4
[application]
config/name="%s"
run/main_scene="res://%s_main.tscn"
[display]
window/size/width=%d
window/size/height=%d
window/vsync/use_vsync=false
[rendering]
%s
"""
FORCED = {"quality/driver/driver_name": '"GLES3"', "quality/filters/msaa": "0"}
USUAL = {"quality/shadow_atlas/size": "4096", "quality/directional_shadow/size": "4096"}
MAIN = """[gd_scene load_steps=2 format=2]

[ext_resource path="res://%s_main.gd" type="Script" id=1]

[node name="Main" type="Spatial"]
script = ExtResource( 1 )
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


def write_project(scene, folder, name, script, size, quality):
    """Makes the copy in `folder` start with a scene whose script is `script`. name: of the files that are added."""
    (folder / "project.godot").write_text(PROJECT % (name, name, *size, rendering_settings(scene, quality)))
    (folder / f"{name}_main.gd").write_text(script)
    (folder / f"{name}_main.tscn").write_text(MAIN % name)


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
