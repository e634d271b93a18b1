#include "base/number_text.h"

#include "base/random.h"

#include <bit>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace scree {
namespace {

template <class Number>
std::string text_of(Number value) {
    std::string text;
    append_number(text, value);
    return text;
}

TEST(NumberText, IsTheShortestThatReadsBack) {
    EXPECT_EQ(text_of(0.1), "0.1");
    EXPECT_EQ(text_of(0.1F), "0.1");
    EXPECT_EQ(text_of(12), "12");
    EXPECT_EQ(text_of(-3.0), "-3");
}

TEST(NumberText, EveryFloatComesBack) {
    Rng rng({.seed = 4});
    for (int i = 0; i < 100000; ++i) {
        const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(rng.bits()));
        if (!std::isfinite(value))
            continue;
        ASSERT_EQ(parse_number<float>(text_of(value)), value);
        std::string nine;
        append_number(nine, value, 9);
        ASSERT_EQ(parse_number<float>(nine), value);
    }
}

TEST(NumberText, RefusesWhatIsNotWhollyANumber) {
    EXPECT_FALSE(parse_number<double>(""));
    EXPECT_FALSE(parse_number<double>(" 1"));
    EXPECT_FALSE(parse_number<double>("1,5"));
    EXPECT_FALSE(parse_number<int>("1.5"));
    EXPECT_FALSE(parse_number<int>("99999999999"));
    EXPECT_EQ(parse_number<int>("-7"), -7);
}

}  // namespace
}  // namespace scree
