// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/value_traits.h"

#include <cstddef>
#include <span>
#include <string_view>

namespace terrane {

// All formats, types and their words in archives (Ork reference 2.2) stand here and nowhere else.
// The values of the enumerations are OpenGL's own.

/// How a texture stores its pixels, such as GL_RGBA8; see internalFormats for the ones there are.
enum class InternalFormat : unsigned {
    r8 = 0x8229,
    rg8 = 0x822B,
    rgb8 = 0x8051,
    rgba8 = 0x8058,
    srgb8 = 0x8C41,
    srgb8Alpha8 = 0x8C43,
    r16f = 0x822D,
    rg16f = 0x822F,
    rgb16f = 0x881B,
    rgba16f = 0x881A,
    r32f = 0x822E,
    rg32f = 0x8230,
    rgb32f = 0x8815,
    rgba32f = 0x8814,
    r8ui = 0x8232,
    r32i = 0x8235,
    r32ui = 0x8236,
    depth16 = 0x81A5,
    depth24 = 0x81A6,
    depth32f = 0x8CAC,
    depth24Stencil8 = 0x88F0,
    depth32fStencil8 = 0x8CAD,
    stencil8 = 0x8D48
};

/// The channels of pixels in memory, in uploads and downloads.
enum class TransferFormat : unsigned {
    stencil = 0x1901,
    depth = 0x1902,
    depthStencil = 0x84F9,
    red = 0x1903,
    green = 0x1904,
    blue = 0x1905,
    rg = 0x8227,
    rgb = 0x1907,
    rgba = 0x1908,
    bgr = 0x80E0,
    bgra = 0x80E1,
    redInteger = 0x8D94,
    greenInteger = 0x8D95,
    blueInteger = 0x8D96,
    rgInteger = 0x8228,
    rgbInteger = 0x8D98,
    rgbaInteger = 0x8D99,
    bgrInteger = 0x8D9A,
    bgraInteger = 0x8D9B
};

/// The type of a channel in memory, or, from u8x332 on, of a whole pixel. A packed type goes with
/// formats of as many channels as it has numbers.
enum class TransferType : unsigned {
    i8 = 0x1400,
    u8,
    i16,
    u16,
    i32,
    u32,
    f32,
    f16 = 0x140B,
    u8x332 = 0x8032,
    u8x233Reversed = 0x8362,
    u16x565 = 0x8363,
    u16x565Reversed = 0x8364,
    u16x4444 = 0x8033,
    u16x4444Reversed = 0x8365,
    u16x5551 = 0x8034,
    u16x1555Reversed = 0x8366,
    u32x8888 = 0x8035,
    u32x8888Reversed = 0x8367,
    u32x1010102 = 0x8036,
    u32x2101010Reversed = 0x8368,
    u32x10f11f11f = 0x8C3B,
    u32x5999 = 0x8C3E,
    u24u8 = 0x84FA,   ///< depth and stencil of depth24Stencil8
    f32u24u8 = 0x8DAD ///< depth and stencil of depth32fStencil8, 8 bytes
};

/// What channels are stored as, and so what a shader reads them as.
enum class ChannelKind {
    normalized,
    signedNormalized,
    real,
    signedInteger,
    unsignedInteger,
    depth,
    stencil,
    depthStencil
};

struct TransferLayout {
    TransferFormat format = TransferFormat::rgba;
    TransferType type = TransferType::u8;
    std::size_t pixelSize() const; ///< in bytes, tightly packed
    bool operator==(const TransferLayout&) const = default;
};

/// What is known about an internal format.
struct InternalFormatInfo {
    std::string_view name; ///< its word in archives
    InternalFormat value;
    /// What the texture is made with: OpenGL has no immutable storage of the generic compressed
    /// formats, so each stands for a specific one.
    unsigned storage;
    int channels;
    ChannelKind kind;
    /// Bytes of a pixel, or of a block of 4 x 4 pixels when compressed; without what drivers pad.
    int bytes;
    bool compressed;
    TransferLayout transfer; ///< loses nothing in uploads and downloads (but what compression does)

    bool integer() const {
        return kind == ChannelKind::signedInteger || kind == ChannelKind::unsignedInteger;
    }
    bool hasDepth() const {
        return kind == ChannelKind::depth || kind == ChannelKind::depthStencil;
    }
    bool hasStencil() const {
        return kind == ChannelKind::stencil || kind == ChannelKind::depthStencil;
    }
};

std::span<const InternalFormatInfo> internalFormats();
/// `format` must be one of internalFormats().
const InternalFormatInfo& formatInfo(InternalFormat format);
/// By its word; null when there is none. Also knows OpenGL's own spellings where the words differ.
const InternalFormatInfo* findInternalFormat(std::string_view word);

int channelCount(TransferFormat format);
bool isInteger(TransferFormat format);

const Words<InternalFormat>& internalFormatWords();
const Words<TransferFormat>& transferFormatWords();
const Words<TransferType>& transferTypeWords();

/// The layout for data with so many channels (1 to 4), as an internal format can take it: integer
/// and depth formats need other words than the plain RED, RG, RGB, RGBA.
TransferLayout transferLayout(const InternalFormatInfo& internal, int channels, TransferType type);

} // namespace terrane
