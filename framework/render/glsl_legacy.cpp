// SPDX-License-Identifier: BSD-3-Clause
#include "render/glsl_legacy.h"

#include "render/glsl_tokens.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <unordered_set>

namespace terrane {

namespace {

constexpr std::string_view kRenamedPrefix = "terrane_";
constexpr int kRemovalVersion = 420; // the core profile lost its deprecated names with GLSL 4.20

struct ReservedWord {
    std::string_view word;
    int since;              // GLSL version
    bool qualifier = false; // a keyword with a meaning, not only kept for later
};

// GLSL specifications 3.30 to 4.50, section 3.6 "Keywords".
constexpr std::array kReservedWords{
    ReservedWord{"active", 130},
    ReservedWord{"asm", 130},
    ReservedWord{"cast", 130},
    ReservedWord{"class", 130},
    ReservedWord{"common", 130},
    ReservedWord{"enum", 130},
    ReservedWord{"extern", 130},
    ReservedWord{"external", 130},
    ReservedWord{"filter", 130},
    ReservedWord{"fixed", 130},
    ReservedWord{"goto", 130},
    ReservedWord{"half", 130},
    ReservedWord{"inline", 130},
    ReservedWord{"input", 130},
    ReservedWord{"interface", 130},
    ReservedWord{"long", 130},
    ReservedWord{"namespace", 130},
    ReservedWord{"noinline", 130},
    ReservedWord{"output", 130},
    ReservedWord{"packed", 130},
    ReservedWord{"partition", 130},
    ReservedWord{"public", 130},
    ReservedWord{"short", 130},
    ReservedWord{"sizeof", 130},
    ReservedWord{"static", 130},
    ReservedWord{"superp", 130},
    ReservedWord{"template", 130},
    ReservedWord{"this", 130},
    ReservedWord{"typedef", 130},
    ReservedWord{"union", 130},
    ReservedWord{"unsigned", 130},
    ReservedWord{"using", 130},
    ReservedWord{"resource", 420},
    ReservedWord{"patch", 400, true},
    ReservedWord{"precise", 400, true},
    ReservedWord{"sample", 400, true},
    ReservedWord{"coherent", 420, true},
    ReservedWord{"readonly", 420, true},
    ReservedWord{"restrict", 420, true},
    ReservedWord{"volatile", 130, true},
    ReservedWord{"writeonly", 420, true},
    ReservedWord{"buffer", 430, true},
    ReservedWord{"shared", 430, true},
};

// Extensions whose contents core GLSL 3.30 has, under the names that texture functions and geometry
// inputs are rewritten to; drivers that don't know them refuse `require`.
constexpr std::array<std::string_view, 3> kAbsorbedExtensions{
    "GL_EXT_gpu_shader4", "GL_EXT_geometry_shader4", "GL_EXT_texture_array"};

bool startsWithAny(std::string_view& text, std::initializer_list<std::string_view> choices) {
    for (const std::string_view choice : choices) {
        if (!text.starts_with(choice)) continue;
        text.remove_prefix(choice.size());
        return true;
    }
    return false;
}

bool isLookupSuffix(std::string_view suffix) {
    constexpr std::array<std::string_view, 12> suffixes{
        "",       "Proj",       "Lod",       "ProjLod",       "Grad",       "ProjGrad",
        "Offset", "ProjOffset", "LodOffset", "ProjLodOffset", "GradOffset", "ProjGradOffset"};
    return std::find(suffixes.begin(), suffixes.end(), suffix) != suffixes.end();
}

// Part of the deprecated names that core GLSL had until 4.10.
bool wasCore(std::string_view dimension, std::string_view suffix, bool shadow) {
    const bool plain = suffix.empty() || suffix == "Lod";
    const bool projected = suffix == "Proj" || suffix == "ProjLod";
    if (dimension == "1D" || dimension == "2D") return plain || projected;
    if (shadow) return false;
    return dimension == "3D" ? plain || projected : dimension == "Cube" && plain;
}

struct NewName {
    std::string name;
    bool wrapped = false; // the call becomes vec4(...): old shadow functions gave four components
};

// What a texture function is called in core GLSL, when it has to be renamed.
std::optional<NewName> newTextureFunction(std::string_view name, int version) {
    std::string_view rest = name;
    std::string_view base;
    bool shadow = false;
    if (startsWithAny(rest, {"texelFetch"}))
        base = "texelFetch";
    else if (startsWithAny(rest, {"textureSize"}))
        base = "textureSize";
    else if (startsWithAny(rest, {"texture"}))
        base = "texture";
    else if (startsWithAny(rest, {"shadow"}))
        shadow = true;
    else
        return std::nullopt;
    const std::string_view from = rest;
    if (!startsWithAny(rest, {"1DArray", "2DArray", "2DRect", "CubeArray", "Cube", "Buffer", "1D",
                              "2D", "3D"}))
        return std::nullopt;
    const std::string_view dimension = from.substr(0, from.size() - rest.size());
    if (base == "textureSize") {
        if (!rest.empty()) return std::nullopt;
        return NewName{"textureSize"};
    }
    if (base == "texelFetch") {
        if (!rest.empty() && rest != "Offset") return std::nullopt;
        return NewName{"texelFetch" + std::string(rest)};
    }
    for (const std::string_view vendor : {"ARB", "EXT"}) {
        if (rest.ends_with(vendor)) rest.remove_suffix(vendor.size());
    }
    if (!isLookupSuffix(rest)) return std::nullopt;
    const bool vendorName =
        name.size() != (shadow ? 6 : base.size()) + dimension.size() + rest.size();
    if (!vendorName && wasCore(dimension, rest, shadow) && version < kRemovalVersion)
        return std::nullopt;
    // Core GLSL has rectangle textures, but their old function stayed valid where it was.
    if (shadow) return NewName{"vec4(texture" + std::string(rest), true};
    return NewName{"texture" + std::string(rest)};
}

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
        if (word != "gl_PositionIn" && word != "gl_PointSizeIn") return;
        const std::size_t close = isSymbol(i + 1, "[") ? closing(i + 1, "[", "]") : 0;
        if (close == 0) return;
        const std::string member(word.substr(0, word.size() - 2));
        record(i, "gl_in[]." + member);
        edits_.push_back({tokens_[i].offset, word.size(), "gl_in"});
        insertBehind(close, "." + member);
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
        const bool absorbed = std::find(kAbsorbedExtensions.begin(), kAbsorbedExtensions.end(),
                                        argument) != kAbsorbedExtensions.end();
        if (i == 0 || (directive == "extension" && !absorbed)) return last;
        // The '#' stands before the directive's name.
        const std::size_t begin = tokens_[i - 1].offset;
        const std::size_t end = tokens_[last].offset + tokens_[last].text.size();
        std::string from = "#" + std::string(directive);
        if (directive == "extension") from += " " + std::string(argument);
        changes_.push_back({text_.place(begin), std::move(from), ""});
        edits_.push_back({begin, end - begin, ""});
        return last;
    }

    bool isReservedHere(std::size_t i) const {
        const std::string_view word = tokens_[i].text;
        const auto found =
            std::find_if(kReservedWords.begin(), kReservedWords.end(),
                         [&](const auto& reserved) { return reserved.word == word; });
        if (found == kReservedWords.end() || version_ < found->since) return false;
        return !insideLayout(i) && (!found->qualifier || isIdentifier(i));
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
};

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
        if (partBegins && name.substr(i).starts_with(kRenamedPrefix)) {
            std::size_t end = i + kRenamedPrefix.size();
            while (end < name.size() && isGlslIdentifierPart(name[end]))
                ++end;
            const std::string_view word =
                name.substr(i + kRenamedPrefix.size(), end - i - kRenamedPrefix.size());
            const bool ours = std::any_of(kReservedWords.begin(), kReservedWords.end(),
                                          [&](const auto& r) { return r.word == word; });
            if (ours) {
                result += word;
                i = end;
                continue;
            }
        }
        result += name[i++];
    }
    return result;
}

} // namespace terrane
