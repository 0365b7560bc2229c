// SPDX-License-Identifier: BSD-3-Clause
#include "core/files.h"
#include "render/gl_fixture.h"
#include "render/layer_ranges.h"
#include "render/pixel_readback.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace terrane;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Some layers of (zf, zc, zm), and their texture.
struct Layers {
    Layers(const GlContext& context, int size, int count, unsigned seed)
        : size(size)
        , texels(static_cast<std::size_t>(size) * size * count * 3)
        , texture(context, {.target = TextureTarget::texture2DArray,
                            .format = InternalFormat::rgb32f,
                            .width = size,
                            .height = size,
                            .layers = count}) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> height(-1000, 9000);
        std::generate(texels.begin(), texels.end(), [&] { return height(random); });
        send();
    }
    void send() {
        texture.upload({TransferFormat::rgb, TransferType::f32}, std::as_bytes(std::span(texels)));
    }
    float& at(int layer, int x, int y, int channel) {
        const auto pixel = (static_cast<std::size_t>(layer) * size + y) * size + x;
        return texels[pixel * 3 + static_cast<std::size_t>(channel)];
    }
    /// One texel after the other, on the CPU.
    LayerRanges::Range range(int layer, int border) {
        LayerRanges::Range result{std::numeric_limits<float>::max(),
                                  -std::numeric_limits<float>::max()};
        for (int y = border; y < size - border; ++y)
            for (int x = border; x < size - border; ++x)
                for (int channel : {1, 2}) {
                    const float z = at(layer, x, y, channel);
                    if (std::isnan(z)) continue;
                    result = {std::min(result.zmin, z), std::max(result.zmax, z)};
                }
        return result;
    }

    const int size;
    std::vector<float> texels;
    Texture texture;
};

std::vector<LayerRanges::Range> rangesOf(LayerRanges& ranges,
                                         const std::vector<LayerRanges::Request>& requests) {
    ranges.draw(requests);
    const auto bytes = ranges.framebuffer().readPixels(
        0, 0, ranges.rows(), static_cast<int>(requests.size()), LayerRanges::kLayout);
    std::vector<LayerRanges::Range> rows(bytes.size() / sizeof(LayerRanges::Range));
    std::memcpy(rows.data(), bytes.data(), bytes.size());
    std::vector<LayerRanges::Range> result;
    const auto count = static_cast<std::size_t>(ranges.rows());
    for (std::size_t i = 0; i < requests.size(); ++i)
        result.push_back(LayerRanges::combined(std::span(rows).subspan(i * count, count)));
    return result;
}

} // namespace

TEST_CASE_FIXTURE(GlFixture, "Ranges of layers are those of going through all texels") {
    ProgramBindings bindings(*context);
    for (const int size : {5, 6, 29, 53, 64, 101, 197}) {
        CAPTURE(size);
        constexpr int kBorder = 2, kLayers = 5;
        const auto ranges = LayerRanges::make(bindings, size, kBorder, diagnostics);
        REQUIRE(ranges);
        // Some textures, as storages have when a texture can't hold all layers.
        std::vector<std::unique_ptr<Layers>> pools;
        std::vector<LayerRanges::Request> requests;
        std::vector<LayerRanges::Range> expected;
        for (unsigned i = 0; i < 3; ++i) {
            pools.push_back(std::make_unique<Layers>(*context, size, kLayers, 10 + i));
            for (int layer = 0; layer < kLayers; ++layer) {
                requests.push_back({.texture = &pools.back()->texture, .layer = layer});
                expected.push_back(pools.back()->range(layer, kBorder));
            }
        }
        const auto order = [&](std::size_t i) { return i * 7 % requests.size(); };
        std::vector<LayerRanges::Request> mixed;
        for (std::size_t i = 0; i < requests.size(); ++i)
            mixed.push_back(requests[order(i)]);
        const auto actual = rangesOf(*ranges, mixed);
        for (std::size_t i = 0; i < actual.size(); ++i) {
            CAPTURE(i);
            CHECK(actual[i].zmin == expected[order(i)].zmin);
            CHECK(actual[i].zmax == expected[order(i)].zmax);
        }
    }
}

TEST_CASE_FIXTURE(GlFixture, "What is no number, and the first channel, are in no range") {
    ProgramBindings bindings(*context);
    const auto ranges = LayerRanges::make(bindings, 29, 2, diagnostics);
    REQUIRE(ranges);
    Layers layers(*context, 29, 3, 1);
    layers.at(0, 7, 9, 2) = kNan;
    layers.at(0, 3, 2, 1) = kNan;
    layers.at(0, 4, 4, 0) = 1e6f; // zf is never drawn
    layers.at(0, 1, 4, 2) = 1e6f; // nor is the border
    layers.at(2, 5, 5, 2) = std::numeric_limits<float>::infinity();
    for (int y = 0; y < 29; ++y)
        for (int x = 0; x < 29; ++x)
            layers.at(1, x, y, 1) = layers.at(1, x, y, 2) = kNan;
    layers.send();
    const auto actual = rangesOf(*ranges, {{.texture = &layers.texture, .layer = 0},
                                           {.texture = &layers.texture, .layer = 1},
                                           {.texture = &layers.texture, .layer = 2}});
    CHECK(actual[0].zmin == layers.range(0, 2).zmin);
    CHECK(actual[0].zmax == layers.range(0, 2).zmax);
    CHECK(actual[0].zmax < 1e5f);
    CHECK(actual[1].zmin > actual[1].zmax);
    CHECK_FALSE(std::isfinite(actual[2].zmax)); // whoever asked sees it
}

TEST_CASE_FIXTURE(GlFixture, "Points are read between the centres of texels") {
    ProgramBindings bindings(*context);
    const auto ranges = LayerRanges::make(bindings, 53, 2, diagnostics);
    REQUIRE(ranges);
    Layers layers(*context, 53, 2, 3);
    std::mt19937 random(4);
    std::uniform_real_distribution<float> place(2, 50);
    for (int round = 0; round < 20; ++round) {
        std::vector<LayerRanges::Request> requests;
        for (int i = 0; i < LayerRanges::kMost; ++i)
            requests.push_back({.texture = &layers.texture,
                                .layer = i % 2,
                                .point = glm::vec2(place(random), place(random))});
        requests[0].point = {2, 2};
        requests[1].point = {50, 50};
        requests[2].point = {52, 52}; // beside the last one there is nothing
        const auto actual = rangesOf(*ranges, requests);
        for (std::size_t i = 0; i < requests.size(); ++i) {
            CAPTURE(i);
            const auto [x, y] = std::pair(requests[i].point->x, requests[i].point->y);
            const int column = static_cast<int>(x), row = static_cast<int>(y);
            const double fx = x - column, fy = y - row;
            const auto z = [&](int dx, int dy) -> double {
                return layers.at(static_cast<int>(i) % 2, std::min(column + dx, 52),
                                 std::min(row + dy, 52), 2);
            };
            const double expected = (z(0, 0) * (1 - fx) + z(1, 0) * fx) * (1 - fy) +
                                    (z(0, 1) * (1 - fx) + z(1, 1) * fx) * fy;
            CHECK(actual[i].zmax == doctest::Approx(expected).epsilon(1e-5));
            CHECK(actual[i].zmin == actual[i].zmax);
        }
    }
}

TEST_CASE_FIXTURE(GlFixture, "Pixels arrive three frames later, in the order of the requests") {
    auto texture = std::make_shared<Texture>(
        *context, TextureDescription{.format = InternalFormat::r32f, .width = 4, .height = 2});
    Framebuffer framebuffer(*context);
    framebuffer.attach(AttachmentPoint::colour0, {texture});
    framebuffer.setDrawBuffers({AttachmentPoint::colour0});
    framebuffer.setReadBuffer(AttachmentPoint::colour0);
    framebuffer.state.viewport = {0, 0, 4, 2};
    const TransferLayout layout{TransferFormat::red, TransferType::f32};
    const ReadbackTiming timing;

    PixelReadback readback(*context, 4 * 2 * sizeof(float));
    CHECK(readback.empty());
    for (std::uint64_t frame = 100; frame < 120; ++frame) {
        CAPTURE(frame);
        const auto pixels = readback.take(frame, timing);
        if (frame < 103) {
            CHECK(pixels.empty());
        } else {
            // Sizes come and go.
            const std::size_t width = (frame - 3) % 4 + 1;
            REQUIRE(pixels.size() == width * 2 * sizeof(float));
            std::vector<float> values(width * 2);
            std::memcpy(values.data(), pixels.data(), pixels.size());
            for (float value : values)
                CHECK(value == static_cast<float>(frame - 3));
            CHECK(readback.take(frame, timing).empty());
        }
        CHECK_FALSE(readback.full());
        framebuffer.state.clear.colour.r = static_cast<float>(frame);
        framebuffer.clear(Planes::colour);
        readback.request(frame, framebuffer, static_cast<int>(frame % 4 + 1), 2, layout);
        CHECK(readback.full() == (frame >= 102));
        // What is drawn afterwards does not count.
        framebuffer.state.clear.colour.r = -1;
        framebuffer.clear(Planes::colour);
        CHECK_FALSE(readback.empty());
    }
    // Others that read pixels are not disturbed.
    CHECK(framebuffer.readPixels(0, 0, 1, 1, layout).size() == sizeof(float));
}

TEST_CASE_FIXTURE(GlFixture, "A reader that never waits gets the same a little later") {
    auto texture = std::make_shared<Texture>(
        *context, TextureDescription{.format = InternalFormat::r32f, .width = 1, .height = 1});
    Framebuffer framebuffer(*context);
    framebuffer.attach(AttachmentPoint::colour0, {texture});
    framebuffer.setDrawBuffers({AttachmentPoint::colour0});
    framebuffer.setReadBuffer(AttachmentPoint::colour0);
    framebuffer.state.viewport = {0, 0, 1, 1};
    framebuffer.state.clear.colour.r = 7;
    framebuffer.clear(Planes::colour);
    PixelReadback readback(*context, sizeof(float));
    readback.request(1, framebuffer, 1, 1, {TransferFormat::red, TransferType::f32});
    const ReadbackTiming never{.sameFrameInEachRun = false};
    CHECK(readback.take(3, never).empty());
    context->finish();
    const auto pixels = readback.take(4, never);
    REQUIRE(pixels.size() == sizeof(float));
    float value = 0;
    std::memcpy(&value, pixels.data(), sizeof value);
    CHECK(value == 7);
    // One that dies with requests on their way leaves nothing behind.
    readback.request(5, framebuffer, 1, 1, {TransferFormat::red, TransferType::f32});
}

TEST_CASE("Nothing that is read back frame by frame calls what waits for the GPU") {
    const char* const source = std::getenv("TERRANE_SOURCE");
    if (!source) return;
    const std::filesystem::path framework = std::filesystem::path(source) / "framework";
    for (const char* file : {"render/pixel_readback.cpp", "render/layer_ranges.cpp",
                             "producer/elevation_readback.cpp", "terrain/tile_sampler_z.cpp"}) {
        CAPTURE(file);
        const auto text = readFile(framework / file);
        REQUIRE(text);
        for (const char* call :
             {"Finish(", "finish(", "GetTexImage", "GetTextureImage", "GetTextureSubImage",
              "GetNamedBufferSubData", "GetBufferSubData", "download(", "readPixels("}) {
            CAPTURE(call);
            CHECK(text->find(call) == std::string::npos);
        }
    }
}
