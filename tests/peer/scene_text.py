"""Writes small Godot 3 text scenes: sub-resources and nodes by type name and keyword properties.

    s = SceneText()
    red = s.resource("SpatialMaterial", albedo_color=color(1, 0, 0))
    s.node("Box", "MeshInstance", transform=place((0, 1, 0), yaw=30), mesh=s.resource("CubeMesh"), **{"material/0": red})
    open("scene.tscn", "w").write(s.text())

Property values are scene-file text, or numbers and bools, which are written as such.
"""
import math


def number(v):
    return repr(round(float(v), 6)) if isinstance(v, float) else str(v)


def value(v):
    if isinstance(v, bool):
        return "true" if v else "false"
    return v if isinstance(v, str) else number(v)


def call(name, *numbers):
    return "%s( %s )" % (name, ", ".join(number(n) for n in numbers))


def vector(x, y, z):
    return call("Vector3", x, y, z)


def color(r, g, b, a=1):
    return call("Color", r, g, b, a)


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def rotation(yaw=0.0, pitch=0.0, roll=0.0):
    """Ry * Rx * Rz of degrees, as Godot's Euler angles."""
    y, x, z = (math.radians(a) for a in (yaw, pitch, roll))
    ry = [[math.cos(y), 0, math.sin(y)], [0, 1, 0], [-math.sin(y), 0, math.cos(y)]]
    rx = [[1, 0, 0], [0, math.cos(x), -math.sin(x)], [0, math.sin(x), math.cos(x)]]
    rz = [[math.cos(z), -math.sin(z), 0], [math.sin(z), math.cos(z), 0], [0, 0, 1]]
    return product(product(ry, rx), rz)


def place(origin, yaw=0.0, pitch=0.0, roll=0.0, scale=(1, 1, 1)):
    r = rotation(yaw, pitch, roll)
    basis = [r[i][j] * scale[j] for i in range(3) for j in range(3)]
    return call("Transform", *(float(v) for v in basis + list(origin)))


def look(eye, target):
    """Looks along -Z from eye to target, with +Y up as far as possible."""
    z = [e - t for e, t in zip(eye, target)]
    length = math.sqrt(sum(c * c for c in z))
    z = [c / length for c in z]
    up = (0, 1, 0) if abs(z[1]) < 0.999 else (1, 0, 0)
    x = [up[1] * z[2] - up[2] * z[1], up[2] * z[0] - up[0] * z[2], up[0] * z[1] - up[1] * z[0]]
    length = math.sqrt(sum(c * c for c in x))
    x = [c / length for c in x]
    y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]]
    basis = [c for row in zip(x, y, z) for c in row]
    return call("Transform", *(float(v) for v in basis + list(eye)))


class SceneText:
    def __init__(self):
        self._resources, self._nodes = [], ['[node name="Root" type="Spatial"]\n']

    def _lines(self, properties):
        return "".join("%s = %s\n" % (k, value(v)) for k, v in properties.items())

    def resource(self, kind, **properties):
        self._resources.append('[sub_resource type="%s" id=%d]\n%s' % (kind, len(self._resources) + 1,
                                                                       self._lines(properties)))
        return "SubResource( %d )" % len(self._resources)

    def node(self, name, kind, parent=".", **properties):
        self._nodes.append('[node name="%s" type="%s" parent="%s"]\n%s' % (name, kind, parent, self._lines(properties)))

    def texture(self, width, height, texel, components=3, flags=7):
        """texel(x, y) -> `components` bytes."""
        data = [b for y in range(height) for x in range(width) for b in texel(x, y)]
        form = {1: "Lum8", 2: "LumAlpha8", 3: "RGB8", 4: "RGBA8"}[components]
        image = self.resource("Image", data='{\n"data": PoolByteArray( %s ),\n"format": "%s",\n"height": %d,\n'
                              '"mipmaps": false,\n"width": %d\n}' % (", ".join(map(str, data)), form, height, width))
        return self.resource("ImageTexture", flags=flags, image=image, size="Vector2( %d, %d )" % (width, height))

    def text(self):
        head = "[gd_scene load_steps=%d format=2]\n" % (len(self._resources) + 1)
        return "\n".join([head] + self._resources + self._nodes)
