// SPDX-License-Identifier: BSD-3-Clause
#include "core/text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>

namespace terrane {

namespace {

char lower(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

// Optimal string alignment distance (insertions, deletions, substitutions, neighbours swapped), or
// limit + 1 when it is more than the limit. Only the band around the diagonal that can stay within
// the limit is computed, since broken archives ask for thousands of names.
std::size_t editDistance(std::string_view a, std::string_view b, std::size_t limit) {
    const std::size_t tooFar = limit + 1;
    std::vector<std::size_t> older(b.size() + 1), previous(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        previous[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        const std::size_t first = i > limit ? i - limit : 1;
        const std::size_t last = std::min(b.size(), i + limit);
        row.assign(b.size() + 1, tooFar);
        if (i <= limit) row[0] = i;
        std::size_t least = row[0];
        for (std::size_t j = first; j <= last; ++j) {
            const std::size_t cost = lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1;
            row[j] = std::min({previous[j] + 1, row[j - 1] + 1, previous[j - 1] + cost});
            const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                                 lower(a[i - 2]) == lower(b[j - 1]);
            if (swapped) row[j] = std::min(row[j], older[j - 2] + 1);
            least = std::min(least, row[j]);
        }
        if (least > limit) return tooFar;
        std::swap(older, previous);
        std::swap(previous, row);
    }
    return std::min(previous[b.size()], tooFar);
}

// Whether a candidate is a name with something behind it: RGB32F for RGB32.
bool goesOn(std::string_view name, std::string_view candidate) {
    return candidate.size() > name.size() &&
           std::equal(name.begin(), name.end(), candidate.begin(),
                      [](char a, char b) { return lower(a) == lower(b); });
}

std::size_t skipBlanksAndPlus(std::string_view text) {
    std::size_t i = 0;
    while (i < text.size() && std::isspace(static_cast<unsigned char>(text[i])))
        ++i;
    // std::from_chars takes no '+'; "+-1" is no number either.
    if (i + 1 < text.size() && text[i] == '+' && text[i + 1] != '-') ++i;
    return i;
}

template <class T>
std::optional<ParsedNumber<T>> parseNumber(std::string_view text) {
    const std::size_t start = skipBlanksAndPlus(text);
    ParsedNumber<T> result;
    const char* const first = text.data() + start;
    const auto [end, error] = std::from_chars(first, text.data() + text.size(), result.value);
    if (error != std::errc{}) return std::nullopt;
    result.length = static_cast<std::size_t>(end - text.data());
    return result;
}

// One line, no control characters, and not longer than a terminal minds.
std::string shown(std::string_view text) {
    constexpr std::size_t kLongest = 120;
    std::string result;
    for (const char c : text.substr(0, kLongest)) {
        const auto byte = static_cast<unsigned char>(c);
        result += byte < 0x20 || byte == 0x7f ? ' ' : c;
    }
    if (text.size() <= kLongest) return result;
    // A character of several bytes is not cut in two.
    while (!result.empty() && (static_cast<unsigned char>(result.back()) & 0xc0) == 0x80)
        result.pop_back();
    if (!result.empty() && static_cast<unsigned char>(result.back()) >= 0xc0) result.pop_back();
    return result + "...";
}

} // namespace

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> pieces;
    if (text.empty()) return pieces;
    std::size_t start = 0;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        if (i < text.size() && text[i] != separator) continue;
        pieces.push_back(text.substr(start, i - start));
        start = i + 1;
    }
    return pieces;
}

std::string nearestName(std::string_view name, const std::vector<std::string>& candidates) {
    // A third of the letters wrong is still a likely misspelling; more is a different word.
    const std::size_t limit = std::max<std::size_t>(1, name.size() / 3);
    // The distance is quadratic; a name this long is no misspelling of anything.
    constexpr std::size_t kLongestName = 256;
    if (name.size() > kLongestName) return {};
    std::size_t best = limit + 1;
    std::string nearest;
    bool longerNearest = false;
    for (const std::string& candidate : candidates) {
        if (candidate.size() > name.size() + limit || name.size() > candidate.size() + limit)
            continue;
        const bool longer = !longerNearest && goesOn(name, candidate);
        const std::size_t distance = editDistance(name, candidate, longer ? limit : best - 1);
        if (distance > limit) continue;
        if (distance < best || (longer && distance == best)) {
            best = distance;
            nearest = candidate;
            longerNearest = goesOn(name, candidate);
        }
        if (best == 0) break;
    }
    return nearest;
}

std::string listOfNames(const std::vector<std::string>& names) {
    // Nobody reads more; the nearest name is told apart from the list.
    constexpr std::size_t kMost = 24;
    const bool all = names.size() <= kMost;
    const std::size_t shown = all ? names.size() : kMost / 2;
    std::string text;
    for (std::size_t i = 0; i < shown; ++i) {
        if (i > 0) text += all && i + 1 == shown ? " or " : ", ";
        text += "'" + names[i] + "'";
    }
    if (!all) text += " or " + std::to_string(names.size() - shown) + " others";
    return text;
}

std::string inQuotes(std::string_view text) {
    return "'" + shown(text) + "'";
}

std::string asTag(std::string_view name) {
    return "<" + shown(name) + ">";
}

std::string withArticle(std::string_view noun) {
    constexpr std::string_view kVowels = "aeiouAEIOU";
    const bool vowel = !noun.empty() && kVowels.find(noun[0]) != std::string_view::npos;
    return (vowel ? "an " : "a ") + std::string(noun);
}

std::optional<ParsedNumber<int>> parseBits(std::string_view text) {
    const auto wide = parseNumber<long long>(text);
    if (!wide || wide->value < std::numeric_limits<int>::min() ||
        wide->value > std::numeric_limits<unsigned>::max())
        return std::nullopt;
    return ParsedNumber<int>{static_cast<int>(static_cast<unsigned>(wide->value)), wide->length};
}

std::optional<ParsedNumber<int>> parseInt(std::string_view text) {
    return parseNumber<int>(text);
}

std::optional<ParsedNumber<double>> parseReal(std::string_view text) {
    return parseNumber<double>(text);
}

bool isBlank(std::string_view text) {
    return std::all_of(text.begin(), text.end(),
                       [](char c) { return std::isspace(static_cast<unsigned char>(c)); });
}

} // namespace terrane
