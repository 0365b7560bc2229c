// SPDX-License-Identifier: BSD-3-Clause
#include "app/check.h"
#include "app/fixture_pool.h"
#include "app/register_types.h"
#include "app/run.h"
#include "app/script.h"
#include "core/files.h"
#include "core/text.h"
#include "plugins/standard_plugins.h"
#include "resource/registry.h"
#include "tools/terrane/allocation_counter.h"
#include "tools/terrane/new_archive.h"
#include "tools/terrane/pack_command.h"
#include "tools/terrane/schema_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using namespace terrane;

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

constexpr const char* kExamples = R"(Examples:
  terrane play archives/mountains
  terrane play archives/mountains --headless --screenshot mountains.png
  terrane play archives/mountains --headless --frames 300 --script flight.txt --metrics m.json
  terrane check archives/mountains
  terrane pack archives/mountains mountains.zip
  terrane test tests/fixtures archives

'terrane play --help' tells the options of a subcommand.
Exit status: 0 fine, 1 the archive or the run failed, 2 wrong usage.)";

constexpr const char* kWindow = R"(In the window:
  left button and drag             the ground follows the pointer
  control, any button and drag     turn around the point looked at
  middle or right button and drag  move the light, where the archive has one
  wheel, page up and page down     farther and nearer
  up and down, left and right      forwards and back, turn
  escape                           close)";

/// The script commands come from the parser itself.
std::string playFooter() {
    return std::string(kWindow) + "\n\nA script has one command a line:\n" + scriptUsage() +
           "OP is one of == != < <= > >=. Angles are in degrees, lengths in metres.";
}

/// What the command line says.
struct Arguments {
    RunOptions run;
    std::vector<std::string> archives, paths;
    std::string archive, headless, size, view, plugin;
    std::optional<double> timeStep;
    bool realTime = false, json = false, strict = false, unused = false, update = false;
    int samples = 1;
    std::string name, junit;
    std::string format = "xsd"; ///< of the schema
    std::string output;         ///< of the schema, or the zip
};

/// A range that does not fill the help with itself.
template <class T>
CLI::Validator within(T least, T most) {
    return CLI::Range(least, most).description("");
}

CLI::Validator validSize() {
    return {[](std::string& text) {
                return parseSize(text) ? "" : "'" + text + "' is no size such as 1024x768";
            },
            ""};
}

CLI::Validator validView() {
    return {[](std::string& text) {
                return parseView(text) ? ""
                                       : "'" + text + "' is no view such as 0,0,60,0,5000: " +
                                             "x0,y0,theta,phi,d in metres and degrees, d above 0";
            },
            ""};
}

std::vector<fs::path> toPaths(const std::vector<std::string>& texts) {
    return {texts.begin(), texts.end()};
}

void addCommon(CLI::App& command, Arguments& a) {
    command.add_option("--path", a.paths, "Another folder for names (repeatable)")
        ->type_name("DIR")
        ->allow_extra_args(false);
    command.add_option("--plugin", a.plugin, "A plugin to load (not built yet)")->type_name("FILE");
    static const std::map<std::string, LogLevel> kLevels{{"debug", LogLevel::debug},
                                                         {"info", LogLevel::info},
                                                         {"warning", LogLevel::warning},
                                                         {"error", LogLevel::error}};
    command
        .add_option("--log-level", a.run.logLevel, "What is told: debug, info, warning or error")
        ->transform(CLI::CheckedTransformer(kLevels).description(""))
        ->type_name("LEVEL");
}

void addPlay(CLI::App& app, Arguments& a) {
    CLI::App* play = app.add_subcommand("play", "Open an archive: draw what it describes");
    play->footer(playFooter());
    play->add_option("archive", a.archive, "An .xml file, a .zip, or the folder of an archive")
        ->required();
    play->add_flag("--headless{any}", a.headless,
                   "Draw without a window or a display; =osmesa or =egl says how")
        ->check(CLI::IsMember({"osmesa", "egl", "any"}).description(""));
    play->add_option("--size", a.size, "Size of the picture [1024x768]")
        ->type_name("WxH")
        ->check(validSize());
    play->add_option("--frames", a.run.frames,
                     "Frames to draw; without it, until the window is closed, or headless until "
                     "the picture is complete, at most 1000")
        ->type_name("N")
        ->check(within(1, 1000000000));
    CLI::Option* step =
        play->add_option("--time-step", a.timeStep,
                         "Seconds from frame to frame [a window: real time; headless: 1/60]")
            ->type_name("SECONDS")
            ->check(within(1e-6, 1e6));
    play->add_flag("--real-time", a.realTime, "Follow the clock, also headless")->excludes(step);
    play->add_option("--camera", a.view,
                     "Where to look at, from how far: metres and degrees; on a planet X0,Y0 are "
                     "longitude and latitude")
        ->type_name("X0,Y0,THETA,PHI,D")
        ->check(validView());
    play->add_option("--screenshot", a.run.screenshot, "Write the last frame (PNG)")
        ->type_name("FILE");
    play->add_option("--script", a.run.script, "Run the lines of a file; '-' answers each line")
        ->type_name("FILE");
    play->add_option("--metrics", a.run.metrics, "Write counts and times (JSON)")
        ->type_name("FILE");
    play->add_option("--trace", a.run.trace, "Write when each task ran (opens in Perfetto)")
        ->type_name("FILE");
    play->add_flag(
        "--keep-going", a.run.player.keepGoing,
        "Draw what can be drawn despite errors of the archive, which are no failure then");
    play->add_option("--samples", a.samples, "Samples of a pixel [1] (more are not built yet)")
        ->type_name("N")
        ->check(within(1, 32));
    play->add_option("--max-anisotropy", a.run.player.maxAnisotropy,
                     "Cap on anisotropic filtering [1 on a software renderer]")
        ->type_name("N")
        ->check(within(1, 16));
    addCommon(*play, a);
}

void addOthers(CLI::App& app, Arguments& a) {
    CLI::App* check = app.add_subcommand("check", "Load and validate everything, draw nothing");
    check->add_option("archive", a.archives, "Archives: .xml files, .zip files, or folders")
        ->required();
    check->add_flag("--json", a.json, "Tell the problems as JSON");
    check->add_flag("--strict", a.strict, "Warnings are failures, too");
    check->add_flag("--unused", a.unused, "Warn of entries that nothing which is played uses");
    addCommon(*check, a);

    CLI::App* test = app.add_subcommand("test", "Run archive fixtures");
    test->add_option("path", a.archives, "Fixtures (folders with a script), or folders of them")
        ->required();
    test->add_flag("--update", a.update,
                   "Write expected pictures anew where others are drawn, and tell where the old "
                   "ones and the differences are to be seen");
    test->add_option("--junit", a.junit, "Also write the results as JUnit XML, for build servers")
        ->type_name("FILE");
    addCommon(*test, a);

    CLI::App* fresh = app.add_subcommand("new", "Make a working archive to start from");
    fresh->add_option("name", a.name, "The folder to make")->required();
    CLI::App* schema =
        app.add_subcommand("schema", "The schema of archives, or the reference manual");
    schema->add_option("--format", a.format, "xsd, rnc or md [xsd]")
        ->type_name("FORMAT")
        ->check(CLI::IsMember({"xsd", "rnc", "md"}).description(""));
    schema
        ->add_option("--output", a.output,
                     "Where to write it: a file, or a folder for md [standard output]")
        ->type_name("PATH");
    addCommon(*schema, a);
    CLI::App* pack = app.add_subcommand("pack", "Pack an archive into one file that plays");
    pack->add_option("archive", a.archive, "An .xml file, a .zip, or the folder of an archive")
        ->required();
    pack->add_option("output", a.output, "The .zip to write")->type_name("OUT.zip")->required();
    pack->footer(kPackFooter);
    addCommon(*pack, a);
}

int fail(int status, const std::string& message) {
    std::cerr << "terrane: " << message << "\n";
    return status;
}

/// What CLI11 does not say: that a word is no subcommand. Empty when it is one.
std::string unknownSubcommand(const std::string& word) {
    const std::vector<std::string> names{"play", "check", "test", "new", "schema", "pack"};
    const bool known = std::find(names.begin(), names.end(), word) != names.end();
    if (known || word.starts_with('-')) return {};
    const std::string near = nearestName(word, names);
    return "there is no subcommand '" + word + "'; " +
           (near.empty() ? "try --help" : "did you mean '" + near + "'?");
}

int play(const Registry& registry, Arguments& a) {
    if (a.samples > 1) return fail(kWrongUsage, "more than one sample is not built yet");
    PlayerOptions& player = a.run.player;
    player.archive = a.archive;
    player.paths = toPaths(a.paths);
    player.allocations = countedAllocations;
    a.run.window = a.headless.empty();
    if (a.headless == "egl") player.headless = HeadlessKind::egl;
    if (a.headless == "osmesa") player.headless = HeadlessKind::osmesa;
    // People want to see the time pass as it does; pictures are to be the same each time.
    if (a.timeStep)
        player.timeStep = *a.timeStep;
    else if (a.realTime || a.run.window)
        player.timeStep = 0;
    if (const auto size = parseSize(a.size)) {
        player.width = size->width;
        player.height = size->height;
    }
    if (!a.view.empty()) player.view = parseView(a.view);
    return run(registry, a.run, {std::cin, std::cout, std::cerr});
}

int check(const Registry& registry, const Arguments& a) {
    std::vector<Diagnostic> all;
    for (const std::string& archive : a.archives) {
        std::vector<Diagnostic> found = checkArchive(registry, archive, toPaths(a.paths), a.unused);
        all.insert(all.end(), found.begin(), found.end());
    }
    sortByPlace(all);
    const DiagnosticCounts counts = count(all);
    if (a.json) {
        std::cout << toJson(all) << "\n";
    } else {
        for (const Diagnostic& diagnostic : all)
            std::cerr << toString(diagnostic);
        std::cout << counts.toString() << "\n";
    }
    return counts.errors > 0 || (a.strict && counts.warnings > 0) ? kFailed : 0;
}

/// Pictures of failures go into a build folder if there is one here.
fs::path reportFolder() {
    std::error_code error;
    if (fs::is_directory("build", error)) return fs::path("build") / "fixtures";
    return fs::temp_directory_path(error) / "terrane-fixtures";
}

int test(const Registry& registry, const Arguments& a) {
    FixtureOptions options{.data = toPaths(a.paths),
                           .output = reportFolder(),
                           .updatePictures = a.update,
                           .junit = a.junit};
    const char* const data = std::getenv("TERRANE_TEST_DATA");
    options.data.push_back(data ? fs::path(data) : homeFolder() / ".." / "shared" / "data");
    return testFixtures(registry, toPaths(a.archives), options, std::cout);
}

int dispatch(const CLI::App& app, Arguments& a) {
    if (!a.plugin.empty()) return fail(kWrongUsage, "--plugin is not built yet");
    Registry registry;
    registerStandardTypes(registry);
    registerStandardPlugins(registry);
    if (app.got_subcommand("new")) return makeNewArchive(registry, a.name, std::cout, std::cerr);
    if (app.got_subcommand("play")) return play(registry, a);
    if (app.got_subcommand("check")) return check(registry, a);
    if (app.got_subcommand("schema"))
        return writeSchema(registry, a.format, a.output, std::cout, std::cerr);
    if (app.got_subcommand("pack"))
        return packCommand(registry, a.archive, toPaths(a.paths), a.output,
                           a.run.logLevel <= LogLevel::info, std::cout, std::cerr);
    return test(registry, a);
}

} // namespace

int main(int count, char** words) {
    CLI::App app("Terrane: landscapes, from one valley to a whole planet, described by archives.",
                 "terrane");
    app.footer(kExamples);
    app.require_subcommand(1);
    app.set_version_flag("--version", "terrane " TERRANE_VERSION);
    Arguments arguments;
    addPlay(app, arguments);
    addOthers(app, arguments);
    const std::string unknown = count > 1 ? unknownSubcommand(words[1]) : std::string();
    if (!unknown.empty()) return fail(kWrongUsage, unknown);
    try {
        app.parse(count, words);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : kWrongUsage;
    }
    return dispatch(app, arguments);
}
