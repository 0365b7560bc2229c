// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace terrane {

/// What is wrong with a text that is no XML, told where the author can mend it: an unclosed quote,
/// comment or tag at where it opens, a wrong end tag at the end tag.
struct XmlFault {
    std::size_t offset = 0;
    std::string message;
    std::string expected; ///< may be empty
};

/// Finds the first fault of a text that the XML parser has refused; the parser itself only knows
/// where it gave up, which may be at the end of the file. Nothing when no fault is seen. Linear in
/// the length of the text.
std::optional<XmlFault> findXmlFault(std::string_view text);

/// Offsets of each '<', and of each '&' that starts no entity of XML, in the values of attributes:
/// our parser takes them as they are, others refuse the file. Linear in the length of the text.
std::vector<std::size_t> findLooseCharacters(std::string_view text);

} // namespace terrane
