// SPDX-License-Identifier: BSD-3-Clause
#include "resource/archive_world.h"

#include <clocale>
#include <cmath>
#include <doctest/doctest.h>

using namespace terrane;
using namespace terrane::test;

namespace {

// Loads one apple whose attributes are the text; the description that was read, or null.
struct AppleReading {
    explicit AppleReading(const std::string& attributes) {
        world.load("<apple name=\"a\" " + attributes + "/>");
        const auto found = world.manager->entries().find("a");
        if (found == world.manager->entries().end()) return;
        description = dynamic_cast<AppleDescription*>(found->second->description.get());
        built = found->second->instance != nullptr;
    }

    ArchiveWorld world;
    const AppleDescription* description = nullptr;
    bool built = false;
};

} // namespace

TEST_CASE("a wrong attribute is told where it stands") {
    struct Row {
        std::string name;
        const char* attributes; // '^' marks the places
        std::vector<std::string> codes;
        bool built;
    };
    const Row rows[] = {
        {"nothing wrong", R"(ripe="true" seeds="3" weight="1" colour="RED" note="!")", {}, true},
        {"an unknown attribute", R"(^kolour="RED")", {"unknown-attribute"}, false},
        {"the end of a known name is another name",
         R"(^our="RED" ^ame="x")",
         {"unknown-attribute", "unknown-attribute"},
         false},
        {"case matters", R"(^Seeds="3")", {"unknown-attribute"}, false},
        {"an id where none is needed", R"(^id="x")", {"unknown-attribute"}, false},
        {"an attribute given twice", R"(seeds="3" ^seeds="3")", {"duplicate-attribute"}, false},
        {"an attribute given by both its names",
         R"(sugar="1" ^sweetness="1")",
         {"duplicate-attribute"},
         false},
        {"an attribute without effect yet", R"(^smell="good")", {"not-built-yet"}, true},

        {"a boolean is true only as 'true'", R"(ripe="^TRUE")", {"boolean-word"}, true},
        {"another word for a boolean", R"(visible="^no")", {"boolean-word"}, true},

        {"no integer", R"(seeds="^many")", {"wrong-kind"}, false},
        {"nothing for an integer", R"(seeds="^")", {"wrong-kind"}, false},
        {"blanks for an integer", R"(seeds="^  ")", {"wrong-kind"}, false},
        {"an integer that does not fit", R"(seeds="^99999999999")", {"wrong-kind"}, false},
        {"a sign too many", R"(seeds="^+-1")", {"wrong-kind"}, false},
        {"more behind an integer", R"(seeds="3^ apples")", {"trailing-garbage"}, true},
        {"a real number for an integer", R"(seeds="1^.5")", {"trailing-garbage"}, true},
        {"hexadecimal digits", R"(seeds="0^x10")", {"trailing-garbage"}, true},
        {"below the range", R"(seeds="^-1")", {"out-of-range"}, false},
        {"above the range", R"(seeds="^21")", {"out-of-range"}, false},
        {"the ends of the range", R"(seeds="0")", {}, true},
        {"the other end of the range", R"(seeds="20")", {}, true},

        {"no number", R"(weight="^heavy")", {"wrong-kind"}, false},
        {"a decimal comma", R"(weight="1^,5")", {"trailing-garbage"}, true},
        {"an end that is excluded", R"(weight="^0")", {"out-of-range"}, false},
        {"just inside of an end that is excluded", R"(weight="1e-300")", {}, true},
        {"only an upper end", R"(sugar="^1.1")", {"out-of-range"}, false},
        {"far below where there is no lower end", R"(sugar="-1e30")", {}, true},
        {"infinity where there is an end", R"(sugar="^inf")", {"out-of-range"}, false},
        {"no number where there is an end", R"(weight="^nan")", {"out-of-range"}, false},
        {"infinity where there is no end", R"(angle="^-inf")", {"out-of-range"}, false},
        {"too little of what is clamped", R"(shine="^-0.5")", {"out-of-range"}, true},
        {"too much of what is clamped", R"(shine="^inf")", {"out-of-range"}, true},
        {"no number where is clamped", R"(shine="^nan")", {"out-of-range"}, false},
        {"bits that only an unsigned number has", R"(marks="4294967295")", {}, true},
        {"more bits than there are", R"(marks="^4294967296")", {"wrong-kind"}, false},
        {"more than a number can be", R"(angle="^1e999")", {"wrong-kind"}, false},

        {"an unknown word", R"(colour="^PINK")", {"unknown-word"}, false},
        {"a word in another case", R"(colour="^Red")", {"unknown-word"}, false},
        {"no word", R"(colour="^")", {"unknown-word"}, false},

        {"wrong pieces of an integer list",
         R"(sizes="1,^x,3,^y")",
         {"wrong-kind", "wrong-kind"},
         false},
        {"blanks in an integer list", R"(sizes="1, 2, +3")", {}, true},
        {"garbage in an integer list", R"(sizes="1^.5,2")", {"trailing-garbage"}, true},
        {"range in a list", R"(spots="1,^0,5,^5.1")", {"out-of-range", "out-of-range"}, false},
        {"wrong words of a list",
         R"(colours="RED,^PINK,BLUE,^")",
         {"unknown-word", "unknown-word"},
         false},

        {"half a target", R"(target="^this.")", {"wrong-kind"}, false},
        {"a target without a node", R"(target="^.terrain")", {"wrong-kind"}, false},
        {"a variable without a name", R"(target="^$.terrain")", {"wrong-kind"}, false},
        {"no target", R"(target="^")", {"wrong-kind"}, false},

        {"a file that is not there", R"(file="^gone.txt")", {"file-missing"}, false},
        {"a file elsewhere", R"(file="^../gone.txt")", {"name-leaves-folders"}, false},
        {"an absolute file", R"(file="^/etc/passwd")", {"name-leaves-folders"}, false},

        {"no reference", R"(friend="^")", {"wrong-kind"}, false},
        {"a dangling reference", R"(friend="^nobody")", {"unknown-resource"}, false},
        {"dangling references of a list",
         R"(friends="^x,^yy")",
         {"unknown-resource", "unknown-resource"},
         false},
        {"a dangling reference that is needed later",
         R"(later="^nobody")",
         {"unknown-resource"},
         true},
        {"a missing file beside a wrong value",
         R"(seeds="^x" file="^gone.txt")",
         {"wrong-kind", "file-missing"},
         false},
        {"a missing file beside a dangling reference",
         R"(friend="^x" file="^gone.txt")",
         {"unknown-resource", "file-missing"},
         false},
        {"everything at once",
         R"(^kind="x" seeds="^many" colour="^PINK" friend="^nobody" weight="^0" spots="^9")",
         {"unknown-attribute", "wrong-kind", "unknown-word", "unknown-resource", "out-of-range",
          "out-of-range"},
         false},
        {"single quotes, blanks and several lines",
         "seeds\n =\n\t'^x'\n   ^kolour = 'RED'",
         {"wrong-kind", "unknown-attribute"},
         false},
        {"behind entities",
         R"(sizes="1&#44;^x" words="&lt;&amp;" ^k="")",
         {"wrong-kind", "unknown-attribute"},
         false},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        const MarkedText marked("<archive><apple name=\"a\" " + std::string(row.attributes) +
                                "/></archive>");
        ArchiveWorld world;
        world.add(marked.text);
        world.manager->loadAll();
        CHECK(problems(world.diagnostics) == expected(marked, row.codes));
        CHECK((world.manager->get<Apple>("a").get() != nullptr) == row.built);
    }
}

TEST_CASE("line breaks in a value count as the author typed them") {
    for (const std::string newline : {"\n", "\r\n"}) {
        CAPTURE(newline.size());
        const MarkedText marked("<archive>" + newline + "<apple name=\"a\" sizes=\"1," + newline +
                                "  2," + newline + "^x\" friends=\"^b,^" + newline +
                                "c\"/></archive>");
        ArchiveWorld world;
        world.add(marked.text);
        world.manager->loadAll();
        CHECK(problems(world.diagnostics) ==
              expected(marked, {"wrong-kind", "unknown-resource", "unknown-resource"}));
    }
}

TEST_CASE("a good value is read") {
    const AppleReading apple(
        R"(ripe="true" visible="false" seeds=" +7" weight="1.25" sugar="-5.8e-006"
        angle="1e30" label=" A &lt;B&gt; " colour="BLUE" sizes="1,-2,,+3" spots="0.5, 5"
        words="a, b,,c" colours="RED,BLUE" target="this.that.other" friends="x,,y")");
    REQUIRE(apple.description);
    const AppleDescription& d = *apple.description;
    CHECK(d.ripe == true);
    CHECK(d.visible == false);
    CHECK(d.seeds == 7);
    CHECK(d.weight == 1.25);
    CHECK(d.sugar == -5.8e-006f);
    CHECK(d.angle == 1e30f);
    CHECK(*d.label == " A <B> ");
    CHECK(*d.colour == Colour::blue);
    CHECK(*d.sizes == std::vector<int>{1, -2, 3});
    CHECK(*d.spots == std::vector<float>{0.5f, 5});
    CHECK(*d.words == std::vector<std::string>{"a", " b", "", "c"});
    CHECK(*d.colours == std::vector<Colour>{Colour::red, Colour::blue});
    CHECK(d.target->node == "this");
    CHECK(d.target->name == "that.other");
    REQUIRE(d.friends.size() == 2);
    CHECK(d.friends[1].name == "y");
    CHECK(d.ripe.given);
    CHECK(d.label.place.position().line == 2);
    CHECK(d.label.place.position().column == 29);
}

TEST_CASE("other spellings of values are read as the original reads them") {
    CHECK(AppleReading(R"(ripe="1")").description->ripe == false);
    CHECK(AppleReading(R"(visible="no")").description->visible == true);
    CHECK(AppleReading(R"(seeds="1.5")").description->seeds == 1);
    CHECK(AppleReading(R"(seeds="0x10")").description->seeds == 0);
    CHECK(std::isinf(AppleReading(R"(angle="inf")").description->angle));
    CHECK(AppleReading(R"(sweetness="0.75")").description->sugar == 0.75f);
    CHECK(AppleReading(R"(target="plain")").description->target->node.empty());
    CHECK(AppleReading(R"(target="$v.x")").description->target->node == "$v");
}

TEST_CASE("numbers are read alike in every locale") {
    // A comma for the decimal point, where the system has such a locale.
    for (const char* locale : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8"}) {
        if (std::setlocale(LC_ALL, locale)) break;
    }
    const AppleReading apple(R"(angle="1.5")");
    std::setlocale(LC_ALL, "C");
    CHECK(apple.description->angle == 1.5f);
    CHECK(apple.world.diagnostics.all().empty());
}

TEST_CASE("what is not written has its default, placed at the element") {
    const AppleReading apple("");
    REQUIRE(apple.description);
    const AppleDescription& d = *apple.description;
    CHECK(d.seeds == 5);
    CHECK(*d.label == "plain");
    CHECK(*d.colour == Colour::green);
    CHECK_FALSE(d.seeds.given);
    CHECK(d.seeds.place == d.place);
    CHECK(d.colours.place == d.place);
    CHECK(d.friendly.place == d.place);
    CHECK(d.id.place == d.place);
    CHECK(d.place.toString().ends_with("a.xml:1:10"));
    CHECK(apple.built);
}

TEST_CASE("a value that can't be read leaves the default") {
    const AppleReading apple(R"(seeds="x" colour="PINK")");
    REQUIRE(apple.description);
    CHECK(apple.description->seeds == 5);
    CHECK(*apple.description->colour == Colour::green);
}

TEST_CASE("a name that has to be there, but is empty, is told") {
    ArchiveWorld world;
    const MarkedText marked(R"(<archive><pear name="a" kind="^"/></archive>)");
    world.add(marked.text);
    world.manager->loadAll();
    CHECK(problems(world.diagnostics) == expected(marked, {"empty-value"}));
    CHECK(world.diagnostics.warnings() == 1);
}

TEST_CASE("what is clamped is told, and counts as the nearest end") {
    struct Row {
        const char* given;
        float value;
        const char* told;
    };
    const Row rows[] = {{"-0.5", 0, "'shine' of '-0.5' counts as 0"},
                        {"1.5", 1, "'shine' of '1.5' counts as 1"},
                        {"-inf", 0, "'shine' of '-inf' counts as 0"}};
    for (const Row& row : rows) {
        CAPTURE(row.given);
        const AppleReading apple("shine=\"" + std::string(row.given) + "\"");
        REQUIRE(apple.description);
        CHECK(*apple.description->shine == row.value);
        const Diagnostic* const d = apple.world.find("out-of-range");
        REQUIRE(d);
        CHECK(d->severity == Severity::warning);
        CHECK(d->message == row.told);
        CHECK(d->expected == "0 to 1");
    }
    const AppleReading bits("marks=\"4294967294\"");
    REQUIRE(bits.description);
    CHECK(*bits.description->marks == -2);
}

TEST_CASE("a wrong name gets the nearest right one") {
    struct Row {
        const char* attributes;
        const char* code;
        const char* suggestion;
        const char* expected; // a part of it
    };
    const Row rows[] = {
        {R"(kolour="RED")", "unknown-attribute", "colour", "'angle', 'colour'"},
        {R"(nmae="a")", "unknown-attribute", "name", "'name'"},
        {R"(quince="a")", "unknown-attribute", "", "'words' or 'worm'"},
        {R"(colour="GREN")", "unknown-word", "GREEN", "'RED', 'GREEN' or 'BLUE'"},
        {R"(colours="RED,blue")", "unknown-word", "BLUE", "'BLUE'"},
        {R"(seeds="21")", "out-of-range", "", "0 to 20"},
        {R"(weight="0")", "out-of-range", "", "more than 0 kg"},
        {R"(sugar="2")", "out-of-range", "", "at most 1"},
        {R"(spots="9")", "out-of-range", "", "more than 0 and at most 5"},
        {R"(friend="aa")", "unknown-resource", "a", "'aa.xml'"},
    };
    for (const Row& row : rows) {
        CAPTURE(std::string(row.attributes));
        const AppleReading apple(row.attributes);
        const Diagnostic* const d = apple.world.find(row.code);
        REQUIRE(d);
        CHECK(d->suggestion == row.suggestion);
        CHECK(d->expected.find(row.expected) != std::string::npos);
    }
}

TEST_CASE("a declaration prints what it reads") {
    Registry registry;
    declareTestTypes(registry);
    const ElementDeclaration* const apple = registry.find("apple");
    REQUIRE(apple);
    struct Row {
        std::string name;
        const char* text;
        const char* byDefault;
    };
    const Row rows[] = {
        {"ripe", "true", "false"},
        {"seeds", "12", "5"},
        {"weight", "0.1", "0.5"},
        {"sugar", "0.7", "0.1"},
        {"label", "some text", "plain"},
        {"colour", "RED", "GREEN"},
        {"sizes", "1,2", ""},
        {"spots", "0.1,0.25", ""},
        {"words", "a,,b", ""},
        {"colours", "BLUE,RED", ""},
        {"target", "this.x", ""},
        {"file", "a/b.png", ""},
        {"friend", "nobody", ""},
        {"friends", "a,b", ""},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        const AttributeDeclaration* const a = apple->attribute(row.name);
        REQUIRE(a);
        CHECK(a->defaultText == row.byDefault);
        Diagnostics diagnostics;
        const auto description = apple->makeDescription();
        CHECK(a->read({row.text, {}, {}}, *description, diagnostics));
        CHECK(a->print(*description) == row.text);
        CHECK(diagnostics.all().empty());
    }
    CHECK(apple->attribute("sweetness") == apple->attribute("sugar"));
    CHECK(apple->attribute("nothing") == nullptr);
    CHECK(apple->attribute("weight")->unit == "kg");
}
