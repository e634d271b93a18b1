#include "vision/exif_orientation.h"

namespace scree::vision {
namespace {

// Where the value of pixel (x, y) of the upright picture lies in the stored one, after EXIF.
glm::ivec2 stored_pixel(int orientation, int x, int y, int stored_width, int stored_height) {
    const int right = stored_width - 1;
    const int bottom = stored_height - 1;
    switch (orientation) {
        case 2:
            return {right - x, y};
        case 3:
            return {right - x, bottom - y};
        case 4:
            return {x, bottom - y};
        case 5:
            return {y, x};
        case 6:
            return {y, bottom - x};
        case 7:
            return {right - y, bottom - x};
        case 8:
            return {right - y, x};
        default:
            return {x, y};
    }
}

}  // namespace

Photo upright(Photo stored, int orientation) {
    if (orientation < 2 || orientation > 8)
        return stored;
    const bool turned = orientation >= 5;
    Photo result(turned ? stored.height() : stored.width(),
                 turned ? stored.width() : stored.height());
    for (int y = 0; y < result.height(); ++y) {
        const glm::ivec2 first = stored_pixel(orientation, 0, y, stored.width(), stored.height());
        const glm::ivec2 step =
            stored_pixel(orientation, 1, y, stored.width(), stored.height()) - first;
        glm::ivec2 at = first;
        for (glm::u8vec3* pixel = result.row(y); pixel != result.row(y) + result.width(); ++pixel) {
            *pixel = stored(at.x, at.y);
            at += step;
        }
    }
    return result;
}

}  // namespace scree::vision
