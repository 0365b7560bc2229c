// SPDX-License-Identifier: BSD-3-Clause
#include "scene/message_log.h"

#include <algorithm>

namespace terrane {

namespace {

/// What the original did not know or say would cover pictures that it drew clean.
bool isRemark(const Diagnostic& d) {
    return d.severity == Severity::note || d.code == "not-built-yet" || d.code == "legacy-glsl" ||
           d.code == "sampler-unset";
}

// Folders would leave no room for the message.
std::string lineOf(const Diagnostic& d) {
    std::string text = d.message;
    if (d.place) {
        const std::string place = d.place.toString();
        text = place.substr(place.find_last_of('/') + 1) + ": " + text;
    }
    return text.substr(0, text.find('\n'));
}

} // namespace

void MessageLog::update(const Diagnostics& diagnostics) {
    const std::size_t reported = diagnostics.reported();
    if (reported == seen_) return;
    const auto all = diagnostics.all();
    const std::size_t fresh = std::min(reported - seen_, all.size());
    seen_ = reported;
    for (std::size_t i = all.size() - fresh; i < all.size(); ++i) {
        const Diagnostic& d = all[i];
        lines_.push_back({isRemark(d) ? Severity::note : d.severity, lineOf(d)});
        if (lines_.size() > kMostLines) lines_.pop_front();
        visible = visible || !isRemark(d);
    }
}

} // namespace terrane
