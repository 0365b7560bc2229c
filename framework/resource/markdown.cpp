// SPDX-License-Identifier: BSD-3-Clause
#include "resource/markdown.h"

#include <cctype>

namespace terrane {

namespace {

bool isWord(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

// The end of a piece in quotes that starts at `i`, which is no apostrophe; npos if none does.
std::size_t closingQuote(std::string_view text, std::size_t i) {
    if (text[i] != '\'' || (i > 0 && isWord(text[i - 1]))) return std::string_view::npos;
    for (std::size_t end = text.find('\'', i + 1); end != std::string_view::npos;
         end = text.find('\'', end + 1)) {
        if (end > i + 1 && (end + 1 == text.size() || !isWord(text[end + 1]))) return end;
    }
    return std::string_view::npos;
}

} // namespace

std::string asMarkdown(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const std::size_t end = closingQuote(text, i);
        if (end != std::string_view::npos) {
            result += asCode(text.substr(i + 1, end - i - 1));
            i = end;
            continue;
        }
        const std::size_t close = c == '<' ? text.find('>', i) : std::string_view::npos;
        if (close != std::string_view::npos) {
            result += asCode(text.substr(i, close + 1 - i));
            i = close;
            continue;
        }
        if (std::string_view("\\`*_[]<>#|").find(c) != std::string_view::npos) result += '\\';
        result += c;
    }
    return result;
}

std::string asCode(std::string_view text) {
    return "`" + std::string(text) + "`";
}

std::string asLink(const std::string& markdown, const std::string& target) {
    return "[" + markdown + "](" + target + ")";
}

std::string anchorOf(std::string_view heading) {
    std::string anchor;
    for (const char c : heading) {
        if (isWord(c) || c == '-' || c == '_')
            anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        else if (c == ' ')
            anchor += '-';
    }
    return anchor;
}

std::string pageOf(std::string_view title) {
    return anchorOf(title) + ".md";
}

std::string alternatives(const std::vector<std::string>& markdown, const std::string& lastWord) {
    std::string text;
    for (std::size_t i = 0; i < markdown.size(); ++i) {
        if (i > 0) text += i + 1 == markdown.size() ? lastWord : ", ";
        text += markdown[i];
    }
    return text;
}

std::string tableRow(const std::vector<std::string>& cells) {
    std::string row = "|";
    for (const std::string& cell : cells)
        row += " " + cell + " |";
    return row + "\n";
}

} // namespace terrane
