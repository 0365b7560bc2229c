// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as an archive: parsed, validated, loaded, and everything told about them printed.
#include "resource/manager.h"
#include "resource/test_types.h"
#include "resource/xml_fault.h"

#include <cstdint>
#include <cstdlib>

using namespace terrane;

namespace {

void require(bool condition) {
    if (!condition) std::abort();
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it so.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto source = std::make_shared<SourceFile>(
        "a.xml", std::string(reinterpret_cast<const char*>(data), size));
    Registry registry;
    test::declareTestTypes(registry);
    Diagnostics diagnostics;
    Library library(SearchPath(), diagnostics);
    {
        ResourceManager manager(registry, library, diagnostics);
        const bool added = library.addArchive("a.xml", source);
        require(added == (diagnostics.errors() == 0));
        manager.loadAll();
        manager.get<test::Fruit>("a");
    }
    // Only a text that is no XML has a fault, and that lies within the text.
    const auto fault = findXmlFault(source->text());
    require(!fault || fault->offset <= size);
    for (const Diagnostic& diagnostic : diagnostics.all()) {
        require(!diagnostic.place ||
                diagnostic.place.offset <= diagnostic.place.file->text().size());
        require(!toString(diagnostic).empty());
    }
    return 0;
}
