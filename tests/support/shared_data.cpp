#include "tests/support/shared_data.h"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace scree::test {

namespace fs = std::filesystem;

fs::path shared_data() {
    const char* given = std::getenv("SCREE_SHARED_DATA");
    const fs::path folder =
        given != nullptr ? fs::path(given) : fs::path(SCREE_SOURCE_DIR) / ".." / "shared" / "data";
    return fs::is_directory(folder) ? fs::canonical(folder) : fs::path{};
}

std::vector<LabelledPhoto> labelled_photos(const std::string& folder) {
    std::vector<LabelledPhoto> found;
    if (shared_data().empty())
        return found;
    for (const auto& entry : fs::directory_iterator(shared_data() / folder)) {
        const std::string name = entry.path().stem().string();
        const auto cut = name.rfind("_image");
        if (cut == std::string::npos)
            continue;
        const fs::path labels = entry.path().parent_path() / (name.substr(0, cut) + "_labels.png");
        if (fs::exists(labels))
            found.push_back({entry.path(), labels});
    }
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return a.photo < b.photo; });
    return found;
}

}  // namespace scree::test
