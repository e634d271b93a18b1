#include "meshing/space/predicates.h"

#include "base/random.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace scree {
namespace {

using meshing::orientation;

TEST(Orientation, KnowsTheSides) {
    const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    EXPECT_EQ(orientation(a, b, c, glm::vec3(0, 0, 1)), 1);
    EXPECT_EQ(orientation(a, b, c, glm::vec3(0, 0, -1)), -1);
    EXPECT_EQ(orientation(a, b, c, glm::vec3(5, 7, 0)), 0);
    EXPECT_EQ(orientation(glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)), 1);
    EXPECT_EQ(orientation(glm::vec2(0, 0), glm::vec2(0, 1), glm::vec2(1, 0)), -1);
    EXPECT_EQ(orientation(glm::vec2(0, 0), glm::vec2(1, 1), glm::vec2(3, 3)), 0);
}

TEST(Orientation, SeesOneUnitInTheLastPlace) {
    const glm::vec3 a(0.1F, 0.1F, 0.1F), b(0.7F, 0.7F, 0.1F), c(0.3F, 0.9F, 0.1F);
    const float up = std::nextafter(0.1F, 1.0F);
    const float down = std::nextafter(0.1F, 0.0F);
    EXPECT_EQ(orientation(a, b, c, glm::vec3(0.5F, 0.6F, 0.1F)), 0);
    EXPECT_EQ(orientation(a, b, c, glm::vec3(0.5F, 0.6F, up)), 1);
    EXPECT_EQ(orientation(a, b, c, glm::vec3(0.5F, 0.6F, down)), -1);
}

TEST(Orientation, SpansManyMagnitudes) {
    const float tiny = 1e-40F;
    const glm::vec3 a(0, 0, 0), b(1e30F, 0, 0), c(0, 1e-30F, 0);
    EXPECT_EQ(orientation(a, b, c, glm::vec3(1, 1, tiny)), 1);
    EXPECT_EQ(orientation(a, b, c, glm::vec3(1, 1, -tiny)), -1);
    EXPECT_EQ(orientation(a, b, c, glm::vec3(tiny, 1e20F, 0)), 0);
    // On a slanted plane that no common grid holds: x + y = 1e20 z.
    EXPECT_EQ(orientation(glm::vec3(0, 0, 0), glm::vec3(1, -1, 0), glm::vec3(1e20F, 0, 1),
                          glm::vec3(-1e20F, 0, -1)),
              0);
    EXPECT_EQ(orientation(glm::vec2(0, 0), glm::vec2(1e30F, 1e-30F), glm::vec2(-1e30F, -1e-30F)),
              0);
}

TEST(Orientation, ChangesSignWithTheOrder) {
    Rng rng({.seed = 5});
    for (int i = 0; i < 2000; ++i) {  // a coarse lattice: many are coplanar
        const auto pick = [&] {
            return glm::vec3(std::floor(rng.uniform() * 4), std::floor(rng.uniform() * 4),
                             std::floor(rng.uniform() * 4)) *
                   0.1F;
        };
        const glm::vec3 a = pick(), b = pick(), c = pick(), d = pick();
        const int sign = orientation(a, b, c, d);
        EXPECT_EQ(orientation(b, a, c, d), -sign);
        EXPECT_EQ(orientation(b, c, a, d), sign);
        EXPECT_EQ(orientation(a, b, d, c), -sign);
    }
}

}  // namespace
}  // namespace scree
