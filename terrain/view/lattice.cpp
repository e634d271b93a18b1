#include "terrain/view/lattice.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree::terrain {
namespace {

// Rows alternate: even ones hold columns + 1 corners, odd ones stand half a step to the left and
// hold one more, so that both reach the rim.
struct Rows {
    int columns = 1;
    int n_rows = 2;

    bool exists(int row) const { return row >= 0 && row < n_rows; }
    std::uint32_t at(int row, int i) const {
        const auto pairs = static_cast<std::uint32_t>(row / 2);
        const auto even = static_cast<std::uint32_t>(columns) + 1U;
        return pairs * (2U * even + 1U) + (row % 2 == 1 ? even : 0U) +
               static_cast<std::uint32_t>(i);
    }
};

// An apex and a base from left to right, with the corners beyond; `flipped` where the base lies on
// the side of smaller z.
struct Corners {
    std::uint32_t apex, left, right;
    std::uint32_t beyond_base, beyond_left, beyond_right;
};

LatticePatch patch(const Corners& c, bool flipped) {
    if (flipped)
        return {c.apex, c.right, c.left, c.beyond_base, c.beyond_right, c.beyond_left};
    return {c.apex, c.left, c.right, c.beyond_base, c.beyond_left, c.beyond_right};
}

// The patches between an even row and an odd one beside it.
void add_strip(const Rows& rows, int even, int odd, std::vector<LatticePatch>& patches) {
    const int n = rows.columns;
    const int past_odd = odd + (odd - even);  // the rows beyond the strip
    const int past_even = even + (even - odd);
    const bool odd_is_lower = odd > even;
    for (int k = 0; k <= n; ++k) {
        const std::uint32_t apex = rows.at(even, k);
        const std::uint32_t left = rows.at(odd, k);
        const std::uint32_t right = rows.at(odd, k + 1);
        patches.push_back(
            patch({apex, left, right, rows.exists(past_odd) ? rows.at(past_odd, k) : apex,
                   k > 0 ? rows.at(even, k - 1) : right, k < n ? rows.at(even, k + 1) : left},
                  !odd_is_lower));
        if (k == n)
            break;
        const std::uint32_t tip = rows.at(odd, k + 1);
        patches.push_back(patch({tip, rows.at(even, k), rows.at(even, k + 1),
                                 rows.exists(past_even) ? rows.at(past_even, k + 1) : tip,
                                 rows.at(odd, k), rows.at(odd, k + 2)},
                                odd_is_lower));
    }
}

}  // namespace

Lattice make_lattice(const GroundArea& area, int columns) {
    if (columns < 1 || columns > 4096)
        fail<InvalidOption>("columns is ", columns, ", must be in [1, 4096]");
    if (!(area.width > 0.0) || !(area.depth > 0.0) || !std::isfinite(area.width + area.depth))
        fail<InvalidInput>("a lattice over ", area.width, " by ", area.depth,
                           " m: both sides must be positive");
    Lattice lattice;
    lattice.step = area.width / columns;
    const double pitch = std::numbers::sqrt3 / 2.0 * lattice.step;
    const double wanted_rows = std::max(1.0, std::ceil(area.depth / pitch - 1e-9)) + 1.0;
    if (wanted_rows * (columns + 2.0) > 268435456.0)
        fail<InvalidOption>("a lattice of ", columns, " columns over ", area.width, " by ",
                            area.depth, " m has more than 2^28 corners");
    const Rows rows{columns, static_cast<int>(wanted_rows)};
    lattice.positions.reserve(rows.at(rows.n_rows, 0));
    for (int j = 0; j < rows.n_rows; ++j) {
        const bool last = j + 1 == rows.n_rows;
        const double z = last ? area.depth : j * pitch;
        const int n_corners = columns + 1 + j % 2;
        for (int i = 0; i < n_corners; ++i) {
            const double x = lattice.step * (i - 0.5 * (j % 2));
            const double inside = i + 1 == n_corners ? area.width : std::clamp(x, 0.0, area.width);
            lattice.positions.emplace_back(static_cast<float>(area.x + inside),
                                           static_cast<float>(area.z + z));
        }
    }
    lattice.patches.reserve(static_cast<std::size_t>(rows.n_rows - 1) *
                            (2U * static_cast<std::size_t>(columns) + 1U));
    for (int j = 0; j + 1 < rows.n_rows; ++j)
        add_strip(rows, j % 2 == 0 ? j : j + 1, j % 2 == 0 ? j + 1 : j, lattice.patches);
    return lattice;
}

}  // namespace scree::terrain
