// shaders/lib/vertex_inputs.glsl -- the attributes of a mesh, at the locations of gl/vertex_array.h; vertex stage
// Absent attributes read white (a_color) or (0, 0, 0, 1). Normals and tangents are not unit length when they come
// from int8: normalise. a_tangent.w is the sign of the binormal: B = cross(N, T) * w.
layout(location = 0) in vec3 a_position;  // local space [m]
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec4 a_tangent;
layout(location = 3) in vec4 a_color;
layout(location = 4) in vec2 a_uv;
layout(location = 5) in vec2 a_uv2;
