// SPDX-License-Identifier: BSD-3-Clause
#include "resource/archive_world.h"

#include <doctest/doctest.h>

using namespace terrane;
using namespace terrane::test;

TEST_CASE("a wrong element is told where it stands") {
    struct Row {
        std::string name;
        const char* entries; // '^' marks the places
        std::vector<std::string> codes;
    };
    const Row rows[] = {
        {"nothing wrong",
         R"(<basket name="b"><apple/><lid low="0" high="1"/><uniform3f name="u"/></basket>)",
         {}},
        {"an unknown type", R"(^<aple name="a"/>)", {"unknown-element"}},
        {"an unknown child", R"(<basket name="b"><apple/>^<stone/></basket>)", {"unknown-element"}},
        {"a resource that may not stand here",
         R"(<basket name="b"><apple/>^<mesh source="m"/></basket>)",
         {"unknown-element"}},
        {"a child of what has none", R"(<apple name="a">^<apple/></apple>)", {"unknown-element"}},
        {"no child where one is needed", R"(^<basket name="b"/>)", {"missing-element"}},
        {"too many children",
         R"(^<basket name="b"><apple/><apple/><pear kind="p"/><apple/></basket>)",
         {"too-many-elements"}},
        {"too many lids",
         R"(^<basket name="b"><apple/><lid/><lid/></basket>)",
         {"too-many-elements"}},
        {"a missing attribute", R"(^<pear name="p"/>)", {"missing-attribute"}},
        {"a missing attribute of a child",
         R"(<basket name="b">
            ^<pear/></basket>)",
         {"missing-attribute"}},
        {"a rule across attributes",
         R"(<basket name="b"><apple/><lid high="1" low="^2"/></basket>)",
         {"out-of-range"}},
        {"no rule where a value is wrong already",
         R"(<basket name="b"><apple/><lid high="^x" low="2"/></basket>)",
         {"wrong-kind"}},
        {"a tag that starts as another",
         R"(<basket name="b"><apple/><uniformX name="u"/>^<unifor/></basket>)",
         {"unknown-element"}},
        {"a missing attribute of a prefixed tag",
         R"(<basket name="b"><apple/>^<uniform1f x="1"/></basket>)",
         {"missing-attribute"}},
        {"keyed children",
         R"(<shelf name="s"><apple id="a"/><shelf id="t"><pear id="p" kind="k"/></shelf></shelf>)",
         {}},
        {"a key that is missing", R"(<shelf name="s">^<apple/></shelf>)", {"missing-attribute"}},
        {"a key where none is needed",
         R"(<basket name="b"><apple ^id="x"/></basket>)",
         {"unknown-attribute"}},
        {"an unknown type among keyed children",
         R"(<shelf name="s">^<appel id="a"/></shelf>)",
         {"unknown-element"}},
        {"a type of a later version",
         R"(^<mould name="m" any="x"><thing/></mould>)",
         {"not-built-yet"}},
        {"a type of a later version among children",
         R"(<basket name="b">^<mould any="x"/></basket>)",
         {"not-built-yet"}},
        {"text and what is left of a tag",
         R"(<basket name="b"> ^/> <apple/></basket>)",
         {"text-ignored"}},
        {"text where anything is allowed", R"(^<mould name="m">words</mould>)", {"not-built-yet"}},
        {"an entry without a name", R"(^<apple/>)", {"unnamed-entry"}},
        {"a misspelt name", R"(^<apple ^nmae="a"/>)", {"unnamed-entry", "unknown-attribute"}},
        {"an element that nobody checked",
         R"(<crate name="c" ^any="1">^<apple/></crate>)",
         {"unknown-attribute", "unknown-element"}},
        {"an attribute that stands for all",
         R"(<apple name="a"/><copy name="c" favourite="a" ^any="1"><stone/> words </copy>)",
         {"unknown-attribute"}},
        {"nothing that stands for all",
         R"(<copy name="c" ^any="1">^<stone/></copy>)",
         {"unknown-attribute", "unknown-element"}},
        {"an element for the player", R"(<player low="1"/>)", {}},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        const MarkedText marked("<archive>" + std::string(row.entries) + "</archive>");
        ArchiveWorld world;
        world.add(marked.text);
        world.manager->loadAll();
        CHECK(problems(world.diagnostics) == expected(marked, row.codes));
    }
}

TEST_CASE("all problems of an archive are told in one run, in the same order each time") {
    const MarkedText marked(R"(<?xml version="1.0"?>
<archive>
    <shelf name="s" ^nmae="t">
        <basket id="b" ^x="">
            <apple seeds="^x"/>
            <pear kind="k" next="^nobody"/>
            ^<pear/>
        </basket>
    </shelf>
    ^<aple name="a"/>
    <apple name="b" friend="^s" file="^gone.png"/>
    <apple name="c" file="^gone.png"/>
    <pear name="d" kind="k" next="^d"/>
    <apple name="d2" colour="^PINK" friends="d,^e"/>
</archive>
)");
    const std::vector<std::string> codes{"unknown-attribute",  "unknown-attribute",
                                         "wrong-kind",         "unknown-resource",
                                         "missing-attribute",  "unknown-element",
                                         "mistyped-reference", "file-missing",
                                         "file-missing",       "cycle",
                                         "unknown-word",       "unknown-resource"};
    std::vector<std::string> first;
    for (int run = 0; run < 3; ++run) {
        ArchiveWorld world;
        world.add(marked.text);
        world.manager->loadAll();
        CHECK(problems(world.diagnostics) == expected(marked, codes));
        if (run == 0) first = reports(world.diagnostics);
        CHECK(reports(world.diagnostics) == first);
        CHECK(world.diagnostics.errors() == codes.size());
    }
}

TEST_CASE("what the original did not check is a warning") {
    ArchiveWorld world;
    world.load(
        R"(<crate name="c" any="1"/><apple name="a"/><copy name="d" favourite="a" any="1"/>)");
    CHECK(world.diagnostics.errors() == 0);
    CHECK(world.diagnostics.warnings() == 2);
    CHECK(world.manager->get<Basket>("c"));
    CHECK(world.manager->get<Basket>("d"));
}

TEST_CASE("children are described and built in document order") {
    ArchiveWorld world;
    world.load(
        R"(<basket name="b"><uniform1f name="u" x="2"/><apple/><lid/><pear kind="k"/></basket>)");
    CHECK(world.diagnostics.all().empty());
    CHECK(world.log.lines ==
          std::vector<std::string>{"make apple b", "make pear b", "make basket b"});
    const ElementDescription& d = *world.manager->entries().at("b")->description;
    REQUIRE(d.children.size() == 4);
    CHECK(d.children[0].as<UniformDescription>()->x == 2.f);
    CHECK(d.children[0].description->tag == "uniform1f");
    CHECK(d.children[0].as<LidDescription>() == nullptr);
    CHECK(d.children[0].resource == nullptr);
    CHECK(d.children[1].built<Apple>() != nullptr);
    CHECK(d.children[1].built<Fruit>() != nullptr);
    CHECK(d.children[1].built<Pear>() == nullptr);
    CHECK(d.children[2].as<LidDescription>() != nullptr);
}

TEST_CASE("keyed children keep their keys") {
    ArchiveWorld world;
    world.load(R"(<shelf name="s"><apple id="a" name="n"/><shelf id="t"/></shelf>)");
    CHECK(world.diagnostics.all().empty());
    const ElementDescription& d = *world.manager->entries().at("s")->description;
    CHECK(*d.children[0].description->id == "a");
    CHECK(*d.children[0].description->name == "n");
    CHECK(*d.children[1].description->id == "t");
}

TEST_CASE("wrong elements get the nearest right one") {
    struct Row {
        const char* entries;
        const char* suggestion;
        const char* expected;
    };
    const Row rows[] = {
        {R"(<aple name="a"/>)", "apple", ""},
        {R"(<plyer/>)", "player", ""},
        {R"(<basket name="b"><apple/><lit/></basket>)", "lid", "'lid', 'uniform', 'apple'"},
        {R"(<apple name="b"><leaf/></apple>)", "", "no child element"},
        {R"(<shelf name="s"><baskte id="b"/></shelf>)", "basket", ""},
    };
    for (const Row& row : rows) {
        CAPTURE(std::string(row.entries));
        ArchiveWorld world;
        world.load(row.entries);
        const Diagnostic* const d = world.find("unknown-element");
        REQUIRE(d);
        CHECK(d->suggestion == row.suggestion);
        CHECK(d->expected.find(row.expected) != std::string::npos);
    }
}

TEST_CASE("a tag declared again replaces the earlier one") {
    Registry registry;
    declareTestTypes(registry);
    registry.resource<Apple, ElementDescription>("apple", "Another one.");
    CHECK(registry.find("apple")->summary == "Another one.");
    CHECK(registry.find("apple")->attributes.empty());
    CHECK_FALSE(registry.find("apple")->isA(typeid(Fruit)));
    CHECK(registry.tagsOf(typeid(Fruit)) == std::vector<std::string>{"mould", "pear"});
    CHECK(registry.find("APPLE") == nullptr);
    CHECK(registry.findTopLevel("player") != nullptr);
    CHECK(registry.findTopLevel("apple") == nullptr);
}
