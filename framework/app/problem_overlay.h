// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "render/font.h"
#include "render/program.h"
#include "render/text_batch.h"
#include "resource/library.h"
#include "resource/manager.h"

#include <string>
#include <vector>

namespace terrane {

class Framebuffer;
class GlContext;

/// Writes diagnostics over a picture, whatever the archive that they are about does: its letters
/// are Terrane's own. GL thread.
class ProblemOverlay {
public:
    /// All must outlive it.
    ProblemOverlay(const Registry& registry, GlContext& context, ProgramBindings& bindings);

    /// What to show from now on; nothing hides it.
    void show(const std::vector<Diagnostic>& problems);
    /// Over the framebuffer's viewport, on a dark band at its top, as many lines as fit. The state
    /// stays as it is.
    void draw(Framebuffer& framebuffer);

private:
    struct Line {
        std::string text;
        Severity severity = Severity::error;
        bool remark = false; ///< what was expected, and the like
    };

    void add(const Diagnostic& diagnostic);
    std::vector<Line> wrapped(float width, float size, std::size_t mostLines) const;

    Diagnostics diagnostics_; ///< of our own resources: there should be none
    Library library_;
    ResourceManager resources_;
    Ref<Font> font_;
    Ref<Program> program_;
    TextBatch text_;
    std::vector<Line> lines_;
};

} // namespace terrane
