#pragma once

#include <charconv>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>

namespace scree {

/// Append the shortest decimal text that reads back as the same number, whatever the locale.
/// @pre  A floating value is finite.
template <class Number>
requires std::floating_point<Number> || std::integral<Number>
void append_number(std::string& text, Number value) {
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, value);
    text.append(digits, end.ptr);
}

/// Append with `significant` digits, as `%.*g` in the C locale.
template <std::floating_point Number>
void append_number(std::string& text, Number value, int significant) {
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, value,
                                   std::chars_format::general, significant);
    text.append(digits, end.ptr);
}

/// The number that `text` is from its first to its last character, whatever the locale; nothing
/// if it is no number or out of the type's range.
template <class Number>
std::optional<Number> parse_number(std::string_view text) {
    Number value{};
    const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end.ec != std::errc{} || end.ptr != text.data() + text.size())
        return std::nullopt;
    return value;
}

}  // namespace scree
