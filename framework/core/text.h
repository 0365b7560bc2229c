// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace terrane {

/// Splits at every separator; empty pieces are kept, blanks are not trimmed. "" gives no piece.
std::vector<std::string_view> split(std::string_view text, char separator);

/// The candidate nearest to `name` by Damerau-Levenshtein distance without regard to case, or an
/// empty text when none is near enough to be a likely misspelling. Among equally near ones those
/// that go on where `name` ends come first.
std::string nearestName(std::string_view name, const std::vector<std::string>& candidates);

/// "'a', 'b' or 'c'"; of a very long list only the first ones, and how many more there are.
std::string listOfNames(const std::vector<std::string>& names);

/// What an author wrote, as messages show it: in single quotes, on one line, without control
/// characters, and shortened when it is very long.
std::string inQuotes(std::string_view text);
/// The same for the name of an element: "<name>".
std::string asTag(std::string_view name);
/// "a program", "an elevationProducer".
std::string withArticle(std::string_view noun);

/// A number read from the start of a text, whatever the locale.
template <class T>
struct ParsedNumber {
    T value{};
    std::size_t length = 0; ///< bytes used, leading blanks and sign included
};

/// Decimal integer; leading blanks and '+' are allowed. Empty when there is none, or when it does
/// not fit.
std::optional<ParsedNumber<int>> parseInt(std::string_view text);
/// The same for an integer whose bits count: 4294967295 is -1, and so on.
std::optional<ParsedNumber<int>> parseBits(std::string_view text);
/// Decimal real, also "inf" and "nan"; leading blanks and '+' are allowed.
std::optional<ParsedNumber<double>> parseReal(std::string_view text);

bool isBlank(std::string_view text);

} // namespace terrane
