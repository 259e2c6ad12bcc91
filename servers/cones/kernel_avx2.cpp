// The kernel of gather.h: eight points at a time through one probe's volume. Built with -mavx2
// (servers/SConscript) and called where the processor has it; so it calls no inline function of others, which
// the linker could take for all.
//
// Light is filtered as rasterisers do, in 8 bits: a lerp by w / 256 is v0 + round(w (v1 - v0) / 256), first
// along x, then y, then z, then between levels. The picture is that of the shaders' cones to the bit, but for
// the last digit of a logarithm.
//
// Source: spec gi-shading sections 3 to 5; shaders/lib/gi_probe.glsl and cone_trace.glsl are its twins.
#include "servers/cones/kernel.h"

#include <immintrin.h>
#include <math.h> // NOLINT(modernize-deprecated-headers): std's are inline functions of others

#define CL_INLINE static inline __attribute__((always_inline))

namespace cl::cones {

namespace {

using float4 = float __attribute__((vector_size(16)));
using float8 = float __attribute__((vector_size(32)));
using int8 = int32_t __attribute__((vector_size(32)));

template <typename Vector>
CL_INLINE Vector load(const void* from) {
    Vector v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
}
template <typename Vector>
CL_INLINE void store(void* to, Vector v) {
    __builtin_memcpy(to, &v, sizeof v);
}

CL_INLINE float8 splat(float v) {
    return float8(_mm256_set1_ps(v));
}
CL_INLINE float8 lesser(float8 a, float8 b) {
    return float8(_mm256_min_ps(a, b));
}
CL_INLINE float8 greater(float8 a, float8 b) {
    return float8(_mm256_max_ps(a, b));
}
CL_INLINE float8 magnitude(float8 v) {
    return float8(int8(v) & 0x7FFFFFFF);
}
/// a where the mask is set, else b.
CL_INLINE float8 select(int8 mask, float8 a, float8 b) {
    return float8(_mm256_blendv_ps(b, a, __m256(mask)));
}
CL_INLINE bool any_of(int8 mask) {
    return !_mm256_testz_si256(__m256i(mask), __m256i(mask));
}

struct Vec3 {
    float8 x, y, z;
};
CL_INLINE Vec3 operator+(Vec3 a, Vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
CL_INLINE Vec3 operator-(Vec3 a, Vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
CL_INLINE Vec3 operator*(Vec3 a, float8 b) {
    return {a.x * b, a.y * b, a.z * b};
}
CL_INLINE float8 dot(Vec3 a, Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
CL_INLINE Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
CL_INLINE Vec3 normalize(Vec3 v) {
    return v * (1.0f / float8(_mm256_sqrt_ps(dot(v, v))));
}
/// What a matrix's columns make of a direction ...
CL_INLINE Vec3 turn(const float (&m)[4][4], Vec3 v) {
    return {m[0][0] * v.x + m[1][0] * v.y + m[2][0] * v.z, m[0][1] * v.x + m[1][1] * v.y + m[2][1] * v.z,
            m[0][2] * v.x + m[1][2] * v.y + m[2][2] * v.z};
}
/// ... and of a place.
CL_INLINE Vec3 place(const float (&m)[4][4], Vec3 v) {
    const Vec3 t = turn(m, v);
    return {t.x + m[3][0], t.y + m[3][1], t.z + m[3][2]};
}
CL_INLINE Vec3 scaled(Vec3 v, const float (&by)[3]) {
    return {v.x * by[0], v.y * by[1], v.z * by[2]};
}

// ---- Filters. Channels are words of 16 bits; weights are parts of 256, times 128 for the rounding product
// ----

CL_INLINE __m256i lerp(__m256i v0, __m256i v1, __m256i weight) {
    return _mm256_add_epi16(v0, _mm256_mulhrs_epi16(_mm256_sub_epi16(v1, v0), weight));
}
CL_INLINE __m128i lerp(__m128i v0, __m128i v1, __m128i weight) {
    return _mm_add_epi16(v0, _mm_mulhrs_epi16(_mm_sub_epi16(v1, v0), weight));
}

/// Where eight points lie in a level: the lower corner of each one's cell between texels [bytes], and the
/// weights of the upper one along each axis.
struct Cells {
    int8 offset, wx, wy, wz;
};

/// Texel below a coordinate, clamped to the level, and the weight of the next: none at its ends. Coordinates
/// are some thousand texels at most.
CL_INLINE int8 texel_of(float scale, int32_t last, float8 uv, int8& weight) {
    const __m256i parts = __m256i(int8(_mm256_cvtps_epi32(uv * scale)) - 128);
    const int8 inside =
        int8(_mm256_min_epi32(_mm256_max_epi32(parts, _mm256_setzero_si256()), _mm256_set1_epi32(last)));
    weight = (inside & 255) << 7;
    return inside >> 8;
}

CL_INLINE Cells find_cells(const Level& l, Vec3 uv) {
    Cells c;
    const int8 x = texel_of(l.scale[0], l.last[0], uv.x, c.wx),
               y = texel_of(l.scale[1], l.last[1], uv.y, c.wy),
               z = texel_of(l.scale[2], l.last[2], uv.z, c.wz);
    c.offset = z * l.slice + y * l.row + (x << 2);
    return c;
}

/// Bytes from a texel to the next along y and z.
struct Strides {
    ptrdiff_t y, z;
};
CL_INLINE Strides strides_of(const Level& l) {
    return {l.row, l.slice};
}

/// The four rows of a cell, two texels each: lower y, upper y of the lower z, then of the upper one.
CL_INLINE __m256i rows_at(const uint8_t* at, Strides s) {
    return _mm256_set_epi64x(load<int64_t>(at + s.z + s.y), load<int64_t>(at + s.z), load<int64_t>(at + s.y),
                             load<int64_t>(at));
}

/// Rows filtered along x, 4 channels each.
CL_INLINE __m256i filter_rows(__m256i rows, __m256i wx) {
    const __m256i lower_first = _mm256_shuffle_epi32(rows, _MM_SHUFFLE(3, 1, 2, 0));
    const __m256i zero = _mm256_setzero_si256();
    return lerp(_mm256_unpacklo_epi8(lower_first, zero), _mm256_unpackhi_epi8(lower_first, zero), wx);
}

/// Two weights that stand in a row, each for 4 channels; twice.
CL_INLINE __m256i spread_pair(const uint16_t* pair) {
    const __m256i order = _mm256_set1_epi64x(0x0100010001000100);
    const __m256i second = _mm256_set_epi64x(0x0202020202020202, 0, 0x0202020202020202, 0);
    return _mm256_shuffle_epi8(_mm256_set1_epi32(load<int32_t>(pair)), _mm256_add_epi8(order, second));
}

/// Rows of two levels filtered along y and z, and between the levels: 4 channels.
/// @param wy, wz  pairs of weights: fine, coarse
CL_INLINE __m128i filter_levels(__m256i fine, __m256i coarse, const uint16_t* wy, const uint16_t* wz,
                                __m128i share) {
    const __m256i slices =
        lerp(_mm256_unpacklo_epi64(fine, coarse), _mm256_unpackhi_epi64(fine, coarse), spread_pair(wy));
    const __m128i levels = lerp(_mm256_castsi256_si128(slices), _mm256_extracti128_si256(slices, 1),
                                _mm256_castsi256_si128(spread_pair(wz)));
    return lerp(levels, _mm_unpackhi_epi64(levels, levels), share);
}

/// ... of one level.
CL_INLINE __m128i filter_level(__m256i rows, __m128i wy, __m128i wz) {
    const __m256i slices = lerp(rows, _mm256_unpackhi_epi64(rows, rows), _mm256_broadcastsi128_si256(wy));
    return lerp(_mm256_castsi256_si128(slices), _mm256_extracti128_si256(slices, 1), wz);
}

CL_INLINE float4 floats_of(__m128i channels) {
    return float4(_mm_cvtepi32_ps(_mm_cvtepu16_epi32(channels))) * (1.0f / 255.0f);
}

// ---- Diffuse cones: eight points side by side ----

/// Light of eight points, of which 1 is full; a: opacity.
struct Light {
    float8 r, g, b, a;
};

/// Two levels at eight points.
struct Sampled {
    const uint8_t* fine;
    const uint8_t* coarse;
    Strides fine_strides, coarse_strides;
    Cells fine_cells, coarse_cells;
    __m256i share; ///< weight of the coarse level
};

/// Weights in words: of fine for points 0 to 3, of coarse for them, then for points 4 to 7.
CL_INLINE __m256i word_pairs(int8 fine, int8 coarse) {
    return _mm256_packus_epi32(__m256i(fine), __m256i(coarse));
}

/// A texel of either level, each for both halves.
CL_INLINE __m256i two_texels(const uint8_t* fine, const uint8_t* coarse) {
    return _mm256_broadcastq_epi64(
        _mm_insert_epi32(_mm_cvtsi32_si128(load<int32_t>(fine)), load<int32_t>(coarse), 1));
}

/// One channel of two_texels() in the words of word_pairs().
template <int kChannel>
CL_INLINE __m256i spread(__m256i texels) {
    constexpr int64_t kFine = 0x8000800080008000 + 0x0001000100010001 * kChannel;
    constexpr int64_t kCoarse = kFine + 0x0004000400040004;
    return _mm256_shuffle_epi8(texels, _mm256_set_epi64x(kCoarse, kFine, kCoarse, kFine));
}

/// Points in one cell of either level, as neighbours are where texels are large: its corners are spread to
/// all of them, and channels filtered one after the other.
CL_INLINE Light sample_together(const Sampled& s) {
    const __m256i wx = word_pairs(s.fine_cells.wx, s.coarse_cells.wx);
    const __m256i wy = word_pairs(s.fine_cells.wy, s.coarse_cells.wy);
    const __m256i wz = word_pairs(s.fine_cells.wz, s.coarse_cells.wz);
    const uint8_t* f = s.fine + s.fine_cells.offset[0];
    const uint8_t* c = s.coarse + s.coarse_cells.offset[0];
    const ptrdiff_t fy = s.fine_strides.y, fz = s.fine_strides.z, cy = s.coarse_strides.y,
                    cz = s.coarse_strides.z;
    const __m256i v000 = two_texels(f, c), v100 = two_texels(f + 4, c + 4);
    const __m256i v010 = two_texels(f + fy, c + cy), v110 = two_texels(f + fy + 4, c + cy + 4);
    const __m256i v001 = two_texels(f + fz, c + cz), v101 = two_texels(f + fz + 4, c + cz + 4);
    const __m256i v011 = two_texels(f + fy + fz, c + cy + cz),
                  v111 = two_texels(f + fy + fz + 4, c + cy + cz + 4);
    const auto channel = [&]<int kChannel>() __attribute__((always_inline)) {
        const __m256i near = lerp(lerp(spread<kChannel>(v000), spread<kChannel>(v100), wx),
                                  lerp(spread<kChannel>(v010), spread<kChannel>(v110), wx), wy);
        const __m256i far = lerp(lerp(spread<kChannel>(v001), spread<kChannel>(v101), wx),
                                 lerp(spread<kChannel>(v011), spread<kChannel>(v111), wx), wy);
        const __m256i levels = lerp(near, far, wz);
        const __m256i light = lerp(levels, _mm256_unpackhi_epi64(levels, levels), s.share);
        return float8(_mm256_cvtepi32_ps(_mm256_unpacklo_epi16(light, _mm256_setzero_si256()))) *
               (1.0f / 255.0f);
    };
    return {channel.template operator()<0>(), channel.template operator()<1>(),
            channel.template operator()<2>(), channel.template operator()<3>()};
}

/// Points each in a cell of its own. @param wanted  those whose light is needed
CL_INLINE Light sample_apart(const Sampled& s, int8 wanted) {
    alignas(32) int32_t fine_offset[kLanes], coarse_offset[kLanes];
    alignas(32) uint16_t wx[kLanes][2], wy[kLanes][2], wz[kLanes][2]; // fine, coarse
    store(fine_offset, s.fine_cells.offset);
    store(coarse_offset, s.coarse_cells.offset);
    store(wx, s.fine_cells.wx | s.coarse_cells.wx << 16);
    store(wy, s.fine_cells.wy | s.coarse_cells.wy << 16);
    store(wz, s.fine_cells.wz | s.coarse_cells.wz << 16);
    const auto is_wanted = uint32_t(_mm256_movemask_ps(__m256(wanted)));
    alignas(32) int64_t texels[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
        __m128i light = _mm_setzero_si128();
        if ((is_wanted >> lane & 1) != 0) {
            const __m256i fine = rows_at(s.fine + fine_offset[lane], s.fine_strides);
            const __m256i coarse = rows_at(s.coarse + coarse_offset[lane], s.coarse_strides);
            const __m256i any = _mm256_or_si256(fine, coarse);
            if (!_mm256_testz_si256(any, any)) {
                light = filter_levels(filter_rows(fine, _mm256_set1_epi16(int16_t(wx[lane][0]))),
                                      filter_rows(coarse, _mm256_set1_epi16(int16_t(wx[lane][1]))), wy[lane],
                                      wz[lane], _mm256_castsi256_si128(s.share));
            }
        }
        _mm_storel_epi64(reinterpret_cast<__m128i*>(&texels[lane]), light);
    }
    const int8 first = load<int8>(texels), last = load<int8>(texels + 4);
    const int8 rg = __builtin_shufflevector(first, last, 0, 2, 4, 6, 8, 10, 12, 14);
    const int8 ba = __builtin_shufflevector(first, last, 1, 3, 5, 7, 9, 11, 13, 15);
    const auto floats = [](int8 v) __attribute__((always_inline)) {
        return float8(_mm256_cvtepi32_ps(__m256i(v))) * (1.0f / 255.0f);
    };
    return {floats(rg & 0xFFFF), floats(rg >> 16), floats(ba & 0xFFFF), floats(ba >> 16)};
}

/// One diffuse cone of each point: all take the same steps. Those that begin with an opacity of 1 rest.
CL_INLINE void march_alike(const Probe& probe, Vec3 at, Vec3 along, Light& sum) {
    for (int i = 0; i < probe.step_count; ++i) {
        const int8 goes_on = sum.a < kOpaque;
        if (!any_of(goes_on)) {
            return;
        }
        const Step& step = probe.steps[i];
        const Vec3 uv = at + along * splat(step.distance);
        const Sampled s{.fine = step.fine->rgba8,
                        .coarse = step.coarse->rgba8,
                        .fine_strides = strides_of(*step.fine),
                        .coarse_strides = strides_of(*step.coarse),
                        .fine_cells = find_cells(*step.fine, uv),
                        .coarse_cells = find_cells(*step.coarse, uv),
                        .share = _mm256_set1_epi16(int16_t(step.coarse_share << 7))};
        const int8 differ = (s.fine_cells.offset ^ s.fine_cells.offset[0]) |
                            (s.coarse_cells.offset ^ s.coarse_cells.offset[0]);
        const Light light = any_of(differ) ? sample_apart(s, goes_on) : sample_together(s);
        const float8 rest = select(goes_on, 1.0f - sum.a, splat(0.0f));
        sum.r += light.r * rest;
        sum.g += light.g * rest;
        sum.b += light.b * rest;
        sum.a += light.a * rest;
    }
}

// ---- Specular cones: each of an aperture of its own ----

/// Where one point lies in a level, as Cells.
struct Cell {
    ptrdiff_t offset;
    uint16_t wx, wy, wz;
};

CL_INLINE int32_t texel_of(float scale, int32_t last, float uv, uint16_t& weight) {
    // Unsigned: what is no number becomes the least integer, and is clamped like any other.
    const auto parts = int32_t(uint32_t(_mm_cvtss_si32(_mm_set_ss(uv * scale))) - 128u);
    const int32_t inside = parts < 0 ? 0 : (parts < last ? parts : last);
    weight = uint16_t((inside & 255) << 7);
    return inside >> 8;
}

CL_INLINE Cell find_cell(const Level& l, float4 uv) {
    Cell c;
    const int32_t x = texel_of(l.scale[0], l.last[0], uv[0], c.wx),
                  y = texel_of(l.scale[1], l.last[1], uv[1], c.wy),
                  z = texel_of(l.scale[2], l.last[2], uv[2], c.wz);
    c.offset = ptrdiff_t(z) * l.slice + ptrdiff_t(y) * l.row + 4 * ptrdiff_t(x);
    return c;
}

CL_INLINE __m256i filtered_rows(const Level& l, const Cell& cell) {
    return filter_rows(rows_at(l.rgba8 + cell.offset, strides_of(l)), _mm256_set1_epi16(int16_t(cell.wx)));
}

CL_INLINE float4 sample(const Probe& probe, float4 uv, float lod) {
    const float last = float(probe.level_count - 1);
    const float clamped = lod <= 0.0f ? 0.0f : (lod < last ? lod : last);
    const int low = int(clamped);
    const int share = int((clamped - float(low)) * 256.0f);
    const Level& fine = probe.levels[low];
    const Cell f = find_cell(fine, uv);
    const __m256i rows = filtered_rows(fine, f);
    if (share == 0) {
        return floats_of(filter_level(rows, _mm_set1_epi16(int16_t(f.wy)), _mm_set1_epi16(int16_t(f.wz))));
    }
    const Level& coarse = probe.levels[low + 1];
    const Cell c = find_cell(coarse, uv);
    const uint16_t wy[2] = {f.wy, c.wy}, wz[2] = {f.wz, c.wz};
    return floats_of(
        filter_levels(rows, filtered_rows(coarse, c), wy, wz, _mm_set1_epi16(int16_t(share << 7))));
}

/// Logarithms are taken once a cone, as in cone_trace.glsl.
CL_INLINE float4 march_alone(const Probe& probe, float4 at, float4 along, float tan_half) {
    float4 sum{0.0f, 0.0f, 0.0f, 0.0f};
    const float slope = tan_half > 1e-4f ? tan_half : 1e-4f;
    const float narrow = ceilf(1.0f / slope - 2.0f * probe.bias);
    const float narrow_steps = narrow > 0.0f ? narrow : 0.0f;
    const float lod_step = log2f(1.0f + slope);
    float lod = log2f(slope * (2.0f * probe.bias + narrow_steps)) - narrow_steps * lod_step;
    float distance = probe.bias;
    while (distance < probe.reach && sum[3] < kOpaque) {
        sum += sample(probe, at + along * distance, lod) * (1.0f - sum[3]);
        const float diameter = 2.0f * tan_half * distance;
        distance += 0.5f * (diameter > 1.0f ? diameter : 1.0f);
        lod += lod_step;
    }
    return sum;
}

// ---- A probe ----

/// A cone's light as it counts: rgb with the opacity that is short of full left to what is beyond, whose
/// share is a.
CL_INLINE float4 with_miss(const Probe& probe, float4 got) {
    const float full = got[3] * (1.0f / kOpaque);
    const float met = !probe.blend_ambient ? 1.0f : (full < 1.0f ? full : 1.0f);
    float4 out = got * met;
    out[3] = 1.0f - met;
    return out;
}

/// Two tangents of a normal. They turn with the camera, as the specification has it.
CL_INLINE void find_tangents(Vec3 normal, Vec3& tangent, Vec3& binormal) {
    const float8 zero = splat(0.0f), one = splat(1.0f);
    const int8 upright = magnitude(normal.z) < 0.999f;
    tangent = normalize(cross(Vec3{zero, select(upright, zero, one), select(upright, one, zero)}, normal));
    binormal = normalize(cross(tangent, normal));
}

/// Light of all diffuse cones; a: share of what is beyond the volume. @param inside  points that gather
CL_INLINE Light gather_diffuse(const Quality& quality, const Probe& probe, Vec3 normal, Vec3 offset, Vec3 at,
                               int8 inside) {
    Vec3 tangent, binormal;
    find_tangents(normal, tangent, binormal);
    const float8 zero = splat(0.0f), one = splat(1.0f);
    Light all{zero, zero, zero, zero};
    for (int i = 0; i < quality.cone_count; ++i) {
        const float(&cone)[4] = quality.cones[i];
        const Vec3 way = tangent * splat(cone[0]) + binormal * splat(cone[1]) + normal * splat(cone[2]);
        // It ends 1 m from the unbiased point: with a normal bias all cones bend.
        const Vec3 direction = normalize(turn(probe.cells_from_view, way) - offset);
        Light got{zero, zero, zero, select(inside, zero, one)};
        march_alike(probe, at, scaled(direction, probe.uv_from_cells), got);
        const float8 met = probe.blend_ambient ? lesser(got.a * (1.0f / kOpaque), one) : one;
        all.r += got.r * met * cone[3];
        all.g += got.g * met * cone[3];
        all.b += got.b * met * cone[3];
        all.a += (1.0f - met) * cone[3];
    }
    return all;
}

/// Adds what one probe gathers at the points.
CL_INLINE void gather_probe(const Quality& quality, const Probe& probe, const Points& points, Sums& sums) {
    const Vec3 position{load<float8>(points.position[0]), load<float8>(points.position[1]),
                        load<float8>(points.position[2])};
    const Vec3 normal{load<float8>(points.normal[0]), load<float8>(points.normal[1]),
                      load<float8>(points.normal[2])};
    const Vec3 offset = turn(probe.cells_from_view, normal) * splat(probe.normal_bias);
    const Vec3 origin = place(probe.cells_from_view, position) + offset;
    const float8 axes[3] = {origin.x, origin.y, origin.z};
    float8 from_center = splat(0.0f);
    int8 inside = int8(_mm256_set1_epi32(-1));
    for (int i = 0; i < 3; ++i) {
        from_center = greater(from_center, magnitude(2.0f * axes[i] / probe.bounds[i] - 1.0f));
        inside &= (axes[i] >= 0.0f) & (axes[i] <= probe.bounds[i]);
    }
    if (!any_of(inside)) {
        return;
    }
    const float8 blend = lesser(greater(1.0f - from_center, splat(0.0f)), splat(1.0f));
    const Vec3 at = scaled(origin, probe.uv_from_cells);
    const Light diffuse = gather_diffuse(quality, probe, normal, offset, at, inside);
    const Vec3 eye_ray = normalize(position);
    const Vec3 reflection = eye_ray - normal * (2.0f * dot(normal, eye_ray));
    const Vec3 along = scaled(normalize(turn(probe.cells_from_view, reflection)), probe.uv_from_cells);
    for (int lane = 0; lane < points.count; ++lane) {
        if (!inside[lane]) {
            continue;
        }
        const float4 met =
            march_alone(probe, float4{at.x[lane], at.y[lane], at.z[lane], 0.0f},
                        float4{along.x[lane], along.y[lane], along.z[lane], 0.0f}, points.specular_tan[lane]);
        const float4 around{diffuse.r[lane], diffuse.g[lane], diffuse.b[lane], diffuse.a[lane]};
        const float scale = probe.multiplier * blend[lane];
        store(sums.diffuse[lane], load<float4>(sums.diffuse[lane]) + around * scale);
        store(sums.specular[lane], load<float4>(sums.specular[lane]) + with_miss(probe, met) * scale);
        sums.weight[lane] += blend[lane];
    }
}

} // namespace

void gather_avx2(const Quality& quality, const Probe* probes, int probe_count, const Points& points,
                 Sums& sums) {
    for (int i = 0; i < probe_count; ++i) {
        if (probes[i].levels) {
            gather_probe(quality, probes[i], points, sums);
        }
    }
}

} // namespace cl::cones
