// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Small pieces of Markdown, as GitHub and editors show it.
namespace terrane {

/// Plain text as Markdown: nothing of it is markup, but words in single quotes become code.
std::string asMarkdown(std::string_view text);
/// In backquotes.
std::string asCode(std::string_view text);
std::string asLink(const std::string& markdown, const std::string& target);
/// The part of a link that leads to a heading.
std::string anchorOf(std::string_view heading);
/// The name of a page with a title: "Meshes and fonts" is "meshes-and-fonts.md".
std::string pageOf(std::string_view title);
/// "a, b or c", or with another last word.
std::string alternatives(const std::vector<std::string>& markdown,
                         const std::string& lastWord = " or ");
/// A row of a table.
std::string tableRow(const std::vector<std::string>& cells);

} // namespace terrane
