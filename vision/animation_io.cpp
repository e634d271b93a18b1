#include "vision/animation_io.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "vision/picture_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <OpenImageIO/imageio.h>

namespace scree::vision {

namespace fs = std::filesystem;

void write_gif(const fs::path& path, std::span<const Photo> pictures, double frames_per_second) {
    if (pictures.empty() || pictures[0].empty() || !(frames_per_second > 0.0))
        fail<InvalidInput>("an animation of ", pictures.size(), " pictures at ", frames_per_second,
                           " frames a second cannot be written");
    for (const Photo& picture : pictures)
        if (picture.width() != pictures[0].width() || picture.height() != pictures[0].height())
            fail<InvalidInput>("the pictures of an animation have different sizes");
    OIIO::ImageSpec spec(pictures[0].width(), pictures[0].height(), 3, OIIO::TypeDesc::UINT8);
    // Hundredths of a second are all that the format can say.
    const int hundredths =
        static_cast<int>(std::lround(std::clamp(100.0 / frames_per_second, 2.0, 1000.0)));
    const int rate[2] = {100, hundredths};
    spec.attribute(
        "FramesPerSecond",
        OIIO::TypeDesc(OIIO::TypeDesc::INT, OIIO::TypeDesc::VEC2, OIIO::TypeDesc::RATIONAL), rate);
    spec.attribute("oiio:Movie", 1);
    spec.attribute("gif:LoopCount", 0);
    OIIO::geterror();  // forget what earlier calls on this thread left
    const auto output = OIIO::ImageOutput::create("gif");
    if (!output)
        fail<IoError>("cannot write ", path.string(), ": ", one_line(OIIO::geterror()));
    const std::vector<OIIO::ImageSpec> specs(pictures.size(), spec);
    bool sound = output->open(path.string(), static_cast<int>(specs.size()), specs.data());
    for (std::size_t i = 0; sound && i < pictures.size(); ++i)
        sound = (i == 0 || output->open(path.string(), spec, OIIO::ImageOutput::AppendSubimage)) &&
                output->write_image(OIIO::TypeDesc::UINT8, pictures[i].data());
    if (!sound || !output->close())
        fail<IoError>("cannot write ", path.string(), ": ", one_line(output->geterror()));
    // The writer does not ask whether its bytes arrived; a whole file ends with a semicolon.
    const std::string bytes = read_whole_file(path, std::size_t{1} << 31);
    if (bytes.empty() || bytes.back() != ';')
        fail<IoError>("cannot write ", path.string(), ": it was cut off, the disk may be full");
}

}  // namespace scree::vision
