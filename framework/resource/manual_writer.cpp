// SPDX-License-Identifier: BSD-3-Clause
#include "resource/manual_writer.h"

#include "resource/manual_section.h"
#include "resource/markdown.h"
#include "resource/schema_text.h"

#include <algorithm>

namespace terrane {

namespace {

constexpr const char* kIndex = R"(# Reference of archives

Every element that an archive may have, with its attributes and what may stand in it. These pages are made from the
declarations that the parser itself works with, by `tools/update-reference`; so are the schemas for editors
beside them, `resources/schema/terrane.xsd` and `.rnc`.

## How archives are written

An archive is an XML file with the root `<archive>`. In it stand resources in any order, each with a `name` by
which others refer to it. A resource may also have a file of its own, `NAME.xml`, whose root it is; it is then found by the
name of the file. In a [`<node>`](NODE) any resource may stand, with an `id` in place of the name.

- **Values.** `true` and `false`, numbers such as `12`, `-0.5` and `1e6`, words and names are written as they are, with
  capitals where they have them. Of several values, commas stand between. A file is named relative to the archive's
  folder, or to another of the folders that are searched.
- **Names** are those of entries, of XML files without `.xml`, of pictures (`rock.png`, a texture), of meshes
  (`grid.mesh`), and of modules in a row (`terrain;fog;`, a program).
- **Units** are those of the tables: metres, and mostly radians in XML.

### Targets

A method says what it works on relative to the node that it runs for: `this.terrain` is what the node has under the
key `terrain`, `$o.terrain` what the node has that the variable `o` of a loop stands for, and `camera.terrain` what the
first node with the flag `camera` has. A name without a dot is that of a resource.

### In an editor

An editor that knows the schema completes elements, attributes and words, tells what they mean, and marks what is wrong
while you type. What it marks, `terrane check` would tell as well, be it an error or a warning; references, shaders and
files only `check` and `play` look at.

| Editor | |
|---|---|
| VS Code | with the extension *XML* by Red Hat, at once: in this repository by `.vscode/settings.json`, in an archive that `terrane new` made by its first line |
| Emacs | in nxml-mode, at once: by `schemas.xml` beside the archive, and in the rest of this repository by `.dir-locals.el`, for which Emacs asks |
| others | `terrane schema > terrane.xsd` or `terrane schema --format rnc > terrane.rnc`, and in the first line of the archive `<archive xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="terrane.xsd">` |

Some archives of the original are no XML by the letter, such as those with `--` in a comment; we read them, and editors
mark these places.
)";

struct Contents {
    Chapter chapter;
    std::vector<const SchemaType*> types;
};

// Nothing but a summary is known of what is not built yet.
bool isPlanned(const Contents& page) {
    return std::all_of(page.types.begin(), page.types.end(),
                       [](const SchemaType* type) { return type->declaration->planned; });
}

// In the order of chapters, what is planned last; types in that of their tags.
std::vector<Contents> contents(const Schema& schema) {
    std::vector<Contents> result;
    for (const Chapter& chapter : schema.registry().chapters())
        result.push_back({chapter, {}});
    result.push_back({{"Others", "What belongs to no chapter."}, {}});
    std::vector<const SchemaType*> types;
    for (const SchemaElement& entry : schema.entries()) {
        if (std::find(types.begin(), types.end(), entry.type) == types.end())
            types.push_back(entry.type);
    }
    for (const SchemaType* type : types) {
        for (Contents& page : result) {
            if (page.chapter.title == ManualSections::chapterOf(*type)) page.types.push_back(type);
        }
    }
    std::erase_if(result, [](const Contents& page) { return page.types.empty(); });
    std::stable_partition(result.begin(), result.end(),
                          [](const Contents& page) { return !isPlanned(page); });
    return result;
}

std::string listOf(const Contents& page, const ManualSections& sections,
                   const std::string& chapter) {
    std::string text;
    for (const SchemaType* type : page.types) {
        const ElementDeclaration& d = *type->declaration;
        const bool section = !isPlanned(page);
        text += "- " + (section ? sections.link(*type, chapter) : asCode("<" + d.tag + ">")) +
                ": " + asMarkdown(asSentence(d.summary)) +
                (d.planned && section ? " *Not built yet.*" : "") + "\n";
    }
    return text;
}

std::string pageText(const Contents& page, const ManualSections& sections) {
    const std::string& title = page.chapter.title;
    std::string text = "# " + title + "\n\n" + page.chapter.summary + "\n\n" +
                       asLink("All elements", "README.md") + "\n\n";
    if (isPlanned(page)) return text + listOf(page, sections, title);
    text += listOf(page, sections, title) + "\n";
    for (const SchemaType* type : page.types)
        text += sections.write(*type) + "\n";
    text.pop_back();
    return text;
}

} // namespace

std::vector<ManualPage> writeManual(const Schema& schema) {
    const ManualSections sections(schema);
    std::string index = kIndex;
    std::vector<ManualPage> pages{{"README.md", {}}};
    for (const Contents& page : contents(schema)) {
        const std::string& title = page.chapter.title;
        index += "\n## " + asLink(title, pageOf(title)) + "\n\n" + page.chapter.summary + "\n";
        if (!isPlanned(page)) index += "\n" + listOf(page, sections, {});
        pages.push_back({pageOf(title), pageText(page, sections)});
    }
    const std::string node = "NODE";
    const SchemaType* nodeType = nullptr;
    for (const SchemaElement& resource : schema.resources()) {
        if (resource.tag == "node") nodeType = resource.type;
    }
    const std::size_t at = index.find("(" + node + ")");
    index.replace(at + 1, node.size(),
                  nodeType ? pageOf(ManualSections::chapterOf(*nodeType)) + "#node" : "");
    pages[0].text = std::move(index);
    return pages;
}

} // namespace terrane
