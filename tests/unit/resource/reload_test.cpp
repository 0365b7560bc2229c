// SPDX-License-Identifier: BSD-3-Clause
#include "resource/reload.h"

#include "resource/archive_world.h"

#include <algorithm>
#include <doctest/doctest.h>

using namespace terrane;
using namespace terrane::test;

namespace {

using Lines = std::vector<std::string>;

/// An archive that is edited. What its entry "root" needs is loaded.
class EditedWorld {
public:
    explicit EditedWorld(const std::string& entries) {
        world.add(archiveOf(entries));
        world.manager->resolve(root_, typeid(Resource), nullptr);
        world.log.lines.clear();
    }

    /// Reloads; false, with everything as before, after errors.
    bool edit(const std::string& entries) {
        world.folder.file("a.xml", archiveOf(entries));
        return reload();
    }

    bool reload() {
        world.log.lines.clear();
        world.diagnostics.clear();
        auto fresh = std::make_unique<Library>(world.library->searchPath(), world.diagnostics);
        if (!fresh->addArchive(world.folder / "a.xml")) return false;
        Reload reload(*world.manager, *fresh);
        affected.clear();
        for (const ResourceEntry* entry : reload.affected())
            affected.push_back(entry->name);
        std::sort(affected.begin(), affected.end());
        reload.rebuild();
        world.manager->resolve(root_, typeid(Resource), nullptr);
        built = world.log.lines;
        world.log.lines.clear();
        if (world.diagnostics.errors() > 0) {
            reload.rollBack();
            return false;
        }
        reload.commit({root_.entry()});
        world.library = std::move(fresh);
        return true;
    }

    Resource* instance(const std::string& name) const {
        const auto found = world.manager->entries().find(name);
        return found == world.manager->entries().end() ? nullptr : found->second->instance.get();
    }
    Lines loaded() const {
        Lines names;
        for (const auto& [name, entry] : world.manager->entries())
            names.push_back(name);
        return names;
    }

    ArchiveWorld world;
    Lines affected; ///< by the last reload
    Lines built;    ///< by the last reload, before it was ended
    /// What went when it ended.
    const Lines& dropped() const { return world.log.lines; }

private:
    static std::string archiveOf(const std::string& entries) {
        return "<archive>" + entries + "</archive>";
    }

    Ref<Resource> root_{"root"};
};

} // namespace

TEST_CASE("a reload builds what changed and what was made from it, and nothing else") {
    EditedWorld world(R"(<apple name="root" friend="a"/> <apple name="a" friend="b"/>
        <apple name="b"/> <apple name="c"/> <basket name="d"><apple/></basket>)");
    const Resource* const b = world.instance("b");
    struct Row {
        const char* name;
        const char* entries;
        Lines affected, built;
    };
    const Row rows[] = {
        {"nothing",
         R"(<apple name="root" friend="a"/> <apple name="a" friend="b"/> <apple name="b"/>)",
         {},
         {}},
        {"blanks, comments and the order of attributes",
         R"(<!-- new -->
            <apple friend="a"   name="root"><!-- here, too --></apple>
            <apple name="a" friend="b"/> <apple name="b"/>)",
         {},
         {}},
        {"another order",
         R"(<apple name="b"/> <apple name="root" friend="a"/> <apple name="a" friend="b"/>)",
         {},
         {}},
        {"the root",
         R"(<apple name="root" friend="a" seeds="1"/> <apple name="a" friend="b"/>
            <apple name="b"/>)",
         {"root"},
         {"make apple root"}},
        {"one in the middle",
         R"(<apple name="root" friend="a" seeds="1"/> <apple name="a" friend="b" seeds="1"/>
            <apple name="b"/>)",
         {"a", "root"},
         {"make apple a", "make apple root"}},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        CHECK(world.edit(row.entries));
        CHECK(world.affected == row.affected);
        CHECK(world.built == row.built);
        CHECK(world.dropped().size() == row.built.size());
        CHECK(world.instance("b") == b);
    }
}

TEST_CASE("the old versions go, dependents first, when the new ones are there") {
    EditedWorld world(R"(<apple name="root" friend="a"/> <apple name="a"/>)");
    CHECK(world.edit(R"(<apple name="root" friend="a"/> <apple name="a" seeds="1"/>)"));
    CHECK(world.built == Lines{"make apple a", "make apple root"});
    CHECK(world.dropped() == Lines{"drop apple root", "drop apple a"});
}

TEST_CASE("a live reference shows the new version without a rebuild of who has it") {
    EditedWorld world(R"(<basket name="root" favourite="a"><apple/></basket> <apple name="a"/>)");
    const auto* const root = world.instance("root");
    CHECK(world.edit(
        R"(<basket name="root" favourite="a"><apple/></basket> <apple name="a" seeds="1"/>)"));
    CHECK(world.built == Lines{"make apple a"});
    CHECK(world.instance("root") == root);
    const auto* d = static_cast<BasketDescription*>(
        world.world.manager->entries().at("root")->description.get());
    CHECK(d->favourite.get() == world.instance("a"));
}

TEST_CASE("a bad edit changes nothing, and the next good one is built") {
    const char* const good = R"(<apple name="root" friend="a"/> <apple name="a" friend="b"/>
                                <apple name="b"/>)";
    EditedWorld world(good);
    const Lines names = world.loaded();
    struct Row {
        const char* name;
        const char* entries;
        Lines problems;
    };
    const Row rows[] = {
        {"a wrong value",
         "<apple name='root' friend='a'/> <apple name='a' friend='b' seeds='x'/>\n"
         "<apple name='b' seeds='2'/>",
         {"wrong-kind a.xml:1:76"}},
        {"a missing resource",
         "<apple name='root' friend='a'/> <apple name='a' friend='b'/>",
         {"unknown-resource a.xml:1:66"}},
        {"a cycle",
         "<apple name='root' friend='a'/> <apple name='a' friend='b'/><apple name='b' friend='a'/>",
         {"cycle a.xml:1:94"}},
        {"another type",
         "<apple name='root' friend='a'/> <apple name='a' friend='b'/>"
         "<basket name='b'><apple/></basket>",
         {"mistyped-reference a.xml:1:66"}},
        {"a truncated file",
         "<apple name='root' friend='a'/> <apple name='a'",
         {"xml-syntax a.xml:1:42"}},
        {"a new resource that can't be built",
         "<apple name='root' friends='a,n'/> <apple name='a' friend='b'/><apple name='b'/>"
         "<apple name='n' file='none.txt'/>",
         {"file-missing a.xml:1:112"}},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        const auto* const root = world.instance("root");
        const auto* const a = world.instance("a");
        CHECK_FALSE(world.edit(row.entries));
        CHECK(reports(world.world.diagnostics) == row.problems);
        CHECK(world.instance("root") == root);
        CHECK(world.instance("a") == a);
        CHECK(world.loaded() == names);
        CHECK(world.dropped().size() == world.built.size()); // what was built in vain

        CHECK(world.edit(good));
        CHECK(world.built.empty());
        CHECK(world.instance("root") == root);
        CHECK(world.world.diagnostics.all().empty());
    }
    CHECK(world.edit(R"(<apple name="root" friend="a"/> <apple name="a" friend="b" seeds="1"/>
                        <apple name="b"/>)"));
    CHECK(world.built == Lines{"make apple a", "make apple root"});
}

TEST_CASE("what is not needed any more goes, and comes back") {
    EditedWorld world(R"(<apple name="root" friends="a,b"/> <apple name="a"/> <apple name="b"/>)");
    CHECK(world.edit(R"(<apple name="root" friends="a"/> <apple name="a"/>)"));
    CHECK(world.loaded() == Lines{"a", "root"});
    CHECK(world.dropped() == Lines{"drop apple root", "drop apple b"});
    CHECK(world.edit(R"(<apple name="root" friends="c,a"/> <apple name="a"/> <apple name="c"/>)"));
    CHECK(world.loaded() == Lines{"a", "c", "root"});
    CHECK(world.built == Lines{"make apple c", "make apple root"});
}

TEST_CASE("a renamed resource is another one") {
    EditedWorld world(R"(<apple name="root" friend="a"/> <apple name="a"/>)");
    CHECK(world.edit(R"(<apple name="root" friend="b"/> <apple name="b"/>)"));
    CHECK(world.loaded() == Lines{"b", "root"});
}

TEST_CASE("an element may become one of another type") {
    EditedWorld world(R"(<apple name="root" friend="a"/> <apple name="a"/>)");
    CHECK(world.edit(R"(<apple name="root" friend="a"/> <pear name="a" kind="k" next="p"/>
                        <apple name="p"/>)"));
    CHECK(world.built == Lines{"make apple p", "make pear a", "make apple root"});
}

TEST_CASE("files count by what they say") {
    EditedWorld world(R"(<apple name="root" friend="a"/> <apple name="a" file="data.txt"/>)");
    CHECK_FALSE(world.instance("root")); // the file is missing
    world.world.folder.file("data.txt", "one");
    CHECK(world.reload());
    CHECK(world.built == Lines{"make apple a", "make apple root"});

    SUBCASE("written anew with the same text") {
        world.world.folder.file("data.txt", "one");
        CHECK(world.reload());
        CHECK(world.built.empty());
    }
    SUBCASE("of the same length, at once") {
        world.world.folder.file("data.txt", "two");
        CHECK(world.reload());
        CHECK(world.built == Lines{"make apple a", "make apple root"});
    }
    SUBCASE("gone, and back") {
        const auto* const a = world.instance("a");
        std::filesystem::remove(world.world.folder / "data.txt");
        CHECK_FALSE(world.reload());
        CHECK(reports(world.world.diagnostics) == Lines{"file-missing a.xml:1:64"});
        CHECK(world.instance("a") == a);
        world.world.folder.file("data.txt", "one");
        CHECK(world.reload());
        CHECK(world.instance("a") == a);
    }
}

TEST_CASE("a file that is found earlier in the search folders takes the place of another") {
    EditedWorld world(R"(<apple name="root" friend="far"/>)");
    const auto deeper = world.world.folder.folder("deeper");
    world.world.folder.file("deeper/far.xml", "<apple/>");
    SearchPath search;
    search.add(world.world.folder.path());
    search.add(deeper);
    world.world.library = std::make_unique<Library>(search, world.world.diagnostics);
    CHECK(world.reload());
    const Lines apples{"make apple far", "make apple root"};
    CHECK(world.built == apples);
    CHECK(world.reload());
    CHECK(world.built.empty());
    world.world.folder.file("far.xml", "<pear kind='k' next='deeper/far'/>");
    CHECK(world.reload());
    CHECK(world.built == Lines{"make apple deeper/far", "make pear far", "make apple root"});
}

TEST_CASE("elements in an element that is built anew are kept if nothing has changed for them") {
    EditedWorld world(R"(<shelf name="root"> <apple id="one"/> <apple id="two" friend="a"/>
        <shelf id="s"> <apple id="three"/> <apple id="four" friend="a"/> </shelf>
        <shelf id="t"> <apple id="five" file="data.txt"/> </shelf> </shelf> <apple name="a"/>)");
    world.world.folder.file("data.txt");
    CHECK(world.reload());
    CHECK(world.built.size() == 3); // five, t and root

    struct Row {
        const char* name;
        const char* entries;
        std::ptrdiff_t apples, shelves;
    };
    const Row rows[] = {
        {"an attribute of one of them",
         R"(<shelf name="root"> <apple id="one" seeds="1"/> <apple id="two" friend="a"/>
            <shelf id="s"> <apple id="three"/> <apple id="four" friend="a"/> </shelf>
            <shelf id="t"> <apple id="five" file="data.txt"/> </shelf> </shelf>
            <apple name="a"/>)",
         2, 2}, // also what reads a file, and what that stands in
        {"what two of them refer to",
         R"(<shelf name="root"> <apple id="one" seeds="1"/> <apple id="two" friend="a"/>
            <shelf id="s"> <apple id="three"/> <apple id="four" friend="a"/> </shelf>
            <shelf id="t"> <apple id="five" file="data.txt"/> </shelf> </shelf>
            <apple name="a" seeds="1"/>)",
         4, 3},
        {"another order, and one less",
         R"(<shelf name="root"> <shelf id="s"> <apple id="three"/> </shelf>
            <apple id="two" friend="a"/> <apple id="one" seeds="1"/> </shelf>
            <apple name="a" seeds="1"/>)",
         0, 2},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        CHECK(world.edit(row.entries));
        const auto made = [&](const std::string& what) {
            return std::count_if(world.built.begin(), world.built.end(),
                                 [&](const std::string& line) { return line.starts_with(what); });
        };
        CAPTURE(world.built);
        CHECK(made("make apple") == row.apples);
        CHECK(made("make shelf") == row.shelves);
    }
}

TEST_CASE("a reload that is given up rolls back") {
    EditedWorld world(R"(<apple name="root"/>)");
    const auto* const root = world.instance("root");
    world.world.folder.file("a.xml", R"(<archive><apple name="root" seeds="1"/></archive>)");
    Library fresh(world.world.library->searchPath(), world.world.diagnostics);
    REQUIRE(fresh.addArchive(world.world.folder / "a.xml"));
    {
        Reload reload(*world.world.manager, fresh);
        reload.rebuild();
        CHECK(world.instance("root") != root);
    }
    CHECK(world.instance("root") == root);
    CHECK(&world.world.manager->library() == world.world.library.get());
}

TEST_CASE("data that was not prepared is taken when it comes, and costs nothing until then") {
    EditedWorld world(R"(<apple name="root"/>)");
    const std::string entries = R"(<apple name="root" friend="a"/> <apple name="a" file="b.txt"/>)";
    world.world.folder.file("prepare", "# makes: b.txt\n");
    CHECK(world.edit(entries));
    CHECK(world.instance("root"));
    CHECK_FALSE(world.instance("a"));
    CHECK(world.reload());
    CHECK(world.affected == Lines{});
    world.world.folder.file("b.txt");
    CHECK(world.reload());
    CHECK(world.affected == Lines{"a", "root"});
    CHECK(world.instance("a"));
}
