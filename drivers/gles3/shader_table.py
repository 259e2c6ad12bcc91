"""Makes C++ of the .glsl files: drivers/gles3/shaders.h and shaders.cpp in the build's gen folder.

One file in shaders/ is one program. It is plain GLSL ES 3.00 but for these lines, which this script consumes:

    #pragma flags GRAY TWO_SIDED      switches of the program, at most 32. Variant = any set of them, each given as
                                      `#define GRAY 1` before all else. Test with #ifdef.
    #pragma validate GRAY             a variant that the build checks with glslangValidator; one line a set, an
                                      empty line is the variant without flags. At least one line.
    #pragma share A B                 sampler A takes the unit of B: no variant uses both.
    #pragma stage vertex              what follows, up to the next stage, is the vertex stage ...
    #pragma stage fragment            ... the fragment stage. What is before the first stage is in both.
    #include "lib/x.glsl"             the text of shaders/lib/x.glsl, once a stage; libraries may include libraries.

Not written in the files: #version 300 es, and highp precision for float, int and every sampler type; both are put
in front. Errors of the driver, of glslangValidator and of this script name the file and line as they are on disk.

Uniforms are found by reading the declarations, in every branch of every #if, one a line:

    uniform mat4 clip_from_world;             -> Uniform<X, glm::mat4> clip_from_world
    uniform vec4 lights[4];                   -> UniformArray<X, glm::vec4> lights (literal, #define NAME 4 or
                                                 const int NAME = 4 as the size)
    uniform sampler3D volumes[2];             -> Sampler<X, gl::Texture3D> volumes; units are given in order of
                                                 declaration and fixed; more than 16 a program are an error
    layout(std140) uniform Camera {           -> struct shaders::CameraBlock with the std140 layout, for
        mat4 clip_from_view;                     BlockStream<CameraBlock>. Programs that share the name share
        vec3 position_m; float exposure;         the declaration (keep it in lib/) and the binding point. Members:
        vec4 planes[6];                          float, int, uint, vec, ivec, uvec, mat4, arrays of 16-byte types,
    };                                           structs of these (`struct Light { ... };`, arrays of them).

`uniform` types: float int uint bool vec2-4 ivec2-3 mat3 mat4; samplers 2D, 3D, Cube,
2DShadow, usampler2D and usampler3D. The C++ side of tone_map.glsl:

    gl::ShaderVariants<shaders::ToneMap> programs;
    const gl::ShaderProgram<shaders::ToneMap>* program = *programs.get(shaders::ToneMap::kFilmic);
    program->set(shaders::ToneMap::exposure, 1.0f);        // a renamed or retyped uniform does not compile
    program->bind(shaders::ToneMap::radiance, texture);    // nor does a 3D texture here

The struct's name is the file's in PascalCase (tone_map.glsl: ToneMap), flags are kPascalCase constants.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import shader_emit
from shader_parse import STAGES, ShaderError, read_program
from shader_reflect import reflect

ROOT = Path(__file__).resolve().parent.parent.parent
LOCATION = re.compile(r"^(ERROR|WARNING): (\d+):(\d+): (.*)$")


def included_files(path):
    """The .glsl files that a program's text is made of, for the build's dependencies."""
    try:
        return [str(ROOT / f) for f in read_program(path, ROOT).files]
    except ShaderError:
        return [str(path)]  # check() will say what is wrong


def complaints(output, files):
    """glslangValidator's `ERROR: 1:12: text` as `file:12: error: text`, without what follows from the first."""
    found, lines = [], output.split("\n")
    for line, following in zip(lines, lines[1:] + [""]):
        if m := LOCATION.match(line):
            file = files[int(m[2])] if int(m[2]) < len(files) else files[0]
            if "compilation terminated" not in line and not (found and "missing #endif" in line):
                found.append(f"{file}:{m[3]}: {m[1].lower()}: {' '.join(m[4].split())}")
        elif line.startswith("ERROR: Linking") and not found:
            found.append(f"{files[0]}:1: error: {line[7:]} {' '.join(following.split())}")
    return found


def check_variant(program, flags):
    """Compiles and links one variant with glslangValidator; returns its complaints."""
    with tempfile.TemporaryDirectory() as folder:
        names = []
        for stage in STAGES:
            name = Path(folder) / f"{program.name}.{stage[:4]}"
            name.write_text(shader_emit.preamble(flags) + program.stages[stage].text(), encoding="utf-8")
            names.append(str(name))
        run = subprocess.run(["glslangValidator", "-l"] + names, capture_output=True, text=True, check=False)
    lines = complaints(run.stdout, program.files)
    if run.returncode and not lines:
        lines = [f"{program.files[0]}:1: error: glslangValidator failed: {run.stdout}{run.stderr}"]
    return [f"{line} [variant: {' '.join(flags) or 'none'}]" for line in lines]


def check(stamp, path):
    """Fails unless every `#pragma validate` variant of a program is right; then writes the stamp."""
    program = read_program(path, ROOT)
    reflect(program)
    faults = [f for flags in program.validate for f in check_variant(program, flags)]
    if faults:
        print("\n".join(faults), file=sys.stderr)
        return 1
    Path(stamp).write_text(f"{len(program.validate)} variants\n", encoding="utf-8")
    return 0


def table(header, source, paths):
    programs = [(p, reflect(p)) for p in (read_program(path, ROOT) for path in sorted(paths))]
    Path(header).write_text(shader_emit.header(programs), encoding="utf-8")
    Path(source).write_text(shader_emit.source(programs), encoding="utf-8")
    return 0


def main(arguments):
    try:
        if len(arguments) == 3 and arguments[0] == "check":
            return check(arguments[1], arguments[2])
        if len(arguments) > 3 and arguments[0] == "table":
            return table(arguments[1], arguments[2], arguments[3:])
    except ShaderError as error:
        print(error, file=sys.stderr)
        return 1
    print("usage: shader_table.py check STAMP FILE.glsl | table SHADERS_H SHADERS_CPP FILE.glsl...", file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
