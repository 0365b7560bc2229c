// SPDX-License-Identifier: BSD-3-Clause
#include "plugin_terrain/terrain_fixture.h"
#include "producer/tile_pass.h"
#include "terrain/deformation_uniforms.h"
#include "terrain/spherical_deformation.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/gtc/matrix_transform.hpp>

using namespace terrane;
using terrane::test::TerrainFixture;

namespace {

constexpr int kSize = 16; // of the grid of places at which functions are evaluated

/// Evaluates an expression of `ij`, the pixel's integer coordinates, over kSize x kSize pixels.
struct ShaderFixture : TerrainFixture {
    void compile(const std::string& declarations, const std::string& expression) {
        write("function.glsl", "#ifdef _VERTEX_\n"
                               "layout(location = 0) in vec4 vertex;\n"
                               "void main() { gl_Position = vertex; }\n"
                               "#endif\n"
                               "#ifdef _FRAGMENT_\n" +
                                   declarations +
                                   "\nlayout(location = 0) out vec4 data;\n"
                                   "void main() { ivec2 ij = ivec2(gl_FragCoord.xy);\n"
                                   "data = " +
                                   expression + "; }\n#endif\n");
        open("<module name=\"function\" version=\"330\" source=\"function.glsl\"/>\n");
        program = manager->get<Program>("function;").shared();
        REQUIRE(program);
        target = manager->get<Texture>("renderbuffer-16-RGBA32F").shared();
        REQUIRE(target);
    }
    ~ShaderFixture() { program = nullptr, target = nullptr; }

    std::vector<glm::vec4> run() {
        TilePass pass(*context, target);
        pass.begin();
        pass.draw(*program);
        const auto bytes = pass.framebuffer().readPixels(0, 0, kSize, kSize,
                                                         {TransferFormat::rgba, TransferType::f32});
        std::vector<glm::vec4> result(kSize * kSize);
        std::memcpy(result.data(), bytes.data(), bytes.size());
        return result;
    }

    std::shared_ptr<Program> program;
    std::shared_ptr<Texture> target;
};

TerrainQuad quadOf(const TileId& tile, double size) {
    const TileCoordinates at = tileCoordinates(tile, 2 * size);
    TerrainQuad quad;
    quad.level = tile.level;
    quad.tx = tile.tx;
    quad.ty = tile.ty;
    quad.ox = at.ox;
    quad.oy = at.oy;
    quad.l = at.size;
    return quad;
}

} // namespace

TEST_CASE_FIXTURE(ShaderFixture, "The built-in deformation puts vertices where they belong") {
    struct Row {
        const char* name;
        const char* function;
        bool sphere;
    };
    for (const Row& row : {Row{"flat", "deformFlat", false}, Row{"sphere", "deformSphere", true}}) {
        CAPTURE(std::string(row.name));
        const double size = 6360000;
        const SphericalDeformation sphere(size);
        const Deformation flat;
        const Deformation& deformation = row.sphere ? sphere : flat;
        compile("#include \"deformation.glsl\"\nuniform float height;",
                std::string(row.function) + "(vec2(ij) / 15.0, height)");
        for (const TileId& tile : {TileId{0, 0, 0}, TileId{2, 3, 1}, TileId{6, 40, 11},
                                   TileId{11, 1500, 300}, TileId{17, 100000, 70001}}) {
            CAPTURE(tile.level);
            const TerrainQuad quad = quadOf(tile, size);
            const double height = std::min(3000.0, 0.2 * quad.l);
            const glm::dvec3 near = deformation.localToDeformed(
                {quad.ox + 0.3 * quad.l, quad.oy + 0.4 * quad.l, height + 1.5 * quad.l});
            const glm::dvec3 centre =
                deformation.localToDeformed({quad.ox + 0.5 * quad.l, quad.oy + 0.6 * quad.l, 0});
            const TerrainView view{
                .localToCamera = glm::lookAt(near, centre, glm::dvec3(0.6, 0.5, 0.62)),
                .cameraToScreen = glm::perspective(1.2, 4.0 / 3, 0.01 * quad.l, 100 * quad.l)};
            const auto state = terrainState(view, deformation, 2, 0, 0);
            REQUIRE(state);
            const NodeUniforms node = nodeUniforms(deformation, *state);
            const QuadUniforms perQuad = quadUniforms(deformation, *state, quad);
            program->uniform<glm::mat4>("deformation.localToScreen").set(node.localToScreen);
            program->uniform<float>("deformation.radius").set(node.radius);
            program->uniform<glm::vec4>("deformation.offset").set(perQuad.offset);
            program->uniform<glm::mat4>("deformation.screenQuadCorners")
                .set(perQuad.screenQuadCorners);
            program->uniform<glm::mat4>("deformation.screenQuadVerticals")
                .set(perQuad.screenQuadVerticals);
            program->uniform<glm::vec4>("deformation.screenQuadCornerNorms")
                .set(perQuad.screenQuadCornerNorms);
            program->uniform<float>("height").set(static_cast<float>(height));
            const auto clip = run();
            double worst = 0;
            for (int k = 0; k < kSize; ++k) {
                for (int i = 0; i < kSize; ++i) {
                    const glm::dvec3 p = deformation.localToDeformed({quad.ox + quad.l * i / 15.0,
                                                                      quad.oy + quad.l * k / 15.0,
                                                                      static_cast<float>(height)});
                    const glm::dvec4 expected = state->localToScreen * glm::dvec4(p, 1);
                    const glm::dvec4 difference =
                        glm::dvec4(clip[static_cast<std::size_t>(k * kSize + i)]) - expected;
                    const double scale = std::max(std::abs(expected.w), 0.1 * quad.l);
                    for (const int c : {0, 1, 3})
                        worst = std::max(worst, std::abs(difference[c]) / scale);
                }
            }
            // Of the screen. Flat terrains lose the digits that their coordinates need.
            CHECK(worst < (row.sphere ? 2e-6 : 2e-6 * std::max(1.0, size / quad.l)));
        }
    }
}

TEST_CASE_FIXTURE(ShaderFixture,
                  "Vertices of a planet's level 20 are drawn within a centimetre of their place") {
    compile("#include \"deformation.glsl\"\nuniform float height;",
            "deformSphere(vec2(ij) / 15.0, height)");
    const double radius = 6360000;
    const SphericalDeformation sphere(radius);
    constexpr int kLast = (1 << 20) - 1;
    for (const auto& [tile, height] :
         {std::pair{TileId{20, 0, 0}, 0.0f}, std::pair{TileId{20, kLast, 345678}, 8848.25f},
          std::pair{TileId{20, 777777, 222}, -7000.5f},
          std::pair{TileId{20, kLast, kLast}, 12.0f}}) {
        CAPTURE(tile.tx);
        const TerrainQuad quad = quadOf(tile, radius);
        const glm::dvec3 eye =
            sphere.localToDeformed({quad.ox - 0.3 * quad.l, quad.oy + 0.4 * quad.l, height + 2.0});
        const glm::dvec3 centre = sphere.localToDeformed(
            {quad.ox + 0.5 * quad.l, quad.oy + 0.6 * quad.l, double(height)});
        // In two steps: lookAt alone would lose digits so far from the origin.
        const glm::dmat4 turn = glm::lookAt(glm::dvec3(0), centre - eye, glm::normalize(eye));
        const TerrainView view{.localToCamera = glm::translate(turn, -eye),
                               .cameraToScreen = glm::perspective(1.2, 4.0 / 3, 0.2, 2e6)};
        const auto state = terrainState(view, sphere, 2, height, 0);
        REQUIRE(state);
        const NodeUniforms node = nodeUniforms(sphere, *state);
        const QuadUniforms perQuad = quadUniforms(sphere, *state, quad);
        program->uniform<float>("deformation.radius").set(node.radius);
        program->uniform<glm::vec4>("deformation.offset").set(perQuad.offset);
        program->uniform<glm::mat4>("deformation.screenQuadCorners").set(perQuad.screenQuadCorners);
        program->uniform<glm::mat4>("deformation.screenQuadVerticals")
            .set(perQuad.screenQuadVerticals);
        program->uniform<glm::vec4>("deformation.screenQuadCornerNorms")
            .set(perQuad.screenQuadCornerNorms);
        program->uniform<float>("height").set(height);
        const auto clip = run();
        double worst = 0;
        for (int k = 0; k < kSize; ++k) {
            for (int i = 0; i < kSize; ++i) {
                const glm::dvec3 p = sphere.localToDeformed(
                    {quad.ox + quad.l * i / 15.0, quad.oy + quad.l * k / 15.0, double(height)});
                const glm::dvec3 inCamera = glm::dmat3(turn) * (p - eye);
                const glm::dvec4 c(clip[static_cast<std::size_t>(k * kSize + i)]);
                const glm::dvec3 seen(c.x / view.cameraToScreen[0][0],
                                      c.y / view.cameraToScreen[1][1], -c.w);
                worst = std::max(worst, glm::length(seen - inCamera));
            }
        }
        CHECK(worst < 0.01);
    }
}

TEST_CASE_FIXTURE(ShaderFixture, "Tiles are sampled, and interpolated where the filter does not") {
    compile(
        "#include \"textureTile.glsl\"\nuniform samplerTile tile; uniform bool linear;",
        "linear ? textureTileLinear(tile, vec2(ij) / 15.0) : textureTile(tile, vec2(ij) / 15.0)");
    const auto pool =
        std::make_shared<Texture>(*context,
                                  TextureDescription{.target = TextureTarget::texture2DArray,
                                                     .format = InternalFormat::r32f,
                                                     .width = 13,
                                                     .height = 13,
                                                     .layers = 3},
                                  SamplingParameters{.mag = MagFilter::nearest});
    std::vector<float> texels(13 * 13);
    for (int k = 0; k < 13; ++k)
        for (int i = 0; i < 13; ++i)
            texels[static_cast<std::size_t>(k * 13 + i)] = static_cast<float>(10 * k + i);
    pool->upload({.z = 2, .width = 13, .height = 13}, {TransferFormat::red, TransferType::f32},
                 std::as_bytes(std::span(texels)));
    // Border 2, so 8 texels from corner to corner; the quad is the upper right quarter of the tile.
    program->uniform<Texture>("tile.tilePool").set(pool);
    program->uniform<glm::vec3>("tile.tileCoords").set({6.5f / 13, 6.5f / 13, 2});
    program->uniform<glm::vec3>("tile.tileSize").set({4.0f / 13, 4.0f / 13, 4});
    program->uniform<bool>("linear").set(false);
    const auto nearest = run();
    CHECK(nearest[0].x == 66);
    CHECK(nearest[kSize * kSize - 1].x == 110);
    program->uniform<bool>("linear").set(true);
    const auto linear = run();
    for (int k = 0; k < kSize; ++k) {
        for (int i = 0; i < kSize; ++i) {
            const double expected = 66 + 40 * (k / 15.0) + 4 * (i / 15.0);
            CHECK(linear[static_cast<std::size_t>(k * kSize + i)].x ==
                  doctest::Approx(expected).epsilon(1e-5));
        }
    }
}

TEST_CASE_FIXTURE(ShaderFixture, "The built-in modules compile, and programs of them link") {
    compile("#include \"textureQuadtree.glsl\"\nuniform samplerTile tile;",
            "textureQuadtree(tile, vec2(ij), 0) + textureTileLinear(tile, vec2(0.5))");
    for (const char* name : {"upsampleShader;", "blendShader;", "normalShader;", "copyShader;"}) {
        CAPTURE(std::string(name));
        const auto built = manager->get<Program>(name);
        CHECK(built);
    }
}
