"""A copy of a scene whose probes are given baked data."""
import re
import shutil

from godot_project import copy_project, project_root

FIRST_ID = 90001  # beyond the ids of any scene
PROBE = re.compile(r'^\[node name="([^"]+)" type="GIProbe"[^\]]*\]\n(?:(?!\[|; ).*\n)*', re.M)


def with_data(text, data):
    """`text` of a scene with `data = ExtResource( )` at each probe in `data` {name: res:// path}."""
    ids = {name: FIRST_ID + i for i, name in enumerate(sorted(data))}
    links = "".join('[ext_resource path="%s" type="GIProbeData" id=%d]\n' % (data[n], i) for n, i in ids.items())

    def give(section):
        name = section.group(1)
        if name not in data:
            return section.group(0)
        kept = re.sub(r"^data = .*\n", "", section.group(0), flags=re.M).rstrip("\n")
        return kept + "\ndata = ExtResource( %d )\n\n" % ids[name]

    head, rest = text.split("\n", 1)
    return head + "\n\n" + links + PROBE.sub(give, rest)


def scene_with_data(scene, folder, data):
    """Copies `scene` and what it needs to `folder` and gives its probes `data` {name: Path}; returns the copy's path."""
    copy = folder / copy_project(scene, folder)
    for name, path in data.items():
        shutil.copy(path, folder / ("given_%s.tres" % name))
    project = project_root(scene) / "project.godot"
    (folder / "project.godot").write_text(project.read_text() if project.exists() else "")
    copy.write_text(with_data(copy.read_text(), {n: "res://given_%s.tres" % n for n in data}))
    return copy
