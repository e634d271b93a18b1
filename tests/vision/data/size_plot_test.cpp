#include "vision/data/size_plot.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

RockSet discs(const std::vector<double>& diameters, double metres_per_pixel = 0.0) {
    RockSet set{.image = "a.png",
                .width = 900,
                .height = 600,
                .metres_per_pixel = metres_per_pixel,
                .method = "drawn",
                .rocks = {}};
    for (const double diameter : diameters) {
        Rock rock;
        rock.outline.centre = {450, 300};
        rock.outline.radii.fill(static_cast<float>(0.5 * diameter));
        rock.depth = static_cast<float>(0.5 * diameter);
        set.rocks.push_back(rock);
    }
    return set;
}

bool is_blue(const glm::u8vec3& c) {
    return c.z > c.x + 100 && c.z > c.y + 40;
}

// Columns of the plot's blue marks are filled discs: rows of at least 8 blue pixels.
std::vector<int> mark_columns(const Photo& plot, int row) {
    std::vector<int> columns;
    for (int x = 70; x + 8 < plot.width(); ++x) {
        bool whole = true;
        for (int k = 0; k < 8; ++k)
            whole = whole && is_blue(plot(x + k, row));
        if (whole && (columns.empty() || x > columns.back() + 12))
            columns.push_back(x + 4);
    }
    return columns;
}

TEST(SizePlot, MarksPercentilesAtTheirDiameters) {
    std::vector<double> diameters;
    for (int i = 0; i <= 100; ++i)
        diameters.push_back(10.0 * std::pow(10.0, i / 100.0));
    const Photo plot = draw_size_plot(grain_size_curve(discs(diameters)));
    ASSERT_EQ(plot.width(), 900);
    ASSERT_EQ(plot.height(), 600);
    // The frame is 64..868 across and 52..536 down; the axis runs from 10 / 1.12 to 100 * 1.12.
    for (const double share : {0.16, 0.50, 0.84}) {
        const double diameter = 10.0 * std::pow(10.0, share);
        const double low = 10 / 1.12;
        const double high = 112;
        const double x = 64 + 804 * std::log(diameter / low) / std::log(high / low);
        const int row = static_cast<int>(52 + 484 * (1 - share));
        const auto columns = mark_columns(plot, row);
        const bool found = std::any_of(columns.begin(), columns.end(),
                                       [&](int column) { return std::abs(column - x) < 4; });
        EXPECT_TRUE(found) << share;
    }
}

TEST(SizePlot, DrawsAnySetOfRocks) {
    for (const std::vector<double>& diameters :
         {std::vector<double>{}, {20}, {20, 20, 20}, {1, 1e6}, {1e-3, 1e-3}}) {
        const Photo plot = draw_size_plot(grain_size_curve(discs(diameters, 2e-4)));
        EXPECT_NE(std::count(plot.begin(), plot.end(), glm::u8vec3(255)), 900 * 600);
    }
}

TEST(SizePlot, SaysTheUnit) {
    const auto pixels = grain_size_curve(discs({10, 20, 40}));
    const auto millimetres = grain_size_curve(discs({10, 20, 40}, 1e-3));
    EXPECT_NE(draw_size_plot(pixels), draw_size_plot(millimetres));
    EXPECT_NE(draw_size_plot(pixels), draw_size_plot(pixels, {.by_area = true}));
}

TEST(SizePlotErrors, NameTheRange) {
    EXPECT_THAT(
        [] { draw_size_plot({}, {.width = 10}); },
        testing::ThrowsMessage<InvalidOption>("plot-width is 10, must be in [320, 8192] px"));
}

}  // namespace
}  // namespace scree::vision
