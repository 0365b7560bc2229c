// SPDX-License-Identifier: BSD-3-Clause
// The one place where stb_image's implementation is compiled. Only image.cpp calls it.
#include <cstdlib>

// Zeroed memory, so that a file that ends early never shows what was in memory before.
#define STBI_MALLOC(size) std::calloc(1, size)
#define STBI_REALLOC(pointer, size) std::realloc(pointer, size)
#define STBI_FREE(pointer) std::free(pointer)
#define STBI_MAX_DIMENSIONS (1 << 20)
#define STBI_NO_STDIO
// libjpeg reads these: stb_image of 2022 writes past its tables for hostile ones.
#define STBI_NO_JPEG
#define STBI_NO_GIF
#define STBI_NO_PIC
#define STBI_NO_PNM
#define STB_IMAGE_IMPLEMENTATION

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <stb_image.h>
#pragma GCC diagnostic pop
