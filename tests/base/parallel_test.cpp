#include "base/parallel.h"

#include "base/error.h"

#include <atomic>
#include <numeric>
#include <vector>

#include <gmock/gmock.h>

namespace scree {
namespace {

TEST(Parallel, VisitsEveryIndexOnceForAnyGrainAndThreadCount) {
    for (const int threads : {1, 2, 4})
        for (const std::size_t grain : {1U, 3U, 64U, 5000U}) {
            const ThreadLimit limit(threads);
            std::vector<int> visits(1001, 0);
            parallel_for_each_index(0, visits.size(), grain, [&](std::size_t i) { ++visits[i]; });
            EXPECT_THAT(visits, testing::Each(1)) << threads << " threads, grain " << grain;
        }
}

TEST(Parallel, PiecesDoNotDependOnTheThreadCount) {
    const auto pieces = [](int threads) {
        const ThreadLimit limit(threads);
        std::vector<std::size_t> first_of(100);
        parallel_for(0, 100, 7, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                first_of[i] = first;
        });
        return first_of;
    };
    EXPECT_EQ(pieces(1), pieces(4));
}

TEST(Parallel, PassesAnExceptionOn) {
    EXPECT_THROW(parallel_for_each_index(0, 10, 1,
                                         [](std::size_t i) {
                                             if (i == 5)
                                                 fail<InvalidInput>("five");
                                         }),
                 InvalidInput);
}

TEST(Parallel, EmptyRangeCallsNothing) {
    parallel_for(4, 4, 1, [](std::size_t, std::size_t) { FAIL(); });
}

TEST(Parallel, InvokeRunsBoth) {
    std::atomic<int> sum{0};
    parallel_invoke([&] { sum += 1; }, [&] { sum += 2; });
    EXPECT_EQ(sum.load(), 3);
}

TEST(ThreadLimit, RefusesNegativeCounts) {
    EXPECT_THAT([] { ThreadLimit limit(-1); },
                testing::ThrowsMessage<InvalidOption>("threads is -1, must be 0 (all) or more"));
}

}  // namespace
}  // namespace scree
