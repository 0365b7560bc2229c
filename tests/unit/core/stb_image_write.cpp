// SPDX-License-Identifier: BSD-3-Clause
// Another library's encoders, for tests of our decoders.
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#include <stb_image_write.h>
#pragma GCC diagnostic pop
