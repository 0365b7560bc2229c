// SPDX-License-Identifier: BSD-3-Clause
#include "edited_archive.h"

#include "archive_edits.h"
#include "core/image.h"

namespace terrane {

namespace {

constexpr const char* kArchive = R"(<archive>
    <multithreadScheduler name="scheduler" nthreads="2"/>
    <multithreadScheduler name="scheduler2"/>
    <tileCache name="residualCache" scheduler="scheduler">
        <cpuFloatTileStorage tileSize="29" channels="1" capacity="60"/>
    </tileCache>
    <residualProducer name="residuals" cache="residualCache" file="DEM.dat" delta="1"/>
    <gpuTileStorage name="elevationStorage" tileSize="29" nTiles="500" internalformat="RGB32F"
        format="RGB" type="FLOAT" min="LINEAR" mag="LINEAR"/>
    <tileCache name="elevationCache" scheduler="scheduler" storage="elevationStorage"/>
    <elevationProducer name="elevations" cache="elevationCache" residuals="residuals"
        noise="0,3,2,1,4,2"/>
    <tileCache name="normalCache" scheduler="scheduler">
        <gpuTileStorage tileSize="25" nTiles="500" internalformat="RGBA8" format="RGBA"
            type="UNSIGNED_BYTE" min="LINEAR" mag="LINEAR"/>
    </tileCache>
    <normalProducer name="normals" cache="normalCache" elevations="elevations"/>

    <module name="branchShader" version="330" source="branch.glsl"/>
    <program name="branchProgram"><module name="branchShader"/></program>
    <tileCache name="branchCache" scheduler="scheduler">
        <gpuTileStorage tileSize="29" nTiles="500" internalformat="RGB32F" format="RGB" type="FLOAT"
            min="LINEAR" mag="LINEAR"/>
    </tileCache>
    <elevationProducer name="branch" cache="branchCache" upsampleProg="branchProgram"
        noise="10,5,3,2,1,1"/>

    <terrainNode name="relief" size="400" zmin="0" zmax="100" splitFactor="2" maxLevel="5"/>
    <texture2D name="tint" source="tint.png" internalformat="RGBA8" min="NEAREST" mag="NEAREST"/>
    <module name="paint" version="330" source="paint.glsl">
        <uniformSampler name="tint" texture="tint"/>
        <uniform1f name="warmth" x="0.2"/>
    </module>
    <module name="sky" version="330" source="sky.glsl"/>

    <font name="letters" tex="defaultFontTiles" nCols="16" nRows="6" minChar="32" maxChar="127"
        invalidChar="63" charWidths="16"/>
    <sequence name="updateGround">
        <updateTerrain name="this.terrain"/>
        <updateTileSamplers name="this.terrain"/>
    </sequence>
    <sequence name="drawGround">
        <setProgram><module name="this.material"/></setProgram>
        <drawTerrain name="this.terrain" mesh="this.grid"/>
    </sequence>
    <sequence name="drawFrame">
        <setProgram><module name="sky"/></setProgram>
        <drawMesh name="whole"/>
        <foreach var="g" flag="object"><callMethod name="$g.update"/></foreach>
        <foreach var="g" flag="object"><callMethod name="$g.draw"/></foreach>
        <showLog maxLines="0" font="letters"/>
    </sequence>
    <node name="scene">
        <node flags="camera"><method id="draw" value="drawFrame"/></node>
        <node name="ground" flags="object">
            <bounds xmin="-400" xmax="400" ymin="-400" ymax="400" zmin="0" zmax="100"/>
            <field id="terrain" value="relief"/>
            <tileSampler id="e" sampler="elevationSampler" producer="elevations"/>
            <tileSampler id="n" sampler="normalSampler" producer="normals"/>
            <tileSampler id="b" sampler="branchSampler" producer="branch"/>
            <module id="material" value="paint"/>
            <mesh id="grid" value="grid.mesh"/>
            <method id="update" value="updateGround"/>
            <method id="draw" value="drawGround"/>
        </node>
    </node>
    <player>
        <view name="start" x0="-40" y0="-60" theta="0.95" phi="0.5" d="420"/>
    </player>
</archive>
)";

constexpr const char* kCommon = R"(
const vec3 kSun = vec3(-0.7, 0.3, 0.6); // shared
)";

constexpr const char* kPaint = R"(
#include "deformation.glsl"
#include "textureTile.glsl"
#include "common.glsl"

uniform samplerTile elevationSampler;
uniform samplerTile normalSampler;
uniform samplerTile branchSampler;
uniform sampler2D tint;
uniform float warmth;

#ifdef _VERTEX_
layout(location = 0) in vec3 vertex;
out vec2 uv;
void main() {
    uv = vertex.xy;
    gl_Position = deformFlat(uv, deformationHeight(uv, textureTile(elevationSampler, uv).xyz));
}
#endif

#ifdef _FRAGMENT_
in vec2 uv;
layout(location = 0) out vec4 colour;
void main() {
    vec4 n = textureTile(normalSampler, uv) * 2.0 - 1.0;
    vec2 slope = mix(n.xy, n.zw, deformationBlend(uv));
    vec3 normal = vec3(slope, sqrt(max(0.0, 1.0 - dot(slope, slope))));
    float light = 0.3 + 0.8 * max(dot(normal, normalize(kSun)), 0.0);
    float branch = textureTile(branchSampler, uv).x;
    vec3 ground = mix(vec3(0.35, 0.5, 0.25), texture(tint, vec2(0.5)).rgb, 0.3 + 0.02 * branch);
    colour = vec4((ground + vec3(warmth, 0.0, 0.0)) * light, 1.0);
}
#endif
)";

constexpr const char* kSky = R"(
#ifdef _VERTEX_
layout(location = 0) in vec3 position;
void main() { gl_Position = vec4(position.xy, 0.9999, 1.0); }
#endif
#ifdef _FRAGMENT_
layout(location = 0) out vec4 colour;
void main() { colour = vec4(0.4, 0.6, 0.9, 1.0); }
#endif
)";

std::filesystem::path sourceFolder() {
    return exampleArchive("x").parent_path().parent_path();
}

std::string bytesOf(const std::filesystem::path& path) {
    const auto bytes = readFile(path);
    CAPTURE(path.string());
    REQUIRE(bytes);
    return *bytes;
}

} // namespace

EditedArchive::EditedArchive(PlayerOptions options)
    : options_(std::move(options)) {
    const std::filesystem::path shaders = sourceFolder() / "resources" / "shaders";
    // As authors do who change the built-in shaders.
    write("upsampleShader.xml", bytesOf(shaders / "upsampleShader.xml"));
    write("upsample.glsl", bytesOf(shaders / "upsample.glsl"));
    write("normalShader.xml", bytesOf(shaders / "normalShader.xml"));
    write("normal.glsl", bytesOf(shaders / "normal.glsl"));
    write("branch.glsl", bytesOf(shaders / "upsample.glsl"));
    write("DEM.dat", bytesOf(sourceFolder() / "tests/fixtures/residualProducer/good/DEM.dat"));
    write("archive.xml", kArchive);
    write("common.glsl", kCommon);
    write("paint.glsl", kPaint);
    write("sky.glsl", kSky);
    write("whole.mesh", "0 1 0 1 0 0 trianglestrip 1 0 3 float false\n"
                        "4  -1 -1 0  1 -1 0  -1 1 0  1 1 0\n0\n");
    paintTint(180, 160, 150);
}

PlayerOptions EditedArchive::options() const {
    PlayerOptions options = options_;
    options.archive = folder_.path();
    options.width = 160;
    options.height = 120;
    options.debug = true;
    return options;
}

Player& EditedArchive::open() {
    player_ = std::make_unique<Player>(standardRegistry(), options());
    player_->load();
    for (const Diagnostic& diagnostic : player_->diagnostics().all())
        FAIL_CHECK(toString(diagnostic));
    player_->drawUntilComplete();
    return *player_;
}

void EditedArchive::edit(const std::string& file, std::string_view before, std::string_view after) {
    std::string text = read(file);
    const std::size_t at = text.find(before);
    CAPTURE(file);
    CAPTURE(std::string(before));
    REQUIRE(at != std::string::npos);
    write(file, text.replace(at, before.size(), after));
}

std::string EditedArchive::read(const std::string& file) const {
    return bytesOf(folder_.path() / file);
}

void EditedArchive::remove(const std::string& file) {
    std::filesystem::remove(folder_.path() / file);
}

Image EditedArchive::picture() {
    REQUIRE(player_->drawUntilComplete());
    return player_->capture();
}

Image EditedArchive::freshPicture() {
    Player fresh(standardRegistry(), options());
    REQUIRE(fresh.load());
    fresh.controller().view = player_->controller().view;
    REQUIRE(fresh.drawUntilComplete());
    return fresh.capture();
}

void EditedArchive::paintTint(unsigned char r, unsigned char g, unsigned char b) {
    REQUIRE(writePng(folder_ / "tint.png",
                     Image{.width = 1, .height = 1, .channels = 3, .bytes = {r, g, b}}));
}

std::string EditedArchive::problems() const {
    std::vector<std::string> codes;
    for (const Diagnostic& d : player_->problems())
        codes.push_back(d.code);
    return listed(codes);
}

bool samePicture(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.bytes == b.bytes;
}

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names)
        text += name + " ";
    return text;
}

} // namespace terrane
