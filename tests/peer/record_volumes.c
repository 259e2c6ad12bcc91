/* Preloaded into a program (LD_PRELOAD), writes the levels of its 3D textures, as they are when it ends, to
 * $RECORD_VOLUMES/ID_LEVEL.bin: eight int32 (texture name, level, width, height, depth, bytes, format, 0) and RGBA8
 * texels. A level is as large as the boxes reach that were uploaded. Levels of DXT5 blocks, which Mesa refuses for 3D textures (Godot then draws black), are
 * decoded and uploaded as RGBA8, so that the program shows what a graphics card would.
 * Works whatever way the program finds its GL functions. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { kTexture3D = 0x806F, kBinding3D = 0x806A, kRgba = 0x1908, kRgba8 = 0x8058, kUnsignedByte = 0x1401, kDxt5 = 0x83F3 };

typedef void (*GetIntegerv)(unsigned, int *);
typedef void (*SubImage)(unsigned, int, int, int, int, int, int, int, unsigned, unsigned, const void *);
typedef void (*CompressedSubImage)(unsigned, int, int, int, int, int, int, int, unsigned, int, const void *);
typedef void (*CompressedImage)(unsigned, int, unsigned, int, int, int, int, int, const void *);
typedef void (*Image)(unsigned, int, int, int, int, int, int, unsigned, unsigned, const void *);
typedef void *(*Lookup)(const char *);

static GetIntegerv real_get_integerv;
static SubImage real_sub_image;
static CompressedSubImage real_compressed;
static CompressedImage real_compressed_image;
static Image real_image;
static Lookup real_lookup;
static Lookup real_egl_lookup;

typedef struct Level {
    struct Level *next;
    int texture, level, size[3];
    uint8_t *rgba8; /* x fastest, then y, then z */
} Level;

static Level *levels;

static size_t texel_count(const int size[3]) { return (size_t)size[0] * size[1] * size[2]; }

/* Copies rows of a box from one array to another. */
static void copy_box(uint8_t *to, const int to_size[3], const int at[3], const uint8_t *from, const int size[3]) {
    for (int z = 0; z < size[2]; ++z)
        for (int y = 0; y < size[1]; ++y)
            memcpy(to + (((size_t)(at[2] + z) * to_size[1] + at[1] + y) * to_size[0] + at[0]) * 4,
                   from + ((size_t)z * size[1] + y) * size[0] * 4, (size_t)size[0] * 4);
}

static void grow(Level *level, const int size[3]) {
    static const int origin[3] = {0, 0, 0};
    uint8_t *larger = calloc(texel_count(size), 4);
    copy_box(larger, size, origin, level->rgba8, level->size);
    free(level->rgba8);
    level->rgba8 = larger;
    memcpy(level->size, size, sizeof level->size);
}

static void record(int level, const int at[3], const int size[3], const void *rgba8) {
    int texture = 0, reach[3], must_grow = 0;
    if (!rgba8 || !real_get_integerv)
        return;
    real_get_integerv(kBinding3D, &texture);
    Level *known = levels;
    while (known && (known->texture != texture || known->level != level))
        known = known->next;
    if (!known) {
        known = calloc(1, sizeof *known);
        *known = (Level){levels, texture, level, {0, 0, 0}, NULL};
        levels = known;
    }
    for (int i = 0; i < 3; ++i) {
        reach[i] = at[i] + size[i] > known->size[i] ? at[i] + size[i] : known->size[i];
        must_grow |= reach[i] > known->size[i];
    }
    if (must_grow)
        grow(known, reach);
    copy_box(known->rgba8, known->size, at, rgba8, size);
}

__attribute__((destructor)) static void write_levels(void) {
    const char *folder = getenv("RECORD_VOLUMES");
    for (const Level *l = levels; folder && l; l = l->next) {
        const size_t bytes = texel_count(l->size) * 4;
        const int32_t head[8] = {l->texture, l->level, l->size[0], l->size[1], l->size[2], (int32_t)bytes, kRgba, 0};
        char path[4096];
        snprintf(path, sizeof path, "%s/%d_%d.bin", folder, l->texture, l->level);
        FILE *file = fopen(path, "wb");
        if (!file)
            continue;
        fwrite(head, sizeof head, 1, file);
        fwrite(l->rgba8, bytes, 1, file);
        fclose(file);
    }
}

static void sub_image(unsigned target, int level, int x, int y, int z, int w, int h, int d, unsigned format, unsigned type,
                      const void *data) {
    if (target == kTexture3D && format == kRgba && type == kUnsignedByte)
        record(level, (int[3]){x, y, z}, (int[3]){w, h, d}, data);
    real_sub_image(target, level, x, y, z, w, h, d, format, type, data);
}

/* The 16 texels of a block, by the format's own rules. */
static void decode_block(const uint8_t *block, uint8_t texels[16][4]) {
    uint64_t alpha_codes = 0;
    uint32_t color_codes = 0;
    int colors[4][3], alphas[8] = {block[0], block[1], 0, 0, 0, 0, 0, 255};
    for (int i = 5; i >= 0; --i)
        alpha_codes = alpha_codes << 8 | block[2 + i];
    for (int i = 3; i >= 0; --i)
        color_codes = color_codes << 8 | block[12 + i];
    for (int i = 2; i < 8 && alphas[0] > alphas[1]; ++i)
        alphas[i] = (alphas[0] * (8 - i) + alphas[1] * (i - 1)) / 7;
    for (int end = 0; end < 2; ++end) {
        int code = block[8 + 2 * end] | block[9 + 2 * end] << 8;
        int r = code >> 11, g = code >> 5 & 63, b = code & 31;
        colors[end][0] = r << 3 | r >> 2;
        colors[end][1] = g << 2 | g >> 4;
        colors[end][2] = b << 3 | b >> 2;
    }
    for (int c = 0; c < 3; ++c) {
        colors[2][c] = (2 * colors[0][c] + colors[1][c]) / 3;
        colors[3][c] = (colors[0][c] + 2 * colors[1][c]) / 3;
    }
    for (int i = 0; i < 16; ++i) {
        for (int c = 0; c < 3; ++c)
            texels[i][c] = (uint8_t)colors[color_codes >> (2 * i) & 3][c];
        texels[i][3] = (uint8_t)alphas[alpha_codes >> (3 * i) & 7];
    }
}

/* Uploads a level of blocks as texels; 0 if that is not possible. */
static int show_blocks(int level, int w, int h, int d, int bytes, unsigned format, const uint8_t *blocks) {
    if (format != kDxt5 || !blocks || !real_image || bytes != w * h * d)
        return 0;
    uint8_t *rgba = malloc((size_t)bytes * 4), texels[16][4];
    for (int block = 0; block < bytes / 16; ++block) {
        int x = block % (w / 4) * 4, y = block / (w / 4) % (h / 4) * 4, z = block / (w / 4) / (h / 4);
        decode_block(blocks + block * 16, texels);
        for (int row = 0; row < 4; ++row)
            memcpy(rgba + (((size_t)z * h + y + row) * w + x) * 4, texels[row * 4], 16);
    }
    record(level, (int[3]){0, 0, 0}, (int[3]){w, h, d}, rgba);
    real_image(kTexture3D, level, kRgba8, w, h, d, 0, kRgba, kUnsignedByte, rgba);
    free(rgba);
    return 1;
}

static void compressed(unsigned target, int level, int x, int y, int z, int w, int h, int d, unsigned format, int bytes,
                       const void *data) {
    if (target == kTexture3D && x == 0 && y == 0 && z == 0 && show_blocks(level, w, h, d, bytes, format, data))
        return;
    real_compressed(target, level, x, y, z, w, h, d, format, bytes, data);
}

static void compressed_image(unsigned target, int level, unsigned format, int w, int h, int d, int border, int bytes,
                             const void *data) {
    if (target == kTexture3D && show_blocks(level, w, h, d, bytes, format, data))
        return;
    real_compressed_image(target, level, format, w, h, d, border, bytes, data);
}

static void *lookup(const char *name);
static void *egl_lookup(const char *name);

/* `found` or the function of ours that stands before it. */
static void *replaced(const char *name, void *found) {
    if (!found)
        return found;
    if (!strcmp(name, "glGetIntegerv"))
        real_get_integerv = (GetIntegerv)found;
    if (!strcmp(name, "glTexImage3D"))
        real_image = (Image)found;
    if (!strcmp(name, "glTexSubImage3D")) {
        real_sub_image = (SubImage)found;
        return (void *)sub_image;
    }
    if (!strcmp(name, "glCompressedTexSubImage3D")) {
        real_compressed = (CompressedSubImage)found;
        return (void *)compressed;
    }
    if (!strcmp(name, "glCompressedTexImage3D")) {
        real_compressed_image = (CompressedImage)found;
        return (void *)compressed_image;
    }
    if (!strcmp(name, "glXGetProcAddressARB") || !strcmp(name, "glXGetProcAddress")) {
        real_lookup = (Lookup)found;
        return (void *)lookup;
    }
    if (!strcmp(name, "eglGetProcAddress")) {
        real_egl_lookup = (Lookup)found;
        return (void *)egl_lookup;
    }
    return found;
}

static void *lookup(const char *name) { return replaced(name, real_lookup(name)); }
static void *egl_lookup(const char *name) { return replaced(name, real_egl_lookup(name)); }

void *dlsym(void *handle, const char *name) {
    static void *(*real)(void *, const char *);
    if (!real)
        real = (void *(*)(void *, const char *))dlvsym(RTLD_NEXT, "dlsym", "GLIBC_2.2.5");
    return replaced(name, real(handle, name));
}

/* For programs that link these. */
void *eglGetProcAddress(const char *name) {
    if (!real_egl_lookup)
        dlsym(RTLD_NEXT, "eglGetProcAddress");
    return egl_lookup(name);
}
void *glXGetProcAddressARB(const char *name) {
    if (!real_lookup)
        dlsym(RTLD_NEXT, "glXGetProcAddressARB");
    return lookup(name);
}
