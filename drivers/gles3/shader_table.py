"""Makes C++ of the .glsl files: drivers/gles3/shaders.h and shaders.cpp in the build's gen folder.

One file in shaders/ is one program. It is plain GLSL ES 3.00 but for these lines, which this script consumes:

    #pragma flags GRAY TWO_SIDED      switches of the program, at most 32. Variant = any set of them, each given as
                                      `#define GRAY 1` before all else. Test with #ifdef.
    #pragma validate GRAY             a variant that the build checks with glslangValidator; one line a set, an
                                      empty line is the variant without flags. At least one line.
    #pragma stage vertex              what follows, up to the next stage, is the vertex stage ...
    #pragma stage fragment            ... the fragment stage. What is before the first stage is in both.
    #include "lib/x.glsl"             the text of shaders/lib/x.glsl, once a stage; libraries may include libraries.

Not written in the files: #version 300 es, and highp precision for float, int and every sampler type; both are put
in front. Errors of the driver, of glslangValidator and of this script name the file and line as they are on disk.

Uniforms are found by reading the declarations, in every branch of every #if, one a line:

    uniform mat4 clip_from_world;             -> Uniform<Copy, glm::mat4> clip_from_world
    uniform vec4 lights[4];                   -> UniformArray<Copy, glm::vec4> lights (literal, #define NAME 4 or
                                                 const int NAME = 4 as the size)
    uniform sampler3D volumes[2];             -> Sampler<Copy, gl::Texture3D> volumes; units are given in order of
                                                 declaration and fixed; more than 16 a program are an error
    layout(std140) uniform Camera {           -> struct shaders::CameraBlock with the std140 layout, for
        mat4 clip_from_view;                     gl::UniformBuffer<CameraBlock>. Programs that share the name share
        vec3 position_m; float exposure;         the declaration (keep it in lib/) and the binding point. Members:
        vec4 planes[6];                          float, int, uint, vec, ivec, uvec, mat4, arrays of 16-byte types,
    };                                           structs of these (`struct Light { ... };`, arrays of them).

`uniform` types: float int uint bool vec2-4 ivec2-3 mat3 mat4; samplers 2D, 3D, Cube, 2DArray, 2DShadow and
usampler3D. The C++ side of copy.glsl:

    gl::ShaderVariants<shaders::Copy> copies;
    const gl::ShaderProgram<shaders::Copy>* copy = *copies.get(shaders::Copy::kGray);
    copy->set(shaders::Copy::lod, 0.0f);                // a renamed or retyped uniform does not compile
    copy->bind(shaders::Copy::source, texture);         // nor does a 3D texture here

The struct's name is the file's in PascalCase (tone_map.glsl: ToneMap), flags are kPascalCase constants.
"""
