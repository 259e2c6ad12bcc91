/* Preloaded into a program (LD_PRELOAD), writes every upload of a 3D texture's level to $RECORD_VOLUMES/ID_LEVEL.bin:
 * eight int32 (texture name, level, width, height, depth, bytes, format, 0) and the bytes. A later upload of the same
 * level replaces the file. Works whatever way the program finds its GL functions. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { kTexture3D = 0x806F, kBinding3D = 0x806A, kRgba = 0x1908, kUnsignedByte = 0x1401 };

typedef void (*GetIntegerv)(unsigned, int *);
typedef void (*SubImage)(unsigned, int, int, int, int, int, int, int, unsigned, unsigned, const void *);
typedef void (*CompressedSubImage)(unsigned, int, int, int, int, int, int, int, unsigned, int, const void *);
typedef void (*CompressedImage)(unsigned, int, unsigned, int, int, int, int, int, const void *);
typedef void *(*Lookup)(const char *);

static GetIntegerv real_get_integerv;
static SubImage real_sub_image;
static CompressedSubImage real_compressed;
static CompressedImage real_compressed_image;
static Lookup real_lookup;
static Lookup real_egl_lookup;

static void record(int level, int w, int h, int d, int bytes, unsigned format, const void *data) {
    const char *folder = getenv("RECORD_VOLUMES");
    int32_t head[8] = {0, level, w, h, d, bytes, (int32_t)format, 0};
    char path[4096];
    if (!folder || !data || !real_get_integerv)
        return;
    real_get_integerv(kBinding3D, &head[0]);
    snprintf(path, sizeof path, "%s/%d_%d.bin", folder, head[0], level);
    FILE *file = fopen(path, "wb");
    if (!file)
        return;
    fwrite(head, sizeof head, 1, file);
    fwrite(data, (size_t)bytes, 1, file);
    fclose(file);
}

static void sub_image(unsigned target, int level, int x, int y, int z, int w, int h, int d, unsigned format, unsigned type,
                      const void *data) {
    if (target == kTexture3D && format == kRgba && type == kUnsignedByte)
        record(level, w, h, d, w * h * d * 4, format, data);
    real_sub_image(target, level, x, y, z, w, h, d, format, type, data);
}

static void compressed(unsigned target, int level, int x, int y, int z, int w, int h, int d, unsigned format, int bytes,
                       const void *data) {
    if (target == kTexture3D)
        record(level, w, h, d, bytes, format, data);
    real_compressed(target, level, x, y, z, w, h, d, format, bytes, data);
}

static void compressed_image(unsigned target, int level, unsigned format, int w, int h, int d, int border, int bytes,
                             const void *data) {
    if (target == kTexture3D)
        record(level, w, h, d, bytes, format, data);
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
