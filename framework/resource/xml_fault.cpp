// SPDX-License-Identifier: BSD-3-Clause
#include "resource/xml_fault.h"

#include "core/source.h"
#include "core/text.h"

#include <algorithm>
#include <vector>

namespace terrane {

namespace {

constexpr std::size_t kNone = std::string_view::npos;

bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
bool startsName(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') || byte == '_' ||
           byte == ':' || byte >= 0x80;
}
bool inName(char c) {
    return startsName(c) || (c >= '0' && c <= '9') || c == '-' || c == '.';
}

// `&lt;` and so on, `&#60;`, `&#x3c;`.
bool startsEntity(std::string_view text) {
    const std::string_view name = text.substr(1, std::min(text.find(';'), text.size()) - 1);
    if (name.size() + 1 == text.size()) return false; // no ';'
    constexpr std::string_view kNames[] = {"lt", "gt", "amp", "quot", "apos"};
    if (std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames)) return true;
    const bool hexadecimal = name.starts_with("#x");
    const std::string_view digits =
        name.substr(std::min<std::size_t>(hexadecimal ? 2 : 1, name.size()));
    return name.starts_with('#') && !digits.empty() &&
           digits.find_first_not_of(hexadecimal ? "0123456789abcdefABCDEF" : "0123456789") == kNone;
}

class Scanner {
public:
    /// @param loose gets the offsets of loose characters; may be null
    explicit Scanner(std::string_view text, std::vector<std::size_t>* loose = nullptr)
        : text_(text)
        , loose_(loose) {}

    std::optional<XmlFault> run() {
        while (!fault_) {
            at_ = text_.find('<', at_);
            if (at_ == kNone) break;
            scanMarkup();
        }
        if (!fault_ && !open_.empty()) {
            const Open& last = open_.back();
            fail(last.offset, "<" + last.name() + "> is not closed", "</" + last.name() + ">");
        }
        return fault_;
    }

private:
    struct Open {
        std::string_view tag;
        std::size_t offset; // of the '<'
        std::string name() const { return std::string(tag.substr(0, 100)); }
    };

    char peek(std::size_t ahead = 0) const {
        return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
    }
    bool atEnd() const { return at_ >= text_.size(); }
    void skipSpace() {
        while (!atEnd() && isSpace(text_[at_]))
            ++at_;
    }
    std::string_view readName() {
        const std::size_t start = at_;
        while (!atEnd() && inName(text_[at_]))
            ++at_;
        return text_.substr(start, at_ - start);
    }

    // A quote that swallowed markup is the likely cause of whatever goes wrong behind it.
    void fail(std::size_t offset, std::string message, std::string expected = {}) {
        if (runawayQuote_ != kNone) return failQuote(runawayQuote_);
        fault_ = XmlFault{offset, std::move(message), std::move(expected)};
    }
    void failQuote(std::size_t offset) {
        fault_ = XmlFault{offset, "the quote is not closed", std::string(1, text_[offset])};
    }

    void scanMarkup() {
        const std::string_view rest = text_.substr(at_);
        if (rest.starts_with("<!--")) return skip(4, "-->", "the comment");
        if (rest.starts_with("<![CDATA[")) return skip(9, "]]>", "the CDATA section");
        if (rest.starts_with("<?")) return skip(2, "?>", "the declaration");
        if (rest.starts_with("<!DOCTYPE")) return skipDoctype();
        if (rest.starts_with("</")) return scanEndTag();
        if (rest.size() > 1 && startsName(rest[1])) return scanStartTag();
        fail(at_, "'<' starts no element", "a name after it, or &lt; for the character");
    }

    void skip(std::size_t opening, std::string_view closing, const std::string& what) {
        const std::size_t end = text_.find(closing, at_ + opening);
        if (end == kNone) return fail(at_, what + " is not closed", std::string(closing));
        at_ = end + closing.size();
    }

    void skipDoctype() {
        int depth = 0;
        for (std::size_t i = at_; i < text_.size(); ++i) {
            if (text_[i] == '<') ++depth;
            if (text_[i] == '>' && --depth == 0) {
                at_ = i + 1;
                return;
            }
        }
        fail(at_, "the document type is not closed", ">");
    }

    void scanEndTag() {
        const std::size_t start = at_;
        at_ += 2;
        const std::string_view tag = readName();
        skipSpace();
        if (peek() != '>')
            return fail(start,
                        "the end tag </" + std::string(tag.substr(0, 100)) + " is not closed",
                        "</" + std::string(tag.substr(0, 100)) + ">");
        ++at_;
        if (!open_.empty() && open_.back().tag == tag) {
            open_.pop_back();
            return;
        }
        failEndTag(tag, start);
    }

    // Either an element inside was left open, or the end tag itself is wrong.
    void failEndTag(std::string_view tag, std::size_t start) {
        const std::string name(tag.substr(0, 100));
        if (open_.empty()) return fail(start, "</" + name + "> closes no element");
        const Open& last = open_.back();
        const auto outer = std::find_if(open_.begin(), open_.end(),
                                        [&](const Open& open) { return open.tag == tag; });
        if (outer == open_.end())
            return fail(start, "</" + name + "> does not close <" + last.name() + ">",
                        "</" + last.name() + ">");
        fail(last.offset, "<" + last.name() + "> is not closed",
             "</" + last.name() + "> before the </" + name + "> that stands at " + shown(start));
    }

    std::string shown(std::size_t offset) const {
        const auto begin = text_.begin();
        const auto line = std::count(begin, begin + static_cast<std::ptrdiff_t>(offset), '\n') + 1;
        return "line " + std::to_string(line);
    }

    void scanStartTag() {
        Open tag{{}, at_};
        ++at_;
        tag.tag = readName();
        for (;;) {
            const bool separated = !atEnd() && isSpace(text_[at_]);
            skipSpace();
            const char c = peek();
            if (atEnd() || c == '<')
                return fail(tag.offset, "the tag <" + tag.name() + " is not closed", ">");
            if (c == '>') {
                ++at_;
                open_.push_back(tag);
                return;
            }
            if (c == '/') {
                if (peek(1) != '>')
                    return fail(at_, "'/' stands in the tag <" + tag.name() + ">", "/>");
                at_ += 2;
                return;
            }
            if (!startsName(c))
                return fail(
                    at_, inQuotes(text_.substr(at_, 1)) + " stands in the tag <" + tag.name() + ">",
                    "an attribute, '>' or '/>'");
            if (!separated) return fail(at_, "there is no blank before the attribute", "a blank");
            if (!scanAttribute()) return;
        }
    }

    bool scanAttribute() {
        const std::size_t start = at_;
        const std::string name(readName().substr(0, 100));
        skipSpace();
        if (peek() != '=') {
            fail(start, "the attribute '" + name + "' has no value", name + "=\"...\"");
            return false;
        }
        ++at_;
        skipSpace();
        const char quote = peek();
        if (quote != '"' && quote != '\'') {
            fail(std::min(at_, text_.size()), "the value of '" + name + "' is not in quotes",
                 name + "=\"...\"");
            return false;
        }
        const std::size_t opening = at_;
        const std::size_t closing = text_.find(quote, opening + 1);
        if (closing == kNone) {
            failQuote(opening);
            return false;
        }
        at_ = closing + 1;
        const std::string_view value = text_.substr(opening + 1, closing - opening - 1);
        if (loose_) findLoose(opening + 1, value);
        const char next = peek();
        const bool proper = isSpace(next) || next == '>' || next == '/' || atEnd();
        if (!proper && swallowedMarkup(value)) {
            failQuote(opening);
            return false;
        }
        if (runawayQuote_ == kNone && value.find('<') != kNone && value.find('\n') != kNone)
            runawayQuote_ = opening;
        return true;
    }

    void findLoose(std::size_t begin, std::string_view value) {
        for (std::size_t at = 0; (at = value.find_first_of("<&", at)) != kNone; ++at) {
            // No entity is longer.
            if (value[at] == '<' || !startsEntity(value.substr(at, 12)))
                loose_->push_back(begin + at);
        }
    }

    // `a="1 b="2"` and `a="1>` + a new line + `<b c="2"`: the value ends where the next one starts.
    static bool swallowedMarkup(std::string_view value) {
        if (value.find_first_of("<\n") != kNone) return true;
        const std::size_t last = value.find_last_not_of(" \t\r\n");
        return last != kNone && value[last] == '=';
    }

    std::string_view text_;
    std::vector<std::size_t>* loose_;
    std::size_t at_ = 0;
    std::vector<Open> open_;
    std::size_t runawayQuote_ = kNone;
    std::optional<XmlFault> fault_;
};

} // namespace

std::optional<XmlFault> findXmlFault(std::string_view text) {
    return Scanner(text).run();
}

std::vector<std::size_t> findLooseCharacters(std::string_view text) {
    std::vector<std::size_t> loose;
    Scanner(text, &loose).run();
    return loose;
}

} // namespace terrane
