// SPDX-License-Identifier: BSD-3-Clause
#include "render/glsl_source.h"

#include "core/text.h"
#include "render/glsl_tokens.h"

#include <algorithm>

namespace terrane {

namespace {

// A chain this long is no library of shaders but a lookup that never ends.
constexpr std::size_t kDeepestInclude = 64;
// Empty files that include one another twice would grow the work but not the text.
constexpr int kMostIncludes = 4096;

struct Include {
    std::size_t end = 0; // behind the closing quote
    std::string name;
    bool wellFormed = false;
};

std::size_t skipBlanks(std::string_view text, std::size_t i) {
    while (i < text.size() && (text[i] == ' ' || text[i] == '\t'))
        ++i;
    return i;
}

// The include directive that starts with the '#' at `offset`, if it is one.
std::optional<Include> includeAt(std::string_view text, std::size_t offset) {
    constexpr std::string_view word = "include";
    std::size_t i = skipBlanks(text, offset + 1);
    if (text.substr(i, word.size()) != word) return std::nullopt;
    i += word.size();
    if (i < text.size() && isGlslIdentifierPart(text[i])) return std::nullopt;
    i = skipBlanks(text, i);
    Include include;
    include.end = i;
    if (i >= text.size() || text[i] != '"') return include;
    const std::size_t close = text.find_first_of("\"\n", i + 1);
    if (close == std::string_view::npos || text[close] != '"') return include;
    include.name = text.substr(i + 1, close - i - 1);
    include.end = close + 1;
    include.wellFormed = !include.name.empty();
    return include;
}

class Expander {
public:
    Expander(const GlslFiles& files, Diagnostics& diagnostics)
        : files_(files)
        , diagnostics_(diagnostics) {}

    ExpandedGlsl run(const std::shared_ptr<const SourceFile>& file) {
        remember(file);
        expand(file, result_.text);
        return std::move(result_);
    }

private:
    void expand(const std::shared_ptr<const SourceFile>& file, GlslText& target) {
        stack_.push_back(file);
        const std::string& text = file->text();
        std::size_t done = 0;
        std::size_t i = 0;
        while (i < text.size() && !full_) {
            const std::size_t afterComment = skipGlslComment(text, i);
            if (afterComment > i) {
                i = afterComment;
                continue;
            }
            const std::optional<Include> include =
                text[i] == '#' ? includeAt(text, i) : std::nullopt;
            if (!include) {
                ++i;
                continue;
            }
            add(target, file, done, i);
            insert(target, *include, {file, i});
            done = i = include->end;
        }
        add(target, file, done, text.size());
        stack_.pop_back();
    }

    void add(GlslText& target, const std::shared_ptr<const SourceFile>& file, std::size_t begin,
             std::size_t end) {
        if (full_) return;
        size_ += end - begin;
        if (size_ > kLongestGlsl)
            stop({file, begin}, "the text with its includes is longer than 16 MiB");
        else
            target.append(file, begin, end - begin);
    }

    void insert(GlslText& target, const Include& include, const Place& place) {
        if (!include.wellFormed)
            return fail("include-syntax", place, "no file name after #include",
                        "#include \"file\"");
        const std::shared_ptr<const SourceFile> file =
            files_.find ? files_.find(include.name, place) : nullptr;
        if (!file) return reportMissing(include, place);
        if (const std::string cycle = cycleThrough(*file); !cycle.empty())
            return fail("include-cycle", place,
                        "'" + include.name + "' is included in itself: " + cycle);
        if (stack_.size() >= kDeepestInclude || ++count_ > kMostIncludes)
            return stop(place, "more includes than any shader needs");
        remember(file);
        GlslText included;
        expand(file, included);
        target.appendIncluded(included, place);
    }

    // "a.glsl, b.glsl, a.glsl" when the file is being expanded already, else empty.
    std::string cycleThrough(const SourceFile& file) const {
        const auto same = [&](const auto& open) { return open->path() == file.path(); };
        const auto first = std::find_if(stack_.begin(), stack_.end(), same);
        if (first == stack_.end()) return {};
        std::string names;
        for (auto i = first; i != stack_.end(); ++i)
            names += (*i)->path() + ", ";
        return names + file.path();
    }

    void reportMissing(const Include& include, const Place& place) {
        Diagnostic d{.code = "include-missing",
                     .place = place,
                     .message = "there is no file '" + include.name + "' to include"};
        if (files_.namesNear)
            d.suggestion = nearestName(include.name, files_.namesNear(include.name));
        diagnostics_.report(std::move(d));
        result_.complete = false;
    }

    void fail(std::string code, const Place& place, std::string message,
              std::string expected = {}) {
        diagnostics_.error(std::move(code), place, std::move(message), std::move(expected));
        result_.complete = false;
    }

    void stop(const Place& place, std::string message) {
        fail("include-limit", place, std::move(message));
        full_ = true;
    }

    void remember(const std::shared_ptr<const SourceFile>& file) {
        if (std::find(result_.files.begin(), result_.files.end(), file) == result_.files.end())
            result_.files.push_back(file);
    }

    const GlslFiles& files_;
    Diagnostics& diagnostics_;
    ExpandedGlsl result_;
    std::vector<std::shared_ptr<const SourceFile>> stack_;
    std::size_t size_ = 0;
    int count_ = 0;
    bool full_ = false;
};

} // namespace

ExpandedGlsl expandGlsl(const std::shared_ptr<const SourceFile>& file, const GlslFiles& files,
                        Diagnostics& diagnostics) {
    return Expander(files, diagnostics).run(file);
}

bool mentionsStage(const GlslText& text, ShaderStage stage) {
    return text.text().find(stageMacro(stage)) != std::string::npos;
}

GlslText assembleStage(const GlslHeader& header, const GlslText& expanded) {
    GlslText text;
    text.append("#version " + std::to_string(header.version) + '\n', header.versionPlace);
    if (header.macro)
        text.append("#define " + std::string(stageMacro(*header.macro)) + '\n',
                    header.versionPlace);
    for (std::string option : header.options) {
        if (isBlank(option)) continue;
        std::replace(option.begin(), option.end(), '\n', ' ');
        text.append("#define " + option + '\n', header.optionsPlace);
    }
    text.append(expanded);
    return text;
}

} // namespace terrane
