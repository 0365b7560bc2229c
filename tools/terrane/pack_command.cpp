// SPDX-License-Identifier: BSD-3-Clause
#include "tools/terrane/pack_command.h"

#include "app/check.h"
#include "app/pack.h"
#include "core/files.h"
#include "core/text.h"

#include <algorithm>
#include <cstdio>
#include <ostream>

namespace fs = std::filesystem;
using namespace terrane;

namespace {

std::string sizeText(std::uint64_t bytes) {
    constexpr const char* kUnits[] = {"bytes", "kB", "MB", "GB", "TB"};
    auto value = static_cast<double>(bytes);
    int unit = 0;
    for (; value >= 999.5 && unit < 4; ++unit)
        value /= 1000;
    char text[32];
    std::snprintf(text, sizeof text, unit > 0 && value < 9.95 ? "%.1f %s" : "%.0f %s", value,
                  kUnits[unit]);
    return text;
}

std::string counted(std::size_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

void tell(const PackResult& result, const fs::path& output, std::ostream& out) {
    std::size_t width = 0;
    for (const PackedFile& file : result.files)
        width = std::max(width, file.name.size());
    std::uint64_t sum = 0;
    for (const PackedFile& file : result.files) {
        out << "  " << file.name << std::string(width - file.name.size() + 2, ' ')
            << sizeText(file.size) << "\n";
        sum += file.size;
    }
    out << "Packed " << counted(result.files.size(), "file") << " of " << sizeText(sum) << " into "
        << shownPath(output) << ", " << sizeText(result.size) << ".\n";
    if (result.builtIn > 0)
        out << "Left out " << counted(result.builtIn, "file") << " that every Terrane has.\n";
}

} // namespace

int packCommand(const Registry& registry, const fs::path& archive,
                const std::vector<fs::path>& paths, const fs::path& output, bool told,
                std::ostream& out, std::ostream& err) {
    const std::string extension = output.extension().string();
    if (extension != ".zip" && extension != ".ZIP") {
        err << "terrane: " << inQuotes(output.string()) << " is to end with .zip, by which "
            << "'play' and 'check' know it\n";
        return 2;
    }
    const PackResult result = packArchive(registry, archive, paths, output);
    for (const Diagnostic& diagnostic : result.diagnostics) {
        if (told || diagnostic.severity == Severity::error) err << toString(diagnostic);
    }
    if (result.size == 0) {
        err << "terrane: nothing was packed: " << count(result.diagnostics).toString() << "\n";
        return 1;
    }
    if (told) tell(result, output, out);
    return 0;
}
