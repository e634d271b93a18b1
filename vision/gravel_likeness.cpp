#include "vision/gravel_likeness.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

namespace scree::vision {
namespace {

constexpr float kBorder = 0.5F;  // of the boundary channel
constexpr int kNearPixels = 2;   // how far from an outline a border may lie and still be its own

// A figure counts nothing up to `none` and fully from `whole` on.
struct Ramp {
    double none;
    double whole;
};
constexpr Ramp kNumber{0.0, 30.0};
constexpr Ramp kConfidence{0.4, 0.8};
constexpr Ramp kExplained{0.0, 0.5};
constexpr Ramp kSpread{0.0, 0.2};
constexpr Ramp kAlignment{0.95, 0.6};     // the less the better
constexpr std::size_t kLeastForLaws = 8;  // fewer rocks say nothing of spread and alignment

double share_of(double figure, Ramp ramp) {
    return std::clamp((figure - ramp.none) / (ramp.whole - ramp.none), 0.0, 1.0);
}

void mark(Mask& near, int x, int y) {
    const int left = std::max(0, x - kNearPixels);
    const int right = std::min(near.width() - 1, x + kNearPixels);
    for (int j = std::max(0, y - kNearPixels); j <= std::min(near.height() - 1, y + kNearPixels);
         ++j)
        for (int i = left; i <= right; ++i)
            near(i, j) = 1;
}

// The border as straight pieces between whole degrees, looked at twice a neighbourhood's width.
void mark_outline(Mask& near, const Outline& outline) {
    const double reach =
        static_cast<double>(*std::max_element(outline.radii.begin(), outline.radii.end()));
    const glm::dvec2 size(near.width(), near.height());
    if (outline.centre.x + reach < 0.0 || outline.centre.y + reach < 0.0 ||
        outline.centre.x - reach > size.x || outline.centre.y - reach > size.y)
        return;
    glm::dvec2 last = border_point(outline, kRadii - 1);
    int marked_x = std::numeric_limits<int>::min(), marked_y = marked_x;
    for (int k = 0; k < kRadii; ++k) {
        const glm::dvec2 next = border_point(outline, k);
        const double length = std::hypot(next.x - last.x, next.y - last.y);
        // A piece longer than the picture is no border of a rock in it.
        const int steps = std::clamp(static_cast<int>(length / kNearPixels), 1, 4096);
        for (int i = 0; i < steps; ++i) {
            const glm::dvec2 p = last + (next - last) * (static_cast<double>(i) / steps);
            const int x = static_cast<int>(std::floor(p.x));
            const int y = static_cast<int>(std::floor(p.y));
            if (x != marked_x || y != marked_y)  // degrees of a small rock share their pixels
                mark(near, x, y);
            marked_x = x;
            marked_y = y;
        }
        last = next;
    }
}

double explained_share(const FloatRaster& boundary, const std::vector<Rock>& rocks) {
    Mask near(boundary.width(), boundary.height());
    for (const Rock& rock : rocks)
        mark_outline(near, rock.outline);
    std::size_t n_border = 0;
    std::size_t n_explained = 0;
    for (std::size_t i = 0; i < near.size(); ++i) {
        const bool is_border = boundary.data()[i] > kBorder;
        n_border += is_border ? 1 : 0;
        n_explained += is_border && near.data()[i] != 0 ? 1 : 0;
    }
    return n_border == 0 ? 0.0 : static_cast<double>(n_explained) / static_cast<double>(n_border);
}

// Twice the azimuth of the long axis as a direction, as long as the outline is elongated: what the
// second harmonic of the squared radii says.
glm::dvec2 long_axis(const Outline& outline, const std::vector<glm::dvec2>& twice) {
    glm::dvec2 sum(0.0);
    double total = 0.0;
    for (int k = 0; k < kRadii; ++k) {
        const auto r = static_cast<double>(outline.radii[static_cast<std::size_t>(k)]);
        sum += r * r * twice[static_cast<std::size_t>(k)];
        total += r * r;
    }
    return sum / std::max(1e-12, total);
}

double alignment_of(const std::vector<Rock>& rocks) {
    std::vector<glm::dvec2> twice;  // the directions at twice the azimuth of every degree
    for (int k = 0; k < kRadii; ++k) {
        const double angle = 2.0 * k * std::numbers::pi / 180.0;
        twice.emplace_back(std::cos(angle), std::sin(angle));
    }
    glm::dvec2 sum(0.0);
    double lengths = 0.0;
    for (const Rock& rock : rocks) {
        const glm::dvec2 axis = long_axis(rock.outline, twice);
        sum += axis;
        lengths += std::hypot(axis.x, axis.y);
    }
    // Discs have no long axes, so none that agree.
    const double least = 1e-6 * static_cast<double>(rocks.size());
    return lengths > least ? std::hypot(sum.x, sum.y) / lengths : 0.0;
}

std::string percent(double share) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%.0f %%", 100.0 * share);
    return text.data();
}

std::string reason_of(const GravelLikeness& result, std::size_t weakest) {
    if (result.n_rocks == 0)
        return "no rocks were found";
    switch (weakest) {
        case 0:
            return "only " + std::to_string(result.n_rocks) +
                   (result.n_rocks == 1 ? " rock was found" : " rocks were found");
        case 1:
            return "the outlines are doubtful, " + percent(result.confidence) + " sure on average";
        case 2:
            return "only " + percent(result.explained) + " of its edges belong to outlines";
        case 3:
            return "all outlines have the same size, as made things have";
        default:
            return "all outlines lie in the same direction, as made things do";
    }
}

}  // namespace

GravelLikeness gravel_likeness(const FloatRaster& boundary, const std::vector<Rock>& rocks) {
    if (boundary.empty())
        fail<InvalidInput>("the boundary of the edge field is empty");
    GravelLikeness result;
    result.n_rocks = rocks.size();
    double sum = 0.0;
    double squares = 0.0;
    for (const Rock& rock : rocks) {
        const double size = std::log(std::max(1e-6, equivalent_diameter(rock.outline)));
        sum += size;
        squares += size * size;
        result.confidence += static_cast<double>(rock.outline.confidence);
    }
    if (!rocks.empty()) {
        const double n = static_cast<double>(rocks.size());
        result.confidence /= n;
        result.spread = std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)));
        result.alignment = alignment_of(rocks);
        result.explained = explained_share(boundary, rocks);
    }
    const bool few = result.n_rocks < kLeastForLaws;
    const std::array<double, 5> shares{
        share_of(static_cast<double>(result.n_rocks), kNumber),
        share_of(result.confidence, kConfidence),
        share_of(result.explained, kExplained),
        few ? 1.0 : share_of(result.spread, kSpread),
        few ? 1.0 : share_of(result.alignment, kAlignment),
    };
    const auto weakest = std::min_element(shares.begin(), shares.end());
    result.likeness = *weakest;
    if (result.likeness < kLooksLikeGravel)
        result.reason = reason_of(result, static_cast<std::size_t>(weakest - shares.begin()));
    return result;
}

}  // namespace scree::vision
