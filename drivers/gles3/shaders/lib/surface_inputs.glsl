// shaders/lib/surface_inputs.glsl -- what lib/surface_vertex.glsl gives; fragment stage
in vec3 v_position;
in vec3 v_normal;
in vec3 v_tangent;
in vec3 v_binormal;
in vec4 v_color;
in vec2 v_uv;
in vec2 v_uv2;
