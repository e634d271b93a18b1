#include "base/error.h"
#include "vision/data/rocks_json.h"

#include <cmath>

namespace scree::vision {
namespace {

// All comparisons are written so that NaN fails them.
bool is_size(double value) {
    return value > 0.0 && value <= kMaxCoordinate;
}

bool is_place(double value) {
    return std::abs(value) <= kMaxCoordinate;
}

void check_rock(const Rock& rock, std::size_t index, std::string_view source) {
    const auto refuse = [&](std::string_view member, double value, std::string_view wanted) {
        fail<InvalidInput>(source, ": rocks[", index, "].", member, " is ", value, ", must be ",
                           wanted);
    };
    const Outline& outline = rock.outline;
    if (!is_place(outline.centre.x))
        refuse("centre[0]", outline.centre.x, "within 1e6 px of the picture");
    if (!is_place(outline.centre.y))
        refuse("centre[1]", outline.centre.y, "within 1e6 px of the picture");
    for (std::size_t k = 0; k < kRadii; ++k)
        if (!is_size(outline.radii[k]))
            fail<InvalidInput>(source, ": rocks[", index, "].radii[", k, "] is ", outline.radii[k],
                               ", must be above 0 and at most 1e6 px");
    if (!is_size(rock.depth))
        refuse("depth", rock.depth, "above 0 and at most 1e6 px");
    if (!(outline.confidence >= 0.0F && outline.confidence <= 1.0F))
        refuse("confidence", outline.confidence, "in [0, 1]");
    if (!(rock.uncertainty >= 0.0F && rock.uncertainty <= kMaxCoordinate))
        refuse("uncertainty", rock.uncertainty, "in [0, 1e6] px");
}

void check_name(const std::string& text, std::string_view member, std::string_view source) {
    if (text.size() > kMaxNameLength)
        fail<InvalidInput>(source, ": ", member, " has ", text.size(), " bytes, at most ",
                           kMaxNameLength, " are allowed");
    for (const char c : text)
        if (static_cast<unsigned char>(c) < 0x20)
            fail<InvalidInput>(source, ": ", member, " holds a control character");
}

}  // namespace

void check_rock_set(const RockSet& set, std::string_view source, const RocksFileLimits& limits) {
    check_name(set.image, "image", source);
    check_name(set.method, "method", source);
    if (set.image.find('/') != std::string::npos)
        fail<InvalidInput>(source, ": image is '", set.image,
                           "', must be a file name without its folder");
    if (set.width < 1)
        fail<InvalidInput>(source, ": width is ", set.width, ", must be at least 1");
    if (set.height < 1)
        fail<InvalidInput>(source, ": height is ", set.height, ", must be at least 1");
    if (static_cast<double>(set.width) * set.height > limits.max_pixels)
        fail<InvalidInput>(source, ": width x height is ", set.width, " x ", set.height,
                           ", the limit is ", limits.max_pixels, " pixels");
    if (!(set.metres_per_pixel >= 0.0 && set.metres_per_pixel <= 1e6))
        fail<InvalidInput>(source, ": metres_per_pixel is ", set.metres_per_pixel,
                           ", must be above 0 and at most 1e6, or 0 if unknown");
    if (set.likeness && !(*set.likeness >= 0.0 && *set.likeness <= 1.0))
        fail<InvalidInput>(source, ": likeness is ", *set.likeness, ", must be in [0, 1]");
    if (set.rocks.size() > kMaxRocks)
        fail<InvalidInput>(source, ": rocks has ", set.rocks.size(), " entries, at most ",
                           kMaxRocks, " are allowed");
    for (std::size_t i = 0; i < set.rocks.size(); ++i)
        check_rock(set.rocks[i], i, source);
}

}  // namespace scree::vision
