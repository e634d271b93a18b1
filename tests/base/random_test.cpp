#include "base/random.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>

namespace scree {
namespace {

TEST(Random, SameKeySameNumbersOtherKeyOthers) {
    Rng a({.seed = 7, .stream = 1, .step = 2, .cell = 3});
    Rng b({.seed = 7, .stream = 1, .step = 2, .cell = 3});
    Rng c({.seed = 7, .stream = 1, .step = 2, .cell = 4});
    Rng d({.seed = 7, .stream = 2, .step = 1, .cell = 3});
    const std::uint64_t first = a.bits();
    EXPECT_EQ(first, b.bits());
    EXPECT_NE(first, c.bits());
    EXPECT_NE(first, d.bits());
}

TEST(Random, FirstNumberIsTheSameOnEveryMachine) {
    EXPECT_EQ(Rng({.seed = 1}).bits(), Rng({.seed = 1}).bits());
    Rng rng({.seed = 42, .stream = 9});
    double sum = 0.0;
    for (int i = 0; i < 100000; ++i)
        sum += rng.uniform();
    EXPECT_NEAR(sum / 100000, 0.5, 0.005);
}

TEST(Random, BelowIsEvenAndInRange) {
    Rng rng({.seed = 3});
    std::vector<int> count(7, 0);
    for (int i = 0; i < 70000; ++i)
        ++count[rng.below(7)];
    EXPECT_THAT(count, testing::Each(testing::AllOf(testing::Gt(9500), testing::Lt(10500))));
}

TEST(Random, NormalHasUnitVariance) {
    Rng rng({.seed = 5});
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < 100000; ++i) {
        const double x = rng.normal();
        sum += x;
        squares += x * x;
    }
    EXPECT_NEAR(sum / 100000, 0.0, 0.02);
    EXPECT_NEAR(squares / 100000, 1.0, 0.02);
}

}  // namespace
}  // namespace scree
