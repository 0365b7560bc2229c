// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/script.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace terrane {

/// The words of a line of a script, taken one after the other, each as what is expected: nothing,
/// when it is something else.
class ScriptWords {
public:
    explicit ScriptWords(std::vector<std::string> words)
        : words_(std::move(words)) {}

    bool empty() const { return next_ == words_.size(); }
    std::optional<std::string> word();
    /// Takes the word if it is this one.
    bool literal(std::string_view text);
    std::optional<double> real(); ///< finite
    std::optional<int> count();   ///< at least 0
    std::optional<View> view();
    std::optional<Comparison> comparison();

private:
    std::vector<std::string> words_;
    std::size_t next_ = 0;
};

/// Words are separated by blanks; one with blanks stands in double quotes. Nothing when a quote is
/// not closed.
std::optional<std::vector<std::string>> wordsOf(std::string_view text);

} // namespace terrane
