#pragma once

#include "base/error.h"
#include "base/options.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace scree::apps {

/// The command line was wrong; exit status 2.
class UsageError : public Error {
    using Error::Error;
};

/// Not a failure: somebody asked for help. The message is the help.
class HelpRequest : public Error {
    using Error::Error;
};

/// The work failed and the reason was said already; exit status 1.
class Reported : public Error {
public:
    Reported() : Error("failed") {}
};

/// What a command says of itself.
struct CommandWords {
    std::string name;     ///< As typed after `scree`.
    std::string summary;  ///< One line, lower case, without a full stop.
    std::string example;  ///< A whole command line that works.
    std::string notes;    ///< More, after the flags; may be empty.
};

/// The words after a command's name, turned into values.
///
/// Describe everything first, then parse(). Flags get their name, range, unit and help from
/// describe(); a switch that is on by default is turned off by `--no-NAME`. The only user of
/// CLI11.
class Arguments {
public:
    Arguments(CommandWords words, std::vector<std::string> typed);
    ~Arguments();
    Arguments(const Arguments&) = delete;
    Arguments& operator=(const Arguments&) = delete;

    /// One path or word that must be given, by its place.
    void positional(const std::string& name, std::filesystem::path& value, const std::string& help);
    /// One or more, by their place. A name of several words is shown whole.
    void positional(const std::string& name, std::vector<std::filesystem::path>& values,
                    const std::string& help);
    /// `--NAME PATH`; `letter` adds `-L`. Must be given if `required`.
    struct PathFlag {
        std::string name;
        char letter = 0;
        std::string word = "PATH";
        std::string help;
        bool required = false;
    };
    void path(const PathFlag& flag, std::filesystem::path& value);

    void flag(std::string_view name, bool& value, const FieldInfo& info);
    void flag(std::string_view name, int& value, const FieldInfo& info);
    void flag(std::string_view name, double& value, const FieldInfo& info);
    void flag(std::string_view name, std::int64_t& value, const FieldInfo& info);
    void flag(std::string_view name, std::filesystem::path& value, const FieldInfo& info);

    template <class Enum>
    requires std::is_enum_v<Enum>
    void flag(std::string_view name, Enum& value, const FieldInfo& info) {
        words_flag(
            name, names_of(Enum{}), static_cast<std::size_t>(value),
            [&value](std::size_t index) { value = static_cast<Enum>(index); }, info);
    }

    /// One flag for each described field, or for those named in `only`. parse() checks them all.
    template <class Options>
    void options(Options& values, std::initializer_list<std::string_view> only = {}) {
        describe(values, [&](std::string_view name, auto& value, const FieldInfo& info) {
            bool wanted = only.size() == 0;
            for (const std::string_view one : only)
                wanted = wanted || one == name;
            if (wanted)
                flag(name, value, info);
        });
        checks_.push_back([&values] { check(values); });
    }

    /// Read the typed words into the values.
    /// @throw UsageError     an unknown, missing or malformed word.
    /// @throw InvalidOption  a value is out of its range.
    /// @throw HelpRequest    `--help` is among them.
    void parse();

    /// The page that `--help` shows.
    std::string help() const;

    const std::string& command() const;

private:
    struct State;
    void words_flag(std::string_view name, std::span<const std::string_view> words, std::size_t now,
                    std::function<void(std::size_t)> set, const FieldInfo& info);

    std::unique_ptr<State> state_;
    std::vector<std::function<void()>> checks_;
};

}  // namespace scree::apps
