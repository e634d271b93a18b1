#pragma once

#include <chrono>

namespace scree {

/// Seconds since it was made or last lapped.
class Stopwatch {
public:
    /// Seconds since the last lap, and start the next one.
    double lap() {
        const auto now = Clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        return seconds;
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point last_ = Clock::now();
};

}  // namespace scree
