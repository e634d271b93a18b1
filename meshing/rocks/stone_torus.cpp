#include "meshing/rocks/stone_torus.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();
constexpr long kMostCells = 1024;  // along a side
constexpr std::size_t kDirections = 8;

double radius_of(const StoneTorus::Stone& stone) {
    return static_cast<double>(stone.shape.radius);
}

double squared(glm::dvec2 v) {
    return glm::dot(v, v);
}

// How far a stone can go along a direction before its disc meets a neighbour's, discs of equal area
// standing in for the silhouettes; at most `reach`.
struct Obstacle {
    glm::dvec2 offset;
    double reach;  // sum of both radii
};

double free_way(const std::vector<Obstacle>& obstacles, glm::dvec2 direction, double reach) {
    double free = reach;
    for (const Obstacle& disc : obstacles) {
        const double along = glm::dot(disc.offset, direction);
        if (along <= 0.0)
            continue;
        const double aside = glm::dot(disc.offset, disc.offset) - along * along;
        const double inside = disc.reach * disc.reach - aside;
        if (inside > 0.0)
            free = std::min(free, std::max(0.0, along - std::sqrt(inside)));
    }
    return free;
}

using Directions = std::array<glm::dvec2, kDirections>;

Directions all_round() {
    Directions directions;
    for (std::size_t k = 0; k < kDirections; ++k) {
        const double azimuth = 2.0 * std::numbers::pi * static_cast<double>(k) / kDirections;
        directions[k] = {std::cos(azimuth), std::sin(azimuth)};
    }
    return directions;
}

}  // namespace

StoneTorus::StoneTorus(glm::dvec2 size, double cell_size)
    : size_(size), turns_(1.0 / size), cell_size_(cell_size) {
    const bool positive = size.x > 0.0 && size.y > 0.0 && cell_size > 0.0;
    if (!positive || !std::isfinite(size.x) || !std::isfinite(size.y) || !std::isfinite(cell_size))
        fail<InvalidOption>("the patch is ", size.x, " x ", size.y, " m with cells of ", cell_size,
                            " m, all must be positive");
    reset_cells();
}

glm::dvec2 StoneTorus::offset(glm::dvec2 from, glm::dvec2 to) const {
    const glm::dvec2 way = to - from;
    return way - size_ * glm::floor(way * turns_ + 0.5);
}

glm::dvec2 StoneTorus::wrapped(glm::dvec2 position) const {
    const glm::dvec2 inside = position - size_ * glm::floor(position / size_);
    return {inside.x < size_.x ? inside.x : 0.0, inside.y < size_.y ? inside.y : 0.0};
}

// Offsets are unambiguous only while two stones and the way between them fit in half the torus.
void StoneTorus::check_reach(const Stone& stone) const {
    const double least = 4.0 * radius_of(stone);
    if (least > std::min(size_.x, size_.y))
        fail<InvalidInput>("a stone of radius ", radius_of(stone), " m needs a patch of at least ",
                           least, " m a side, this one is ", size_.x, " x ", size_.y, " m");
}

template <class Visit>
void StoneTorus::for_cells(glm::dvec2 position, double radius, Visit&& visit) const {
    const auto cell = [](double at, double n, double side) {
        return static_cast<long>(std::floor(at * n / side));
    };
    const auto columns = static_cast<double>(columns_);
    const auto rows = static_cast<double>(rows_);
    const long left = cell(position.x - radius, columns, size_.x);
    const long right = std::min(cell(position.x + radius, columns, size_.x), left + columns_ - 1);
    const long top = cell(position.y - radius, rows, size_.y);
    const long bottom = std::min(cell(position.y + radius, rows, size_.y), top + rows_ - 1);
    for (long y = top; y <= bottom; ++y)
        for (long x = left; x <= right; ++x) {
            const long column = ((x % columns_) + columns_) % columns_;
            const long row = ((y % rows_) + rows_) % rows_;
            if (!visit(static_cast<std::size_t>(row * columns_ + column)))
                return;
        }
}

void StoneTorus::find_neighbours(glm::dvec2 position, double radius,
                                 std::vector<std::uint32_t>& found) const {
    for_cells(position, radius, [&](std::size_t cell) {
        for (const std::uint32_t i : cells_[cell]) {
            const double reach = radius + discs_[i].radius;
            if (squared(offset(position, discs_[i].position)) < reach * reach)
                found.push_back(i);
        }
        return true;
    });
}

bool StoneTorus::is_clear(const Silhouette& shape, glm::dvec2 position, std::uint32_t self) const {
    const auto radius = static_cast<double>(shape.radius);
    bool clear = true;
    for_cells(position, radius, [&](std::size_t cell) {
        for (const std::uint32_t i : cells_[cell]) {
            const glm::dvec2 way = offset(position, discs_[i].position);
            const double reach = radius + discs_[i].radius;
            if (i != self && squared(way) <= reach * reach &&
                overlap(shape, shapes_[i], glm::vec2(way))) {
                clear = false;
                return false;
            }
        }
        return true;
    });
    return clear;
}

bool StoneTorus::add_by_disc(const Stone& stone) {
    check_reach(stone);
    const double radius = radius_of(stone);
    bool clear = true;
    for_cells(stone.position, radius, [&](std::size_t cell) {
        for (const std::uint32_t i : cells_[cell]) {
            const double reach = radius + discs_[i].radius;
            if (squared(offset(stone.position, discs_[i].position)) < reach * reach) {
                clear = false;
                return false;
            }
        }
        return true;
    });
    if (clear)
        insert(stone);
    return clear;
}

bool StoneTorus::add_by_silhouette(const Stone& stone) {
    check_reach(stone);
    const bool clear = is_clear(stone.shape, stone.position, kNobody);
    if (clear)
        insert(stone);
    return clear;
}

bool StoneTorus::move(std::uint32_t stone, glm::dvec2 to) {
    assert(stone < discs_.size());
    const glm::dvec2 position = wrapped(to);
    if (!is_clear(shapes_[stone], position, stone))
        return false;
    unlist(stone);
    discs_[stone].position = position;
    list(stone);
    return true;
}

void StoneTorus::grow(double factor) {
    assert(factor >= 1.0);
    size_ *= factor;
    turns_ = 1.0 / size_;
    for (Disc& disc : discs_)
        disc.position = wrapped(disc.position * factor);
    reset_cells();
}

double StoneTorus::covered_area() const {
    double area = 0.0;
    for (const Silhouette& shape : shapes_)
        area += area_of(shape);
    return area;
}

void StoneTorus::insert(const Stone& stone) {
    discs_.push_back({wrapped(stone.position), radius_of(stone),
                      std::sqrt(area_of(stone.shape) / std::numbers::pi)});
    shapes_.push_back(stone.shape);
    labels_.push_back(stone.label);
    list(static_cast<std::uint32_t>(discs_.size() - 1));
}

void StoneTorus::list(std::uint32_t stone) {
    for_cells(discs_[stone].position, discs_[stone].radius, [&](std::size_t cell) {
        cells_[cell].push_back(stone);
        return true;
    });
}

void StoneTorus::unlist(std::uint32_t stone) {
    for_cells(discs_[stone].position, discs_[stone].radius, [&](std::size_t cell) {
        std::erase(cells_[cell], stone);
        return true;
    });
}

void StoneTorus::reset_cells() {
    const auto count = [&](double side) {
        return std::clamp(static_cast<long>(std::min(side / cell_size_, 1e6)), 1L, kMostCells);
    };
    columns_ = count(size_.x);
    rows_ = count(size_.y);
    cells_.assign(static_cast<std::size_t>(columns_ * rows_), {});
    for (std::uint32_t i = 0; i < discs_.size(); ++i)
        list(i);
}

double move_into_voids(StoneTorus& torus, double step_share) {
    const Directions directions = all_round();
    double moved = 0.0;
    std::vector<std::uint32_t> near;
    std::vector<Obstacle> obstacles;
    for (std::uint32_t i = 0; i < torus.n_stones(); ++i) {
        const StoneTorus::Disc stone = torus.disc(i);
        const double own = stone.mean_radius;
        const double reach = std::min(2.0 * own, torus.cell_size());
        near.clear();
        obstacles.clear();
        torus.find_neighbours(stone.position, reach + own, near);
        for (const std::uint32_t j : near)
            if (j != i)
                obstacles.push_back({torus.offset(stone.position, torus.disc(j).position),
                                     own + torus.disc(j).mean_radius});
        double largest = 0.0;
        glm::dvec2 towards(0.0);
        for (const glm::dvec2& direction : directions) {
            const double free = free_way(obstacles, direction, reach);
            if (free > largest) {
                largest = free;
                towards = direction;
            }
        }
        const double step = step_share * largest;
        if (step > 0.01 * own && torus.move(i, stone.position + step * towards))
            moved += step;
    }
    return moved;
}

}  // namespace scree::meshing
