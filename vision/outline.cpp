#include "vision/outline.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree::vision {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct UnitCircle {
    std::array<double, kRadii> cosine;
    std::array<double, kRadii> sine;
};

const UnitCircle& unit_circle() {
    static const UnitCircle circle = [] {
        UnitCircle c{};
        for (std::size_t k = 0; k < kRadii; ++k) {
            c.cosine[k] = std::cos(static_cast<double>(k) * kDegree);
            c.sine[k] = std::sin(static_cast<double>(k) * kDegree);
        }
        return c;
    }();
    return circle;
}

void check_outline(const Outline& outline, std::size_t index) {
    const bool finite = std::isfinite(outline.centre.x) && std::isfinite(outline.centre.y);
    const bool positive = std::all_of(outline.radii.begin(), outline.radii.end(),
                                      [](float r) { return r > 0.0F && r < 1e6F; });
    if (!finite || !positive)
        fail<InvalidInput>("outline ", index,
                           " has a centre or radius that is not a positive number");
}

// Where the outline crosses the middle of a row.
struct Crossing {
    int y;
    double x;

    bool operator<(const Crossing& o) const { return y != o.y ? y < o.y : x < o.x; }
};

void find_crossings(const Outline& outline, int height, std::vector<Crossing>& crossings) {
    crossings.clear();
    glm::dvec2 a = border_point(outline, kRadii - 1);
    for (int k = 0; k < kRadii; ++k) {
        const glm::dvec2 b = border_point(outline, k);
        const double low = std::clamp(std::min(a.y, b.y) - 0.5, 0.0, static_cast<double>(height));
        const double high = std::max(a.y, b.y) - 0.5;
        for (int y = static_cast<int>(low); y < height && y <= high; ++y) {
            const double level = y + 0.5;
            if ((a.y <= level) != (b.y <= level))
                crossings.push_back({y, a.x + (level - a.y) / (b.y - a.y) * (b.x - a.x)});
        }
        a = b;
    }
    std::sort(crossings.begin(), crossings.end());
}

// Half-open rows and even-odd crossings, so that a pixel centre on a shared border is painted once.
// An outline is closed: every row is crossed an even number of times.
void paint(const Outline& outline, std::uint16_t label, LabelMap& labels,
           std::vector<Crossing>& crossings) {
    find_crossings(outline, labels.height(), crossings);
    for (std::size_t c = 0; c + 1 < crossings.size(); c += 2) {
        const int from = std::max(0, static_cast<int>(std::ceil(crossings[c].x - 0.5)));
        const int to =
            std::min(labels.width(), static_cast<int>(std::ceil(crossings[c + 1].x - 0.5)));
        std::uint16_t* row = labels.row(crossings[c].y);
        for (int x = from; x < to; ++x)
            row[x] = row[x] == 0 ? label : row[x];
    }
}

}  // namespace

double radius_at(const Outline& outline, double azimuth) {
    const double turns = azimuth / (2.0 * std::numbers::pi);
    const double degrees = (turns - std::floor(turns)) * kRadii;
    const auto k = static_cast<std::size_t>(degrees);
    const double share = degrees - std::floor(degrees);
    const double here = outline.radii[k % kRadii];
    const double next = outline.radii[(k + 1) % kRadii];
    return here + share * (next - here);
}

glm::dvec2 border_point(const Outline& outline, int degree) {
    const auto k = static_cast<std::size_t>(((degree % kRadii) + kRadii) % kRadii);
    const double r = outline.radii[k];
    return {outline.centre.x + r * unit_circle().cosine[k],
            outline.centre.y + r * unit_circle().sine[k]};
}

double outline_area(const Outline& outline) {
    double twice = 0.0;
    for (std::size_t k = 0; k < kRadii; ++k)
        twice += static_cast<double>(outline.radii[k]) * outline.radii[(k + 1) % kRadii];
    return 0.5 * std::sin(kDegree) * twice;
}

double equivalent_diameter(const Outline& outline) {
    return 2.0 * std::sqrt(outline_area(outline) / std::numbers::pi);
}

LabelMap paint_labels(const std::vector<Outline>& outlines, int width, int height) {
    if (outlines.size() > 65535)
        fail<InvalidInput>("a label map holds 65535 rocks at most, got ", outlines.size());
    LabelMap labels(width, height);
    std::vector<Crossing> crossings;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        check_outline(outlines[i], i);
        paint(outlines[i], static_cast<std::uint16_t>(i + 1), labels, crossings);
    }
    return labels;
}

}  // namespace scree::vision
