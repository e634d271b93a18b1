#pragma once

#include "meshing/rocks/silhouette.h"

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace scree::meshing {

/// Stones on a rectangle of ground whose opposite sides are joined, so that it tiles.
///
/// Invariant: no two silhouettes overlap. A grid of cells, each listing the stones whose bounding
/// discs reach into it, keeps look-ups local.
class StoneTorus {
public:
    struct Stone {
        Silhouette shape;          ///< Turned and scaled as it lies.
        glm::dvec2 position{0.0};  ///< Metres; taken modulo the size.
        std::uint32_t label = 0;   ///< The caller's number for it.
    };

    /// Where a stone lies and how far it reaches.
    struct Disc {
        glm::dvec2 position{0.0};  ///< In [0, size) along both sides, metres.
        double radius = 0.0;       ///< Of the disc about it.
        double mean_radius = 0.0;  ///< Of the disc of equal area.
    };

    /// @param size       Of the rectangle, metres.
    /// @param cell_size  Edge of a grid cell, about a usual stone's diameter, metres.
    /// @throw InvalidOption  a size is not positive and finite.
    StoneTorus(glm::dvec2 size, double cell_size);

    std::size_t n_stones() const { return discs_.size(); }
    const Disc& disc(std::size_t stone) const { return discs_[stone]; }
    Stone stone(std::size_t i) const { return {shapes_[i], discs_[i].position, labels_[i]}; }
    /// Area under silhouettes, square metres.
    double covered_area() const;
    glm::dvec2 size() const { return size_; }
    double cell_size() const { return cell_size_; }

    /// Shortest way from one place to another round the torus.
    glm::dvec2 offset(glm::dvec2 from, glm::dvec2 to) const;

    /// Append the stones whose bounding disc meets this disc; one may be named more than once.
    void find_neighbours(glm::dvec2 position, double radius,
                         std::vector<std::uint32_t>& found) const;

    /// Add a stone if its bounding disc stays clear of all others: a dart that sticks.
    bool add_by_disc(const Stone& stone);

    /// Add a stone if its silhouette stays clear of all others.
    bool add_by_silhouette(const Stone& stone);

    /// Move a stone if its silhouette stays clear there, else leave it.
    bool move(std::uint32_t stone, glm::dvec2 to);

    /// Enlarge the rectangle and the distances, not the stones. @pre factor >= 1.
    ///
    /// Keeps the invariant: a silhouette is star-shaped about its centre, so it lies inside its
    /// own enlargement.
    void grow(double factor);

private:
    template <class Visit>
    void for_cells(glm::dvec2 position, double radius, Visit&& visit) const;
    glm::dvec2 wrapped(glm::dvec2 position) const;
    void check_reach(const Stone& stone) const;
    bool is_clear(const Silhouette& shape, glm::dvec2 position, std::uint32_t self) const;
    void insert(const Stone& stone);
    void list(std::uint32_t stone);
    void unlist(std::uint32_t stone);
    void reset_cells();

    glm::dvec2 size_;
    glm::dvec2 turns_;  // 1 / size
    double cell_size_;
    long columns_ = 1;
    long rows_ = 1;
    std::vector<Disc> discs_;  // apart from the silhouettes, which few look-ups need
    std::vector<Silhouette> shapes_;
    std::vector<std::uint32_t> labels_;
    std::vector<std::vector<std::uint32_t>> cells_;
};

/// Move stones once each, largest first, a share of the way into the largest void beside them
/// (`rocks-and-deformer.md` A.18). Moves that would make silhouettes overlap are not made.
/// @return Metres moved, all stones together.
double move_into_voids(StoneTorus& torus, double step_share);

}  // namespace scree::meshing
