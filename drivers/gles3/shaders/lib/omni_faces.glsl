// shaders/lib/omni_faces.glsl -- all directions on six faces of a cube, for omni lights' shadows; library, no main()
// space    the light's own axes [m]; places in the shadow atlas 0..1
// twin     drivers/gles3/omni_faces.cpp, which says how the faces lie

/// How far a point is along the axis of its face [m].
float omni_face_depth(vec3 p) {
    vec3 a = abs(p);
    return max(a.x, max(a.y, a.z));
}

/// A point's place in the atlas and its depth there.
/// tiles: xy middle of the face of +x; z from tile to tile; w from the middle of a face to its edge
vec3 omni_face_at(vec3 p, vec4 tiles, float near) {
    vec3 a = abs(p);
    bool is_z = a.z > max(a.x, a.y);
    bool is_y = !is_z && a.y > a.x;
    vec3 q = is_z ? p.zxy : (is_y ? p.yzx : p); // the face's axis first
    float side = q.x < 0.0 ? 1.0 : 0.0;
    vec2 tile = vec2(is_z ? 2.0 : (is_y ? 1.0 : 0.0), side);
    float along = max(abs(q.x), 1e-6);
    vec2 at = vec2(q.z * (1.0 - 2.0 * side), q.y) / along;
    return vec3(tiles.xy + tile * tiles.z + at * tiles.w, 1.0 - near / along);
}
