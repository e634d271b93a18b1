#pragma once

// Behind mesh_io; not installed.

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

namespace scree::meshing::io {

/// Words of a text, line by line; `#` starts a comment where asked for.
class TextScanner {
public:
    explicit TextScanner(std::string_view text) : rest_(text) {}

    /// Move to the next line; false at the end.
    bool next_line() {
        if (rest_.empty())
            return false;
        const std::size_t end = rest_.find_first_of("\r\n");
        line_ = rest_.substr(0, end);
        std::size_t skip = end == std::string_view::npos ? rest_.size() : end + 1;
        if (skip < rest_.size() && rest_[skip - 1] == '\r' && rest_[skip] == '\n')
            ++skip;
        rest_.remove_prefix(skip);
        ++number_;
        return true;
    }

    /// The next word of the line; empty at its end.
    std::string_view word() {
        const std::size_t begin = line_.find_first_not_of(" \t\v\f");
        if (begin == std::string_view::npos) {
            line_ = {};
            return {};
        }
        const std::size_t end = line_.find_first_of(" \t\v\f", begin);
        const std::string_view result = line_.substr(begin, end - begin);
        line_.remove_prefix(end == std::string_view::npos ? line_.size() : end);
        return result;
    }

    /// The next word, on this line or a later one, past comments; empty at the end of the text.
    std::string_view word_anywhere() {
        for (;;) {
            const std::string_view result = word();
            if (!result.empty() && result.front() != '#')
                return result;
            line_ = {};
            if (!next_line())
                return {};
        }
    }

    std::size_t line_number() const { return number_; }
    std::string_view rest() const { return rest_; }
    std::size_t n_left() const { return line_.size() + rest_.size(); }

private:
    std::string_view rest_;
    std::string_view line_;
    std::size_t number_ = 0;
};

/// The whole word as a number; false if it is none.
template <class Number>
bool parse(std::string_view word, Number& value) {
    if (!word.empty() && word.front() == '+')
        word.remove_prefix(1);
    const char* const end = word.data() + word.size();
    const auto result = std::from_chars(word.data(), end, value);
    return result.ec == std::errc() && result.ptr == end && !word.empty();
}

/// Add the shortest digits that read back as the same number.
template <class Number>
void put(std::string& text, Number value) {
    char digits[32];
    const auto result = std::to_chars(digits, digits + sizeof digits, value);
    text.append(digits, result.ptr);
}

}  // namespace scree::meshing::io
