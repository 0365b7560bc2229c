// SPDX-License-Identifier: BSD-3-Clause
#include "app/script.h"

#include "app/options.h"

#include <doctest/doctest.h>

#include <string>

using namespace terrane;

namespace {

ScriptLine parsed(const std::string& text) {
    auto line = parseScriptLine(text, 7);
    REQUIRE(line);
    CHECK(line->number == 7);
    CHECK(line->text == text);
    return *line;
}

template <class Command>
Command command(const std::string& text) {
    const ScriptLine line = parsed(text);
    CAPTURE(text);
    CAPTURE(line.problem);
    REQUIRE(line.command);
    REQUIRE(std::holds_alternative<Command>(*line.command));
    return std::get<Command>(*line.command);
}

} // namespace

TEST_CASE("each command of the script language is understood") {
    const auto jump = command<CameraCommand>("camera 1,2,3.5,-4,500");
    CHECK(jump.from == View{.x0 = 1, .y0 = 2, .theta = 3.5, .phi = -4, .d = 500});
    CHECK(!jump.to);
    const auto flight = command<CameraCommand>("camera 0,0,0,0,1 to 9,0,0,0,2 in 30 frames");
    REQUIRE(flight.to);
    CHECK(flight.to->x0 == 9);
    CHECK(flight.frames == 30);

    CHECK(command<FramesCommand>("frames 12").count == 12);
    CHECK(command<WaitCommand>("wait tiles").maxFrames == kMostFrames);
    CHECK(command<WaitCommand>("wait tiles 40").maxFrames == 40);
    CHECK(command<ScreenshotCommand>("screenshot \"my picture.png\"").file == "my picture.png");
    command<MarkCommand>("  mark\t");
    CHECK(command<ArchiveCommand>("archive ../other.xml").path == "../other.xml");
    CHECK(command<NeedsCommand>("needs dem.dat").path == "dem.dat");

    const auto tiles = command<ExpectTilesCommand>("expect tiles elevation <= 20");
    CHECK(tiles.producer == "elevation");
    CHECK(tiles.comparison == Comparison::lessOrEqual);
    CHECK(tiles.count == 20);
    const auto height = command<ExpectHeightCommand>("expect height 1 2 -3 0.5");
    CHECK(height.z == -3);
    CHECK(height.tolerance == 0.5);
    CHECK(!command<ExpectImageCommand>("expect image a.png").percent);
    CHECK(command<ExpectImageCommand>("expect image a.png 2.5%").percent == 2.5);
    const auto diagnostic = command<ExpectDiagnosticCommand>("expect diagnostic cycle a.xml:1:2");
    CHECK(diagnostic.code == "cycle");
    CHECK(diagnostic.place == "a.xml:1:2");
    const auto metric = command<ExpectMetricCommand>("expect metric /caches/c/used == 3");
    CHECK(metric.pointer == "/caches/c/used");
    CHECK(metric.value == 3);
    command<ExpectNoErrorsCommand>("expect no-errors");
}

TEST_CASE("what a person does is understood") {
    const auto events = [](const std::string& text) { return command<InputCommand>(text).events; };
    const auto held = events("key PageUp down");
    REQUIRE(held.size() == 1);
    CHECK(std::get<KeyEvent>(held[0]).key == Key::pageUp);
    CHECK(std::get<KeyEvent>(held[0]).down);
    const auto pressed = events("key f5");
    REQUIRE(pressed.size() == 2);
    CHECK(std::get<KeyEvent>(pressed[0]).down);
    CHECK_FALSE(std::get<KeyEvent>(pressed[1]).down);
    const auto letter = events("key a");
    REQUIRE(letter.size() == 1);
    CHECK(std::get<TextEvent>(letter[0]).character == U'a');
    CHECK(events("key a up").empty());
    CHECK(command<ModifierCommand>("key control down").modifier == &Modifiers::control);
    CHECK(command<ModifierCommand>("key control down").down);
    CHECK_FALSE(command<ModifierCommand>("key shift up").down);

    CHECK(std::get<MouseMoveEvent>(events("mouse move 3 4.5").at(0)).y == 4.5);
    const auto button = std::get<MouseButtonEvent>(events("mouse up middle").at(0));
    CHECK(button.button == MouseButton::middle);
    CHECK_FALSE(button.down);
    CHECK(std::get<WheelEvent>(events("wheel -1.5").at(0)).steps == -1.5);

    const auto text = events("text h\u00e9 \u20ac");
    REQUIRE(text.size() == 4);
    CHECK(std::get<TextEvent>(text[1]).character == U'\u00e9');
    CHECK(std::get<TextEvent>(text[2]).character == U' ');
    CHECK(std::get<TextEvent>(text[3]).character == U'\u20ac');
}

TEST_CASE("a byte that is no character of UTF-8 is typed as the replacement character") {
    struct Row {
        const char* name;
        std::string bytes;
        std::u32string characters;
    };
    const Row rows[] = {
        {"the largest character", "\xf4\x8f\xbf\xbf", {0x10ffff}},
        {"beyond it", "\xf4\x90\x80\x80", U"\ufffd\ufffd\ufffd\ufffd"},
        {"a byte of no character", "a\xff", U"a\ufffd"},
        {"a continuation alone", "\x80z", U"\ufffdz"},
        {"cut off", "\xe2\x82", U"\ufffd\ufffd"},
        {"longer than it needs to be", "\xc1\xa1", U"\ufffd\ufffd"},
        {"half of a pair of UTF-16", "\xed\xa0\x80", U"\ufffd\ufffd\ufffd"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        std::u32string characters;
        for (const InputEvent& event : command<InputCommand>("text " + row.bytes).events)
            characters += std::get<TextEvent>(event).character;
        CHECK(characters == row.characters);
    }
}

TEST_CASE("attributes are set by name") {
    const auto set = command<SetCommand>("set a.b.c \"1, 2\"");
    CHECK(set.resource == "a.b");
    CHECK(set.attribute == "c");
    CHECK(set.value == "1, 2");
    command<ReloadCommand>("reload");
}

TEST_CASE("blank lines and comments are nothing") {
    for (const char* text : {"", "   ", "\t\r", "# expect miracles", "  # indented"}) {
        CAPTURE(text);
        CHECK(!parseScriptLine(text, 1));
    }
    const auto lines = parseScript("# one\n\nframes 3\r\nmark\n");
    REQUIRE(lines.size() == 2);
    CHECK(lines[0].number == 3);
    CHECK(lines[1].number == 4);
}

TEST_CASE("a line that is no command says what was expected") {
    struct Row {
        const char* text;
        const char* problem;
    };
    const Row rows[] = {
        {"fraems 3", "unknown command 'fraems'; did you mean 'frames'?"},
        {"frames", "expected: frames N"},
        {"frames three", "expected: frames N"},
        {"frames -3", "expected: frames N"},
        {"frames 3 4", "expected: frames N"},
        {"camera 1,2,3,4", "expected: camera X0,Y0,THETA,PHI,D [to X0,Y0,THETA,PHI,D in N frames]"},
        {"camera 1,2,3,4,5 to 1,2,3,4,5",
         "expected: camera X0,Y0,THETA,PHI,D [to X0,Y0,THETA,PHI,D in N frames]"},
        {"camera 1,2,3,4,5 to 1,2,3,4,5 in 0 frames",
         "expected: camera X0,Y0,THETA,PHI,D [to X0,Y0,THETA,PHI,D in N frames]"},
        {"wait", "expected: wait tiles [MAXFRAMES]"},
        {"screenshot", "expected: screenshot FILE"},
        {"set terrain 3", "expected: set RESOURCE.ATTRIBUTE VALUE"},
        {"set .size 3", "expected: set RESOURCE.ATTRIBUTE VALUE"},
        {"set terrain.size", "expected: set RESOURCE.ATTRIBUTE VALUE"},
        {"reload now", "expected: reload"},
        {"key nothing", "expected: key NAME [down|up] (escape, f5, pageup... or a character; "
                        "shift, control, alt)"},
        {"mouse down",
         "expected: mouse move X Y (pixels from the top left), or mouse down|up left|middle|right"},
        {"wheel up", "expected: wheel STEPS (up is above 0)"},
        {"wheel inf", "expected: wheel STEPS (up is above 0)"},
        {"mouse move nan 1",
         "expected: mouse move X Y (pixels from the top left), or mouse down|up left|middle|right"},
        {"expect image a.png nan%", "expected: expect image FILE [PIXELS%]"},
        {"text", "expected: text STRING"},
        {"screenshot \"a.png", "a quote is not closed"},
        {"expect tile x == 1", "unknown expectation 'tile'; did you mean 'tiles'?"},
        {"expect tiles x ~ 1", "expected: expect tiles PRODUCER OP N"},
        {"expect image a.png 3", "expected: expect image FILE [PIXELS%]"},
        {"expect metric frames > 1",
         "expected: expect metric /POINTER OP N (counts only, never times)"},
        {"expect metric /startup_ms/load < 1",
         "expected: expect metric /POINTER OP N (counts only, never times)"},
        {"expect metric /frames/0/cpu_ms < 1",
         "expected: expect metric /POINTER OP N (counts only, never times)"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.text);
        const ScriptLine line = parsed(row.text);
        CHECK(!line.command);
        CHECK(line.problem == row.problem);
    }
    CHECK(parsed("expect").problem.starts_with("expected after 'expect': 'tiles',"));
}

TEST_CASE("comparisons hold as they are written") {
    struct Row {
        const char* word;
        bool less, equal, greater; // of 1, 2, 3 compared with 2
    };
    const Row rows[] = {{"==", false, true, false}, {"=", false, true, false},
                        {"!=", true, false, true},  {"<", true, false, false},
                        {"<=", true, true, false},  {">", false, false, true},
                        {">=", false, true, true}};
    for (const Row& row : rows) {
        CAPTURE(row.word);
        const auto c = command<ExpectTilesCommand>("expect tiles p " + std::string(row.word) + " 2")
                           .comparison;
        CHECK(holds(1, c, 2) == row.less);
        CHECK(holds(2, c, 2) == row.equal);
        CHECK(holds(3, c, 2) == row.greater);
    }
}

TEST_CASE("views and sizes are read strictly") {
    CHECK(parseView("1,-2.5,3e1,+4,5"));
    for (const char* text : {"", "1,2,3,4", "1,2,3,4,5,6", "1,2,3,4,5m", "1,2,3,4,0", "1,2,3,4,-1",
                             "nan,0,0,0,1", "1,,3,4,5"}) {
        CAPTURE(text);
        CHECK(!parseView(text));
    }
    REQUIRE(parseSize("640x480"));
    CHECK(parseSize("640x480")->width == 640);
    CHECK(parseSize("640x480")->height == 480);
    for (const char* text :
         {"", "640", "640x", "0x5", "-1x5", "640x480x1", "640 x480", "99999x1"}) {
        CAPTURE(text);
        CHECK(!parseSize(text));
    }
}
