#pragma once

#include "base/progress.h"

#include <chrono>
#include <string>
#include <string_view>

namespace scree::apps {

/// From now on Ctrl-C and a polite kill ask for a stop instead of ending the program.
void catch_stop_signals();

/// Somebody asked for a stop.
bool stop_requested();

/// How much a command says while it works.
enum class Talk {
    Quiet,  ///< Nothing.
    Lines,  ///< A line when a stage begins.
    Live,   ///< One line that is rewritten, with the share done and the time left.
};

/// Live on a terminal, else lines; nothing if `quiet`.
Talk talk_for_terminal(bool quiet);

/// Progress on standard error, and the stop that a signal asks for.
class ConsoleProgress : public Progress {
public:
    explicit ConsoleProgress(Talk talk) : talk_(talk) {}
    ~ConsoleProgress() override { clear(); }
    ConsoleProgress(const ConsoleProgress&) = delete;
    ConsoleProgress& operator=(const ConsoleProgress&) = delete;

    void report(std::string_view stage, double fraction) override;
    bool cancelled() const override { return stop_requested(); }

    /// Name what is worked on before each stage; empty names nothing.
    void begin(std::string_view subject);

    /// Take the live line away.
    void clear();

private:
    using Clock = std::chrono::steady_clock;
    Talk talk_;
    std::string subject_;
    std::string stage_;
    Clock::time_point stage_start_{};
    Clock::time_point last_drawn_{};
    bool line_shown_ = false;
};

/// A line on standard error that does not tear a live line.
void print_error_line(std::string_view text);

}  // namespace scree::apps
