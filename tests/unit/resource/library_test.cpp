// SPDX-License-Identifier: BSD-3-Clause
#include "resource/archive_world.h"

#include <cstdlib>
#include <doctest/doctest.h>

using namespace terrane;
using namespace terrane::test;
namespace fs = std::filesystem;

namespace {

// "apple 'label'" of what a name leads to: its tag and one telling attribute.
std::string lookUp(Library& library, const std::string& name) {
    const auto found = library.find(name);
    if (!found) return "nothing";
    std::string result = found->element.tag();
    for (const char* attribute : {"label", "source", "width"}) {
        const std::string value = found->element.attribute(attribute);
        if (!value.empty()) result += " " + value;
    }
    for (const XmlElement& child : found->element.children())
        result += " " + child.tag() + "=" + child.attribute("name");
    return result;
}

} // namespace

TEST_CASE("a name leads to one element, by rules in a fixed order") {
    ArchiveWorld world;
    world.folder.file("file.xml", R"(<apple label="file"/>)");
    world.folder.file("both.xml", R"(<apple label="file"/>)");
    world.folder.file("other.xml", R"(<apple name="someone else" label="other"/>)");
    world.folder.file("folder/deep.xml", R"(<apple label="deep"/>)");
    world.folder.file("x;y;.xml", R"(<program><module name="explicit"/></program>)");
    world.folder.file("grass.png.xml", R"(<apple label="never"/>)");
    world.folder.file("Params.xml", R"(<apple label="params"/>)");
    world.folder.file("broken.xml", R"(<apple label="broken">)");
    world.folder.folder("directory.xml");
    world.add(R"(<anything>
        <apple name="entry" label="1"/>
        <apple name="both" label="archive"/>
        <group><apple name="hidden" label="nested"/></group>
        <program name="m;n;"><module name="named"/></program>
    </anything>)");
    world.add(R"(<archive>
        <apple name="second" label="2"/>
        <pear name="entry" label="shadowed"/>
    </archive>)",
              "b.xml");

    struct Row {
        std::string name;
        const char* element;
    };
    const Row rows[] = {
        {"entry", "apple 1"},
        {"second", "apple 2"},
        {"both", "apple archive"}, // an entry shadows a file
        {"hidden", "nothing"},     // only direct children of the root
        {"file", "apple file"},
        {"other", "apple other"}, // the file's own name is ignored
        {"someone else", "nothing"},
        {"folder/deep", "apple deep"},
        {"folder\\deep", "apple deep"},
        {"deep", "nothing"},
        {"params", "apple params"}, // another case
        {"PARAMS", "apple params"},
        {"Entry", "nothing"}, // entries are case sensitive
        {"broken", "nothing"},
        {"directory", "nothing"},
        {"", "nothing"},
        {"../file", "nothing"},
        {"/etc/passwd", "nothing"},
        {"nobody", "nothing"},

        {"grass.png", "texture2D grass.png"}, // whatever files and entries say
        {"a.jpg", "texture2D a.jpg"},
        {"a.bmp", "texture2D a.bmp"},
        {"folder/a.tga", "texture2D folder/a.tga"},
        {"a;b.png", "texture2D a;b.png"},
        {".png", "nothing"},
        {"a.PNG", "nothing"},
        {"a.gif", "nothing"},
        {"cube.mesh", "mesh cube.mesh"},
        {".mesh", "mesh .mesh"},
        {"cube.MESH", "nothing"},
        {"a&\"<b>.png", "texture2D a&\"<b>.png"},

        {"renderbuffer-64-RGBA8", "texture2D 64"},
        {"renderbuffer-512-R32F-second", "texture2D 512"},
        {"renderbuffer-a\"b-R", "texture2D a\"b"},
        {"renderbuffer-64", "nothing"},
        {"renderbuffer", "nothing"},

        {"a;", "program module=a"},
        {"a;b;", "program module=a module=b"},
        {"b;a;", "program module=b module=a"},
        {"a;b", "program module=a"}, // the tail is dropped
        {"a;b.mesh", "program module=a"},
        {"x;y;", "program module=explicit"},
        {"m;n;", "program module=named"},
        {";", "program"},
        {"a;;b;", "program module=a module= module=b"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        CHECK(lookUp(*world.library, row.name) == std::string(row.element));
    }
    CHECK(world.library->isDamaged("broken"));
    CHECK_FALSE(world.library->isDamaged("nobody"));
}

TEST_CASE("a damaged file is told once and the next folder is tried") {
    TemporaryFolder folder;
    folder.file("one/a.xml", "<apple");
    folder.file("two/a.xml", R"(<apple label="two"/>)");
    SearchPath search;
    search.add(folder.path() / "one");
    search.add(folder.path() / "two");
    Diagnostics diagnostics;
    Library library(search, diagnostics);
    CHECK(lookUp(library, "a") == "apple two");
    CHECK(lookUp(library, "a") == "apple two");
    CHECK(reports(diagnostics) == std::vector<std::string>{"xml-syntax a.xml:1:1"});
}

TEST_CASE("an archive that can't be read is told") {
    ArchiveWorld world;
    CHECK_FALSE(world.library->addArchive(world.folder.path() / "gone.xml"));
    CHECK_FALSE(world.library->addArchive(world.folder.folder("folder.xml")));
    CHECK_FALSE(world.add("<archive>", "damaged.xml"));
    CHECK(reports(world.diagnostics) == std::vector<std::string>{"file-missing :0:0",
                                                                 "file-missing :0:0",
                                                                 "xml-syntax damaged.xml:1:1"});
    CHECK(world.library->entries().empty());
}

TEST_CASE("entries that no name leads to are told") {
    const MarkedText marked(R"(<archive>
        <apple name="a"/>
        ^<apple name="a" seeds="^x"/>
        ^<texture2D name="grass.png" ^kolour=""/>
        ^<mesh name="cube.mesh" source="m"/>
        ^<texture2D name="renderbuffer-8-R" internalformat="R8"/>
        <program name="a;b;"/>
    </archive>)");
    ArchiveWorld world;
    world.add(marked.text);
    const std::vector<std::string> codes{"duplicate-name", "reserved-name", "reserved-name",
                                         "reserved-name"};
    const MarkedText names(R"(<archive>
        <apple name="a"/>
        ^<apple name="a" seeds="x"/>
        ^<texture2D name="grass.png" kolour=""/>
        ^<mesh name="cube.mesh" source="m"/>
        ^<texture2D name="renderbuffer-8-R" internalformat="R8"/>
        <program name="a;b;"/>
    </archive>)");
    CHECK(problems(world.diagnostics) == expected(names, codes));
    CHECK(world.diagnostics.errors() == 0);
    // They are checked all the same.
    world.manager->loadAll();
    CHECK(world.find("wrong-kind"));
    CHECK(world.find("unknown-attribute"));
}

TEST_CASE("entries of a second archive are duplicates too") {
    ArchiveWorld world;
    world.add(R"(<archive><apple name="a"/></archive>)", "one.xml");
    world.add("<archive>\n<apple name=\"a\"/></archive>", "two.xml");
    CHECK(reports(world.diagnostics) == std::vector<std::string>{"duplicate-name two.xml:2:1"});
    CHECK(world.find("duplicate-name")->message.find("one.xml:1:10") != std::string::npos);
}

TEST_CASE("data files are found, or told") {
    ArchiveWorld world;
    world.folder.file("textures/Grass.png");
    world.folder.folder("textures/folder.png");
    const auto find = [&](const std::string& name) {
        world.diagnostics.clear();
        return world.library->findFile(name, {}, world.diagnostics);
    };
    CHECK(find("textures/Grass.png"));
    CHECK(world.diagnostics.all().empty());
    CHECK(find("textures\\Grass.png"));
    CHECK(find("textures/grass.png"));
    CHECK(world.find("case-differs"));
    CHECK(world.diagnostics.errors() == 0);
    CHECK_FALSE(find("textures/Gras.png"));
    CHECK(world.find("file-missing")->suggestion == "textures/Grass.png");
    CHECK_FALSE(find("textures/folder.png"));
    CHECK(world.find("file-missing"));
    CHECK_FALSE(find("../a"));
    CHECK(world.find("name-leaves-folders"));
    CHECK_FALSE(find(""));
    CHECK(world.diagnostics.errors() == 1);
}

TEST_CASE("links in the folders are followed, wherever they lead") {
    ArchiveWorld world;
    TemporaryFolder elsewhere;
    elsewhere.file("grass.png");
    std::filesystem::create_directory_symlink(elsewhere.path(), world.folder.path() / "textures");
    CHECK(world.library->findFile("textures/grass.png", {}, world.diagnostics));
    CHECK(world.diagnostics.all().empty());
}

TEST_CASE("data that a script has yet to prepare is told as such") {
    ArchiveWorld world;
    world.folder.file("prepare", "#!/bin/sh\n# makes: DEM.dat\r\n# makes:  tiles/*.dat \n"
                                 "#makes: no.dat\necho # makes: neither.dat\n"
                                 "# makes: a*b*c\n# makes: e**\n");
    struct Row {
        const char* name;
        const char* code;
    };
    const Row rows[] = {
        {"DEM.dat", "data-not-prepared"},
        {"tiles/0/1.dat", "data-not-prepared"},
        {"tiles/.dat", "data-not-prepared"},
        {"axbyc", "data-not-prepared"},
        {"abc", "data-not-prepared"},
        {"abbcc", "data-not-prepared"},
        {"e", "data-not-prepared"},
        {"dem.dat", "file-missing"},
        {"x/DEM.dat", "file-missing"},
        {"tiles/0.png", "file-missing"},
        {"tiles/dat", "file-missing"},
        {"no.dat", "file-missing"},
        {"neither.dat", "file-missing"},
        {"ac", "file-missing"},
        {"abcd", "file-missing"},
        {"../DEM.dat", "name-leaves-folders"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        world.diagnostics.clear();
        CHECK_FALSE(world.library->findFile(row.name, {}, world.diagnostics));
        CHECK(world.find(row.code));
    }
}

TEST_CASE("a path given by a user stands for an archive") {
    struct Row {
        std::string name;
        std::vector<std::pair<const char*, const char*>> files;
        const char* path;     // what the user gives
        const char* archive;  // empty: none
        const char* expected; // a part of the diagnostic's expectation
    };
    const char* const archive = "<!-- c --><archive/>";
    const Row rows[] = {
        {"a file", {{"some.xml", archive}}, "some.xml", "some.xml", ""},
        {"archive.xml first",
         {{"f/archive.xml", archive}, {"f/f.xml", archive}, {"f/helloworld.xml", archive}},
         "f",
         "f/archive.xml",
         ""},
        {"then the folder's name",
         {{"f/f.xml", "<x/>"}, {"f/helloworld.xml", archive}},
         "f",
         "f/f.xml",
         ""},
        {"the folder's name behind a slash", {{"f/f.xml", archive}}, "f/", "f/f.xml", ""},
        {"the folder's name behind dots",
         {{"f/f.xml", archive}, {"f/g/x", ""}},
         "f/g/..",
         "f/g/../f.xml",
         ""},
        {"then helloworld",
         {{"f/helloworld.xml", archive}, {"f/other.xml", archive}},
         "f",
         "f/helloworld.xml",
         ""},
        {"then the only archive",
         {{"f/one.xml", archive}, {"f/two.xml", "<method/>"}, {"f/a.txt", archive}},
         "f",
         "f/one.xml",
         ""},
        {"the only archive, damaged",
         {{"f/one.xml", "<archive><a></archive>"}, {"f/two.xml", "<x/>"}},
         "f",
         "f/one.xml",
         ""},
        {"two archives",
         {{"f/one.xml", archive}, {"f/two.xml", archive}},
         "f",
         "",
         "f/one.xml' or "},
        {"no archive", {{"f/one.xml", "<method/>"}}, "f", "", "archive.xml in it"},
        {"an empty folder", {{"f/g/x", ""}}, "f", "", "archive.xml in it"},
        {"a folder named like the archive",
         {{"f/archive.xml/x", ""}, {"f/one.xml", archive}},
         "f",
         "f/one.xml",
         ""},
        {"nothing", {}, "gone", "", "an .xml file, a .zip, or the folder"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        TemporaryFolder folder;
        for (const auto& [name, text] : row.files)
            folder.file(name, text);
        Diagnostics diagnostics;
        const auto found = resolveArchive(folder.path() / row.path, diagnostics);
        if (*row.archive) {
            REQUIRE(found);
            CHECK(found->path == folder.path() / row.archive);
            CHECK(diagnostics.all().empty());
        } else {
            CHECK_FALSE(found);
            REQUIRE(diagnostics.all().size() == 1);
            CHECK(diagnostics.all()[0].code == "no-archive");
            CAPTURE(diagnostics.all()[0].expected);
            CHECK(diagnostics.all()[0].expected.find(row.expected) != std::string::npos);
        }
    }
}

TEST_CASE("names are looked up in the folders of the design, in its order") {
    TemporaryFolder folder;
    const fs::path home = folder.folder("home");
    folder.folder("home/resources/shaders");
    folder.folder("home/resources/meshes");
    folder.file("examples/scene/archive.xml", "<archive/>");
    folder.folder("examples/textures");
    folder.folder("examples/meshes");
    folder.file("examples/shaders", "no folder");
    ::setenv("TERRANE_HOME", home.c_str(), 1);
    const SearchPath search = archiveSearchPath(folder.path() / "examples/scene/archive.xml",
                                                {folder.path() / "more", folder.path() / "last"});
    ::setenv("TERRANE_HOME", "/nowhere", 1);
    const SearchPath bare = archiveSearchPath("archive.xml", {});
    ::unsetenv("TERRANE_HOME");

    std::vector<std::string> shown;
    for (const fs::path& path : search.folders())
        shown.push_back(fs::relative(path, folder.path()).string());
    CHECK(shown == std::vector<std::string>{"examples/scene", "more", "last", "examples/textures",
                                            "examples/meshes", "home/resources/shaders",
                                            "home/resources/meshes"});
    REQUIRE_FALSE(bare.folders().empty());
    CHECK(bare.folders()[0] == ".");
    for (const fs::path& path : bare.folders())
        CHECK_FALSE(path.string().starts_with("resources"));
}
