#include "vision/thesis/edge_linking.h"

#include "vision/thesis/thinning.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>

namespace scree::vision {
namespace {

constexpr int kBranchSteps = 6;  // pixels that give a branch its direction

template <class Visit>
void for_neighbours(const Mask& mask, glm::ivec2 p, Visit&& visit) {
    for (int y = std::max(0, p.y - 1); y <= std::min(mask.height() - 1, p.y + 1); ++y)
        for (int x = std::max(0, p.x - 1); x <= std::min(mask.width() - 1, p.x + 1); ++x)
            if ((x != p.x || y != p.y) && mask(x, y) != 0)
                visit(glm::ivec2(x, y));
}

bool is_end(const Mask& lines, glm::ivec2 p) {
    int n_neighbours = 0;
    for_neighbours(lines, p, [&](glm::ivec2) { ++n_neighbours; });
    return lines(p.x, p.y) != 0 && n_neighbours == 1;
}

// The pixels of the branch behind an end, the end first.
std::vector<glm::ivec2> branch_of(const Mask& lines, glm::ivec2 end) {
    std::vector<glm::ivec2> branch{end};
    while (branch.size() <= kBranchSteps) {
        std::optional<glm::ivec2> next;
        for_neighbours(lines, branch.back(), [&](glm::ivec2 q) {
            if (!next && std::find(branch.begin(), branch.end(), q) == branch.end())
                next = q;
        });
        if (!next)
            break;
        branch.push_back(*next);
    }
    return branch;
}

void draw_line(Mask& mask, glm::ivec2 from, glm::ivec2 to) {
    const glm::ivec2 way = to - from;
    const int steps = std::max(std::abs(way.x), std::abs(way.y));
    for (int i = 0; i <= steps; ++i) {
        const double t = steps == 0 ? 0.0 : static_cast<double>(i) / steps;
        const auto x = from.x + static_cast<int>(std::lround(t * way.x));
        const auto y = from.y + static_cast<int>(std::lround(t * way.y));
        mask(x, y) = 1;
    }
}

struct Search {
    const Mask& lines;
    const Mask& open_ends;
    int reach;
    double least_cosine;
};

// Nearest pixel ahead of the branch: an open end if there is one, else any edge pixel.
std::optional<glm::ivec2> target_of(const Search& search, const std::vector<glm::ivec2>& branch) {
    const glm::ivec2 end = branch.front();
    const glm::dvec2 direction = glm::normalize(glm::dvec2(end - branch.back()));
    std::optional<glm::ivec2> best;
    double best_distance = std::numeric_limits<double>::max();
    bool best_is_end = false;
    const Mask& lines = search.lines;
    for (int y = std::max(0, end.y - search.reach);
         y <= std::min(lines.height() - 1, end.y + search.reach); ++y)
        for (int x = std::max(0, end.x - search.reach);
             x <= std::min(lines.width() - 1, end.x + search.reach); ++x) {
            const glm::ivec2 q{x, y};
            if (lines(x, y) == 0 || std::find(branch.begin(), branch.end(), q) != branch.end())
                continue;
            const glm::dvec2 way(q - end);
            const double distance = glm::length(way);
            if (distance > search.reach ||
                glm::dot(way, direction) < search.least_cosine * distance - 1e-12)
                continue;
            const bool other_end = search.open_ends(x, y) != 0;
            const bool better = other_end == best_is_end ? distance < best_distance : other_end;
            if (better) {
                best = q;
                best_distance = distance;
                best_is_end = other_end;
            }
        }
    return best;
}

}  // namespace

std::vector<glm::ivec2> line_ends(const Mask& lines) {
    std::vector<glm::ivec2> ends;
    for (int y = 0; y < lines.height(); ++y)
        for (int x = 0; x < lines.width(); ++x)
            if (lines(x, y) != 0 && is_end(lines, {x, y}))
                ends.emplace_back(x, y);
    return ends;
}

Mask linked(const Mask& lines, const ThesisOptions& options) {
    check_thesis(options);
    Mask result = lines;
    const std::vector<glm::ivec2> ends = line_ends(lines);
    Mask open_ends(lines.width(), lines.height());
    for (const glm::ivec2 end : ends)
        open_ends(end.x, end.y) = 1;
    const Search search{lines, open_ends, options.link_reach,
                        std::cos(options.link_angle * std::numbers::pi / 180.0)};
    for (const glm::ivec2 end : ends) {
        if (open_ends(end.x, end.y) == 0)
            continue;
        const auto target = target_of(search, branch_of(lines, end));
        if (!target)
            continue;
        draw_line(result, end, *target);
        open_ends(end.x, end.y) = 0;
        open_ends(target->x, target->y) = 0;
    }
    return result;
}

Mask without_small_pieces(const Mask& lines, int least_pixels) {
    Mask result = lines;
    Mask seen(lines.width(), lines.height());
    std::vector<glm::ivec2> piece;
    for (int y = 0; y < lines.height(); ++y)
        for (int x = 0; x < lines.width(); ++x) {
            if (lines(x, y) == 0 || seen(x, y) != 0)
                continue;
            piece.assign(1, {x, y});
            seen(x, y) = 1;
            for (std::size_t i = 0; i < piece.size(); ++i)
                for_neighbours(lines, piece[i], [&](glm::ivec2 q) {
                    if (seen(q.x, q.y) == 0) {
                        seen(q.x, q.y) = 1;
                        piece.push_back(q);
                    }
                });
            if (piece.size() < static_cast<std::size_t>(least_pixels))
                for (const glm::ivec2 p : piece)
                    result(p.x, p.y) = 0;
        }
    return result;
}

Mask link_edges(const Mask& thresholded, const ThesisOptions& options) {
    check_thesis(options);
    Mask lines = thinned(thresholded);
    for (int pass = 0; pass < options.link_passes; ++pass)
        lines = linked(lines, options);
    return without_small_pieces(lines, options.least_component);
}

}  // namespace scree::vision
