// SPDX-License-Identifier: BSD-3-Clause
#include "zip_bytes.h"

#include <zlib.h>

namespace terrane::test {

namespace {

void put(std::string& out, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i)
        out += static_cast<char>(value >> 8 * i);
}

constexpr std::uint32_t kIn64 = ~0U;

struct Placed {
    const ZipPiece* piece;
    std::uint64_t header, size, packedSize;
    std::uint32_t checksum;
    std::uint16_t method;
};

Placed putEntry(std::string& out, const ZipPiece& piece) {
    const std::string packed = !piece.packed.empty() ? piece.packed
                               : piece.deflated      ? deflated(piece.bytes)
                                                     : piece.bytes;
    const Placed placed{
        .piece = &piece,
        .header = piece.header.value_or(out.size()),
        .size = piece.size.value_or(piece.bytes.size()),
        .packedSize = piece.packedSize.value_or(packed.size()),
        .checksum = piece.checksum.value_or(checksumOf(piece.bytes)),
        .method = piece.method.value_or(piece.deflated ? std::uint16_t(8) : std::uint16_t(0))};
    const std::string name = piece.localName.value_or(piece.name);
    put(out, 0x04034b50, 4);
    put(out, 20, 2);
    put(out, piece.flags, 2);
    put(out, placed.method, 2);
    put(out, 0, 2);
    put(out, 0x21, 2);
    put(out, placed.checksum, 4);
    put(out, piece.in64 ? kIn64 : placed.packedSize, 4);
    put(out, piece.in64 ? kIn64 : placed.size, 4);
    put(out, name.size(), 2);
    put(out, piece.in64 ? 20 : 0, 2);
    out += name;
    if (piece.in64) {
        put(out, 1, 2);
        put(out, 16, 2);
        put(out, placed.size, 8);
        put(out, placed.packedSize, 8);
    }
    out += packed;
    return placed;
}

void putRecord(std::string& out, const Placed& placed) {
    const ZipPiece& piece = *placed.piece;
    put(out, 0x02014b50, 4);
    put(out, 20 | 3 << 8, 2); // made by Unix
    put(out, 20, 2);
    put(out, piece.flags, 2);
    put(out, placed.method, 2);
    put(out, 0, 2);
    put(out, 0x21, 2);
    put(out, placed.checksum, 4);
    put(out, piece.in64 ? kIn64 : placed.packedSize, 4);
    put(out, piece.in64 ? kIn64 : placed.size, 4);
    put(out, piece.name.size(), 2);
    put(out, piece.in64 ? 28 : 0, 2);
    put(out, 0, 2);
    put(out, piece.disk, 2);
    put(out, 0, 2);
    put(out, std::uint64_t(piece.unixMode) << 16, 4);
    put(out, piece.in64 ? kIn64 : placed.header, 4);
    out += piece.name;
    if (piece.in64) {
        put(out, 1, 2);
        put(out, 24, 2);
        put(out, placed.size, 8);
        put(out, placed.packedSize, 8);
        put(out, placed.header, 8);
    }
}

void putEnd64(std::string& out, std::uint64_t entries, std::uint64_t size, std::uint64_t begin,
              const ZipEnds& ends) {
    const std::uint64_t at = out.size();
    put(out, 0x06064b50, 4);
    put(out, 44 + ends.size64Shift, 8);
    put(out, 45, 2);
    put(out, 45, 2);
    put(out, 0, 4);
    put(out, 0, 4);
    put(out, entries, 8);
    put(out, entries, 8);
    put(out, size, 8);
    put(out, begin, 8);
    put(out, 0x07064b50, 4);
    put(out, 0, 4);
    put(out, at, 8);
    put(out, 1, 4);
}

} // namespace

std::string deflated(const std::string& bytes) {
    z_stream stream{};
    deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
    std::string out(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

std::uint32_t checksumOf(const std::string& bytes) {
    return static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

std::string zipBytes(const std::vector<ZipPiece>& pieces, const ZipEnds& ends) {
    std::string out = ends.before;
    std::vector<Placed> placed;
    for (const ZipPiece& piece : pieces)
        placed.push_back(putEntry(out, piece));
    const std::uint64_t at = out.size();
    for (const Placed& entry : placed)
        putRecord(out, entry);
    const std::uint64_t size = out.size() - at;
    const std::uint64_t begin = at + static_cast<std::uint64_t>(ends.beginShift);
    const std::uint64_t entries = ends.entries.value_or(pieces.size());
    if (ends.in64) putEnd64(out, entries, size, begin, ends);
    put(out, 0x06054b50, 4);
    put(out, 0, 4);
    put(out, ends.in64 ? 0xffff : entries, 2);
    put(out, ends.in64 ? 0xffff : entries, 2);
    put(out, ends.in64 ? kIn64 : size, 4);
    put(out, ends.in64 ? kIn64 : begin, 4);
    put(out, ends.comment.size(), 2);
    return out + ends.comment;
}

} // namespace terrane::test
