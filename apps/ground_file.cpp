#include "apps/ground_file.h"

#include "base/error.h"
#include "vision/image_io.h"

#include <algorithm>
#include <utility>

namespace scree::apps {

terrain::Heightfield read_ground(const std::filesystem::path& path, const GroundScale& scale) {
    vision::HeightImage image = vision::read_heights(path);
    if (!image.in_metres && !(scale.height_m > 0.0))
        fail<InvalidInput>(path.string(),
                           " does not say its heights in metres; give that of white with "
                           "--height-m");
    if (scale.height_m > 0.0) {
        if (image.in_metres)
            fail<InvalidInput>(path.string(), " says its heights in metres; leave --height-m out");
        for (float& height : image.metres)
            height *= static_cast<float>(scale.height_m);
    }
    const double cell = scale.width_m > 0.0 ? scale.width_m / std::max(1, image.metres.width())
                                            : image.metres_per_pixel;
    if (!(cell > 0.0))
        fail<InvalidInput>(path.string(), " does not say its scale; give it with --width-m");
    terrain::Heightfield ground{std::move(image.metres), cell};
    terrain::check_heightfield(ground);
    return ground;
}

}  // namespace scree::apps
