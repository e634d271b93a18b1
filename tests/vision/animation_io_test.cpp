#include "vision/animation_io.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "tests/support/temp_dir.h"
#include "vision/image_io.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scree::vision {
namespace {

Photo gradient(int width, int height) {
    Photo photo(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            photo(x, y) = {static_cast<std::uint8_t>(3 * x), static_cast<std::uint8_t>(5 * y), 77};
    return photo;
}

TEST(AnimationIo, GifHoldsEveryPictureAtItsRate) {
    const test::TempDir dir;
    const std::vector<Photo> pictures = {gradient(20, 12), Photo(20, 12, glm::u8vec3(200, 10, 10)),
                                         gradient(20, 12)};
    write_gif(dir / "a.gif", pictures, 12.5);
    const std::string bytes = read_whole_file(dir / "a.gif", 100'000);
    EXPECT_EQ(bytes.substr(0, 6), "GIF89a");
    const std::string control("\x21\xF9\x04", 3);  // precedes every picture, with its delay
    std::size_t n = 0;
    for (auto at = bytes.find(control); at != std::string::npos; at = bytes.find(control, at + 1)) {
        EXPECT_EQ(bytes[at + 4], 8);  // hundredths of a second
        ++n;
    }
    EXPECT_EQ(n, 3U);
    const Photo first = read_photo(dir / "a.gif").pixels;
    EXPECT_EQ(first.width(), 20);
    EXPECT_NEAR(first(10, 6).x, 30, 12);
    EXPECT_THROW(write_gif(dir / "b.gif", {}, 10), InvalidInput);
    EXPECT_THROW(write_gif(dir / "b.gif", pictures, 0), InvalidInput);
    const std::vector<Photo> odd = {Photo(4, 4), Photo(5, 4)};
    EXPECT_THROW(write_gif(dir / "b.gif", odd, 10), InvalidInput);
    EXPECT_THROW(write_gif(dir / "none" / "b.gif", pictures, 10), IoError);
}

}  // namespace
}  // namespace scree::vision
