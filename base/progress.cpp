#include "base/progress.h"

#include "base/error.h"

namespace scree {

void stop_if_cancelled(const Progress* progress, std::string_view stage) {
    if (progress != nullptr && progress->cancelled())
        fail<Cancelled>("stopped during ", stage);
}

void report_progress(Progress* progress, std::string_view stage, double fraction) {
    stop_if_cancelled(progress, stage);
    if (progress != nullptr)
        progress->report(stage, fraction);
}

}  // namespace scree
