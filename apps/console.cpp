#include "apps/console.h"

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <string>
#include <unistd.h>

namespace scree::apps {
namespace {

std::atomic<bool> stop_flag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

extern "C" void ask_for_stop(int) {
    stop_flag.store(true);
}

std::string time_left(double seconds, double fraction) {
    if (fraction < 0.02 || fraction >= 1.0 || seconds < 0.5)
        return "";
    const auto left = static_cast<long>(std::ceil(seconds * (1.0 - fraction) / fraction));
    char text[48];
    if (left >= 60)
        std::snprintf(text, sizeof text, ", %ld min %02ld s left", left / 60, left % 60);
    else
        std::snprintf(text, sizeof text, ", %ld s left", left);
    return text;
}

}  // namespace

void catch_stop_signals() {
    struct sigaction action = {};
    action.sa_handler = ask_for_stop;
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        sigaction(signal, &action, nullptr);
    // A full disk under `ulimit -f` shall be an error of the write, not the end of the program.
    action.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &action, nullptr);
}

bool stop_requested() {
    return stop_flag.load();
}

Talk talk_for_terminal(bool quiet) {
    if (quiet)
        return Talk::Quiet;
    return ::isatty(STDERR_FILENO) == 1 ? Talk::Live : Talk::Lines;
}

void ConsoleProgress::begin(std::string_view subject) {
    clear();
    subject_ = subject;
    stage_.clear();
}

void ConsoleProgress::report(std::string_view stage, double fraction) {
    if (talk_ == Talk::Quiet)
        return;
    const auto now = Clock::now();
    const bool fresh = stage != stage_;
    if (fresh) {
        stage_ = stage;
        stage_start_ = now;
    }
    const std::string place = subject_.empty() ? stage_ : subject_ + ": " + stage_;
    if (talk_ == Talk::Lines) {
        if (fresh)
            print_error_line(place);
        return;
    }
    if (!fresh && now - last_drawn_ < std::chrono::milliseconds(100))
        return;
    last_drawn_ = now;
    const double seconds = std::chrono::duration<double>(now - stage_start_).count();
    const int percent = static_cast<int>(std::lround(100.0 * fraction));
    std::cerr << "\r\033[K" << place << " " << percent << " %" << time_left(seconds, fraction)
              << std::flush;
    line_shown_ = true;
}

void ConsoleProgress::clear() {
    if (line_shown_)
        std::cerr << "\r\033[K" << std::flush;
    line_shown_ = false;
}

void print_error_line(std::string_view text) {
    std::cerr << text << std::endl;
}

}  // namespace scree::apps
