// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/source.h"

#include <functional>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

namespace terrane {

enum class Severity { note, warning, error };

/// One problem, told so that an author can fix it: where, what was found, what was expected, the
/// nearest valid name, and how the resource came to be loaded.
struct Diagnostic {
    Severity severity = Severity::error;
    std::string code;       ///< stable, kebab-case, for scripts: "unknown-attribute"
    Place place;            ///< may be empty when no file is concerned
    std::string message;    ///< what was found, one line, lower case, no full stop
    std::string expected;   ///< what would have been right; may be empty
    std::string suggestion; ///< the nearest valid name; may be empty
    std::string detail;     ///< more lines, such as a compiler's own words; may be empty
    /// Resources being loaded, innermost first: "producer 'elevation' (file:line:col)".
    std::vector<std::string> chain;
};

/// As a compiler prints it: `file:line:col: error: message [code]`, the source line with a caret,
/// then the expectation, the suggestion and the chain. Ends with a line break.
std::string toString(const Diagnostic& diagnostic);

/// Collects the diagnostics of a player. Thread-safe. A diagnostic that equals an earlier one in
/// code, place and message is dropped, so that a fault met every frame is told once.
class Diagnostics {
public:
    using Listener = std::function<void(const Diagnostic&)>;

    void report(Diagnostic diagnostic);
    void error(std::string code, Place place, std::string message, std::string expected = {});
    void warning(std::string code, Place place, std::string message, std::string expected = {});

    std::size_t errors() const;
    std::size_t warnings() const;
    std::size_t size() const; ///< of all, notes too
    /// How many there ever were, forgotten ones too: what came last stands at the end of all().
    std::size_t reported() const;
    /// A copy, in the order of the reports.
    std::vector<Diagnostic> all() const;
    void clear();
    /// Forgets the diagnostics from one of the list of all() on, up to another.
    void forget(std::size_t first, std::size_t last);
    /// Forgets all errors; how many of them stood in the list of all() before an index.
    std::size_t forgetErrors(std::size_t index);
    /// Called for each new diagnostic, on the thread that reports it.
    void onReport(Listener listener);
    /// Where the places of diagnostics are by now, since files change while they are in use; called
    /// before a diagnostic is looked at, on the thread that reports it.
    void setRelocation(std::function<Place(const Place&)> relocation);

private:
    void countAgain();

    mutable std::mutex mutex_;
    std::vector<Diagnostic> list_;
    std::unordered_multimap<std::size_t, std::size_t> indexByHash_; ///< of code, place, message
    std::size_t reported_ = 0;
    std::size_t errors_ = 0;
    std::size_t warnings_ = 0;
    Listener listener_;
    std::function<Place(const Place&)> relocation_;
};

} // namespace terrane
