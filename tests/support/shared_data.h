#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scree::test {

/// A photograph with its hand-made label map.
struct LabelledPhoto {
    std::filesystem::path photo;
    std::filesystem::path labels;
};

/// Folder of the labelled photographs that lie beside a checkout: $SCREE_SHARED_DATA, else
/// ../shared/data seen from the source tree. Empty if it is not there; tests then skip.
std::filesystem::path shared_data();

/// Pairs `*_image.*`, `*_labels.png` of one folder of it, ordered by name.
std::vector<LabelledPhoto> labelled_photos(const std::string& folder);

}  // namespace scree::test

/// Skip the running test, loudly, where the labelled photographs are missing.
#define SCREE_NEEDS_SHARED_DATA()                                                           \
    if (scree::test::shared_data().empty())                                                 \
    GTEST_SKIP() << "labelled photographs not found: set SCREE_SHARED_DATA or put them in " \
                    "../shared/data beside the checkout"
