// SPDX-License-Identifier: BSD-3-Clause
#include "resource/manual_writer.h"
#include "resource/markdown.h"
#include "resource/schema_text.h"
#include "resource/test_types.h"

#include <doctest/doctest.h>

using namespace terrane;

namespace {

bool contains(const std::string& text, const std::string& part) {
    CAPTURE(text);
    const bool found = text.find(part) != std::string::npos;
    CHECK(found);
    return found;
}

} // namespace

TEST_CASE("plain text becomes Markdown that shows the same, with code for what is quoted") {
    struct Row {
        const char* text;
        const char* markdown;
    };
    const Row rows[] = {
        {"plain words", "plain words"},
        {"_VERTEX_ *and* [i]", "\\_VERTEX\\_ \\*and\\* \\[i\\]"},
        {"the file's own", "the file's own"},
        {"such as 'rock.png' or 'a;b;'", "such as `rock.png` or `a;b;`"},
        {"'a' isn't 'b'", "`a` isn't `b`"},
        {"in <node>, a|b", "in `<node>`, a\\|b"},
        {"less < more", "less \\< more"},
        {"'", "'"},
        {"", ""},
    };
    for (const Row& row : rows) {
        CAPTURE(row.text);
        CHECK(asMarkdown(row.text) == row.markdown);
    }
}

TEST_CASE("summaries become sentences, and names stay as they are spelt") {
    CHECK(asSentence("height of the water") == "Height of the water.");
    CHECK(asSentence("mat4: from here to there") == "mat4: from here to there.");
    CHECK(asSentence("texture2D with tiles") == "texture2D with tiles.");
    CHECK(asSentence("a switch") == "A switch.");
    CHECK(asSentence("Whole.") == "Whole.");
    CHECK(asSentence(" ") == " .");
    CHECK(asSentence("").empty());
}

TEST_CASE("the manual tells of each attribute its kind, default, range and names") {
    Registry registry;
    test::declareTestTypes(registry);
    const std::vector<ManualPage> pages = writeManual(Schema(registry));
    REQUIRE(pages.size() == 2); // no chapters: one page beside the index
    CHECK(pages[0].file == "README.md");
    CHECK(pages[1].file == "others.md");
    contains(pages[0].text, "[`<apple>`](others.md#apple): An attribute of every kind.");
    const std::string& page = pages[1].text;
    contains(page, "## `<apple>`\n\nAn attribute of every kind.\n");
    contains(page, "| `seeds` | integer, 0 to 20 | `5` | How many. |");
    contains(page, "| `weight` | number, more than 0 kg | `0.5` | How heavy. |");
    contains(page, "How sweet. Also spelt `sweetness`. |");
    contains(page, "| `colour` | `RED`, `GREEN` or `BLUE` | `GREEN` |");
    contains(page, "| `kind` | text | **required** | A text. |");
    contains(page, "| `smell` | text |  | No effect yet. Has no effect yet. |");
    contains(page, "| `note` | ignored |  | For people. |");
    contains(page, "### `<lid>` in `<basket>`");
    contains(page, "Tags: `uniform`, `uniform1`, `uniform2`.");
    contains(page, "A fruit of a later version. Not built yet: accepted, without effect.");
}
