#pragma once

#include "apps/step_log.h"
#include "terrain/surface/erosion_loop.h"

#include <filesystem>
#include <string>

namespace scree::apps {

/// steps.csv of an erosion: a row a step (`mesh-erosion.md` 12).
class ErosionRows {
public:
    /// @param times  Add columns of milliseconds; without them runs give the same bytes.
    ErosionRows(const std::filesystem::path& file, bool times);

    void resume(const terrain::ErosionRun& run);
    void add(const terrain::ErosionRun& run);
    std::string text() const { return log_.text(); }

private:
    StepLog log_;
    bool times_;
    terrain::ErosionTimes before_;  // of the steps up to the last one
};

}  // namespace scree::apps
