// The bodies of the generated GLES loader; Khronos' generator does not write for our warning flags.
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif

#define GLAD_GLES2_IMPLEMENTATION
#include "drivers/gl_api.h"
