// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>
#include <variant>

/// What a person does with mouse and keyboard: plain data, whether a window reports it, a script
/// says it, or a record repeats it. Places are pixels of the picture from its top left corner, y
/// downwards, with fractions.
namespace terrane {

struct Modifiers {
    bool shift = false, control = false, alt = false;

    bool operator==(const Modifiers&) const = default;
};

enum class MouseButton { left, middle, right };

/// Keys that stand for no character.
enum class Key {
    // clang-format off
    escape, enter, tab, backspace, insert, del, home, end, pageUp, pageDown, up, down, left, right,
    f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12
    // clang-format on
};

/// "escape", "pageup", "f5"... in any case; nothing for other words.
std::optional<Key> keyNamed(std::string_view name);

/// A key that is held may come down again and again.
struct KeyEvent {
    Key key{};
    bool down = false;
    Modifiers modifiers;
};

/// A character was typed, in upper or lower case.
struct TextEvent {
    char32_t character = 0;
};

struct MouseButtonEvent {
    MouseButton button{};
    bool down = false;
    double x = 0, y = 0;
    Modifiers modifiers;
};

struct MouseMoveEvent {
    double x = 0, y = 0;
};

struct WheelEvent {
    double steps = 0; ///< upwards, away from the person
    Modifiers modifiers;
};

using InputEvent = std::variant<KeyEvent, TextEvent, MouseButtonEvent, MouseMoveEvent, WheelEvent>;

} // namespace terrane
