// SPDX-License-Identifier: BSD-3-Clause
#include "render/texture_format.h"

#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <cassert>

namespace terrane {

namespace {

using K = ChannelKind;
using F = TransferFormat;
using T = TransferType;

constexpr InternalFormatInfo plain(std::string_view name, unsigned value, int channels, K kind,
                                   int bytes, F format, T type) {
    return {name, InternalFormat(value), value, channels, kind, bytes, false, {format, type}};
}

constexpr InternalFormatInfo compressed(std::string_view name, unsigned value, int channels, K kind,
                                        int bytes, F format, T type, unsigned storage = 0) {
    return {name, InternalFormat(value), storage ? storage : value, channels, kind, bytes,
            true, {format, type}};
}

// clang-format off
constexpr auto kInternalFormats = std::to_array<InternalFormatInfo>({
    plain("R8", GL_R8, 1, K::normalized, 1, F::red, T::u8),
    plain("R8SNORM", GL_R8_SNORM, 1, K::signedNormalized, 1, F::red, T::i8),
    plain("R16", GL_R16, 1, K::normalized, 2, F::red, T::u16),
    plain("R16_SNORM", GL_R16_SNORM, 1, K::signedNormalized, 2, F::red, T::i16),
    plain("RG8", GL_RG8, 2, K::normalized, 2, F::rg, T::u8),
    plain("RG8_SNORM", GL_RG8_SNORM, 2, K::signedNormalized, 2, F::rg, T::i8),
    plain("RG16", GL_RG16, 2, K::normalized, 4, F::rg, T::u16),
    plain("RG16_SNORM", GL_RG16_SNORM, 2, K::signedNormalized, 4, F::rg, T::i16),
    plain("R3_G3_B2", GL_R3_G3_B2, 3, K::normalized, 1, F::rgb, T::u8),
    plain("RGB4", GL_RGB4, 3, K::normalized, 2, F::rgb, T::u8),
    plain("RGB5", GL_RGB5, 3, K::normalized, 2, F::rgb, T::u8),
    plain("RGB8", GL_RGB8, 3, K::normalized, 3, F::rgb, T::u8),
    plain("RGB8_SNORM", GL_RGB8_SNORM, 3, K::signedNormalized, 3, F::rgb, T::i8),
    plain("RGB10", GL_RGB10, 3, K::normalized, 4, F::rgb, T::u16),
    plain("RGB12", GL_RGB12, 3, K::normalized, 5, F::rgb, T::u16),
    plain("RGB16", GL_RGB16, 3, K::normalized, 6, F::rgb, T::u16),
    plain("RGB16_SNORM", GL_RGB16_SNORM, 3, K::signedNormalized, 6, F::rgb, T::i16),
    plain("RGBA2", GL_RGBA2, 4, K::normalized, 1, F::rgba, T::u8),
    plain("RGBA4", GL_RGBA4, 4, K::normalized, 2, F::rgba, T::u8),
    plain("RGB5_A1", GL_RGB5_A1, 4, K::normalized, 2, F::rgba, T::u8),
    plain("RGBA8", GL_RGBA8, 4, K::normalized, 4, F::rgba, T::u8),
    plain("RGBA8_SNORM", GL_RGBA8_SNORM, 4, K::signedNormalized, 4, F::rgba, T::i8),
    plain("RGB10_A2", GL_RGB10_A2, 4, K::normalized, 4, F::rgba, T::u16),
    plain("RGB10_A2UI", GL_RGB10_A2UI, 4, K::unsignedInteger, 4, F::rgbaInteger, T::u16),
    plain("RGBA12", GL_RGBA12, 4, K::normalized, 6, F::rgba, T::u16),
    plain("RGBA16", GL_RGBA16, 4, K::normalized, 8, F::rgba, T::u16),
    plain("RGBA16_SNORM", GL_RGBA16_SNORM, 4, K::signedNormalized, 8, F::rgba, T::i16),
    plain("SRGB8", GL_SRGB8, 3, K::normalized, 3, F::rgb, T::u8),
    plain("SRGB8_ALPHA8", GL_SRGB8_ALPHA8, 4, K::normalized, 4, F::rgba, T::u8),
    plain("R16F", GL_R16F, 1, K::real, 2, F::red, T::f16),
    plain("RG16F", GL_RG16F, 2, K::real, 4, F::rg, T::f16),
    plain("RGB16F", GL_RGB16F, 3, K::real, 6, F::rgb, T::f16),
    plain("RGBA16F", GL_RGBA16F, 4, K::real, 8, F::rgba, T::f16),
    plain("R32F", GL_R32F, 1, K::real, 4, F::red, T::f32),
    plain("RG32F", GL_RG32F, 2, K::real, 8, F::rg, T::f32),
    plain("RGB32F", GL_RGB32F, 3, K::real, 12, F::rgb, T::f32),
    plain("RGBA32F", GL_RGBA32F, 4, K::real, 16, F::rgba, T::f32),
    plain("R11F_G11F_B10F", GL_R11F_G11F_B10F, 3, K::real, 4, F::rgb, T::f32),
    plain("RGB9_E5", GL_RGB9_E5, 3, K::real, 4, F::rgb, T::f32),
    plain("R8I", GL_R8I, 1, K::signedInteger, 1, F::redInteger, T::i8),
    plain("R8UI", GL_R8UI, 1, K::unsignedInteger, 1, F::redInteger, T::u8),
    plain("R16I", GL_R16I, 1, K::signedInteger, 2, F::redInteger, T::i16),
    plain("R16UI", GL_R16UI, 1, K::unsignedInteger, 2, F::redInteger, T::u16),
    plain("R32I", GL_R32I, 1, K::signedInteger, 4, F::redInteger, T::i32),
    plain("R32UI", GL_R32UI, 1, K::unsignedInteger, 4, F::redInteger, T::u32),
    plain("RG8I", GL_RG8I, 2, K::signedInteger, 2, F::rgInteger, T::i8),
    plain("RG8UI", GL_RG8UI, 2, K::unsignedInteger, 2, F::rgInteger, T::u8),
    plain("RG16I", GL_RG16I, 2, K::signedInteger, 4, F::rgInteger, T::i16),
    plain("RG16UI", GL_RG16UI, 2, K::unsignedInteger, 4, F::rgInteger, T::u16),
    plain("RG32I", GL_RG32I, 2, K::signedInteger, 8, F::rgInteger, T::i32),
    plain("RG32UI", GL_RG32UI, 2, K::unsignedInteger, 8, F::rgInteger, T::u32),
    plain("RGB8I", GL_RGB8I, 3, K::signedInteger, 3, F::rgbInteger, T::i8),
    plain("RGB8UI", GL_RGB8UI, 3, K::unsignedInteger, 3, F::rgbInteger, T::u8),
    plain("RGB16I", GL_RGB16I, 3, K::signedInteger, 6, F::rgbInteger, T::i16),
    plain("RGB16UI", GL_RGB16UI, 3, K::unsignedInteger, 6, F::rgbInteger, T::u16),
    plain("RGB32I", GL_RGB32I, 3, K::signedInteger, 12, F::rgbInteger, T::i32),
    plain("RGB32UI", GL_RGB32UI, 3, K::unsignedInteger, 12, F::rgbInteger, T::u32),
    plain("RGBA8I", GL_RGBA8I, 4, K::signedInteger, 4, F::rgbaInteger, T::i8),
    plain("RGBA8UI", GL_RGBA8UI, 4, K::unsignedInteger, 4, F::rgbaInteger, T::u8),
    plain("RGBA16I", GL_RGBA16I, 4, K::signedInteger, 8, F::rgbaInteger, T::i16),
    plain("RGBA16UI", GL_RGBA16UI, 4, K::unsignedInteger, 8, F::rgbaInteger, T::u16),
    plain("RGBA32I", GL_RGBA32I, 4, K::signedInteger, 16, F::rgbaInteger, T::i32),
    plain("RGBA32UI", GL_RGBA32UI, 4, K::unsignedInteger, 16, F::rgbaInteger, T::u32),
    plain("DEPTH_COMPONENT16", GL_DEPTH_COMPONENT16, 1, K::depth, 2, F::depth, T::u16),
    plain("DEPTH_COMPONENT24", GL_DEPTH_COMPONENT24, 1, K::depth, 4, F::depth, T::u32),
    plain("DEPTH_COMPONENT32F", GL_DEPTH_COMPONENT32F, 1, K::depth, 4, F::depth, T::f32),
    plain("DEPTH32F_STENCIL8", GL_DEPTH32F_STENCIL8, 2, K::depthStencil, 8, F::depthStencil, T::f32u24u8),
    plain("DEPTH24_STENCIL8", GL_DEPTH24_STENCIL8, 2, K::depthStencil, 4, F::depthStencil, T::u24u8),
    plain("STENCIL_INDEX8", GL_STENCIL_INDEX8, 1, K::stencil, 1, F::stencil, T::u8),
    compressed("COMPRESSED_RED", GL_COMPRESSED_RED, 1, K::normalized, 8, F::red, T::u8, GL_COMPRESSED_RED_RGTC1),
    compressed("COMPRESSED_RG", GL_COMPRESSED_RG, 2, K::normalized, 16, F::rg, T::u8, GL_COMPRESSED_RG_RGTC2),
    compressed("COMPRESSED_RGB", GL_COMPRESSED_RGB, 3, K::normalized, 8, F::rgb, T::u8, GL_COMPRESSED_RGB_S3TC_DXT1_EXT),
    compressed("COMPRESSED_RGBA", GL_COMPRESSED_RGBA, 4, K::normalized, 16, F::rgba, T::u8, GL_COMPRESSED_RGBA_S3TC_DXT5_EXT),
    compressed("COMPRESSED_SRGB", GL_COMPRESSED_SRGB, 3, K::normalized, 16, F::rgb, T::u8, GL_COMPRESSED_SRGB_ALPHA_BPTC_UNORM),
    compressed("COMPRESSED_RED_RGTC1", GL_COMPRESSED_RED_RGTC1, 1, K::normalized, 8, F::red, T::u8),
    compressed("COMPRESSED_SIGNED_RED_RGTC1", GL_COMPRESSED_SIGNED_RED_RGTC1, 1, K::signedNormalized, 8, F::red, T::i8),
    compressed("COMPRESSED_RG_RGTC2", GL_COMPRESSED_RG_RGTC2, 2, K::normalized, 16, F::rg, T::u8),
    compressed("COMPRESSED_SIGNED_RG_RGTC2", GL_COMPRESSED_SIGNED_RG_RGTC2, 2, K::signedNormalized, 16, F::rg, T::i8),
    compressed("COMPRESSED_RGBA_BPTC_UNORM_ARB", GL_COMPRESSED_RGBA_BPTC_UNORM, 4, K::normalized, 16, F::rgba, T::u8),
    compressed("COMPRESSED_SRGB_ALPHA_BPTC_UNORM_ARB", GL_COMPRESSED_SRGB_ALPHA_BPTC_UNORM, 4, K::normalized, 16, F::rgba, T::u8),
    compressed("COMPRESSED_RGB_BPTC_SIGNED_FLOAT_ARB", GL_COMPRESSED_RGB_BPTC_SIGNED_FLOAT, 3, K::real, 16, F::rgb, T::f32),
    compressed("COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_ARB", GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT, 3, K::real, 16, F::rgb, T::f32),
    compressed("COMPRESSED_RGB_S3TC_DXT1_EXT", GL_COMPRESSED_RGB_S3TC_DXT1_EXT, 3, K::normalized, 8, F::rgb, T::u8),
    compressed("COMPRESSED_RGBA_S3TC_DXT1_EXT", GL_COMPRESSED_RGBA_S3TC_DXT1_EXT, 4, K::normalized, 8, F::rgba, T::u8),
    compressed("COMPRESSED_RGBA_S3TC_DXT3_EXT", GL_COMPRESSED_RGBA_S3TC_DXT3_EXT, 4, K::normalized, 16, F::rgba, T::u8),
    compressed("COMPRESSED_RGBA_S3TC_DXT5_EXT", GL_COMPRESSED_RGBA_S3TC_DXT5_EXT, 4, K::normalized, 16, F::rgba, T::u8),
});

// Words beside those of the table.
struct Alias {
    std::string_view name;
    std::string_view of;
};
constexpr auto kAliases = std::to_array<Alias>({
    {"R8_SNORM", "R8SNORM"},
    {"COMPRESSED_RGBA_BPTC_UNORM", "COMPRESSED_RGBA_BPTC_UNORM_ARB"},
    {"COMPRESSED_SRGB_ALPHA_BPTC_UNORM", "COMPRESSED_SRGB_ALPHA_BPTC_UNORM_ARB"},
    {"COMPRESSED_RGB_BPTC_SIGNED_FLOAT", "COMPRESSED_RGB_BPTC_SIGNED_FLOAT_ARB"},
    {"COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT", "COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_ARB"},
});

struct TransferFormatInfo {
    std::string_view name;
    F value;
    int channels;
};
constexpr auto kTransferFormats = std::to_array<TransferFormatInfo>({
    {"STENCIL_INDEX", F::stencil, 1}, {"DEPTH_COMPONENT", F::depth, 1},
    {"DEPTH_STENCIL", F::depthStencil, 1},
    {"RED", F::red, 1}, {"GREEN", F::green, 1}, {"BLUE", F::blue, 1}, {"RG", F::rg, 2},
    {"RGB", F::rgb, 3}, {"RGBA", F::rgba, 4}, {"BGR", F::bgr, 3}, {"BGRA", F::bgra, 4},
    {"RED_INTEGER", F::redInteger, 1}, {"GREEN_INTEGER", F::greenInteger, 1},
    {"BLUE_INTEGER", F::blueInteger, 1}, {"RG_INTEGER", F::rgInteger, 2},
    {"RGB_INTEGER", F::rgbInteger, 3}, {"RGBA_INTEGER", F::rgbaInteger, 4},
    {"BGR_INTEGER", F::bgrInteger, 3}, {"BGRA_INTEGER", F::bgraInteger, 4},
});
// clang-format on

static_assert(unsigned(F::bgraInteger) == GL_BGRA_INTEGER);
static_assert(unsigned(F::rgInteger) == GL_RG_INTEGER && unsigned(F::rg) == GL_RG);
static_assert(unsigned(T::f32) == GL_FLOAT && unsigned(T::f16) == GL_HALF_FLOAT);
static_assert(unsigned(T::u8x332) == GL_UNSIGNED_BYTE_3_3_2);
static_assert(unsigned(T::u8x233Reversed) == GL_UNSIGNED_BYTE_2_3_3_REV);
static_assert(unsigned(T::u16x565) == GL_UNSIGNED_SHORT_5_6_5);
static_assert(unsigned(T::u16x565Reversed) == GL_UNSIGNED_SHORT_5_6_5_REV);
static_assert(unsigned(T::u16x4444) == GL_UNSIGNED_SHORT_4_4_4_4);
static_assert(unsigned(T::u16x4444Reversed) == GL_UNSIGNED_SHORT_4_4_4_4_REV);
static_assert(unsigned(T::u16x5551) == GL_UNSIGNED_SHORT_5_5_5_1);
static_assert(unsigned(T::u16x1555Reversed) == GL_UNSIGNED_SHORT_1_5_5_5_REV);
static_assert(unsigned(T::u32x8888) == GL_UNSIGNED_INT_8_8_8_8);
static_assert(unsigned(T::u32x8888Reversed) == GL_UNSIGNED_INT_8_8_8_8_REV);
static_assert(unsigned(T::u32x1010102) == GL_UNSIGNED_INT_10_10_10_2);
static_assert(unsigned(T::u32x2101010Reversed) == GL_UNSIGNED_INT_2_10_10_10_REV);
static_assert(unsigned(T::u32x10f11f11f) == GL_UNSIGNED_INT_10F_11F_11F_REV);
static_assert(unsigned(T::u32x5999) == GL_UNSIGNED_INT_5_9_9_9_REV);
static_assert(unsigned(T::f32u24u8) == GL_FLOAT_32_UNSIGNED_INT_24_8_REV);
static_assert(unsigned(InternalFormat::depth32fStencil8) == GL_DEPTH32F_STENCIL8);

} // namespace

std::span<const InternalFormatInfo> internalFormats() {
    return kInternalFormats;
}

const InternalFormatInfo& formatInfo(InternalFormat format) {
    const auto found = std::find_if(kInternalFormats.begin(), kInternalFormats.end(),
                                    [&](const auto& info) { return info.value == format; });
    assert(found != kInternalFormats.end() && "formatInfo(): not an internal format");
    return *found;
}

const InternalFormatInfo* findInternalFormat(std::string_view word) {
    for (const Alias& alias : kAliases) {
        if (alias.name == word) word = alias.of;
    }
    const auto found = std::find_if(kInternalFormats.begin(), kInternalFormats.end(),
                                    [&](const auto& info) { return info.name == word; });
    return found == kInternalFormats.end() ? nullptr : &*found;
}

int channelCount(TransferFormat format) {
    const auto found = std::find_if(kTransferFormats.begin(), kTransferFormats.end(),
                                    [&](const auto& info) { return info.value == format; });
    assert(found != kTransferFormats.end() && "channelCount(): not a transfer format");
    return found->channels;
}

bool isInteger(TransferFormat format) {
    return format == F::rgInteger || unsigned(format) >= unsigned(F::redInteger);
}

std::size_t TransferLayout::pixelSize() const {
    const auto channels = std::size_t(channelCount(format));
    switch (type) { // packed types hold a whole pixel
    case T::i8:
    case T::u8:
        return channels;
    case T::i16:
    case T::u16:
    case T::f16:
        return 2 * channels;
    case T::i32:
    case T::u32:
    case T::f32:
        return 4 * channels;
    case T::u8x332:
    case T::u8x233Reversed:
        return 1;
    case T::u16x565:
    case T::u16x565Reversed:
    case T::u16x4444:
    case T::u16x4444Reversed:
    case T::u16x5551:
    case T::u16x1555Reversed:
        return 2;
    case T::u32x8888:
    case T::u32x8888Reversed:
    case T::u32x1010102:
    case T::u32x2101010Reversed:
    case T::u32x10f11f11f:
    case T::u32x5999:
    case T::u24u8:
        return 4;
    case T::f32u24u8:
        return 8;
    }
    return 0;
}

const Words<InternalFormat>& internalFormatWords() {
    static const auto words = [] {
        Words<InternalFormat> all;
        for (const auto& info : kInternalFormats)
            all.emplace_back(info.name, info.value);
        for (const Alias& alias : kAliases)
            all.emplace_back(alias.name, findInternalFormat(alias.of)->value);
        return all;
    }();
    return words;
}

const Words<TransferFormat>& transferFormatWords() {
    static const auto words = [] {
        Words<TransferFormat> all;
        for (const auto& info : kTransferFormats)
            all.emplace_back(info.name, info.value);
        return all;
    }();
    return words;
}

const Words<TransferType>& transferTypeWords() {
    static const Words<TransferType> words{{"UNSIGNED_BYTE", T::u8},
                                           {"BYTE", T::i8},
                                           {"UNSIGNED_SHORT", T::u16},
                                           {"SHORT", T::i16},
                                           {"UNSIGNED_INT", T::u32},
                                           {"INT", T::i32},
                                           {"HALF", T::f16},
                                           {"FLOAT", T::f32},
                                           {"UNSIGNED_BYTE_3_3_2", T::u8x332},
                                           {"UNSIGNED_BYTE_2_3_3_REV", T::u8x233Reversed},
                                           {"UNSIGNED_SHORT_5_6_5", T::u16x565},
                                           {"UNSIGNED_SHORT_5_6_5_REV", T::u16x565Reversed},
                                           {"UNSIGNED_SHORT_4_4_4_4", T::u16x4444},
                                           {"UNSIGNED_SHORT_4_4_4_4_REV", T::u16x4444Reversed},
                                           {"UNSIGNED_SHORT_5_5_5_1", T::u16x5551},
                                           {"UNSIGNED_SHORT_1_5_5_5_REV", T::u16x1555Reversed},
                                           {"UNSIGNED_INT_8_8_8_8", T::u32x8888},
                                           {"UNSIGNED_INT_8_8_8_8_REV", T::u32x8888Reversed},
                                           {"UNSIGNED_INT_10_10_10_2", T::u32x1010102},
                                           {"UNSIGNED_INT_2_10_10_10_REV", T::u32x2101010Reversed},
                                           {"UNSIGNED_INT_10F_11F_11F_REV", T::u32x10f11f11f},
                                           {"UNSIGNED_INT_5_9_9_9_REV", T::u32x5999},
                                           {"UNSIGNED_INT_24_8", T::u24u8},
                                           {"FLOAT_32_UNSIGNED_INT_24_8_REV", T::f32u24u8}};
    return words;
}

TransferLayout transferLayout(const InternalFormatInfo& internal, int channels, TransferType type) {
    assert(channels >= 1 && channels <= 4 && "transferLayout(): 1 to 4 channels");
    if (internal.kind == K::depth) return {F::depth, type};
    if (internal.kind == K::stencil) return {F::stencil, type};
    if (internal.kind == K::depthStencil) return internal.transfer;
    constexpr F plainFormats[] = {F::red, F::rg, F::rgb, F::rgba};
    constexpr F integerFormats[] = {F::redInteger, F::rgInteger, F::rgbInteger, F::rgbaInteger};
    return {(internal.integer() ? integerFormats : plainFormats)[channels - 1], type};
}

} // namespace terrane
