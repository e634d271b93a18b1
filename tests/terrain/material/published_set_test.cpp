#include "terrain/material/published_set.h"

#include "base/error.h"
#include "terrain/material/strokes.h"
#include "tests/support/temp_dir.h"
#include "tests/terrain/material/map_samples.h"

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

namespace fs = std::filesystem;

// Row DM-06: strokes with an undo, saved as the four files, loaded and saved again without loss.
TEST(PublishedSet, IsFourFilesThatKeepTheMap) {
    const test::TempDir dir;
    const StrokeScript script = strokes_from_json(
        R"({"format": "scree-strokes", "version": 1, "size": [40, 30], "cell_size": 0.25,
            "ground": "sand", "strokes": [
            {"op": "brush", "points": [[1, 1], [8, 6]], "radius": 1.5, "hardness": 0.4, "material": 3},
            {"op": "fill", "at": [9, 1], "material": 7}, {"op": "undo"},
            {"op": "polygon", "points": [[1, 5], [4, 5], [4, 7]], "material": 7}]})",
        "s", test::three_materials());
    const DescriptionMap map = map_from_strokes(script, test::three_materials());
    EXPECT_EQ(map.ids(39, 0), 0);  // the fill was taken back
    for (const int bits : {8, 16}) {
        for (const char* folder : {"one", "two"}) {
            OutputBatch batch;
            const bool first = folder == std::string("one");
            const DescriptionMap saved =
                first ? map
                      : unpack_map(read_rgba_map(dir / "one/map_rgba.png", dir / "one/map_ids.txt"),
                                   9.0);
            EXPECT_EQ(saved.ids, map.ids);
            const ConversionReport report = stage_published_set(saved, bits, dir / folder, batch);
            EXPECT_LE(report.repose_deg, first ? 0.5 * 90.0 / ((1 << bits) - 1) + 1e-6 : 1e-5);
            batch.commit();
        }
        int n_files = 0;
        for (const auto& entry : fs::directory_iterator(dir / "one")) {
            const fs::path name = entry.path().filename();
            EXPECT_EQ(read_whole_file(entry.path(), 1 << 20),
                      read_whole_file(dir / "two" / name, 1 << 20))
                << name;
            ++n_files;
        }
        EXPECT_EQ(n_files, 4);
    }
}

}  // namespace
}  // namespace scree::terrain
