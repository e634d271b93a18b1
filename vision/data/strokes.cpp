#include "vision/data/strokes.h"

#include "base/parallel.h"
#include "base/simd.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace scree::vision {
namespace {

constexpr int kBandRows = 64;
constexpr float kFar = std::numeric_limits<float>::max();

struct Segment {
    glm::vec2 from;
    glm::vec2 along;
    float inverse_square;  // of the length; 0 of a point
};

// Pixels of a band that lie within reach of a segment; rows count from the band's first.
struct Box {
    int left, right, top, bottom;
};

// Rows [top, bottom) of the picture, and the squared distance of each pixel to the line being
// drawn: far everywhere between two lines.
struct Band {
    int top, bottom, width;
    std::vector<float> squares;

    float* row(int y) {
        return squares.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    }
};

int whole(float value, int low, int high) {
    return static_cast<int>(std::clamp(value, static_cast<float>(low), static_cast<float>(high)));
}

Box box_of(const Segment& s, float reach, const Band& band) {
    const glm::vec2 to = s.from + s.along;
    return {whole(std::floor(std::min(s.from.x, to.x) - reach), 0, band.width),
            whole(std::ceil(std::max(s.from.x, to.x) + reach), 0, band.width),
            whole(std::floor(std::min(s.from.y, to.y) - reach), band.top, band.bottom) - band.top,
            whole(std::ceil(std::max(s.from.y, to.y) + reach), band.top, band.bottom) - band.top};
}

SCREE_MULTIVERSION void lower_row(float* __restrict squares, int n, glm::vec2 first,
                                  const Segment& s) {
    for (int i = 0; i < n; ++i) {
        const float x = first.x + static_cast<float>(i);
        const float t = (x * s.along.x + first.y * s.along.y) * s.inverse_square;
        const float near = t < 0.0F ? 0.0F : t > 1.0F ? 1.0F : t;
        const float dx = x - near * s.along.x;
        const float dy = first.y - near * s.along.y;
        const float square = dx * dx + dy * dy;
        squares[i] = square < squares[i] ? square : squares[i];
    }
}

template <class Visit>
void for_each_segment(const Stroke& stroke, float reach, const Band& band, Visit&& visit) {
    glm::vec2 last = stroke.points.back();
    for (const glm::vec2& next : stroke.points) {
        const glm::vec2 along = next - last;
        const float square = along.x * along.x + along.y * along.y;
        const Segment segment{last, along, square > 0.0F ? 1.0F / square : 0.0F};
        const Box box = box_of(segment, reach, band);
        if (box.left < box.right && box.top < box.bottom)
            visit(segment, box);
        last = next;
    }
}

void blend(glm::u8vec3& pixel, const glm::u8vec3& colour, float share) {
    const auto s = static_cast<unsigned>(256.0F * share + 0.5F);
    pixel = glm::u8vec3((glm::uvec3(pixel) * (256U - s) + glm::uvec3(colour) * s + 128U) >> 8U);
}

// Segments overlap at their joints: distances are gathered first, and each pixel is blended once.
void draw_in_band(const Stroke& stroke, float width, Band& band, Photo& picture) {
    const float reach = 0.5F * width + 0.5F;
    for_each_segment(stroke, reach, band, [&](const Segment& segment, const Box& box) {
        for (int y = box.top; y < box.bottom; ++y) {
            const glm::vec2 centre(static_cast<float>(box.left) + 0.5F,
                                   static_cast<float>(band.top + y) + 0.5F);
            lower_row(band.row(y) + box.left, box.right - box.left, centre - segment.from, segment);
        }
    });
    for_each_segment(stroke, reach, band, [&](const Segment&, const Box& box) {
        for (int y = box.top; y < box.bottom; ++y) {
            float* squares = band.row(y);
            glm::u8vec3* pixels = picture.row(band.top + y);
            for (int x = box.left; x < box.right; ++x) {
                if (squares[x] < reach * reach)
                    blend(pixels[x], stroke.colour, std::min(1.0F, reach - std::sqrt(squares[x])));
                squares[x] = kFar;
            }
        }
    });
}

struct Reach {
    float top, bottom;
};

Reach rows_of(const Stroke& stroke, float width) {
    Reach reach{kFar, -kFar};
    for (const glm::vec2& p : stroke.points)
        reach = {std::min(reach.top, p.y), std::max(reach.bottom, p.y)};
    return {reach.top - width, reach.bottom + width};
}

}  // namespace

void draw_strokes(Photo& picture, std::span<const Stroke> strokes, float width) {
    std::vector<Reach> reaches(strokes.size());
    parallel_for_each_index(0, strokes.size(), 64,
                            [&](std::size_t i) { reaches[i] = rows_of(strokes[i], width); });
    const auto n_bands = static_cast<std::size_t>((picture.height() + kBandRows - 1) / kBandRows);
    parallel_for_each_index(0, n_bands, 1, [&](std::size_t i) {
        Band band{static_cast<int>(i) * kBandRows,
                  std::min(picture.height(), (static_cast<int>(i) + 1) * kBandRows),
                  picture.width(),
                  {}};
        band.squares.assign(static_cast<std::size_t>(band.width) * kBandRows, kFar);
        for (std::size_t k = 0; k < strokes.size(); ++k)
            if (reaches[k].top < static_cast<float>(band.bottom) &&
                reaches[k].bottom > static_cast<float>(band.top))
                draw_in_band(strokes[k], width, band, picture);
    });
}

}  // namespace scree::vision
