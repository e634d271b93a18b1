#include "base/progress.h"

#include "base/error.h"

namespace scree {

void report_progress(Progress* progress, std::string_view stage, double fraction) {
    if (progress == nullptr)
        return;
    if (progress->cancelled())
        fail<Cancelled>("stopped during ", stage);
    progress->report(stage, fraction);
}

}  // namespace scree
