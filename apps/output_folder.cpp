#include "apps/output_folder.h"

#include "base/whole_file.h"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

namespace scree::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostLevels = 16;

}  // namespace

std::vector<fs::path> job_folders(const std::vector<fs::path>& photos, const fs::path& folder) {
    if (photos.size() == 1)
        return {folder};
    std::set<std::string> taken;
    for (const fs::path& photo : photos)
        taken.insert(photo.stem().string());
    std::set<std::string> used;
    std::vector<fs::path> folders;
    for (const fs::path& photo : photos) {
        std::string name = photo.stem().string();
        for (int n = 2; used.count(name) != 0; ++n) {
            const std::string next = photo.stem().string() + "-" + std::to_string(n);
            name = taken.count(next) == 0 ? next : name;
        }
        used.insert(name);
        folders.push_back(folder / name);
    }
    return folders;
}

void check_writable(const fs::path& folder) {
    OutputBatch probe;  // takes the file and any folder it made back at its end
    write_staged_file(probe.stage(folder / "rocks.json"), std::string_view());
}

void remove_stale_files(const AssetReport& assets, const fs::path& folder) {
    std::vector<std::string> names = {"overlay.png", "rocks.glb", "lods.json", "patch.glb"};
    for (std::size_t level = 1; level < kMostLevels; ++level)
        names.push_back("lods/rocks_lod" + std::to_string(level) + ".glb");
    std::error_code ignored;
    for (const std::string& name : names)
        if (std::find(assets.files.begin(), assets.files.end(), name) == assets.files.end())
            fs::remove(folder / name, ignored);
    fs::remove(folder / "lods", ignored);  // stays where something is left in it
}

}  // namespace scree::apps
