// SPDX-License-Identifier: BSD-3-Clause
#include "tools/terrane/schema_command.h"

#include "core/files.h"
#include "resource/manual_writer.h"
#include "resource/rnc_writer.h"
#include "resource/xsd_writer.h"

#include <ostream>

namespace fs = std::filesystem;
using namespace terrane;

namespace {

bool write(const fs::path& file, const std::string& text, std::ostream& err) {
    if (writeFile(file, text)) return true;
    err << "terrane: can't write " << file.string() << "\n";
    return false;
}

bool writePages(const Schema& schema, const fs::path& folder, std::ostream& out,
                std::ostream& err) {
    std::error_code error;
    if (!folder.empty()) fs::create_directories(folder, error);
    for (const ManualPage& page : writeManual(schema)) {
        if (folder.empty())
            out << page.text << "\n";
        else if (!write(folder / page.file, page.text, err))
            return false;
    }
    return true;
}

} // namespace

int writeSchema(const Registry& registry, const std::string& format, const fs::path& output,
                std::ostream& out, std::ostream& err) {
    const Schema schema(registry);
    if (format == "md") return writePages(schema, output, out, err) ? 0 : 1;
    const std::string text = format == "rnc" ? writeRnc(schema) : writeXsd(schema);
    if (!output.empty()) return write(output, text, err) ? 0 : 1;
    out << text;
    return 0;
}
