// SPDX-License-Identifier: BSD-3-Clause
#include "render/glsl_legacy.h"

#include "render/glsl_legacy_names.h"
#include "render/glsl_tokens.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <unordered_set>

namespace terrane {

namespace {

class Rewriter {
public:
    Rewriter(const GlslText& text, int version, ShaderStage stage,
             const std::vector<std::string>& macros, std::vector<LegacyChange>& changes)
        : text_(text)
        , version_(version)
        , stage_(stage)
        , changes_(changes)
        , tokens_(scanGlsl(text.text())) {
        for (const std::string_view name : definedMacros(tokens_))
            own_.insert(name);
        for (const std::string& macro : macros)
            own_.insert(std::string_view(macro).substr(0, macro.find_first_of(" (\t")));
        findFunctions();
    }

    GlslText run() {
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            const GlslToken& token = tokens_[i];
            if (token.directive == "extension" || token.directive == "line") {
                i = rewriteDirective(i);
                continue;
            }
            // Conditions name macros, which are not ours to rename.
            if (!token.directive.empty() && token.directive != "define") continue;
            if (token.kind == GlslToken::Kind::identifier && !own_.contains(token.text))
                rewriteWord(i);
        }
        if (edits_.empty()) return text_;
        declareOutputs();
        std::stable_sort(edits_.begin(), edits_.end(),
                         [](const auto& a, const auto& b) { return a.offset < b.offset; });
        return text_.edited(edits_);
    }

private:
    const GlslToken* at(std::size_t i) const { return i < tokens_.size() ? &tokens_[i] : nullptr; }
    bool isSymbol(std::size_t i, std::string_view symbol) const {
        return i < tokens_.size() && tokens_[i].text == symbol;
    }

    // `vec4 texture2DArray(...)`: a name that stands behind a type and before a parenthesis is the
    // author's own function.
    void findFunctions() {
        for (std::size_t i = 1; i + 1 < tokens_.size(); ++i) {
            if (tokens_[i].kind != GlslToken::Kind::identifier || !isSymbol(i + 1, "(")) continue;
            const GlslToken& before = tokens_[i - 1];
            const bool type = before.kind == GlslToken::Kind::identifier &&
                              before.text != "return" && before.text != "else" &&
                              before.directive == tokens_[i].directive && before.directive.empty();
            if (type && newTextureFunction(tokens_[i].text, version_)) own_.insert(tokens_[i].text);
        }
    }

    void rewriteWord(std::size_t i) {
        const std::string_view word = tokens_[i].text;
        // `a.input` is a member, which is renamed as well; `a.texture2D` is none of ours.
        const bool member = i > 0 && isSymbol(i - 1, ".");
        if (isReservedHere(i)) return replace(i, std::string(kRenamedPrefix) + std::string(word));
        if (member) return;
        if (word.starts_with("gl_")) return rewriteBuiltIn(i);
        if (isSymbol(i + 1, "(")) return rewriteFunction(i);
        if (version_ >= kRemovalVersion) rewriteStorage(i);
    }

    void rewriteFunction(std::size_t i) {
        const std::optional<NewName> name = newTextureFunction(tokens_[i].text, version_);
        if (!name) return;
        const std::size_t close = name->wrapped ? closing(i + 1, "(", ")") : 0;
        if (name->wrapped && close == 0) return;
        replace(i, name->name);
        if (name->wrapped) insertBehind(close, ")");
    }

    void rewriteBuiltIn(std::size_t i) {
        const std::string_view word = tokens_[i].text;
        if (word == "gl_VerticesIn") return replace(i, "gl_in.length()");
        if (word == "gl_InstanceIDARB") return replace(i, "gl_InstanceID");
        if (word == kFragColor.old || word == kFragData.old) return rewriteOutput(i);
        if (word != "gl_PositionIn" && word != "gl_PointSizeIn") return;
        const std::size_t close = isSymbol(i + 1, "[") ? closing(i + 1, "[", "]") : 0;
        if (close == 0) return;
        const std::string member(word.substr(0, word.size() - 2));
        record(i, "gl_in[]." + member);
        edits_.push_back({tokens_[i].offset, word.size(), "gl_in"});
        insertBehind(close, "." + member);
    }

    // Core GLSL has no outputs of its own: they are declared where nothing stands before them but
    // directives.
    void rewriteOutput(std::size_t i) {
        if (version_ < kRemovalVersion || stage_ != ShaderStage::fragment) return;
        const OldOutput& output = tokens_[i].text == kFragColor.old ? kFragColor : kFragData;
        replace(i, std::string(output.name));
        outputs_.insert(output.declaration);
    }

    void declareOutputs() {
        if (outputs_.empty()) return;
        std::string declarations;
        for (const std::string_view output : outputs_)
            declarations += std::string(output) + "\n";
        edits_.insert(edits_.begin(), {tokens_[firstBehindExtensions()].offset, 0, declarations});
    }

    // #extension lines must stand before everything else. When the last one is conditional, what
    // follows its #endif will do, unless the condition encloses more than directives.
    std::size_t firstBehindExtensions() const {
        std::size_t first = 0;
        int depth = 0;
        int extensionDepth = 0;
        bool code = false; // since the last extension
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            const GlslToken& token = tokens_[i];
            code = code || token.directive.empty();
            const bool directiveName = i > 0 && token.directive.data() == token.text.data();
            if (directiveName && token.text.starts_with("if")) ++depth;
            const bool ends = directiveName && token.text == "endif";
            if (ends) --depth;
            const bool extension = directiveName && token.text == "extension";
            if (extension) extensionDepth = depth;
            if (extension) code = false;
            const bool leaves = ends && !code && depth < extensionDepth;
            if (leaves) extensionDepth = depth;
            if (extension || leaves) first = behindDirective(i);
        }
        return first < tokens_.size() ? first : 0;
    }

    // The token after the directive that token i belongs to.
    std::size_t behindDirective(std::size_t i) const {
        const std::string_view directive = tokens_[i].directive;
        while (i < tokens_.size() && tokens_[i].directive.data() == directive.data())
            ++i;
        return i;
    }

    void rewriteStorage(std::size_t i) {
        const std::string_view word = tokens_[i].text;
        if (word == "attribute") replace(i, "in");
        if (word == "varying") replace(i, stage_ == ShaderStage::fragment ? "in" : "out");
    }

    // Takes the directive that starts with token i out, if it has to go; gives its last token.
    std::size_t rewriteDirective(std::size_t i) {
        std::size_t last = i;
        const std::string_view directive = tokens_[i].directive;
        while (last + 1 < tokens_.size() && tokens_[last + 1].directive.data() == directive.data())
            ++last;
        const std::string_view argument = i + 1 <= last ? tokens_[i + 1].text : "";
        if (i == 0 || (directive == "extension" && !isAbsorbedExtension(argument))) return last;
        // The '#' stands before the directive's name.
        const std::size_t begin = tokens_[i - 1].offset;
        const std::size_t end = tokens_[last].offset + tokens_[last].text.size();
        std::string from = "#" + std::string(directive);
        if (directive == "extension") from += " " + std::string(argument);
        changes_.push_back({text_.place(begin), std::move(from), ""});
        // A comment or a backslash may carry it over several lines.
        const auto first = text_.text().begin() + static_cast<std::ptrdiff_t>(begin);
        const auto lines =
            std::count(first, first + static_cast<std::ptrdiff_t>(end - begin), '\n');
        edits_.push_back({begin, end - begin, std::string(static_cast<std::size_t>(lines), '\n')});
        return last;
    }

    bool isReservedHere(std::size_t i) const {
        const std::string_view word = tokens_[i].text;
        const ReservedWord* const reserved = findReservedWord(word);
        if (!reserved || version_ < reserved->since) return false;
        return !insideLayout(i) && (!reserved->qualifier || isIdentifier(i));
    }

    // Whether a word that may be a qualifier stands as a name: a qualifier has a type, another
    // qualifier or a block's name behind it.
    bool isIdentifier(std::size_t i) const {
        const GlslToken* const next = at(i + 1);
        if (next && next->kind == GlslToken::Kind::identifier) return false;
        // `layout(std430) buffer;` sets a default.
        return !(isSymbol(i + 1, ";") && i > 0 && isSymbol(i - 1, ")"));
    }

    bool insideLayout(std::size_t i) const {
        constexpr std::size_t kLongestLayout = 64;
        for (std::size_t back = 1; back <= std::min(i, kLongestLayout); ++back) {
            const std::string_view text = tokens_[i - back].text;
            if (text == ";" || text == "{" || text == "}" || text == ")") return false;
            if (text == "(") return i > back && tokens_[i - back - 1].text == "layout";
        }
        return false;
    }

    // The token that closes the bracket at token `open`, or 0.
    std::size_t closing(std::size_t open, std::string_view opens, std::string_view closes) const {
        int depth = 0;
        for (std::size_t i = open; i < tokens_.size(); ++i) {
            if (tokens_[i].text == opens) ++depth;
            if (tokens_[i].text == closes && --depth == 0) return i;
        }
        return 0;
    }

    void record(std::size_t i, std::string to) {
        changes_.push_back(
            {text_.place(tokens_[i].offset), std::string(tokens_[i].text), std::move(to)});
    }
    void replace(std::size_t i, const std::string& with) {
        record(i, with);
        edits_.push_back({tokens_[i].offset, tokens_[i].text.size(), with});
    }
    void insertBehind(std::size_t i, std::string text) {
        edits_.push_back({tokens_[i].offset + tokens_[i].text.size(), 0, std::move(text)});
    }

    const GlslText& text_;
    int version_;
    ShaderStage stage_;
    std::vector<LegacyChange>& changes_;
    std::vector<GlslToken> tokens_;
    std::unordered_set<std::string_view> own_;
    std::vector<GlslText::Edit> edits_;
    std::set<std::string_view> outputs_; ///< declarations that are needed
};

// What a name of ours stands for; empty when it is none of ours.
std::string_view originalGlslWord(std::string_view word) {
    for (const OldOutput& output : {kFragColor, kFragData}) {
        if (word == output.name) return output.old;
    }
    if (!word.starts_with(kRenamedPrefix)) return {};
    word.remove_prefix(kRenamedPrefix.size());
    return findReservedWord(word) ? word : std::string_view();
}

std::string describe(const std::string& from, const std::set<std::string>& to) {
    if (to.contains("")) return "'" + from + "' taken out";
    std::string text = "'" + from + "' to ";
    for (const std::string& name : to)
        text += (name == *to.begin() ? "'" : " or '") + name + "'";
    return text;
}

} // namespace

GlslText rewriteLegacyGlsl(const GlslText& text, int version, ShaderStage stage,
                           const std::vector<std::string>& macros,
                           std::vector<LegacyChange>& changes) {
    return Rewriter(text, version, stage, macros, changes).run();
}

void reportLegacyGlsl(const std::vector<LegacyChange>& changes, Diagnostics& diagnostics) {
    struct File {
        Place first;
        std::map<std::string, std::set<std::string>> words;
    };
    std::map<const SourceFile*, File> files;
    for (const LegacyChange& change : changes) {
        File& file = files[change.place.file.get()];
        if (!file.first || change.place.offset < file.first.offset) file.first = change.place;
        file.words[change.from].insert(change.to);
    }
    for (const auto& [source, file] : files) {
        std::string list;
        for (const auto& [from, to] : file.words)
            list += (list.empty() ? "" : ", ") + describe(from, to);
        diagnostics.warning("legacy-glsl", file.first, "old GLSL rewritten: " + list);
    }
}

std::string originalGlslName(std::string_view name) {
    std::string result;
    std::size_t i = 0;
    while (i < name.size()) {
        const bool partBegins = i == 0 || !isGlslIdentifierPart(name[i - 1]);
        std::size_t end = i;
        while (partBegins && end < name.size() && isGlslIdentifierPart(name[end]))
            ++end;
        const std::string_view word = name.substr(i, end - i);
        const std::string_view original = originalGlslWord(word);
        if (original.empty()) {
            result += name[i++];
            continue;
        }
        result += original;
        i = end;
    }
    return result;
}

} // namespace terrane
