// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

namespace terrane {

/// What code has to say on the picture, by topic: showInfo writes it, in the order of the topics.
/// Good for one frame, so whoever sets a text does so in each. The topic "FPS" stands in place of
/// the frame rate.
class InfoTexts {
public:
    void set(const std::string& topic, std::string text) { texts_[topic] = std::move(text); }
    const std::map<std::string, std::string>& all() const { return texts_; }
    /// At the end of a frame.
    void clear() {
        for (auto& [topic, text] : texts_)
            text.clear(); // and keep the room
    }

private:
    std::map<std::string, std::string> texts_;
};

} // namespace terrane
