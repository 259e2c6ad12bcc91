"""Writes small diffuse scenes in Godot 3's text format.

Metres, degrees, linear colours (sRGB-encoded when written). Materials are Lambert without specular light, so that
pictures can be compared in radiance, unless they are given gloss. Bases are 3 x 3 arrays whose columns are the images of
the axes.
"""
import math

import numpy as np


def rotation(yaw_deg=0.0, pitch_deg=0.0, roll_deg=0.0):
    """About y, then x, then z (Godot's YXZ order)."""
    y, x, z = (math.radians(a) for a in (yaw_deg, pitch_deg, roll_deg))
    about_y = np.array([[math.cos(y), 0, math.sin(y)], [0, 1, 0], [-math.sin(y), 0, math.cos(y)]])
    about_x = np.array([[1, 0, 0], [0, math.cos(x), -math.sin(x)], [0, math.sin(x), math.cos(x)]])
    about_z = np.array([[math.cos(z), -math.sin(z), 0], [math.sin(z), math.cos(z), 0], [0, 0, 1]])
    return about_y @ about_x @ about_z


def looking(eye, target):
    """A basis whose -z points from `eye` to `target`."""
    z = np.array(eye, float) - np.array(target, float)
    z /= np.linalg.norm(z)
    up = (0, 1, 0) if abs(z[1]) < 0.99 else (0, 0, 1)
    x = np.cross(up, z)
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(z, x), z], axis=1)


def srgb(linear):
    c = np.asarray(linear, float)
    return np.where(c <= 0.0031308, 12.92 * c, 1.055 * np.maximum(c, 0) ** (1 / 2.4) - 0.055)


def number(value):
    text = f"{float(value):.6f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def numbers(kind, values):
    return f"{kind}( {', '.join(number(v) for v in values)} )"


def color(linear):
    return numbers("Color", [*srgb(linear), 1])


class Scene:
    """What a scene holds; `text()` writes it. `world` = (basis, origin) places everything that is added: a whole scene
    may be turned, mirrored, moved or scaled (the basis' length) by it."""

    def __init__(self, world=(np.eye(3), np.zeros(3))):
        self.basis, self.origin = np.asarray(world[0], float), np.asarray(world[1], float)
        self.scale = abs(np.linalg.det(self.basis)) ** (1 / 3)
        self.files, self.resources, self.nodes = [], [], []
        self.cube = self.resource("CubeMesh", "size = Vector3( 1, 1, 1 )")
        self.ball = self.resource("SphereMesh", "radius = 1.0\nheight = 2.0\nradial_segments = 64\nrings = 32")
        self.background = self.ambient = None
        self.light_specular = 0  # of lamps added from now on

    def resource(self, kind, body):
        self.resources.append((kind, body))
        return len(self.resources)

    def node(self, kind, name, basis, origin, body):
        basis, origin = self.basis @ basis, self.basis @ np.asarray(origin, float) + self.origin
        placed = numbers("Transform", [*basis.reshape(-1), *origin])
        self.nodes.append(f'[node name="{name}" type="{kind}" parent="."]\ntransform = {placed}\n{body}\n')

    def rigid(self, basis):
        """A basis for what must not be scaled or mirrored: lights, cameras, probes."""
        flip = np.diag([math.copysign(1, np.linalg.det(self.basis)), 1, 1])
        return np.linalg.inv(self.basis) @ (self.basis / self.scale) @ basis @ flip

    def material(self, albedo, emission=None, energy=1.0, texture=None, uv_scale=1.0, gloss=None):
        """`gloss`: (roughness, metallic) of a material that reflects."""
        matt = "roughness = 1.0\nmetallic_specular = 0.0\nparams_diffuse_mode = 1\nparams_specular_mode = 4"
        body = f"albedo_color = {color(albedo)}\n"
        body += matt if gloss is None else (f"roughness = {number(gloss[0])}\nmetallic = {number(gloss[1])}\n"
                                            "params_diffuse_mode = 1")
        if emission is not None:
            body += (f"\nemission_enabled = true\nemission = {color(emission)}\nemission_energy = {number(energy)}\n"
                     "emission_operator = 0\nemission_on_uv2 = false")
        if texture is not None:
            self.files.append(texture)
            body += f"\nalbedo_texture = ExtResource( {len(self.files)} )\nuv1_scale = {numbers('Vector3', [uv_scale] * 3)}"
        return self.resource("SpatialMaterial", body)

    def mesh(self, name, mesh, material, basis, origin):
        self.node("MeshInstance", name, basis, origin,
                  f"use_in_baked_light = true\nmesh = SubResource( {mesh} )\nmaterial/0 = SubResource( {material} )")

    def box(self, name, material, center, size, turned=np.eye(3)):
        self.mesh(name, self.cube, material, turned @ np.diag(np.asarray(size, float)), center)

    def sphere(self, name, material, center, radius):
        self.mesh(name, self.ball, material, np.eye(3) * radius, center)

    def shell(self, size, materials, thick=0.4, sides=("floor", "ceiling", "back", "front", "left", "right")):
        """A room, floor at y = 0, centred on x and z. `materials`: one, or a mapping from side to one."""
        w, h, d = size
        t = thick
        parts = {"floor": ((0, -t / 2, 0), (w + 2 * t, t, d + 2 * t)),
                 "ceiling": ((0, h + t / 2, 0), (w + 2 * t, t, d + 2 * t)),
                 "back": ((0, h / 2, -d / 2 - t / 2), (w + 2 * t, h, t)),
                 "front": ((0, h / 2, d / 2 + t / 2), (w + 2 * t, h, t)),
                 "left": ((-w / 2 - t / 2, h / 2, 0), (t, h, d)),
                 "right": ((w / 2 + t / 2, h / 2, 0), (t, h, d))}
        for side in sides:
            material = materials[side] if isinstance(materials, dict) else materials
            self.box(side.capitalize(), material, *parts[side])

    def light(self, kind, name, basis, origin, tint, energy, body, shadow=True):
        self.node(kind, name, self.rigid(basis), origin,
                  f"light_color = {color(tint)}\nlight_energy = {number(energy)}\nlight_specular = {float(self.light_specular)}\n"
                  f"shadow_enabled = {'true' if shadow else 'false'}{body}")

    def omni(self, name, origin, tint=(1, 1, 1), energy=1.0, reach=8.0):
        self.light("OmniLight", name, np.eye(3), origin, tint, energy,
                   f"\nomni_range = {number(reach * self.scale)}\nomni_attenuation = 1")

    def spot(self, name, origin, target, tint=(1, 1, 1), energy=1.0, reach=8.0, angle=35.0):
        self.light("SpotLight", name, looking(origin, target), origin, tint, energy,
                   f"\nspot_range = {number(reach * self.scale)}\nspot_attenuation = 1\nspot_angle = {number(angle)}\n"
                   "spot_angle_attenuation = 1")

    def sun(self, name, direction, tint=(1, 1, 1), energy=1.0):
        self.light("DirectionalLight", name, looking((0, 0, 0), direction), (0, 0, 0), tint, energy, "")

    def camera(self, eye, target, fov=60.0):
        self.node("Camera", "Camera", self.rigid(looking(eye, target)), eye,
                  f"current = true\nfov = {number(fov)}\nnear = {number(0.05 * self.scale)}\n"
                  f"far = {number(100 * self.scale)}")

    def probe(self, name, center, extents, interior=False, subdiv=1):
        extents = numbers("Vector3", np.asarray(extents, float) * self.scale)
        self.node("GIProbe", name, self.rigid(np.eye(3)), center,
                  f"subdiv = {subdiv}\nextents = {extents}" + ("\ninterior = true" if interior else ""))

    def sky(self, linear, energy=1.0):
        self.background, self.ambient = linear, energy

    def text(self):
        background = (0, 0, 0) if self.background is None else self.background
        world = self.resource("Environment", f"background_mode = 1\nbackground_color = {color(background)}\n"
                              f"ambient_light_color = {color(background)}\nambient_light_energy = "
                              f"{number(self.ambient or 0)}\nambient_light_sky_contribution = 0.0")
        out = [f"[gd_scene load_steps={len(self.files) + len(self.resources) + 1} format=2]\n"]
        out += [f'[ext_resource path="{path}" type="Texture" id={i + 1}]\n' for i, path in enumerate(self.files)]
        out += [f'[sub_resource type="{kind}" id={i + 1}]\n{body}\n' for i, (kind, body) in enumerate(self.resources)]
        out += ['[node name="Root" type="Spatial"]\n', *self.nodes,
                f'[node name="World" type="WorldEnvironment" parent="."]\nenvironment = SubResource( {world} )\n']
        return "\n".join(out)
