#pragma once

#include <string_view>

namespace scree {

/// Where long work says how far it is and asks whether to go on. Passed by pointer; null means
/// nobody is listening. Calls come from the thread that started the work.
class Progress {
public:
    virtual ~Progress() = default;

    /// `stage` is a few words for a person, `fraction` the share of that stage done, 0 to 1.
    virtual void report(std::string_view stage, double fraction) = 0;

    /// True once the work should stop; may be asked from any thread.
    virtual bool cancelled() const { return false; }
};

/// Ask whether to go on, from any thread; null goes on.
/// @throw Cancelled  the listener asked for a stop.
void stop_if_cancelled(const Progress* progress, std::string_view stage);

/// Report to `progress` if there is one.
/// @throw Cancelled  the listener asked for a stop.
void report_progress(Progress* progress, std::string_view stage, double fraction);

}  // namespace scree
