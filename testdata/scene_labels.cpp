#include "testdata/scene_layout.h"

#include <algorithm>
#include <array>
#include <map>

namespace scree::test {
namespace {

constexpr double kLeastShown = 0.2;   // of a rock's own area, unless it is a
constexpr double kLargePart = 400.0;  // pixels
constexpr double kLeastBare = 0.6;    // of what is uppermost, free of clutter
constexpr double kLeastPixels = 20.0;
constexpr double kLeastPiece = 0.06;  // of the uppermost pixels

// What most of a picture pixel's canvas pixels hold; the first of equals.
std::int32_t majority(const Raster<std::int32_t>& canvas, int x, int y) {
    std::array<std::int32_t, kOversampling * kOversampling> votes{};
    std::size_t n = 0;
    for (int j = 0; j < kOversampling; ++j)
        for (int i = 0; i < kOversampling; ++i)
            votes[n++] = canvas(kMargin + kOversampling * x + i, kMargin + kOversampling * y + j);
    std::int32_t best = votes[0];
    std::ptrdiff_t most = 0;
    for (const std::int32_t vote : votes) {
        const auto count = std::count(votes.begin(), votes.end(), vote);
        if (count > most) {
            most = count;
            best = vote;
        }
    }
    return best;
}

// The pixels connected with a start that have the same value; they are set to `done` in `owner`.
std::vector<glm::ivec2> piece_at(Raster<std::int32_t>& owner, glm::ivec2 start) {
    constexpr std::int32_t kDone = -2;
    const std::int32_t value = owner(start.x, start.y);
    std::vector<glm::ivec2> piece{start};
    owner(start.x, start.y) = kDone;
    for (std::size_t next = 0; next < piece.size(); ++next)
        for (const glm::ivec2 step : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
            const glm::ivec2 q = piece[next] + step;
            if (owner.contains(q.x, q.y) && owner(q.x, q.y) == value) {
                owner(q.x, q.y) = kDone;
                piece.push_back(q);
            }
        }
    return piece;
}

struct Shown {
    double rock = 0.0;  ///< Pixels where this is the uppermost rock or thing.
    double bare = 0.0;  ///< Those of them that no clutter hides.
};

// Whether a person would draw this rock. What the picture's edge cuts away is not covered by other
// rocks, so a large visible part is enough.
bool is_labelled(const Body& body, const Shown& shown, double whole, double piece) {
    const bool covered = shown.rock < kLeastShown * whole && shown.rock < kLargePart;
    return body.kind == BodyKind::Rock && !covered && shown.bare >= kLeastBare * shown.rock &&
           shown.rock >= kLeastPixels && piece >= kLeastPiece * shown.rock;
}

}  // namespace

Visible label_heap(const Heap& heap, const SceneOptions& o) {
    Raster<std::int32_t> rock(o.width, o.height);
    std::vector<Shown> shown(heap.bodies.size());
    Visible visible{LabelMap(o.width, o.height), Mask(o.width, o.height)};
    for (int y = 0; y < o.height; ++y)
        for (int x = 0; x < o.width; ++x) {
            const std::int32_t seen = majority(heap.owner, x, y);
            const std::int32_t below = rock(x, y) = majority(heap.rock, x, y);
            visible.ignore(x, y) = below < 0 && seen >= 0 ? 255 : 0;
            if (below < 0)
                continue;
            shown[static_cast<std::size_t>(below)].rock += 1.0;
            shown[static_cast<std::size_t>(below)].bare += seen == below ? 1.0 : 0.0;
        }
    std::map<std::int32_t, std::uint16_t> names;
    for (int y = 0; y < o.height; ++y)
        for (int x = 0; x < o.width; ++x) {
            const std::int32_t index = rock(x, y);
            if (index < 0)
                continue;
            const auto body = static_cast<std::size_t>(index);
            const auto piece = piece_at(rock, {x, y});
            if (heap.bodies[body].kind == BodyKind::Thing)
                continue;
            const double whole = heap.laid_area[body] / (kOversampling * kOversampling);
            const bool labelled = is_labelled(heap.bodies[body], shown[body], whole,
                                              static_cast<double>(piece.size()));
            std::uint16_t name = 0;
            if (labelled)
                name = names.emplace(index, static_cast<std::uint16_t>(names.size() + 1))
                           .first->second;
            for (const glm::ivec2 p : piece) {
                visible.labels(p.x, p.y) = name;
                visible.ignore(p.x, p.y) = labelled ? 0 : 255;
            }
        }
    return visible;
}

}  // namespace scree::test
