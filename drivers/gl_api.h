#pragma once

// The GLES 3.0 entry points: a loader generated at build time (drivers/SConscript), or the browser's own.
// Only drivers/gles3 and the loader itself include this.
#ifdef __EMSCRIPTEN__
#include <GLES3/gl3.h>
#else
#include <glad/gles2.h>
#endif
