"""Finds the uniforms, samplers and uniform blocks that a program declares, and the std140 layout of its blocks."""
import re
from dataclasses import dataclass, field

from shader_parse import STAGES, ShaderError

# GLSL type -> C++ type of a plain uniform.
UNIFORM_TYPES = {
    "float": "float", "int": "int", "uint": "uint32_t", "bool": "int",
    "vec2": "glm::vec2", "vec3": "glm::vec3", "vec4": "glm::vec4",
    "ivec2": "glm::ivec2", "ivec3": "glm::ivec3", "mat3": "glm::mat3", "mat4": "glm::mat4",
}
ARRAY_TYPES = {"float", "int", "vec2", "vec3", "vec4", "mat4"}
SAMPLER_TYPES = {
    "sampler2D": "gl::Texture2D", "sampler2DShadow": "gl::Texture2D", "usampler2D": "gl::Texture2D",
    "sampler3D": "gl::Texture3D", "usampler3D": "gl::Texture3D", "samplerCube": "gl::TextureCube",
}
MAX_UNITS = 16  # what every GLES 3.0 fragment stage has

# GLSL type -> (C++ type, std140 alignment, size [bytes]). A mat3 has three columns of 16 bytes.
BLOCK_TYPES = {
    "float": ("float", 4, 4), "int": ("int32_t", 4, 4), "uint": ("uint32_t", 4, 4),
    "vec2": ("glm::vec2", 8, 8), "vec3": ("glm::vec3", 16, 12), "vec4": ("glm::vec4", 16, 16),
    "ivec2": ("glm::ivec2", 8, 8), "ivec3": ("glm::ivec3", 16, 12), "ivec4": ("glm::ivec4", 16, 16),
    "uvec2": ("glm::uvec2", 8, 8), "uvec3": ("glm::uvec3", 16, 12), "uvec4": ("glm::uvec4", 16, 16),
    "mat3": ("glm::mat3x4", 16, 48), "mat4": ("glm::mat4", 16, 64),
}

IDENTIFIER = r"[A-Za-z_]\w*"
DECLARATION = re.compile(rf"(?:(?:highp|mediump|lowp)\s+)?({IDENTIFIER})\s+({IDENTIFIER})\s*(?:\[\s*(\w+)\s*\])?\s*$")
CONSTANT = re.compile(rf"^\s*(?:#\s*define\s+({IDENTIFIER})\s+(\d+)|const\s+u?int\s+({IDENTIFIER})\s*=\s*(\d+)u?\s*;)")
STRUCT = re.compile(rf"\bstruct\s+({IDENTIFIER})\s*{{([^}}]*)}}\s*;")
BLOCK = re.compile(rf"\blayout\s*\(([^)]*)\)\s*uniform\s+({IDENTIFIER})\s*{{([^}}]*)}}\s*({IDENTIFIER})?\s*;")
UNIFORM = re.compile(r"\buniform\b([^;{]*)([;{])")


@dataclass
class Declared:
    type: str
    name: str
    count: int = 1
    is_array: bool = False


@dataclass
class Member:
    declared: Declared
    cpp: str
    align: int
    offset: int


@dataclass
class Struct:
    """A struct or block with its std140 layout; `size` is rounded up to 16 bytes."""
    name: str
    members: list = field(default_factory=list)
    size: int = 0
    structs: list = field(default_factory=list)  # that members use, in order of declaration

    def __eq__(self, other):
        return (self.name, self.members, self.structs) == (other.name, other.members, other.structs)


@dataclass
class Interface:
    uniforms: list = field(default_factory=list)
    samplers: list = field(default_factory=list)  # (Declared, unit)
    blocks: list = field(default_factory=list)    # Struct


def strip_comments(text):
    """Comments become blanks; newlines stay, so that positions still tell lines."""
    return re.sub(r"//[^\n]*|/\*.*?\*/", lambda m: re.sub(r"[^\n]", " ", m[0]), text, flags=re.S)


class StageReader:
    def __init__(self, program, stage):
        self.files = program.files
        self.origin = program.stages[stage].origin
        self.text = strip_comments("\n".join(program.stages[stage].lines))
        self.constants = {}
        for line in self.text.split("\n"):
            if m := CONSTANT.match(line):
                self.constants[m[1] or m[3]] = int(m[2] or m[4])
        # Directives are dropped, not obeyed: declarations count in every branch.
        self.text = re.sub(r"(?m)^[ \t]*#.*$", lambda m: " " * len(m[0]), self.text)
        self.structs = {m[1]: m for m in STRUCT.finditer(self.text)}

    def fault(self, position, message):
        file, line = self.origin[self.text.count("\n", 0, position)]
        return ShaderError(self.files[file], line, message)

    def declaration(self, text, position):
        m = DECLARATION.match(text.strip())
        if not m:
            raise self.fault(position, f"expected one `type name` or `type name[size]`, found \"{' '.join(text.split())}\"")
        count = 1
        if m[3]:
            if not m[3].isdigit() and m[3] not in self.constants:
                raise self.fault(position, f"expected a number or a constant as array size, found \"{m[3]}\"")
            count = int(m[3]) if m[3].isdigit() else self.constants[m[3]]
        return Declared(m[1], m[2], count, bool(m[3]))

    def layout(self, name, body, position):
        """std140 (OpenGL ES 3.0.6, 7.6.2.2)."""
        result, offset = Struct(name), 0
        for m in re.finditer(r"[^;]+", body):
            if not m[0].strip():
                continue
            at = position + m.start() + len(m[0]) - len(m[0].lstrip())
            d = self.declaration(m[0], at)
            if d.type in BLOCK_TYPES:
                cpp, align, size = BLOCK_TYPES[d.type]
            elif d.type in self.structs:
                inner = self.layout(d.type, self.structs[d.type][2], self.structs[d.type].start(2))
                result.structs += [s for s in inner.structs + [inner] if s not in result.structs]
                cpp, align, size = d.type, 16, inner.size
            else:
                raise self.fault(at, f"expected a type of the table in shader_reflect.py, found \"{d.type}\"")
            if d.is_array:
                if size % 16:
                    raise self.fault(at, f"expected an array of 16-byte elements, found {d.type} (std140 would pad it)")
                cpp, size = f"std::array<{cpp}, {d.count}>", size * d.count
            offset = (offset + align - 1) // align * align
            result.members.append(Member(d, cpp, align, offset))
            offset += size
        result.size = (offset + 15) // 16 * 16
        return result

    def read(self, interface):
        for m in BLOCK.finditer(self.text):
            if m[4]:
                raise self.fault(m.start(4), f"expected a block without an instance name, found \"{m[4]}\"")
            if m[1].replace(" ", "") != "std140":
                raise self.fault(m.start(), f"expected layout(std140), found layout({m[1]})")
            add(interface.blocks, self.layout(m[2], m[3], m.start(3)), lambda b: b.name,
                self.fault(m.start(), f"expected the same declaration of block {m[2]} everywhere, found another"))
        rest = BLOCK.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), self.text)
        for m in UNIFORM.finditer(rest):
            if m[2] == "{":
                raise self.fault(m.start(), "expected layout(std140) before a uniform block, found none")
            d = self.declaration(m[1], m.start())
            into = interface.samplers if d.type in SAMPLER_TYPES else interface.uniforms
            if into is interface.uniforms and d.type not in UNIFORM_TYPES:
                raise self.fault(m.start(), f"expected a type of the table in shader_reflect.py, found \"{d.type}\"")
            if into is interface.uniforms and d.is_array and d.type not in ARRAY_TYPES:
                raise self.fault(m.start(), f"expected an array of {', '.join(sorted(ARRAY_TYPES))}, found {d.type}")
            add(into, d, lambda u: u.name,
                self.fault(m.start(), f"expected the same type of {d.name} everywhere, found another"))


def add(items, item, key, fault):
    same = [i for i in items if key(i) == key(item)]
    if same and same[0] != item:
        raise fault
    if not same:
        items.append(item)


def reflect(program):
    """@return Interface of all variants together; samplers with their units. Raises ShaderError."""
    interface = Interface()
    for stage in STAGES:
        StageReader(program, stage).read(interface)
    unit, units = 0, {}
    for d in interface.samplers:
        if d.name not in program.shares:
            units[d.name] = unit
            unit += d.count
    names = [d.name for d in interface.samplers]
    for name, other in program.shares.items():
        if name not in names or other not in units:
            raise ShaderError(program.files[0], 1, f"expected samplers of this program to share a unit, found \"{name} {other}\"")
        units[name] = units[other]
    if unit > MAX_UNITS:
        raise ShaderError(program.files[0], 1, f"expected at most {MAX_UNITS} texture units, found {unit}")
    interface.samplers = [(d, units[d.name]) for d in interface.samplers]
    return interface
