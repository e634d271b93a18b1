#include "vision/data/rockdata_text.h"

#include "base/error.h"
#include "base/number_text.h"
#include "base/whole_file.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace scree::vision {
namespace {

constexpr int kDigits = 9;  // enough for any float
constexpr std::size_t kLongestQuote = 40;

void append_record(std::string& text, const Rock& rock, std::size_t index) {
    text += "rock " + std::to_string(index) + " centre ";
    append_number(text, rock.outline.centre.x, kDigits);
    text += ' ';
    append_number(text, rock.outline.centre.y, kDigits);
    text += " depth ";
    append_number(text, rock.depth, kDigits);
    text += rock.outline.touches_border ? " flags border\n" : " flags none\n";
    text += "radii " + std::to_string(kRadii) + "\n";
    for (std::size_t k = 0; k < kRadii; ++k) {
        append_number(text, rock.outline.radii[k], kDigits);
        text += k + 1 < kRadii ? ' ' : '\n';
    }
    text += "end\n";
}

/// Hands out the text line by line, split at blanks, and knows where it is.
class Lines {
public:
    Lines(std::string_view text, const std::string& source) : rest_(text), source_(source) {}

    std::string_view next(std::string_view wanted) {
        while (!rest_.empty()) {
            ++line_;
            const auto end = std::min(rest_.find('\n'), rest_.size());
            std::string_view line = rest_.substr(0, end);
            rest_.remove_prefix(std::min(end + 1, rest_.size()));
            if (line.ends_with('\r'))
                line.remove_suffix(1);
            if (line.find_first_not_of(" \t") != std::string_view::npos)
                return line;
        }
        refuse("the file ends, expected ", wanted);
    }

    bool finished() const { return rest_.find_first_not_of(" \t\r\n") == std::string_view::npos; }

    template <class... Parts>
    [[noreturn]] void refuse(const Parts&... parts) const {
        fail<InvalidInput>(source_, ":", line_, ": ", parts...);
    }

private:
    std::string_view rest_;
    const std::string& source_;
    std::size_t line_ = 0;
};

std::string_view next_word(std::string_view& rest) {
    const auto start = std::min(rest.find_first_not_of(" \t"), rest.size());
    rest.remove_prefix(start);
    const auto end = std::min(rest.find_first_of(" \t"), rest.size());
    const std::string_view word = rest.substr(0, end);
    rest.remove_prefix(end);
    return word;
}

std::string_view last_word(std::string_view& rest) {
    rest = rest.substr(0, rest.find_last_not_of(" \t") + 1);
    const auto blank = rest.find_last_of(" \t");
    const std::string_view word = rest.substr(blank == std::string_view::npos ? 0 : blank + 1);
    rest.remove_suffix(word.size());
    return word;
}

void expect_word(const Lines& lines, std::string_view& rest, std::string_view wanted) {
    const std::string_view word = next_word(rest);
    if (word != wanted)
        lines.refuse("found '", word.substr(0, kLongestQuote), "', expected '", wanted, "'");
}

void expect_end_of_line(const Lines& lines, std::string_view rest) {
    const std::string_view word = next_word(rest);
    if (!word.empty())
        lines.refuse("found '", word.substr(0, kLongestQuote), "', expected the end of the line");
}

template <class Number>
Number to_number(const Lines& lines, std::string_view word, std::string_view what) {
    const auto number = parse_number<Number>(word);
    if (!number)
        lines.refuse("found '", word.substr(0, kLongestQuote), "', expected ", what);
    return *number;
}

// `image <file-name> <width> <height>`: the name may hold blanks, so the sizes come off the end.
void read_image_line(Lines& lines, const RocksFileLimits& limits, RockSet& set) {
    std::string_view rest = lines.next("'image'");
    expect_word(lines, rest, "image");
    set.height = to_number<int>(lines, last_word(rest), "the height in pixels");
    set.width = to_number<int>(lines, last_word(rest), "the width in pixels");
    const auto start = rest.find_first_not_of(" \t");
    const auto end = rest.find_last_not_of(" \t");
    if (start != std::string_view::npos)
        set.image = rest.substr(start, end - start + 1);
    if (set.width < 1 || set.height < 1 ||
        static_cast<double>(set.width) * set.height > limits.max_pixels)
        lines.refuse("the picture is ", set.width, " x ", set.height, ", expected 1 x 1 up to ",
                     limits.max_pixels, " pixels");
    if (set.image.size() > kMaxNameLength)
        lines.refuse("the file name has more than ", kMaxNameLength, " bytes");
}

void read_params_line(Lines& lines, RockSet& set) {
    std::string_view rest = lines.next("'params'");
    expect_word(lines, rest, "params");
    if (rest.starts_with(' '))
        rest.remove_prefix(1);
    if (rest.size() > kMaxNameLength)
        lines.refuse("params has more than ", kMaxNameLength, " bytes");
    set.method = rest;
}

float read_length(const Lines& lines, std::string_view word, std::string_view what) {
    const auto value = to_number<float>(lines, word, what);
    if (!(value > 0.0F && value <= kMaxCoordinate))
        lines.refuse(what, " is ", value, ", must be above 0 and at most 1e6 px");
    return value;
}

double read_coordinate(const Lines& lines, std::string_view word) {
    const auto value = to_number<double>(lines, word, "a coordinate of the centre");
    if (!(value >= -kMaxCoordinate && value <= kMaxCoordinate))
        lines.refuse("the centre lies at ", value, ", must be within 1e6 px of the picture");
    return value;
}

void read_radii(Lines& lines, Outline& outline) {
    std::string_view rest = lines.next("'radii 360'");
    expect_word(lines, rest, "radii");
    if (to_number<int>(lines, next_word(rest), "the number of radii") != kRadii)
        lines.refuse("a rock has ", kRadii, " radii");
    std::size_t n = 0;
    while (n < kRadii) {
        rest = lines.next("a radius");
        for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
            if (n == kRadii)
                lines.refuse("found more than ", kRadii, " radii");
            outline.radii[n++] = read_length(lines, word, "a radius");
        }
    }
}

Rock read_record(Lines& lines, std::size_t index) {
    Rock rock;
    std::string_view rest = lines.next("'rock'");
    expect_word(lines, rest, "rock");
    const auto number = to_number<std::size_t>(lines, next_word(rest), "the rock's index");
    if (number != index)
        lines.refuse("found rock ", number, ", expected rock ", index);
    expect_word(lines, rest, "centre");
    rock.outline.centre.x = read_coordinate(lines, next_word(rest));
    rock.outline.centre.y = read_coordinate(lines, next_word(rest));
    expect_word(lines, rest, "depth");
    rock.depth = read_length(lines, next_word(rest), "the depth");
    expect_word(lines, rest, "flags");
    const std::string_view flags = next_word(rest);
    if (flags != "border" && flags != "none")
        lines.refuse("found flags '", flags.substr(0, kLongestQuote),
                     "', expected 'border' or 'none'");
    expect_end_of_line(lines, rest);
    rock.outline.touches_border = flags == "border";
    rock.outline.confidence = 1.0F;
    read_radii(lines, rock.outline);
    rest = lines.next("'end'");
    expect_word(lines, rest, "end");
    expect_end_of_line(lines, rest);
    return rock;
}

}  // namespace

std::string rocks_to_text(const RockSet& set) {
    check_rock_set(set, "the rocks to write", {.max_pixels = std::numeric_limits<double>::max()});
    std::string text = "rockdata 1\nimage " + set.image + " " + std::to_string(set.width) + " " +
                       std::to_string(set.height) + "\nparams " + set.method + "\ncount " +
                       std::to_string(set.rocks.size()) + "\n";
    for (std::size_t i = 0; i < set.rocks.size(); ++i)
        append_record(text, set.rocks[i], i);
    return text;
}

RockSet rocks_from_text(std::string_view text, const std::string& source,
                        const RocksFileLimits& limits) {
    if (text.size() > limits.max_bytes)
        fail<InvalidInput>(source, " has ", text.size(), " bytes, the limit is ", limits.max_bytes);
    Lines lines(text, source);
    std::string_view rest = lines.next("'rockdata 1'");
    expect_word(lines, rest, "rockdata");
    expect_word(lines, rest, "1");
    expect_end_of_line(lines, rest);
    RockSet set;
    read_image_line(lines, limits, set);
    read_params_line(lines, set);
    rest = lines.next("'count'");
    expect_word(lines, rest, "count");
    const auto count = to_number<std::size_t>(lines, next_word(rest), "the number of rocks");
    if (count > kMaxRocks)
        lines.refuse("count is ", count, ", at most ", kMaxRocks, " are allowed");
    for (std::size_t i = 0; i < count; ++i)  // grows as records are read: count may lie
        set.rocks.push_back(read_record(lines, i));
    if (!lines.finished())
        lines.refuse("text follows after the last of ", count, " rocks");
    check_rock_set(set, source, limits);
    return set;
}

void write_rocks_text(const std::filesystem::path& path, const RockSet& set) {
    write_staged_file(path, rocks_to_text(set));
}

RockSet read_rocks_text(const std::filesystem::path& path, const RocksFileLimits& limits) {
    return rocks_from_text(read_whole_file(path, limits.max_bytes), path.string(), limits);
}

}  // namespace scree::vision
