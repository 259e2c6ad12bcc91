#!/usr/bin/env python3
"""Writes the peer test's scenes: each small, each built to show what one part of GI does.

usage: make_scenes.py FOLDER [NAME...]
A line `; set NODE:PROPERTY=VALUE` at a scene's end is an edit that is made while it is shown (see report).
"""
import math
import sys
from pathlib import Path

from scene_text import SceneText, color, look, place, vector

WHITE, RED, GREEN, BLUE = (.87, .87, .87), (.82, .25, .25), (.38, .7, .42), (.35, .45, .8)


class Room(SceneText):
    """A scene of boxes with diffuse materials, an open front and a camera before it."""

    def __init__(self, origin=(0, 0, 0), ambient=None, background=(0, 0, 0), sky=None, **environment):
        super().__init__()
        self.origin = origin
        self.cube = self.resource("CubeMesh", size=vector(1, 1, 1))
        self.sphere = self.resource("SphereMesh", radial_segments=32, rings=16)
        if sky:
            environment.update(background_mode=2, background_sky=self.resource("ProceduralSky", **sky))
        else:
            environment.update(background_mode=1, background_color=color(*background), ambient_light_sky_contribution=0.0)
        self.environment = self.resource("Environment", ambient_light_color=color(*(ambient or (0, 0, 0))), **environment)
        self.node("Environment", "WorldEnvironment", environment=self.environment)
        self.materials = {}

    def at(self, p):
        return tuple(float(a + b) for a, b in zip(self.origin, p))

    def diffuse(self, rgb, **more):
        key = (rgb, tuple(sorted(more.items())))
        if key not in self.materials:
            self.materials[key] = self.resource("SpatialMaterial", albedo_color=color(*rgb), roughness=1.0,
                                                metallic_specular=0.0, params_diffuse_mode=1, params_specular_mode=4, **more)
        return self.materials[key]

    def mesh(self, name, mesh, material, p, yaw=0.0, pitch=0.0, roll=0.0, scale=(1, 1, 1), baked=True, **more):
        if material:
            more["material/0"] = material
        self.node(name, "MeshInstance", transform=place(self.at(p), yaw, pitch, roll, scale), use_in_baked_light=baked,
                  mesh=mesh, **more)

    def box(self, name, material, p, size, yaw=0.0, pitch=0.0, roll=0.0, **more):
        self.mesh(name, self.cube, material, p, yaw, pitch, roll, size, **more)

    def ball(self, name, material, p, radius, **more):
        self.mesh(name, self.sphere, material, p, scale=(radius,) * 3, **more)

    def shell(self, w=4, h=3, d=4, t=.3, left=RED, right=GREEN, ceiling=True, x=0.0, tag=""):
        m = self.diffuse(WHITE)
        self.box(tag + "Floor", m, (x, -t / 2, 0), (w + 2 * t, t, d + 2 * t))
        if ceiling:
            self.box(tag + "Ceiling", m, (x, h + t / 2, 0), (w + 2 * t, t, d + 2 * t))
        self.box(tag + "Back", m, (x, h / 2, -d / 2 - t / 2), (w + 2 * t, h, t))
        self.box(tag + "Left", self.diffuse(left), (x - w / 2 - t / 2, h / 2, 0), (t, h, d))
        self.box(tag + "Right", self.diffuse(right), (x + w / 2 + t / 2, h / 2, 0), (t, h, d))

    def omni(self, name, p, energy=1.5, reach=8.0, **more):
        more = {"light_energy": energy, "light_specular": 0.0, "shadow_enabled": True, "omni_range": reach, **more}
        self.node(name, "OmniLight", transform=place(self.at(p)), **more)

    def spot(self, name, p, target, energy=4.0, reach=9.0, angle=30.0, **more):
        more = {"light_energy": energy, "light_specular": 0.0, "shadow_enabled": True, "spot_range": reach,
                "spot_angle": angle, **more}
        self.node(name, "SpotLight", transform=look(self.at(p), self.at(target)), **more)

    def sun(self, name, direction, energy=1.5, **more):
        more = {"light_energy": energy, "light_specular": 0.0, "shadow_enabled": True, **more}
        self.node(name, "DirectionalLight", transform=look((0, 0, 0), direction), **more)

    def probe(self, name="Probe", p=(0, 1.5, 0), extents=(2.6, 2.2, 2.6), subdiv=0, yaw=0.0, pitch=0.0, roll=0.0, **more):
        self.node(name, "GIProbe", transform=place(self.at(p), yaw, pitch, roll), subdiv=subdiv, extents=vector(*extents),
                  **more)

    def camera(self, eye=(0, 1.6, 6.2), target=(0, 1.4, 0), fov=45.0):
        self.node("Camera", "Camera", transform=look(self.at(eye), self.at(target)), current=True, fov=fov, far=200.0)


def rotated():
    """Probe and meshes rotated against each other, scaled unevenly, one mirrored."""
    s = Room()
    s.shell()
    w, b = s.diffuse(WHITE), s.diffuse(BLUE)
    s.box("Leaning", w, (-.9, 1.1, -.6), (.8, 1.9, .5), 35, 20, 10)
    s.box("Slab", b, (1, .5, .3), (1.6, .25, .9), -25, 0, 30)
    s.mesh("Egg", s.sphere, w, (.2, 2.1, -.9), 40, 30, 0, (.3, .6, .4))
    prism = s.resource("PrismMesh", left_to_right=0.2, size=vector(1, 1, 1))
    s.mesh("Mirrored", prism, b, (-.6, .4, 1), 15, 0, 0, (-.8, .8, .8))
    s.omni("Lamp", (.3, 2.5, .6))
    s.camera()
    s.probe(yaw=25.0, pitch=12.0, roll=-8.0, extents=(3.4, 2.8, 3.2), subdiv=1)
    return s


def far_away():
    """Kilometres from the origin, where float32 has a quarter of a millimetre left."""
    s = Room((2100, -340, 1700))
    s.shell(left=BLUE)
    s.box("Box", s.diffuse(WHITE), (.7, .7, -.4), (1, 1.4, 1), 30)
    s.ball("Ball", s.diffuse(GREEN), (-.9, .6, .2), .6)
    s.omni("Lamp", (0, 2.5, .5))
    s.camera()
    s.probe(subdiv=1, yaw=10.0)
    return s


def textured():
    """Albedo textures of sizes and formats that the bake must resize, tiled and shifted UVs."""
    s = Room()
    checker = s.texture(128, 128, lambda x, y: (230, 60, 40) if (x // 16 + y // 16) % 2 else (240, 240, 220))
    odd = s.texture(37, 19, lambda x, y: (x * 6, y * 13, 255 - x * 6, 255 - 8 * y), 4)
    gray = s.texture(8, 8, lambda x, y: (40 + 24 * ((x * 5 + y * 3) % 8),), 1)
    big = s.texture(160, 150, lambda x, y: (int(127 + 120 * math.sin(x * .3)), int(127 + 120 * math.sin(y * .2)), 90))
    s.shell(ceiling=False)
    s.box("Ceiling", s.diffuse((1, 1, 1), albedo_texture=checker), (0, 3.15, 0), (4.6, .3, 4.6))
    s.box("Carpet", s.diffuse((.9, .8, 1), albedo_texture=odd), (0, .05, .2), (3.4, .1, 3))
    s.box("Box", s.diffuse((1, 1, 1), albedo_texture=gray, uv1_scale=vector(3, 2, 1), uv1_offset=vector(.25, 0, 0)),
          (.9, .7, -.5), (1, 1.2, 1), 20)
    s.ball("Ball", s.diffuse((1, .9, .8), albedo_texture=big), (-.9, .8, -.1), .7)
    s.omni("Lamp", (0, 2.2, 1), 1.8)
    s.camera()
    s.probe(subdiv=1)
    return s


def emissive():
    """Emission by both operators, with and without texture; strong emission saturates."""
    s = Room()
    stripes = s.texture(64, 64, lambda x, y: (255, 160, 40) if (x // 8) % 2 else (0, 20, 60))
    on = dict(emission_enabled=True)
    s.shell(left=WHITE, right=WHITE)
    s.box("Added", s.diffuse((.1, .1, .1), emission=color(.1, .05, .2), emission_energy=2.0, emission_operator=0,
                             emission_texture=stripes, **on), (-1.9, 1.6, -.4), (.1, 1.4, 2))
    s.box("Multiplied", s.diffuse((.2, .2, .2), emission=color(.4, .9, 1), emission_energy=3.0, emission_operator=1,
                                  emission_texture=stripes, **on), (1.9, 1.6, -.4), (.1, 1.4, 2))
    s.box("Strong", s.diffuse((0, 0, 0), emission=color(1, .5, .2), emission_energy=14.0, **on), (0, 2.9, -.8), (.9, .1, .5))
    s.box("Nothing", s.diffuse((.6, .6, .6), emission=color(1, 1, 1), emission_energy=1.0, emission_operator=1, **on),
          (.5, .4, .4), (.8, .8, .8), 30)
    s.ball("Weak", s.diffuse((.3, .3, .3), emission=color(.2, .5, .2), emission_energy=1.0, **on), (-.7, .5, .3), .5)
    s.camera()
    s.probe(dynamic_range=8, subdiv=1)
    return s


def uneven():
    """A long and low probe box whose shortest axis is halved twice, rotated, with the room reaching out of it."""
    s = Room()
    s.shell(8, 2, 3, left=BLUE, right=RED)
    for i, x in enumerate((-3, -1, 1.2, 3)):
        s.box("Pillar%d" % i, s.diffuse(GREEN if i % 2 else WHITE), (x, .9, -.4), (.4, 1.8, .4), 20.0 * i)
    s.omni("Lamp", (-2, 1.6, .6), 1.4)
    s.omni("Lamp2", (2.4, 1.5, .5), 1.0, 5.0, light_color=color(1, .7, .4))
    s.camera((0, 1.3, 7), (0, .9, 0), 40.0)
    s.probe(p=(0, 1, 0), extents=(4.5, 1.1, 1.8), subdiv=1)
    return s


def many_lights():
    """Eighteen lights of all kinds and modes; no instance is reached by more than Godot draws."""
    s = Room()
    s.shell(6, 3, 5, left=WHITE, right=WHITE)
    w = s.diffuse(WHITE)
    s.box("Divider", w, (0, .8, -.8), (.3, 1.6, 2))
    s.ball("Ball", s.diffuse(BLUE), (1.4, .7, -.6), .7)
    s.box("Box", w, (-1.4, .5, -.4), (1, 1, 1), 40)
    hue = lambda i: color(*(.55 + .45 * math.cos(i + k * 2.1) for k in range(3)))
    kinds = [dict(), dict(omni_attenuation=2.5), dict(omni_attenuation=0.4), dict(light_indirect_energy=3.0),
             dict(light_bake_mode=0), dict(light_bake_mode=2), dict(light_negative=True), dict(visible=False)]
    for i, more in enumerate(kinds):
        s.omni("Omni%d" % i, (-2.4 + .7 * i, 2.3 - .25 * (i % 3), 1.2 - .5 * (i % 4)), .45, 3.0 + .4 * i,
               light_color=hue(i), **more)
    kinds = [dict(), dict(spot_angle_attenuation=3.0), dict(spot_angle_attenuation=0.3), dict(spot_attenuation=2.0),
             dict(angle=70.0), dict(angle=12.0), dict(light_negative=True, light_indirect_energy=0.5)]
    for i, more in enumerate(kinds):
        s.spot("Spot%d" % i, (-2.5 + .8 * i, 2.7, 1.8), (-2.2 + .8 * i, .3, -.8 + .3 * (i % 3)), .9, 7.0,
               **{"light_color": hue(i + 3), **more})
    s.sun("Sun", (.3, -.5, -1), .25, light_color=color(1, .9, .7))
    s.sun("Hidden", (1, -1, 0), 2.0, visible=False)
    s.sun("Editor", (1, -1, 0), 2.0, editor_only=True)
    s.camera((0, 1.8, 7.4), (0, 1.3, 0))
    s.probe(extents=(3.4, 1.9, 2.9), subdiv=1)
    return s


def moving_lights():
    """Lights that move, turn, fade and vanish while the scene is shown; the picture is that of the final state."""
    s = Room()
    s.shell(5, 3, 4)
    s.box("Box", s.diffuse(WHITE), (.7, .7, -.4), (1, 1.4, 1), 30)
    s.ball("Ball", s.diffuse(BLUE), (-1.2, .6, .2), .6)
    s.omni("Lamp", (-1.5, 2.5, .5))
    s.omni("Off", (1.5, 2, .5))
    s.spot("Spot", (1.5, 2.6, 1.6), (-1, 1, -1))
    s.sun("Sun", (.2, -.6, -1), .3)
    s.camera()
    s.probe(extents=(2.9, 1.9, 2.4), subdiv=1)
    s.edits = ["Lamp:transform=" + place((1.2, 2.2, .8)), "Off:visible=false", "Lamp:light_energy=0.9",
               "Spot:transform=" + look((-1.5, 2.6, 1.6), (1, .5, -1)), "Spot:spot_angle=40.0",
               "Sun:light_color=" + color(1, .6, .3), "Lamp:transform=" + place((.4, 2.4, .9)), "Spot:light_energy=3.0"]
    return s


def three_probes():
    """Three overlapping probes; instances that touch all of them use two, by Godot's order."""
    s = Room(ambient=(.3, .3, .4), ambient_light_energy=.1)
    s.shell(8, 3, 4)
    s.box("Box", s.diffuse(WHITE), (-.9, .6, -.2), (.9, 1.2, .9), 20)
    s.ball("Ball", s.diffuse(BLUE), (1, .6, .2), .6)
    s.box("Far", s.diffuse(GREEN), (2.9, .7, -.6), (.8, 1.4, .8), -15)
    s.omni("LampA", (-2.6, 2.4, .6), 1.3, 7.0, light_color=color(1, .85, .7))
    s.omni("LampB", (2.4, 2.4, .6), 1.1, 6.0, light_color=color(.7, .85, 1))
    s.camera((0, 1.6, 7.4), (0, 1.4, 0))
    s.probe("Left", (-2.2, 1.5, 0), (2.6, 1.9, 2.6), 0, interior=True)
    s.probe("Middle", (0, 1.5, 0), (2.4, 1.8, 2.5), 1)
    s.probe("Right", (2.2, 1.5, 0), (2.6, 1.9, 2.6), 0, energy=1.4)
    return s


def rooms(name, settings, **environment):
    """Equal rooms in a row, each with a probe of its own that differs in some properties."""
    s = Room(**environment)
    for i, more in enumerate(settings):
        x = 3.0 * (i - (len(settings) - 1) / 2)
        tag = "%s%d" % (name, i)
        s.shell(2.4, 2.2, 2.4, .2, x=x, tag=tag)
        s.box(tag + "Box", s.diffuse(WHITE), (x + .4, .4, -.3), (.7, .8, .7), 25)
        s.ball(tag + "Free", s.diffuse(BLUE), (x - .5, .45, .2), .4, baked=False)
        s.omni(tag + "Lamp", (x, 1.8, .5), 1.3, 4.0)
        s.probe(tag + "Probe", (x, 1.1, 0), (1.45, 1.4, 1.5), **more)
    s.camera((0, 1.3, 3.0 * len(settings) + .5), (0, 1, 0), 40.0)
    return s


def propagation():
    return rooms("P", [dict(propagation=p) for p in (0.0, .5, 1.0)])


def ranges():
    return rooms("R", [dict(dynamic_range=1), dict(dynamic_range=4, energy=2.0), dict(dynamic_range=16)])


def biases():
    return rooms("B", [dict(bias=0.0), dict(bias=4.0), dict(normal_bias=.3), dict(bias=.5, normal_bias=.15, subdiv=1)])


def interiors():
    """Ambient light at a cone's miss: interior, exterior, and an exterior one that is dim."""
    return rooms("I", [dict(interior=True), dict(), dict(energy=.5)], ambient=(.4, .5, .6), ambient_light_energy=.3,
                 background=(.3, .35, .45))


def materials():
    """Specular, metal and roughness; default diffuse and specular lobes."""
    s = Room(background=(.1, .12, .2))
    s.shell(5, 3, 4)
    for row, metallic in enumerate((0.0, 1.0)):
        for i, roughness in enumerate((0.0, .2, .5, .8, 1.0)):
            m = s.resource("SpatialMaterial", albedo_color=color(.9, .7, .4), metallic=metallic, roughness=roughness,
                           metallic_specular=.2 + .2 * i)
            s.ball("Ball%d%d" % (row, i), m, (-2 + i, .5 + 1.1 * row, -.2 - .5 * row), .42)
    s.omni("Lamp", (0, 2.6, .8), 1.4, light_specular=.5)
    s.camera()
    s.probe(extents=(2.9, 2, 2.5), subdiv=1)
    return s


def surfaces():
    """Vertex colours, transparency, cull modes, shading modes, hidden and unbaked instances, casters of shadow only."""
    s = Room(ambient=(.2, .2, .2), ambient_light_energy=.3)
    s.shell(6, 3, 4)
    plane = s.resource("PlaneMesh", size="Vector2( 1, 1 )", subdivide_width=2)
    quad = s.resource("QuadMesh", size="Vector2( 1, 1 )")
    pipe = s.resource("CylinderMesh", top_radius=0.3, bottom_radius=0.45, height=1.2, radial_segments=16)
    pill = s.resource("CapsuleMesh", radius=0.25, mid_height=0.6, radial_segments=16)
    s.mesh("Glass", s.cube, s.diffuse((.3, .9, 1, ), flags_transparent=True), (-2, .6, .8), 20, scale=(.8, 1.2, .1))
    s.mesh("Veil", quad, s.resource("SpatialMaterial", albedo_color=color(1, .4, .4, .4), flags_transparent=True,
                                    params_cull_mode=2), (-1, 1, .9), -20, scale=(1, 1.4, 1))
    s.mesh("Front", quad, s.diffuse(GREEN, params_cull_mode=1), (0, 1, .4), 150)
    s.mesh("Both", plane, s.diffuse(BLUE, params_cull_mode=2), (.9, .8, .2), 0, 40, 20)
    s.mesh("Pipe", pipe, s.diffuse(WHITE), (2, .6, -.2))
    s.mesh("Pill", pill, s.diffuse(RED), (1.5, .4, 1), 40, 60)
    s.mesh("Unshaded", s.cube, s.resource("SpatialMaterial", flags_unshaded=True, albedo_color=color(.2, .6, .3)),
           (-2.3, 2.2, -1), 0, scale=(.5, .5, .5))
    s.mesh("NoAmbient", s.cube, s.diffuse(WHITE, flags_disable_ambient_light=True), (-1.3, .3, -.8), 10, scale=(.6, .6, .6))
    s.mesh("Plain", s.sphere, None, (.2, .4, -.9), scale=(.4, .4, .4))
    s.mesh("Hidden", s.cube, s.diffuse(RED), (0, 2.6, 0), visible=False)
    s.mesh("Unbaked", s.cube, s.diffuse(WHITE), (2.3, 2.2, -1), 30, scale=(.5, .5, .5), baked=False)
    s.mesh("ShadowOnly", s.cube, s.diffuse(RED), (.5, 1.9, -.6), scale=(.5, .1, .5), cast_shadow=3)
    s.mesh("NoShadow", s.cube, s.diffuse(WHITE), (-.4, 2.2, -.6), scale=(.4, .1, .4), cast_shadow=0)
    s.mesh("Overridden", s.cube, s.diffuse(RED), (2.6, .3, .6), scale=(.4, .6, .4), material_override=s.diffuse(GREEN))
    s.omni("Lamp", (.2, 2.7, 1), 1.6)
    s.camera()
    s.probe(extents=(3.4, 2, 2.5), subdiv=1)
    return s


def open_sky():
    """A sky whose light blends with an ambient colour; exterior probe; sun."""
    s = Room(ambient=(.5, .3, .2), ambient_light_energy=.6, ambient_light_sky_contribution=.5, sky=dict(sun_energy=4.0))
    s.shell(5, 3, 4, ceiling=False)
    s.box("Roof", s.diffuse(WHITE), (-1.2, 3.1, -.8), (3, .2, 2.6))
    s.ball("Ball", s.diffuse(BLUE), (1.2, .7, .2), .7)
    s.ball("Mirror", s.resource("SpatialMaterial", metallic=1.0, roughness=.3), (-1.2, .6, .4), .6)
    s.sun("Sun", (.5, -1, -.5), .9)
    s.camera((0, 2, 6.6), (0, 1.5, 0))
    s.probe(extents=(2.9, 2.4, 2.6), subdiv=1)
    return s


def two_suns():
    """More than one directional light, with emission and ambient light."""
    s = Room(ambient=(.3, .35, .4), ambient_light_energy=.2, background=(.25, .3, .4))
    s.shell(5, 3, 4, ceiling=False)
    s.ball("Ball", s.diffuse(BLUE), (1.2, .7, .2), .7)
    s.box("Glow", s.diffuse((.2, .2, .2), emission_enabled=True, emission=color(.5, .35, .1), emission_energy=1.0),
          (-1.2, .6, .2), (1, 1.2, .6), 20)
    s.box("Outside", s.diffuse(GREEN), (4.2, .5, 0), (.8, 1, .8))
    s.sun("Sun", (.5, -1, -.5), .6)
    s.sun("Moon", (-.6, -.8, -.4), .3, light_color=color(.6, .7, 1))
    s.camera((0, 2, 7.6), (.3, 1.4, 0))
    s.probe(extents=(2.9, 2.4, 2.6), subdiv=1)
    return s


def compressed():
    """compress asks for S3TC blocks."""
    s = rooms("C", [dict(compress=True), dict()])
    return s


def nested():
    """Probe, meshes and lamp below parents that are turned, mirrored and scaled unevenly; one chain is broken, one hidden."""
    s = Room()
    s.shell()
    s.node("Turned", "Spatial", transform=place((.2, 1.4, -.1), 30, 10, -15, (1.4, .7, 1.1)))
    s.node("Mirror", "Spatial", parent="Turned", transform=place((0, .1, 0), 20, 0, 0, (-1, 1, 1)))
    s.node("Broken", "Node", parent="Turned")
    s.node("Dark", "Spatial", parent="Turned", visible=False)
    inner = dict(use_in_baked_light=True, mesh=s.cube)
    s.node("Sheared", "MeshInstance", parent="Turned/Mirror", transform=place((.6, -.9, .2), 35, 25, 0, (.7, 1, .5)),
           **inner, **{"material/0": s.diffuse(WHITE)})
    s.node("Egg", "MeshInstance", parent="Turned/Mirror", transform=place((-.5, -.8, .5), 0, 0, 40, (.4, .6, .4)),
           use_in_baked_light=True, mesh=s.sphere, **{"material/0": s.diffuse(BLUE)})
    s.node("InWorld", "MeshInstance", parent="Turned/Broken", transform=place((-1.1, .4, -.9), 15, 0, 0, (.6, .8, .6)),
           **inner, **{"material/0": s.diffuse(GREEN)})
    s.node("Unseen", "MeshInstance", parent="Turned/Dark", transform=place((0, 0, .5)), **inner)
    s.node("Lamp", "OmniLight", parent="Turned/Mirror", transform=place((.1, 1.2, .6), 0, 0, 0, (3, 3, 3)), light_energy=1.5,
           light_specular=0.0, shadow_enabled=True, omni_range=7.0)
    s.node("Beam", "SpotLight", parent="Turned/Mirror", transform=place((-.9, .8, 1.2), -35, -40, 0, (.5, 2, 1)),
           light_energy=2.0, light_specular=0.0, shadow_enabled=True, spot_range=6.0, spot_angle=25.0)
    s.camera()
    s.node("Probe", "GIProbe", parent="Turned", transform=place((0, .1, 0), -10, 5, 0, (2, 2, .5)), subdiv=1,
           extents=vector(3.1, 2.7, 3.3))
    return s


def glowing():
    """Emission textures: tiled, shifted, on UV2, both operators, energies; left behind by a feature that is off."""
    s = Room(ambient=(.2, .2, .25), ambient_light_energy=.2)
    bars = s.texture(128, 128, lambda x, y: (240, 120, 30) if (x // 32 + y // 64) % 2 else (10, 30, 80))
    odd = s.texture(50, 21, lambda x, y: (x * 5, 255 - y * 12, 128, 255 - x * 5), 4)
    on = dict(emission_enabled=True)
    s.shell(5, 3, 4, left=WHITE, right=WHITE)
    s.box("Tiled", s.diffuse((.2, .2, .2), emission=color(.1, .1, .1), emission_energy=1.5, emission_texture=bars,
                             uv1_scale=vector(3, 2, 1), uv1_offset=vector(.2, .1, 0), **on), (-2.4, 1.6, -.4), (.1, 1.4, 2))
    s.box("Negative", s.diffuse((.3, .3, .3), emission=color(.3, 1, .6), emission_energy=4.0, emission_operator=1,
                                emission_texture=odd, uv1_scale=vector(-1, -2, 1), **on), (2.4, 1.6, -.4), (.1, 1.4, 2))
    s.box("OnUv2", s.diffuse((.5, .5, .5), emission=color(0, 0, 0), emission_texture=bars, emission_on_uv2=True, **on),
          (.9, .5, .3), (1, 1, 1), 25)
    s.box("Off", s.diffuse((.4, .4, .4), emission=color(.9, .2, .2), emission_energy=1.2), (-.9, .5, .3), (1, 1, 1), -25)
    s.ball("Both", s.diffuse((1, .9, .8), albedo_texture=odd, emission=color(.2, .1, .3), emission_energy=.8,
                             emission_texture=odd, **on), (0, 2, -.9), .6)
    s.camera()
    s.probe(extents=(2.9, 1.9, 2.4), subdiv=1)
    return s


def leaf(material, z, colors=()):
    """A surface of one upright square of 1 m. colors: of its corners, counted from the lower left on clockwise."""
    corners = ", ".join(map(str, (-.5, -.5, z, -.5, .5, z, .5, .5, z, .5, -.5, z)))
    painted = "PoolColorArray( %s )" % ", ".join(map(str, sum(colors, ()))) if colors else "null"
    return ('{\n"primitive": 4,\n"arrays": [ PoolVector3Array( %s ), PoolVector3Array( %s ), null, %s, '
            'PoolVector2Array( 0, 1, 0, 0, 1, 0, 1, 1 ), null, null, null, PoolIntArray( 0, 1, 2, 0, 2, 3 ) ],'
            '\n"material": %s,\n"morph_arrays": [  ]\n}' % (corners, ", ".join(["0, 0, 1"] * 4), painted, material))


def painted():
    """Vertex colours: as albedo or not, sRGB or linear, alone and times a texture; they do not enter the bake."""
    s = Room()
    s.shell(6, 3, 4)
    hues = ((1, .1, .1, 1), (.1, 1, .1, 1), (.1, .1, 1, 1), (.9, .9, .9, 1))
    checker = s.texture(16, 16, lambda x, y: (250, 200, 40) if (x // 4 + y // 4) % 2 else (20, 60, 200))
    on = dict(vertex_color_use_as_albedo=True)
    kinds = [{}, on, dict(on, vertex_color_is_srgb=True), dict(on, vertex_color_is_srgb=True, albedo_texture=checker),
             dict(on, vertex_color_is_srgb=True, flags_unshaded=True)]
    for i, kind in enumerate(kinds):
        mesh = s.resource("ArrayMesh", **{"surfaces/0": leaf(s.diffuse((1, 1, 1), params_cull_mode=2, **kind), 0, hues)})
        s.mesh("Leaf%d" % i, mesh, None, (-2.2 + 1.1 * i, 1.2, -.4), 10)
    s.omni("Lamp", (0, 2.6, 1.2), 1.4)
    s.camera()
    s.probe(extents=(3.4, 1.9, 2.4), subdiv=1)
    return s


def overrides():
    """A mesh of two surfaces and what may replace their materials; layers, LOD and shadow flags do not keep it from baking."""
    s = Room()
    s.shell(6, 3, 4)
    mesh = s.resource("ArrayMesh", **{"surfaces/0": leaf(s.diffuse(RED, params_cull_mode=2), 0),
                                      "surfaces/1": leaf(s.diffuse(GREEN, params_cull_mode=2), .3)})
    turned = s.diffuse(BLUE, params_cull_mode=2)
    checker = s.texture(16, 16, lambda x, y: (250, 200, 40) if (x // 4 + y // 4) % 2 else (20, 60, 200))
    s.mesh("Own", mesh, None, (-2.2, .8, -.4), 20)
    s.mesh("First", mesh, turned, (-.8, .8, -.4), 40)
    s.mesh("Second", mesh, None, (.6, .8, -.4), -30, 10, **{"material/1": turned})
    s.mesh("All", mesh, turned, (2, .8, -.4), -20, material_override=s.diffuse((1, 1, 1), albedo_texture=checker,
                                                                              params_cull_mode=2))
    s.mesh("OtherLayer", mesh, turned, (0, 2.2, -.9), 180, layers=2, lod_max_distance=.5, cast_shadow=0)
    s.omni("Lamp", (0, 2.6, 1.2), 1.4)
    s.omni("Dim", (-2, 1.5, 1.5), .4, 4.0, light_negative=True)
    s.camera()
    s.probe(extents=(3.4, 1.9, 2.4), subdiv=1)
    return s


def spots():
    """Spot lights at the ends of their ranges: narrow, flat, beyond a half-space, exponents near 0 and large.

    With a shadow Godot also darkens what lies behind one wider than 90 degrees, whose map no perspective can hold.
    """
    s = Room()
    s.shell(8, 3, 4, left=WHITE, right=WHITE)
    s.box("Bar", s.diffuse(BLUE), (0, .3, .2), (6.5, .6, .3))
    kinds = [dict(spot_attenuation=0.0), dict(spot_attenuation=6.0), dict(spot_angle_attenuation=0.05),
             dict(spot_angle_attenuation=8.0), dict(angle=3.0), dict(angle=88.0), dict(angle=100.0, shadow_enabled=False),
             dict(light_indirect_energy=0.0)]
    hue = lambda i: color(*(.6 + .4 * math.cos(i * 1.3 + k * 2.1) for k in range(3)))
    for i, more in enumerate(kinds):
        x = -3.5 + i
        s.spot("Spot%d" % i, (x, 2.6, 1.2), (x + .2, .2, -.9), .8, 5.0, **{"light_color": hue(i), **more})
    s.camera((0, 1.6, 8.6), (0, 1.3, 0))
    s.probe(extents=(4.4, 1.9, 2.4), subdiv=1)
    return s


def blended():
    """Two probes turned against each other that differ in all that is read live, with a sky behind."""
    s = Room(ambient=(.3, .25, .2), ambient_light_energy=.4, sky=dict(sky_top_color=color(.2, .3, .6)))
    s.shell(6, 3, 4, ceiling=False)
    s.box("Box", s.diffuse(WHITE), (-.5, .6, -.2), (.9, 1.2, .9), 20)
    s.ball("Free", s.diffuse(BLUE), (1, .6, .4), .6, baked=False)
    s.ball("Gloss", s.resource("SpatialMaterial", metallic=1.0, roughness=.2), (-1.8, .6, .3), .5)
    s.omni("Lamp", (-.5, 2.4, .6), 1.3, 7.0)
    s.sun("Sun", (.5, -1, -.6), .4)
    s.camera()
    s.probe("Inside", (-1, 1.4, 0), (2.6, 2, 2.7), 0, yaw=20.0, interior=True, bias=2.5, dynamic_range=2, propagation=.3)
    s.probe("Outside", (1.1, 1.5, 0), (2.5, 2.1, 2.6), 1, yaw=-15.0, pitch=10.0, normal_bias=.12, energy=.6, dynamic_range=6)
    return s


def live_probe():
    """Probe and light settings that change while the scene is shown."""
    s = rooms("L", [dict(), dict(subdiv=0)], ambient=(.3, .4, .5), ambient_light_energy=.3)
    s.edits = ["L0Probe:energy=1.7", "L0Probe:interior=true", "L0Probe:bias=0.5", "L1Probe:propagation=0.1",
               "L1Probe:normal_bias=0.2", "L0Lamp:light_bake_mode=0", "L1Lamp:light_bake_mode=2", "L0Lamp:light_bake_mode=1",
               "L1Lamp:light_indirect_energy=2.0", "L0Lamp:omni_range=3.0", "L1Lamp:omni_attenuation=2.0",
               "L0Probe:propagation=1.0"]
    return s


SCENES = [rotated, far_away, textured, emissive, uneven, many_lights, moving_lights, three_probes, propagation, ranges, biases,
          interiors, materials, surfaces, open_sky, two_suns, compressed, nested, glowing,
          overrides, painted, spots, blended, live_probe]


def write_scenes(folder, names=()):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for make in SCENES:
        if not names or make.__name__ in names:
            s = make()
            edits = "".join("\n; set %s\n" % e for e in getattr(s, "edits", []))
            (folder / (make.__name__ + ".tscn")).write_text(s.text() + edits)


if __name__ == "__main__":
    write_scenes(sys.argv[1], sys.argv[2:])
