// SPDX-License-Identifier: BSD-3-Clause
#include "hills.h"

#include <array>

namespace terrane {

namespace {

constexpr const char* kPaint = R"(
#include "deformation.glsl"
#include "textureTile.glsl"
uniform samplerTile elevationSampler;
#ifdef _VERTEX_
layout(location = 0) in vec3 vertex;
out float z;
void main() {
    z = deformationHeight(vertex.xy, textureTileLinear(elevationSampler, vertex.xy).xyz);
    gl_Position = DEFORM(vertex.xy, z);
}
#endif
#ifdef _FRAGMENT_
in float z;
layout(location = 0) out vec4 colour;
void main() {
    colour = vec4(0.5 + 0.5 * cos(z * vec3(0.01, 0.031, 0.11)), 1.0);
}
#endif
)";

constexpr const char* kCylinderShader = R"(
vec4 deformCylinder(vec2 uv, float height) {
    vec2 p = uv * deformation.offset.z + deformation.offset.xy;
    float angle = p.y / deformation.radius, r = deformation.radius - height;
    return deformation.localToScreen * vec4(p.x, r * sin(angle), -r * cos(angle), 1.0);
}
)";

std::string terrainOf(Hills::Shape shape, const std::string& face, const std::string& rotation) {
    std::string size = "1000", rest = "deform=\"none\"";
    if (shape == Hills::Shape::planet) size = "20000", rest = "deform=\"sphere\"";
    if (shape == Hills::Shape::cylinder) rest = "deform=\"cylinder\" radius=\"1500\"";
    return "<terrainNode name='terrain" + face + "' size='" + size + "' " + rest +
           " zmin='0' zmax='600' splitFactor='2' maxLevel='6'/>\n"
           "<elevationProducer name='elevations" +
           face +
           "' cache='cache' noise='100,-80,60,30,15,8,4'/>\n"
           "<node name='ground" +
           face + "' flags='ground'>" + rotation +
           "<bounds xmin='-1e9' xmax='1e9' ymin='-1e9' ymax='1e9' zmin='-1e9' zmax='1e9'/>\n"
           "<field id='terrain' value='terrain" +
           face +
           "'/>\n<tileSamplerZ id='elevationSampler' sampler='elevationSampler' "
           "producer='elevations" +
           face +
           "' storeInvisible='false'/>\n"
           "<mesh id='grid' value='grid.mesh'/>\n"
           "<method id='update' value='updateGround'/><method id='draw' value='drawGround'/>"
           "</node>\n";
}

// The frames of the faces (terrain reference 2.2).
const std::array<std::string, 6> kFaces{"",
                                        "<rotatex angle='90'/>",
                                        "<rotatex angle='90'/><rotatey angle='90'/>",
                                        "<rotatex angle='90'/><rotatey angle='180'/>",
                                        "<rotatex angle='90'/><rotatey angle='270'/>",
                                        "<rotatex angle='180'/>"};

std::string archiveOf(Hills::Shape shape) {
    std::string terrains;
    if (shape == Hills::Shape::planet) {
        for (std::size_t i = 0; i < kFaces.size(); ++i)
            terrains += terrainOf(shape, std::to_string(i + 1), kFaces[i]);
    } else {
        terrains = terrainOf(shape, "1", "");
    }
    std::string nodes, entries;
    for (std::size_t at = 0; at < terrains.size();) {
        const std::size_t end = terrains.find('\n', at) + 1;
        const std::string line = terrains.substr(at, end - at);
        const bool entry = line.starts_with("<terrainNode") || line.starts_with("<elevation");
        (entry ? entries : nodes) += line;
        at = end;
    }
    return R"(<archive>
<multithreadScheduler name="scheduler" nthreads="1"/>
<tileCache name="cache" scheduler="scheduler">
  <gpuTileStorage tileSize="29" nTiles="900" internalformat="RGB32F" format="RGB" type="FLOAT"/>
</tileCache>
)" + entries +
           R"(<module name="paint" version="330" source="paint.glsl"/>
<sequence name="updateGround">
  <updateTerrain name="this.terrain"/><updateTileSamplers name="this.terrain"/>
</sequence>
<sequence name="drawGround">
  <setProgram><module name="paint"/></setProgram>
  <drawTerrain name="this.terrain" mesh="this.grid" culling="true"/>
</sequence>
<sequence name="drawFrame">
  <foreach var="g" flag="ground" parallel="true"><callMethod name="$g.update"/></foreach>
  <foreach var="g" flag="ground"><callMethod name="$g.draw"/></foreach>
</sequence>
<player scheduler="scheduler"/>
<node name="scene">
<node flags="camera"><method id="draw" value="drawFrame"/></node>
)" + nodes +
           "</node>\n</archive>\n";
}

} // namespace

const std::vector<View> Hills::kViews{
    {.x0 = -300, .y0 = -200, .theta = 83, .phi = 23, .d = 60},
    {.x0 = 420, .y0 = 330, .theta = 70, .phi = 200, .d = 15},
    {.x0 = 0, .y0 = 0, .theta = 0, .phi = 0, .d = 900},
    {.x0 = 700, .y0 = -650, .theta = 88, .phi = 45, .d = 200},
    {.x0 = -10, .y0 = 10, .theta = 100, .phi = 10, .d = 5}, // up into the sky
    {.x0 = -640, .y0 = 555, .theta = 60, .phi = 310, .d = 400},
};

const std::vector<double> Hills::kAmplitudes{100, -80, 60, 30, 15, 8, 4};

Hills::Hills(Shape shape, const Edits& edits, PlayerOptions options)
    : player_(standardRegistry(), write(shape, edits, std::move(options))) {}

PlayerOptions Hills::write(Shape shape, const Edits& edits, PlayerOptions options) {
    std::string archive = archiveOf(shape);
    for (const auto& [before, after] : edits) {
        CAPTURE(before);
        REQUIRE(archive.find(before) != std::string::npos);
        for (std::size_t at = 0; (at = archive.find(before, at)) != std::string::npos;
             at += after.size())
            archive.replace(at, before.size(), after);
    }
    std::string paint = kPaint;
    const char* const deform = shape == Shape::flat     ? "deformFlat"
                               : shape == Shape::planet ? "deformSphere"
                                                        : "deformCylinder";
    paint.replace(paint.find("DEFORM"), 6, deform);
    if (shape == Shape::cylinder) paint.insert(paint.find("#ifdef _VERTEX_"), kCylinderShader);
    folder_.write("archive.xml", archive);
    folder_.write("paint.glsl", paint);
    options.archive = folder_.path();
    options.width = 160;
    options.height = 120;
    options.debug = true;
    return options;
}

TerrainNode& Hills::terrain(int face) {
    const auto terrain = player_.resources()->get<TerrainNode>("terrain" + std::to_string(face));
    REQUIRE(terrain);
    return *terrain;
}

void Hills::assumeGround(double height) {
    controller().groundHeight = height;
    terrain().setGroundHeight(height);
}

} // namespace terrane
