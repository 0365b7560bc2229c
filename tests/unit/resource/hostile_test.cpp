// SPDX-License-Identifier: BSD-3-Clause
#include "resource/archive_world.h"

#include <doctest/doctest.h>
#include <filesystem>

using namespace terrane;
using namespace terrane::test;

namespace {

std::string repeated(const std::string& text, int count) {
    std::string result;
    result.reserve(text.size() * static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        result += text;
    return result;
}

// Everything that is told can be printed, in bounded space.
void checkPrintable(const Diagnostics& diagnostics) {
    for (const Diagnostic& d : diagnostics.all()) {
        const std::string text = toString(d);
        const bool bounded = text.size() < 4000 + 200 * d.chain.size();
        if (!bounded) CHECK(text.substr(0, 200) == "too long");
        if (d.place) {
            const bool inside = d.place.offset <= d.place.file->text().size();
            if (!inside) CHECK(inside);
        }
    }
}

const char* const kSample = R"(<!-- c --><?xml version="1.0"?>
<archive>
    <apple name="a" ripe="true" seeds="3" colours="RED,BLUE" friend="b" note='x'/>
    <basket name="b"><apple/><lid low="0" high="1"/><uniform1f name="u"/></basket>
    <shelf name="s"><pear id="p" kind="k&amp;"/></shelf><program name="a;b;"/>
    <mould name="m">text</mould>
</archive>
)";

} // namespace

TEST_CASE("hostile archives are refused or read, never more") {
    const std::string megabyte(1 << 20, 'x');
    struct Row {
        std::string name;
        std::string text;
    };
    const Row rows[] = {
        {"nothing", ""},
        {"zero bytes", std::string(1000, '\0')},
        {"a megabyte of open elements", repeated("<chain>", 150000)},
        {"a megabyte of nested elements", "<archive><chain name='c'>" + repeated("<chain>", 70000) +
                                              repeated("</chain>", 70000) + "</chain></archive>"},
        {"a megabyte of unknown nested elements", "<archive><x name='c'>" + repeated("<y>", 70000) +
                                                      repeated("</y>", 70000) + "</x></archive>"},
        {"a huge value", "<archive><apple name='a' seeds='" + megabyte + "'/></archive>"},
        {"a huge word", "<archive><apple name='a' colour='" + megabyte + "'/></archive>"},
        {"a huge attribute name", "<archive><apple name='a' " + megabyte + "='1'/></archive>"},
        {"a huge tag", "<archive><" + megabyte + " name='a'/></archive>"},
        {"a huge child's tag", "<archive><basket name='b'><" + megabyte + "/></basket></archive>"},
        {"a huge name", "<archive><apple name='" + megabyte + "' seeds='x'/></archive>"},
        {"a huge reference", "<archive><apple name='a' friend='" + megabyte + "'/></archive>"},
        {"a huge file name", "<archive><apple name='a' file='" + megabyte + "'/></archive>"},
        {"a huge target", "<archive><apple name='a' target='" + megabyte + ".'/></archive>"},
        {"a huge program", "<archive><frame name='" + repeated("a;", 1000) + "'/></archive>"},
        {"a list of many wrong numbers",
         "<archive><apple name='a' sizes='" + repeated("x,", 20000) + "'/></archive>"},
        {"a list of many dangling references",
         "<archive><apple name='a' friends='" + repeated("x,", 20000) + "'/></archive>"},
        {"many unknown attributes",
         [] {
             std::string text = "<archive><apple name='a'";
             for (int i = 0; i < 20000; ++i)
                 text += " b" + std::to_string(i) + "=''";
             return text + "/></archive>";
         }()},
        {"many duplicates of an attribute",
         "<archive><apple name='a'" + repeated(" ripe=''", 20000) + "/></archive>"},
        {"many entries of one name",
         "<archive>" + repeated("<apple name='a'/>", 20000) + "</archive>"},
        {"many entries without a name", "<archive>" + repeated("<apple/>", 20000) + "</archive>"},
        {"escape sequences", "<archive><apple name='\x1b[2J' \x1b[2J='1'/></archive>"},
        {"entities",
         "<archive><apple name='&#0;&#x1b;&#xffffffff;&&amp;&unknown;' seeds='&#10;x'/></archive>"},
        {"entities that would expand",
         "<!DOCTYPE a [<!ENTITY b 'cccc'><!ENTITY d '&b;&b;'>]><archive><apple name='&d;' "
         "seeds='&d;'/></archive>"},
        {"no UTF-8", "<archive><apple name='\xff\xfe\x80' seeds='\xc3'/></archive>"},
        {"comments only", repeated("<!-- -->", 100000)},
        {"quotes only", repeated("\"", 100000)},
        {"less-than signs only", repeated("<", 100000)},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        ArchiveWorld world;
        world.add(row.text);
        world.manager->loadAll();
        checkPrintable(world.diagnostics);
        CHECK(world.diagnostics.all().size() > 0);
    }
}

TEST_CASE("an archive cut anywhere is refused or read, never more") {
    const std::string text = kSample;
    for (std::size_t length = 0; length <= text.size(); ++length) {
        Registry registry;
        declareTestTypes(registry);
        Diagnostics diagnostics;
        Library library(SearchPath(), diagnostics);
        const auto source = std::make_shared<SourceFile>("a.xml", text.substr(0, length));
        ResourceManager manager(registry, library, diagnostics);
        const bool added = library.addArchive("a.xml", source);
        manager.loadAll();
        checkPrintable(diagnostics);
        const bool told = diagnostics.errors() > 0;
        if (!added && !told) FAIL_CHECK(length);
    }
}

TEST_CASE("folders and unreadable files named like resources are told") {
    ArchiveWorld world;
    world.folder.folder("folder.xml");
    world.folder.folder("folder.png");
    std::filesystem::create_symlink("loop.xml", world.folder.path() / "loop.xml");
    std::filesystem::create_symlink("gone", world.folder.path() / "broken.xml");
    world.load(R"(<apple name="a" friends="folder,loop,broken" file="folder.png"/>)");
    CHECK(reports(world.diagnostics) ==
          std::vector<std::string>{"unknown-resource a.xml:1:35", "unknown-resource a.xml:1:42",
                                   "unknown-resource a.xml:1:47", "file-missing a.xml:1:61"});
}

TEST_CASE("ten thousand entries are loaded in a moment") {
    struct Row {
        std::string name;
        std::string (*entry)(int);
    };
    const Row rows[] = {
        {"good ones",
         [](int i) {
             return "<apple name=\"entry" + std::to_string(i) + "\" friend=\"entry" +
                    std::to_string(i / 2 + 5000) + "\"/>\n";
         }},
        {"one wrong value each",
         [](int i) { return "<apple name=\"entry" + std::to_string(i) + "\" seeds=\"x\"/>\n"; }},
        {"one dangling reference each",
         [](int i) {
             return "<apple name=\"entry" + std::to_string(i) + "\" friend=\"missing" +
                    std::to_string(i) + "\"/>\n";
         }},
        {"all named by one",
         [](int i) {
             return "<apple name=\"entry" + std::to_string(i) + "\" friend=\"apple\"/>\n";
         }},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        std::string entries = "<apple name=\"apple\"/>";
        for (int i = 0; i < 10000; ++i)
            entries += row.entry(i);
        ArchiveWorld world;
        world.load(entries);
        CHECK(world.manager->entries().size() == 10001);
    }
}
