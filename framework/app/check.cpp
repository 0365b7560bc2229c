// SPDX-License-Identifier: BSD-3-Clause
#include "app/check.h"

#include "app/player.h"
#include "resource/prepared_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>

namespace terrane {

namespace {

std::string counted(int count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

const char* word(Severity severity) {
    switch (severity) {
    case Severity::note:
        return "note";
    case Severity::warning:
        return "warning";
    case Severity::error:
        break;
    }
    return "error";
}

} // namespace

void sortByPlace(std::vector<Diagnostic>& diagnostics) {
    static const std::string kNone;
    const auto key = [](const Diagnostic& d) {
        const std::string& file = d.place ? d.place.file->path() : kNone;
        return std::tie(file, d.place.offset, d.code, d.message);
    };
    std::stable_sort(diagnostics.begin(), diagnostics.end(),
                     [&](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
}

std::vector<Diagnostic> checkArchive(const Registry& registry, const std::filesystem::path& archive,
                                     const std::vector<std::filesystem::path>& paths, bool unused) {
    // Nothing is drawn, so the picture can be small.
    Player player(registry,
                  {.archive = archive, .paths = paths, .width = 64, .height = 64, .debug = true});
    player.check(unused);
    std::vector<Diagnostic> diagnostics = player.diagnostics().all();
    sortByPlace(diagnostics);
    return diagnostics;
}

std::string toJson(const std::vector<Diagnostic>& diagnostics) {
    nlohmann::ordered_json list = nlohmann::json::array();
    for (const Diagnostic& d : diagnostics) {
        nlohmann::ordered_json entry{{"severity", word(d.severity)}, {"code", d.code}};
        if (d.place) {
            const LineColumn at = d.place.position();
            entry["file"] = d.place.file->path();
            entry["line"] = at.line;
            entry["column"] = at.column;
        }
        entry["message"] = d.message;
        if (!d.expected.empty()) entry["expected"] = d.expected;
        if (!d.suggestion.empty()) entry["suggestion"] = d.suggestion;
        if (!d.detail.empty()) entry["detail"] = d.detail;
        if (!d.chain.empty()) entry["chain"] = d.chain;
        list.push_back(std::move(entry));
    }
    // Bytes of a file that are no UTF-8 may stand in a message.
    return list.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string DiagnosticCounts::toString() const {
    const std::string skips =
        skipped > 0 ? ", " + std::to_string(skipped) + " skipped: data not prepared" : "";
    return counted(errors, "error") + ", " + counted(warnings, "warning") + skips;
}

DiagnosticCounts count(const std::vector<Diagnostic>& diagnostics) {
    DiagnosticCounts counts;
    for (const Diagnostic& d : diagnostics) {
        if (d.severity == Severity::error) ++counts.errors;
        if (d.severity == Severity::warning) ++counts.warnings;
        if (d.code == kDataNotPrepared) ++counts.skipped;
    }
    return counts;
}

} // namespace terrane
