#include "apps/arguments.h"

#include "base/number_text.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include <CLI/CLI.hpp>

namespace scree::apps {
namespace {

constexpr std::size_t kIndent = 28;  // column where the explanations start
constexpr std::size_t kLine = 96;

std::string shortest(double value) {
    std::string text;
    append_number(text, value);
    const auto exponent = text.find('e');  // 1e6 reads better than 1e+06
    if (exponent != std::string::npos && text[exponent + 1] == '+')
        text.erase(exponent + 1, 1);
    const auto digits = text.find_first_of("123456789", std::min(exponent, text.size()));
    if (digits != std::string::npos && text[digits - 1] == '0')
        text.erase(digits - 1, 1);
    return text;
}

template <class Number>
Number parsed(std::string_view flag, const std::string& text, const char* kind) {
    const auto value = parse_number<Number>(text);
    if (!value)
        fail<UsageError>("--", flag, " needs ", kind, ", got '", text, "'");
    return *value;
}

std::string range_text(const FieldInfo& info) {
    const bool below = info.min > std::numeric_limits<double>::lowest();
    const bool above = info.max < std::numeric_limits<double>::max();
    std::string text;
    if (below && above)
        text = shortest(info.min) + " to " + shortest(info.max);
    else if (below)
        text = "at least " + shortest(info.min);
    else if (above)
        text = "at most " + shortest(info.max);
    return text;
}

std::string number_help(const FieldInfo& info, const std::string& now) {
    std::string range = range_text(info);
    if (!info.unit.empty())
        range += (range.empty() ? "" : " ") + std::string(info.unit);
    return std::string(info.help) + " (" + (range.empty() ? "" : range + "; ") + "default " + now +
           ")";
}

void check_number(std::string_view name, double value, const FieldInfo& info) {
    if (!(value >= info.min && value <= info.max))
        fail<InvalidOption>(name, " is ", value, ", must be in [", info.min, ", ", info.max, "]",
                            info.unit.empty() ? "" : " ", info.unit);
}

// Wrapped at spaces; every line after the first starts at the given column.
std::string wrapped(const std::string& text, std::size_t column) {
    std::istringstream words(text);
    std::string out;
    std::string word;
    std::size_t at = column;
    while (words >> word) {
        if (at > column && at + 1 + word.size() > kLine) {
            out += "\n" + std::string(column, ' ');
            at = column;
        } else if (at > column) {
            out += ' ';
            ++at;
        }
        out += word;
        at += word.size();
    }
    return out;
}

std::string entry_line(const std::string& left, const std::string& right) {
    std::string line = "  " + left;
    line += line.size() + 2 <= kIndent ? std::string(kIndent - line.size(), ' ')
                                       : "\n" + std::string(kIndent, ' ');
    return line + wrapped(right, kIndent) + "\n";
}

std::string first_word(const std::string& text) {
    return text.substr(0, text.find(' '));
}

// CLI11's messages are sentences of its own style; the usual ones are said in ours.
[[noreturn]] void fail_as_usage(const CLI::ParseError& error, const CLI::App& app) {
    const auto extras = app.remaining();
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !extras.empty())
        fail<UsageError>("'", extras.front(), "' is not expected here");
    const std::string text = error.what();
    fail<UsageError>(text);
}

}  // namespace

struct Arguments::State {
    struct Entry {
        std::string left, right;
    };
    struct Needed {
        CLI::Option* option = nullptr;
        std::string shown;
    };
    CommandWords words;
    std::vector<std::string> typed;
    CLI::App app{"", "scree"};
    std::string usage;
    std::vector<Entry> positionals, flags;
    std::vector<Needed> needed;

    void value_flag(std::string_view name, const std::string& word, const std::string& help,
                    std::function<void(const std::string&)> set) {
        const std::string flag = "--" + std::string(name);
        app.add_option_function<std::string>(flag, std::move(set))->expected(1);
        flags.push_back({flag + " " + word, help});
    }
};

Arguments::Arguments(CommandWords words, std::vector<std::string> typed)
    : state_(std::make_unique<State>()) {
    state_->words = std::move(words);
    state_->typed = std::move(typed);
    state_->app.set_help_flag();  // ours is shown whatever else is wrong
    state_->app.allow_extras(false);
}

Arguments::~Arguments() = default;

const std::string& Arguments::command() const {
    return state_->words.name;
}

void Arguments::positional(const std::string& name, std::filesystem::path& value,
                           const std::string& help) {
    CLI::Option* option = state_->app.add_option_function<std::string>(
        first_word(name), [&value](const std::string& text) { value = text; });
    state_->needed.push_back({option, name});
    state_->usage += " " + name;
    state_->positionals.push_back({name, help});
}

void Arguments::positional(const std::string& name, std::vector<std::filesystem::path>& values,
                           const std::string& help) {
    CLI::Option* option = state_->app.add_option_function<std::vector<std::string>>(
        first_word(name), [&values](const std::vector<std::string>& texts) {
            values.assign(texts.begin(), texts.end());
        });
    state_->needed.push_back({option, name});
    state_->usage += " " + name + "...";
    state_->positionals.push_back({name + "...", help});
}

void Arguments::path(const PathFlag& flag, std::filesystem::path& value) {
    const std::string names =
        flag.letter != 0 ? std::string("-") + flag.letter + ",--" + flag.name : "--" + flag.name;
    CLI::Option* option = state_->app.add_option_function<std::string>(
        names, [&value](const std::string& text) { value = text; });
    option->expected(1);
    const std::string shown =
        (flag.letter != 0 ? std::string("-") + flag.letter : "--" + flag.name) + " " + flag.word;
    if (flag.required) {
        state_->needed.push_back({option, shown});
        state_->usage += " " + shown;
    }
    const std::string left =
        (flag.letter != 0 ? std::string("-") + flag.letter + ", " : "") + "--" + flag.name;
    state_->flags.push_back({left + " " + flag.word, flag.help});
}

void Arguments::flag(std::string_view name, bool& value, const FieldInfo& info) {
    const bool now = value;
    const std::string shown = (now ? "--no-" : "--") + std::string(name);
    state_->app.add_flag_callback(shown, [&value, now] { value = !now; });
    state_->flags.push_back({shown, (now ? "do not " : "") + std::string(info.help)});
}

void Arguments::flag(std::string_view name, int& value, const FieldInfo& info) {
    state_->value_flag(name, "N", number_help(info, std::to_string(value)),
                       [&value, name, info](const std::string& text) {
                           const auto number = parsed<int>(name, text, "a whole number");
                           check_number(name, number, info);
                           value = number;
                       });
}

void Arguments::flag(std::string_view name, double& value, const FieldInfo& info) {
    state_->value_flag(name, "NUMBER", number_help(info, shortest(value)),
                       [&value, name, info](const std::string& text) {
                           const auto number = parsed<double>(name, text, "a number");
                           check_number(name, number, info);
                           value = number;
                       });
}

void Arguments::flag(std::string_view name, std::int64_t& value, const FieldInfo& info) {
    state_->value_flag(name, "N", number_help(info, std::to_string(value)),
                       [&value, name, info](const std::string& text) {
                           const auto number = parsed<std::int64_t>(name, text, "a whole number");
                           check_number(name, static_cast<double>(number), info);
                           value = number;
                       });
}

void Arguments::flag(std::string_view name, std::filesystem::path& value, const FieldInfo& info) {
    state_->value_flag(name, "FILE", std::string(info.help),
                       [&value, name](const std::string& text) {
                           if (text.empty())
                               fail<UsageError>("--", name, " needs a file, got ''");
                           value = text;
                       });
}

void Arguments::words_flag(std::string_view name, std::span<const std::string_view> words,
                           std::size_t now, std::function<void(std::size_t)> set,
                           const FieldInfo& info) {
    std::string choices;
    for (const std::string_view word : words)
        choices += (choices.empty() ? "" : " or ") + std::string(word);
    const std::string help =
        std::string(info.help) + ": " + choices + " (default " + std::string(words[now]) + ")";
    state_->value_flag(
        name, "WORD", help, [words, set = std::move(set), name, choices](const std::string& text) {
            const auto found = std::find(words.begin(), words.end(), text);
            if (found == words.end())
                fail<UsageError>("--", name, " needs ", choices, ", got '", text, "'");
            set(static_cast<std::size_t>(found - words.begin()));
        });
}

void Arguments::parse() {
    const auto& typed = state_->typed;
    for (const std::string& word : typed) {
        if (word == "--")
            break;
        if (word == "--help" || word == "-h")
            throw HelpRequest(help());
    }
    try {
        state_->app.parse(std::vector<std::string>(typed.rbegin(), typed.rend()));
    } catch (const CLI::ParseError& error) {
        fail_as_usage(error, state_->app);
    }
    for (const State::Needed& need : state_->needed)
        if (need.option->count() == 0)
            fail<UsageError>(need.shown, " is missing");
    for (const auto& one : checks_)
        one();
}

std::string Arguments::help() const {
    const State& s = *state_;
    std::string page = "scree " + s.words.name + ": " + s.words.summary + "\n\n";
    page +=
        "usage: scree " + s.words.name + s.usage + (s.flags.empty() ? "" : " [options]") + "\n\n";
    for (const auto& entry : s.positionals)
        page += entry_line(entry.left, entry.right);
    for (const auto& entry : s.flags)
        page += entry_line(entry.left, entry.right);
    page += entry_line("-h, --help", "show this page");
    if (!s.words.notes.empty())
        page += "\n" + wrapped(s.words.notes, 0) + "\n";
    page += "\nexample:\n  " + s.words.example + "\n";
    return page;
}

}  // namespace scree::apps
