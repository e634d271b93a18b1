#include "tests/cli/folder.h"

#include "base/whole_file.h"
#include "testdata/synthetic_photo.h"
#include "vision/image_io.h"

namespace scree::test {

namespace fs = std::filesystem;

std::map<std::string, std::string> files_below(const fs::path& folder) {
    std::map<std::string, std::string> files;
    if (!fs::is_directory(folder))
        return files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            files[entry.path().lexically_relative(folder).string()] =
                read_whole_file(entry.path(), std::size_t{1} << 30);
    return files;
}

void write_test_photo(const fs::path& path, int width, int height, unsigned seed) {
    vision::write_png(path, make_synthetic_photo({.width = width,
                                                  .height = height,
                                                  .n_rocks = 60,
                                                  .greatest_diameter = 80,
                                                  .seed = seed})
                                .photo);
}

}  // namespace scree::test
