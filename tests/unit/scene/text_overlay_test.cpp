// SPDX-License-Identifier: BSD-3-Clause
#include "core/image.h"
#include "render/font.h"
#include "scene/scene_fixture.h"
#include "scene/show_info.h"
#include "scene/show_log.h"

#include <doctest/doctest.h>

namespace terrane {

namespace {

/// A font whose characters are all full, so that each line of text is a bar of its length.
struct TextFixture : SceneFixture {
    TextFixture() {
        declareFont(registry);
        declareShowInfo(registry);
        declareShowLog(registry);
        Image full = makeImage(32, 32, 1);
        std::fill(full.bytes.begin(), full.bytes.end(), static_cast<unsigned char>(255));
        writePng(folder / "full.png", full);
        write("text.glsl",
              "#ifdef _VERTEX_\nlayout(location = 0) in vec4 p;\n"
              "layout(location = 1) in vec4 colour; out vec4 k; out vec2 uv;\n"
              "void main() { k = colour; uv = p.zw; gl_Position = vec4(p.xy, 0, 1); }\n"
              "#endif\n#ifdef _FRAGMENT_\nuniform sampler2D font;\nin vec4 k; in vec2 "
              "uv; layout(location = 0) out vec4 c;\n"
              "void main() { c = k * texture(font, uv).r; }\n#endif\n");
    }
    void loadTask(const std::string& task) {
        scene.reset();
        resources.reset();
        diagnostics.clear();
        load("<texture2D name='full' source='full.png' internalformat='R8'/>"
             "<font name='defaultFont' tex='full' nCols='16' nRows='16' minChar='0' maxChar='255' "
             "invalidChar='0' charWidths='1'/>"
             "<module name='text' version='330' source='text.glsl'/>"
             "<sequence name='frame'>\n" +
             task +
             "</sequence><node name='scene'><node flags='camera'>"
             "<method id='draw' value='frame'/></node></node>");
    }
    /// The rows that have something at x, from the bottom: "rrggg  " for two red rows and so on.
    std::string column(int x) const {
        std::string rows;
        for (int y = 0; y < kSize; ++y) {
            const Colour c = pixel(x, y);
            rows += c == Colour{0, 0, 0} ? ' '
                    : c[1] == 0          ? 'r'
                    : c[0] == 0          ? 'g'
                    : c[0] == c[1]       ? 'w'
                                         : 'a';
        }
        return rows.substr(0, rows.find_last_not_of(' ') + 1);
    }
};

} // namespace

TEST_CASE_FIXTURE(TextFixture, "showInfo writes its lines where it says") {
    struct Row {
        const char* attributes;
        const char* rows; ///< at the left, from the bottom
    };
    const Row rows[] = {
        // Above the bottom there is room for maxLines lines.
        {"x='0' y='0' maxLines='1' fontSize='2'", "rr"},
        {"x='0' y='0' maxLines='4' fontSize='2'", "      rr"},
        {"x='0' y='-3' maxLines='1' fontSize='2'", "   rr"},
        {"x='0' y='3' maxLines='4' fontSize='2'", "           rr"}, // 3 below the top
        {"x='0' y='1' fontSize='4'", "           rrrr"},
        {"x='1' y='0' maxLines='1'", ""},
        {"x='0' y='0' maxLines='1' fontSize='3' fontColor='0,255,0'", "ggg"},
        {"x='0' y='0' maxLines='1'", "rr"}, // the tile's own height
    };
    for (const Row& row : rows) {
        CAPTURE(row.attributes);
        loadTask(std::string("<showInfo ") + row.attributes + "/>");
        CHECK(draw());
        checkNoDiagnostics();
        CHECK(column(0) == row.rows);
    }
}

TEST_CASE_FIXTURE(TextFixture, "showInfo writes what code says, by topic, for one frame") {
    loadTask("<showInfo x='0' y='1' fontSize='2'/>");
    scene->infoTexts().set("b", "12");
    scene->infoTexts().set("a", "1");
    scene->infoTexts().set("c", "");
    scene->infoTexts().set("FPS", "1234");
    CHECK(draw());
    // From the top: four letters, one, two; each half as wide as high.
    CHECK(column(0) == "         rrrrrr");
    CHECK(column(1) == "         rr  rr");
    CHECK(column(3) == "             rr");
    CHECK(column(4) == "");
    CHECK(draw());
    CHECK(column(0) == "             rr"); // the frame rate alone
    checkNoDiagnostics();
}

TEST_CASE_FIXTURE(TextFixture, "Text is blended, and leaves blending off") {
    loadTask("<setState><blend enable='true' eq='ADD' src='ZERO' dst='ONE'/></setState>"
             "<showInfo x='0' y='0' maxLines='1'/>");
    CHECK(draw());
    CHECK(column(0) == "rr");
    CHECK_FALSE(target->framebuffer().state.blend[0].enabled);
    CHECK_FALSE(target->framebuffer().state.blend[7].enabled);
}

TEST_CASE_FIXTURE(TextFixture, "showLog writes the newest messages once there is a warning") {
    loadTask("<showLog x='0' y='0' maxLines='2' fontSize='2'/>");
    CHECK(draw());
    CHECK(column(0) == "");
    diagnostics.warning("legacy-glsl", {}, "a remark of this program's own");
    CHECK(draw());
    CHECK(column(0) == "");
    diagnostics.warning("test", {}, "first");
    CHECK(draw());
    CHECK(column(0) == "aagg");
    diagnostics.error("test", {}, "second");
    CHECK(draw());
    CHECK(column(0) == "rraa");
    scene->messageLog().visible = false;
    CHECK(draw());
    CHECK(column(0) == "");
    diagnostics.warning("test", {}, "third");
    CHECK(draw());
    CHECK(column(0) == "aarr");
    for (int i = 0; i < 300; ++i)
        diagnostics.warning("test", {}, std::to_string(i));
    CHECK(draw());
    CHECK(scene->messageLog().lines().size() == MessageLog::kMostLines);
    CHECK(scene->messageLog().lines().back().text == "299");
    diagnostics.clear();
    diagnostics.error("test", {}, "after a repair");
    CHECK(draw());
    CHECK(scene->messageLog().lines().back().text == "after a repair");
}

TEST_CASE_FIXTURE(TextFixture, "What is wrong with text is told") {
    struct Row {
        const char* task;
        const char* code;
    };
    const Row rows[] = {
        {"<showInfo fontColor='1,2'/>", "wrong-kind 3:22"},
        {"<showInfo fontColor='1,2,256'/>", "out-of-range 3:26"},
        {"<showInfo fontAspect='1'/>", "unknown-attribute 3:11"},
        {"<showInfo fontSize='0'/>", "out-of-range 3:21"},
        {"<showLog fontColor='1,2,3'/>", "unknown-attribute 3:10"},
        {"<showLog fontProgram='plain;'/>", "unknown-resource 3:23"},
        {"<showLog font='text'/>", "mistyped-reference 3:16"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.task);
        loadTask(row.task);
        draw();
        CHECK(codes().front() == row.code);
    }
}

} // namespace terrane
