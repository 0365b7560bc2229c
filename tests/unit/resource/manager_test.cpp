// SPDX-License-Identifier: BSD-3-Clause
#include "resource/archive_world.h"
#include "resource/unused_resources.h"

#include <algorithm>
#include <doctest/doctest.h>

using namespace terrane;
using namespace terrane::test;

namespace {

using Lines = std::vector<std::string>;

Lines names(const std::vector<ResourceEntry*>& entries) {
    Lines result;
    for (const ResourceEntry* entry : entries)
        result.push_back(entry->name);
    std::sort(result.begin(), result.end());
    return result;
}

ResourceEntry::State stateOf(const ArchiveWorld& world, const std::string& name) {
    return world.manager->entries().at(name)->state;
}

using State = ResourceEntry::State;

} // namespace

TEST_CASE("a resource is built once, after what it refers to") {
    ArchiveWorld world;
    world.add(R"(<archive>
        <apple name="a" friend="b" friends="c,d"/>
        <apple name="b" friend="d"/>
        <apple name="c"/>
        <apple name="unused"/>
    </archive>)");
    world.folder.file("d.xml", "<apple/>");
    const Ref<Fruit> a = world.manager->get<Fruit>("a");
    REQUIRE(a);
    CHECK(a->name() == "apple a");
    CHECK(world.manager->get<Apple>("a").get() == a.get());
    CHECK(world.log.lines == Lines{"make apple d", "make apple b", "make apple c", "make apple a"});
    CHECK(world.diagnostics.all().empty());

    CHECK(names(world.manager->entries().at("a")->dependencies) == Lines{"b", "c", "d"});
    CHECK(names(world.manager->entries().at("b")->dependencies) == Lines{"d"});
    CHECK(names(world.manager->entries().at("d")->dependents) == Lines{"a", "b"});
    CHECK(world.manager->entries().at("a")->dependents.empty());
    CHECK(world.manager->entries().count("unused") == 0);

    const auto* d =
        static_cast<AppleDescription*>(world.manager->entries().at("a")->description.get());
    CHECK(d->friendly->name() == "apple b");
    CHECK(d->friends[1]->name() == "apple d");
}

TEST_CASE("naming something twice is one dependency") {
    ArchiveWorld world;
    world.load(R"(<apple name="a" friend="b" friends="b,b"/><apple name="b"/>)");
    CHECK(names(world.manager->entries().at("a")->dependencies) == Lines{"b"});
    CHECK(names(world.manager->entries().at("b")->dependents) == Lines{"a"});
}

TEST_CASE("references of nested elements are dependencies of the entry") {
    ArchiveWorld world;
    world.load(R"(<basket name="s"><apple friend="a"/></basket><apple name="a"/>)");
    CHECK(world.diagnostics.all().empty());
    CHECK(names(world.manager->entries().at("s")->dependencies) == Lines{"a"});
    CHECK(world.log.lines == Lines{"make apple a", "make apple s", "make basket s"});
}

TEST_CASE("resources go in the reverse order of their making") {
    ArchiveWorld world;
    world.load(R"(<basket name="z"><apple friend="a"/><pear kind="k" next="m"/></basket>
                  <apple name="m" friend="a"/><apple name="a"/>)");
    const Lines made = world.log.lines;
    world.log.lines.clear();
    world.manager.reset();
    CHECK(made ==
          Lines{"make apple a", "make apple m", "make apple z", "make pear z", "make basket z"});
    REQUIRE(world.log.lines.size() == 5);
    CHECK(world.log.lines.front() == "drop basket z");
    CHECK(world.log.lines[3] == "drop apple m");
    CHECK(world.log.lines[4] == "drop apple a");
}

TEST_CASE("what was built for a resource that failed goes at once") {
    ArchiveWorld world;
    world.registry.resource<Basket, ElementDescription>("bag", "One that always fails.")
        .children<Fruit>("fruits")
        .build([](const ElementDescription&, BuildContext&) { return std::shared_ptr<Basket>(); });
    world.load(R"(<apple name="a"/><bag name="b"><apple friend="a"/></bag>)");
    CHECK(world.log.lines == Lines{"make apple a", "make apple b", "drop apple b"});
    CHECK(stateOf(world, "b") == State::failed);
}

TEST_CASE("a cycle is told with its chain") {
    struct Row {
        std::string name;
        const char* entries; // '^' marks the place
        const char* message;
        std::vector<std::string> chain;
    };
    const Row rows[] = {
        {"itself",
         R"(<apple name="a" friend="^a"/>)",
         "apple 'a' needs itself: a > a",
         {"apple 'a'"}},
        {"three",
         R"(<apple name="a" friend="b"/>
                     <apple name="b" friends="x,c"/><apple name="x"/>
                     <apple name="c" friend="^a"/>)",
         "apple 'a' needs itself: a > b > c > a",
         {"apple 'c', named at ", "apple 'b', named at ", "apple 'a'"}},
        {"behind a tail",
         R"(<apple name="a" friend="b"/><apple name="b" friend="c"/>
                             <apple name="c" friend="^b"/>)",
         "apple 'b' needs itself: b > c > b",
         {"apple 'c', named at ", "apple 'b', named at ", "apple 'a'"}},
        {"through a nested element",
         R"(<basket name="a"><apple/><pear kind="k" next="b"/></basket>
                             <apple name="b" worm="c"/><shelf name="c"/>)",
         nullptr,
         {}},
        {"through a nested reference",
         R"(<shelf name="a"><apple id="i" friend="b"/></shelf>
                             <pear name="b" kind="k" next="^b"/>)",
         "pear 'b' needs itself: b > b",
         {"pear 'b', named at ", "shelf 'a'"}},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        const MarkedText marked("<archive>" + std::string(row.entries) + "</archive>");
        ArchiveWorld world;
        world.add(marked.text);
        world.manager->loadAll();
        const Diagnostic* const d = world.find("cycle");
        if (!row.message) {
            CHECK_FALSE(d);
            continue;
        }
        REQUIRE(d);
        CHECK(problems(world.diagnostics) == expected(marked, {"cycle"}));
        CHECK(d->message == row.message);
        REQUIRE(d->chain.size() == row.chain.size());
        for (std::size_t i = 0; i < row.chain.size(); ++i)
            CHECK(d->chain[i].starts_with(row.chain[i]));
    }
}

TEST_CASE("a reference on demand may close a circle") {
    ArchiveWorld world;
    world.load(R"(<apple name="a" later="b"/><basket name="b" favourite="a"><apple/></basket>)");
    CHECK(world.diagnostics.all().empty());
    CHECK(stateOf(world, "a") == State::ready);
    CHECK(stateOf(world, "b") == State::ready);
    CHECK(names(world.manager->entries().at("a")->dependencies) == Lines{"b"});
    CHECK(names(world.manager->entries().at("b")->dependencies) == Lines{"a"});
}

TEST_CASE("a reference on demand is loaded when it is asked for") {
    ArchiveWorld world;
    world.add(
        R"(<archive><apple name="a" later="b"/><basket name="b"><apple/></basket></archive>)");
    REQUIRE(world.manager->get<Apple>("a"));
    CHECK(world.manager->entries().count("b") == 0);
    ResourceEntry& a = *world.manager->entries().at("a");
    const auto* d = static_cast<AppleDescription*>(a.description.get());
    CHECK_FALSE(d->later);
    const BuildContext context(*world.manager, a, world.diagnostics);
    REQUIRE(context.load(d->later));
    CHECK(context.load(d->later) == d->later.get());
    CHECK(names(a.dependencies) == Lines{"b"});
    CHECK(context.load<Fruit>("nobody", {}).get() == nullptr);
    CHECK(world.diagnostics.errors() == 1);
}

TEST_CASE("mistyped and dangling references are told with what would do") {
    ArchiveWorld world;
    const MarkedText marked(R"(<archive>
        <apple name="apple1" friend="^basket1" friends="^nobody,^aple1"/>
        <basket name="basket1"><apple/></basket>
        <basket name="basket2"><pear kind="k" next="^basket1"/></basket>
        <apple name="basket3" worm="^basket2"/>
    </archive>)");
    world.add(marked.text);
    world.manager->loadAll();
    CHECK(problems(world.diagnostics) ==
          expected(marked, {"mistyped-reference", "unknown-resource", "unknown-resource",
                            "mistyped-reference", "mistyped-reference"}));
    const Diagnostic* const mistyped = world.find("mistyped-reference");
    CHECK(mistyped->message == "'basket1' is a basket");
    CHECK(mistyped->expected == "fruit ('apple', 'mould' or 'pear')");
    CHECK(mistyped->suggestion == "basket3");
    CHECK(mistyped->chain == Lines{"apple 'apple1'"});
    for (const Diagnostic& d : world.diagnostics.all()) {
        if (d.message == "there is no resource 'aple1'") CHECK(d.suggestion == "apple1");
        if (d.message == "there is no resource 'nobody'") CHECK(d.suggestion.empty());
    }
}

TEST_CASE("a file is suggested for a dangling reference too") {
    ArchiveWorld world;
    world.folder.file("folder/grass.xml", "<apple/>");
    world.load(R"(<apple name="a" friend="folder/gras"/>)");
    REQUIRE(world.find("unknown-resource"));
    CHECK(world.find("unknown-resource")->suggestion == "folder/grass");
}

TEST_CASE("what fails takes along what needs it, and no more") {
    struct Row {
        std::string name;
        const char* entries;
        std::vector<std::pair<const char*, State>> states;
        std::size_t errors;
    };
    const Row rows[] = {
        {"a dangling reference",
         R"(<apple name="a" friend="b"/><apple name="b" friend="x"/>)",
         {{"a", State::failed}, {"b", State::failed}},
         1},
        {"an invalid entry",
         R"(<apple name="a" friend="b"/><apple name="b" seeds="x"/><apple name="c"/>)",
         {{"a", State::failed}, {"b", State::failed}, {"c", State::ready}},
         1},
        {"a reference of a nested element costs that element",
         R"(<basket name="a"><apple/><apple friend="x"/></basket>)",
         {{"a", State::ready}},
         1},
        {"an invalid nested element costs the entry",
         R"(<basket name="a"><apple/><apple seeds="x"/></basket>)",
         {{"a", State::failed}},
         1},
        {"an element whose file is missing",
         R"(<basket name="a"><apple/><apple file="x"/></basket>)",
         {{"a", State::ready}},
         1},
        {"a reference on demand costs nothing",
         R"(<apple name="a" later="x"/>)",
         {{"a", State::ready}},
         1},
        {"a type of a later version",
         R"(<apple name="a" worm="m"/><mould name="m"/>)",
         {{"a", State::ready}, {"m", State::planned}},
         0},
        {"a type of a later version that is needed",
         R"(<program name="p"><module name="m"/></program><mould name="m"/>)",
         {{"m", State::planned}},
         0},
        {"a cycle",
         R"(<apple name="a" friend="b"/><apple name="b" friend="a"/><apple name="c" friend="b"/>)",
         {{"a", State::failed}, {"b", State::failed}, {"c", State::failed}},
         1},
        {"an unknown type",
         R"(<aple name="a"/><apple name="b" friend="a"/>)",
         {{"a", State::failed}, {"b", State::failed}},
         1},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        ArchiveWorld world;
        world.load(row.entries);
        for (const auto& [name, state] : row.states) {
            CAPTURE(std::string(name));
            CHECK(stateOf(world, name) == state);
            CHECK((world.manager->entries().at(name)->instance != nullptr) ==
                  (state == State::ready));
        }
        CHECK(world.diagnostics.errors() == row.errors);
    }
}

TEST_CASE("the element that a failed reference costs is left out") {
    ArchiveWorld world;
    world.load(R"(<basket name="b"><apple/><apple friend="x"/><pear kind="k"/></basket>)");
    const ElementDescription& d = *world.manager->entries().at("b")->description;
    CHECK(d.children[0].resource);
    CHECK_FALSE(d.children[1].resource);
    CHECK(d.children[2].resource);
}

TEST_CASE("a type of a later version is told once where it stands") {
    ArchiveWorld world;
    const MarkedText marked(R"(<archive><apple name="a" worm="m" friends="m,b"/>^<mould name="m"/>
        <apple name="b" worm="m"/></archive>)");
    world.add(marked.text);
    world.manager->loadAll();
    CHECK(problems(world.diagnostics) == expected(marked, {"not-built-yet"}));
    CHECK(world.diagnostics.errors() == 0);
    CHECK(world.diagnostics.warnings() == 1);
}

TEST_CASE("a resource made from its name is blamed on whoever names it") {
    struct Row {
        std::string name;
        const char* entries;
        std::vector<std::string> codes;
    };
    const Row rows[] = {
        {"an image that is missing", R"(<frame name="f" texture="^gras.png"/>)", {"file-missing"}},
        {"a mesh that is missing", R"(<frame name="f" mesh="^cube.mesh"/>)", {"file-missing"}},
        {"an image elsewhere", R"(<frame name="f" texture="^../a.png"/>)", {"name-leaves-folders"}},
        {"a buffer of no size",
         R"(<frame name="f" texture="^^renderbuffer-x-RGBA8"/>)",
         {"wrong-kind", "wrong-kind"}},
        {"a buffer that is too small",
         R"(<frame name="f" texture="^^renderbuffer-0-RGBA8"/>)",
         {"out-of-range", "out-of-range"}},
        {"half the name of a buffer",
         R"(<frame name="f" texture="^renderbuffer-64"/>)",
         {"unknown-resource"}},
        {"modules of a program",
         R"(<module name="b"/><frame name="f" program="^m;b;^c;"/>)",
         {"unknown-resource", "unknown-resource"}},
        {"a module of another type",
         R"(<module name="b"/><apple name="a"/><frame name="f" program="b;^a;"/>)",
         {"mistyped-reference"}},
        {"an empty piece", R"(<module name="a"/><frame name="f" program="^a;;"/>)", {"wrong-kind"}},
        {"a tail that is dropped",
         R"(<module name="a"/><frame name="f" program="^a;b"/>)",
         {"program-tail"}},
        {"a program of nothing", R"(<frame name="f" program="^;"/>)", {"missing-element"}},
        {"good ones",
         R"(<module name="a"/><frame name="f" program="a;" texture="good.png" mesh="good.mesh"/>)",
         {}},
    };
    struct FrameDescription : ElementDescription {
        Ref<Texture> texture;
        Ref<Mesh> mesh;
        Ref<Program> program;
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        const MarkedText marked("<archive>" + std::string(row.entries) + "</archive>");
        ArchiveWorld world;
        using F = FrameDescription;
        world.registry.resource<Basket, F>("frame", "Names things.")
            .attribute("texture", &F::texture, "a texture")
            .attribute("mesh", &F::mesh, "a mesh")
            .attribute("program", &F::program, "a program")
            .build([](const F&, BuildContext&) { return std::make_shared<Basket>("f", nullptr); });
        world.folder.file("good.png");
        world.folder.file("good.mesh");
        world.add(marked.text);
        world.manager->loadAll();
        CHECK(problems(world.diagnostics) == expected(marked, row.codes));
    }
}

TEST_CASE("the order of a program's modules is kept") {
    ArchiveWorld world;
    world.add(R"(<archive><module name="a"/><module name="b"/></archive>)");
    const auto ab = world.manager->get<Program>("a;b;");
    const auto ba = world.manager->get<Program>("b;a;");
    REQUIRE(ab);
    REQUIRE(ba);
    CHECK(ab->name() == "program+module a+module b");
    CHECK(ba->name() == "program+module b+module a");
    CHECK(names(world.manager->entries().at("a")->dependents) == Lines{"a;b;", "b;a;"});
}

TEST_CASE("a file that differs in case is told at the reference") {
    ArchiveWorld world;
    world.folder.file("params.xml", "<apple/>");
    const MarkedText marked(
        R"(<archive><apple name="a" friend="^Params"/><apple name="b" friend="Params"/></archive>)");
    world.add(marked.text);
    world.manager->loadAll();
    CHECK(problems(world.diagnostics) == expected(marked, {"case-differs"}));
    CHECK(stateOf(world, "a") == State::ready);
}

TEST_CASE("a damaged file is told in the file, once, whoever names it") {
    ArchiveWorld world;
    world.folder.file("bad.xml", "<apple\n  seeds=\"1/>");
    world.load(R"(<apple name="a" friend="bad"/><apple name="b" friend="bad"/>)");
    CHECK(reports(world.diagnostics) == Lines{"xml-syntax bad.xml:2:9"});
    CHECK(stateOf(world, "a") == State::failed);
    CHECK(stateOf(world, "bad") == State::failed);
}

TEST_CASE("a resource of its own file is told in that file, with the chain") {
    ArchiveWorld world;
    world.folder.file("file.xml", "<apple seeds=\"x\"\n friend=\"nobody\"/>");
    world.load(R"(<basket name="b" favourite="file"><apple/></basket>)");
    CHECK(reports(world.diagnostics) ==
          Lines{"wrong-kind file.xml:1:15", "unknown-resource file.xml:2:10"});
    for (const Diagnostic& d : world.diagnostics.all()) {
        REQUIRE(d.chain.size() == 2);
        CHECK(d.chain[0].starts_with("apple 'file', named at "));
        CHECK(d.chain[0].ends_with("a.xml:1:38"));
        CHECK(d.chain[1] == "basket 'b'");
    }
    CHECK(world.manager->entries().at("file")->descriptor == world.folder / "file.xml");
}

TEST_CASE("what needs data that is not prepared yet is left out without an error") {
    ArchiveWorld world;
    world.folder.file("prepare", "# makes: data.txt\n");
    world.load("<apple name=\"a\" file=\"data.txt\"/>");
    CHECK(problems(world.diagnostics) == Lines{"data-not-prepared 1:32"});
    CHECK(world.diagnostics.errors() + world.diagnostics.warnings() == 0);
    CHECK(stateOf(world, "a") == State::planned);
}

TEST_CASE("entries that none of the roots needs are told") {
    ArchiveWorld world;
    const MarkedText marked(R"(<archive>
<apple name="leaf"/>
<apple name="root" friend="leaf"/>
^<apple name="alone"/>
^<apple name="pair" friend="leaf"/>
<mould name="later"/>
</archive>)");
    REQUIRE(world.add(marked.text));
    world.manager->loadAll();
    const auto entry = [&](const char* name) { return world.manager->entries().at(name).get(); };
    world.diagnostics.clear();
    reportUnusedResources(*world.manager, {entry("root"), nullptr});
    CHECK(problems(world.diagnostics) == expected(marked, {"unused-resource", "unused-resource"}));
    world.diagnostics.clear();
    reportUnusedResources(*world.manager, {});
    CHECK(world.diagnostics.warnings() == 3); // nothing names them
}

TEST_CASE("files that a resource reads are recorded") {
    ArchiveWorld world;
    world.folder.file("data.txt");
    world.load(R"(<apple name="a" file="data.txt"/>)");
    const ResourceEntry& a = *world.manager->entries().at("a");
    CHECK(a.descriptor == world.folder.path() / "a.xml");
    REQUIRE(a.files.size() == 1);
    CHECK(a.files[0].name == "data.txt");
    CHECK(a.files[0].path == world.folder.path() / "data.txt");
}

TEST_CASE("chains of any sane length are followed, others are told") {
    const auto chainOf = [](int length) {
        std::string entries;
        for (int i = 0; i < length; ++i) {
            entries += "<apple name=\"a" + std::to_string(i) + "\"";
            if (i + 1 < length) entries += " friend=\"a" + std::to_string(i + 1) + "\"";
            entries += "/>";
        }
        return entries;
    };
    ArchiveWorld world;
    world.load(chainOf(400));
    CHECK(world.diagnostics.all().empty());
    ArchiveWorld deep;
    deep.load(chainOf(20000));
    CHECK(deep.find("too-deep"));
}

TEST_CASE("a service that the host does not provide is a mistake of the host") {
    ArchiveWorld world;
    world.load(R"(<apple name="a"/>)");
    const BuildContext context(*world.manager, *world.manager->entries().at("a"),
                               world.diagnostics);
    CHECK(&context.service<Log>() == &world.log);
    CHECK_THROWS_AS(context.service<TemporaryFolder>(), std::logic_error);
}
