// SPDX-License-Identifier: BSD-3-Clause
#include "render/mesh_file.h"

#include "core/text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace terrane {

namespace {

template <class T>
struct Word {
    std::string_view text;
    T value;
};

constexpr auto kTopologies = std::to_array<Word<PrimitiveMode>>({
    {"points", PrimitiveMode::points},
    {"lines", PrimitiveMode::lines},
    {"linesadjacency", PrimitiveMode::linesAdjacency},
    {"linestrip", PrimitiveMode::lineStrip},
    {"linestripadjacency", PrimitiveMode::lineStripAdjacency},
    {"triangles", PrimitiveMode::triangles},
    {"trianglesadjacency", PrimitiveMode::trianglesAdjacency},
    {"trianglestrip", PrimitiveMode::triangleStrip},
    {"trianglestripadjacency", PrimitiveMode::triangleStripAdjacency},
    {"trianglefan", PrimitiveMode::triangleFan},
});

constexpr auto kTypes = std::to_array<Word<VertexType>>({
    {"byte", VertexType::i8},
    {"ubyte", VertexType::u8},
    {"short", VertexType::i16},
    {"ushort", VertexType::u16},
    {"int", VertexType::i32},
    {"uint", VertexType::u32},
    {"float", VertexType::f32},
    {"double", VertexType::f64},
});

constexpr auto kBooleans = std::to_array<Word<bool>>({{"true", true}, {"false", false}});

constexpr int kMaxAttributes = 16; // guaranteed by OpenGL 4.5
constexpr std::int64_t kMostBareVertices = 1 << 20;

bool isSpace(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

class MeshParser {
public:
    MeshParser(std::shared_ptr<const SourceFile> file, Diagnostics& diagnostics)
        : file_(std::move(file))
        , text_(file_->text())
        , diagnostics_(diagnostics) {}

    std::optional<MeshData> parse() {
        MeshData mesh;
        if (!bounds(mesh)) return std::nullopt;
        if (!word("topology", kTopologies, mesh.mode)) return std::nullopt;
        if (!attributes(mesh) || !vertices(mesh) || !indices(mesh)) return std::nullopt;
        return mesh;
    }

private:
    /// The next word; false, with a diagnostic, at the end of the text.
    bool next(std::string_view what) {
        while (position_ < text_.size() && isSpace(text_[position_]))
            ++position_;
        start_ = position_;
        while (position_ < text_.size() && !isSpace(text_[position_]))
            ++position_;
        token_ = text_.substr(start_, position_ - start_);
        if (!token_.empty()) return true;
        return fail("the mesh ends too early", std::string(what));
    }

    bool fail(std::string message, std::string expected, std::string suggestion = {}) {
        diagnostics_.report({.code = "mesh-syntax",
                             .place = {file_, start_},
                             .message = std::move(message),
                             .expected = std::move(expected),
                             .suggestion = std::move(suggestion)});
        return false;
    }

    bool real(std::string_view what, double& value) {
        if (!next(what)) return false;
        const auto number = parseReal(token_);
        if (!number || number->length != token_.size() || !std::isfinite(number->value)) {
            return fail("bad number " + inQuotes(token_), std::string(what));
        }
        value = number->value;
        return true;
    }

    bool integer(std::string_view what, std::int64_t smallest, std::int64_t largest,
                 std::int64_t& value) {
        if (!next(what)) return false;
        std::string_view digits = token_;
        if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc{} || end != digits.data() + digits.size()) {
            return fail("bad number " + inQuotes(token_), std::string(what));
        }
        if (value < smallest || value > largest) {
            return fail("number " + inQuotes(token_) + " is out of range",
                        std::string(what) + ", " + std::to_string(smallest) + " to " +
                            std::to_string(largest));
        }
        return true;
    }

    template <class T, std::size_t N>
    bool word(std::string_view what, const std::array<Word<T>, N>& words, T& value) {
        if (!next(what)) return false;
        std::vector<std::string> names;
        for (const auto& candidate : words) {
            if (candidate.text == token_) {
                value = candidate.value;
                return true;
            }
            names.emplace_back(candidate.text);
        }
        return fail("unknown " + std::string(what) + " " + inQuotes(token_), listOfNames(names),
                    nearestName(token_, names));
    }

    bool bounds(MeshData& mesh) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!real("the bounds, six numbers", mesh.boundsMin[axis]) ||
                !real("the bounds, six numbers", mesh.boundsMax[axis])) {
                return false;
            }
        }
        return true;
    }

    bool attributes(MeshData& mesh) {
        std::int64_t count = 0;
        if (!integer("the number of attributes", 0, kMaxAttributes, count)) return false;
        for (std::int64_t i = 0; i < count; ++i) {
            VertexAttribute attribute;
            std::int64_t location = 0, components = 0;
            if (!integer("the location of an attribute", 0, kMaxAttributes - 1, location)) {
                return false;
            }
            for (const auto& other : mesh.attributes) {
                if (other.location == location) {
                    return fail("two attributes at location " + std::to_string(location),
                                "a location of its own");
                }
            }
            if (!integer("the number of components", 1, 4, components) ||
                !word("type", kTypes, attribute.type) ||
                !word("normalization", kBooleans, attribute.normalized)) {
                return false;
            }
            attribute.location = int(location);
            attribute.components = int(components);
            mesh.attributes.push_back(attribute);
        }
        return true;
    }

    /// Whether the rest of the text has room for so many numbers: a digit and a blank each.
    bool roomFor(std::uint64_t numbers, std::string_view what) {
        if (numbers <= (text_.size() - position_ + 1) / 2) return true;
        return fail("the mesh is too short for " + std::string(token_) + " " + std::string(what),
                    "at least " + std::to_string(numbers) + " numbers");
    }

    bool vertices(MeshData& mesh) {
        std::int64_t count = 0;
        const std::int64_t largest = std::numeric_limits<std::int32_t>::max();
        if (!integer("the number of vertices", 0, largest, count)) return false;
        std::uint64_t components = 0;
        for (const auto& attribute : mesh.attributes)
            components += unsigned(attribute.components);
        // Nothing in the file bounds what has no attributes.
        if (components == 0 && count > kMostBareVertices) {
            return fail("number " + inQuotes(token_) + " is out of range",
                        "at most " + std::to_string(kMostBareVertices) +
                            " vertices without attributes");
        }
        if (!roomFor(std::uint64_t(count) * components, "vertices")) return false;
        mesh.vertexCount = std::size_t(count);
        mesh.vertices.resize(mesh.vertexCount * mesh.stride());
        std::byte* out = mesh.vertices.data();
        for (std::int64_t i = 0; components > 0 && i < count; ++i) {
            for (const auto& attribute : mesh.attributes) {
                for (int c = 0; c < attribute.components; ++c) {
                    if (!component(attribute.type, out)) return false;
                    out += byteSize(attribute.type);
                }
            }
        }
        return true;
    }

    bool component(VertexType type, std::byte* out) {
        constexpr std::string_view what = "a component of a vertex";
        if (type == VertexType::f32 || type == VertexType::f64) {
            double value = 0;
            if (!real(what, value)) return false;
            if (type == VertexType::f64) {
                std::memcpy(out, &value, sizeof value);
                return true;
            }
            const auto single = float(value);
            if (!std::isfinite(single)) {
                return fail("number " + inQuotes(token_) + " is out of range", std::string(what));
            }
            std::memcpy(out, &single, sizeof single);
            return true;
        }
        // Small types wrap, as in the original: its files write 255 for a byte of -1.
        std::int64_t value = 0;
        if (!integer(what, std::numeric_limits<std::int32_t>::min(),
                     std::numeric_limits<std::uint32_t>::max(), value)) {
            return false;
        }
        const auto bits = std::uint32_t(value);
        const auto half = std::uint16_t(bits);
        const auto quarter = std::uint8_t(bits);
        switch (byteSize(type)) {
        case 1:
            std::memcpy(out, &quarter, 1);
            break;
        case 2:
            std::memcpy(out, &half, 2);
            break;
        default:
            std::memcpy(out, &bits, 4);
            break;
        }
        return true;
    }

    bool indices(MeshData& mesh) {
        std::int64_t count = 0;
        const std::int64_t largest = std::numeric_limits<std::int32_t>::max();
        if (!integer("the number of indices", 0, largest, count)) return false;
        if (!roomFor(std::uint64_t(count), "indices")) return false;
        mesh.indices.reserve(std::size_t(count));
        for (std::int64_t i = 0; i < count; ++i) {
            std::int64_t index = 0;
            if (!integer("the index of a vertex", 0, std::int64_t(mesh.vertexCount) - 1, index)) {
                return false;
            }
            mesh.indices.push_back(std::uint32_t(index));
        }
        return true;
    }

    std::shared_ptr<const SourceFile> file_;
    std::string_view text_;
    Diagnostics& diagnostics_;
    std::size_t position_ = 0;
    std::size_t start_ = 0; ///< of token_
    std::string_view token_;
};

} // namespace

std::optional<MeshData> parseMesh(std::shared_ptr<const SourceFile> file,
                                  Diagnostics& diagnostics) {
    return MeshParser(std::move(file), diagnostics).parse();
}

} // namespace terrane
