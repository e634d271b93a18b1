#include "vision/classical/field_model.h"

#include "base/error.h"

#include <array>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

TEST(FieldModel, TrainedNetworksFitTogether) {
    const FieldModel& model = trained_field_model();
    for (const Mlp& mlp : model.levels) {
        EXPECT_EQ(mlp.n_out(), 3);
        for (std::size_t i = 1; i < mlp.layers.size(); ++i)
            EXPECT_EQ(mlp.layers[i].n_in, mlp.layers[i - 1].n_out);
    }
    EXPECT_LT(model.levels.back().n_in(), model.levels.front().n_in()) << "no context there";
}

TEST(FieldModel, ReadsOneNetworkAfterTheOther) {
    const std::array<double, 11> numbers = {1, 2, 1, 0.5, -1, 0.25, 1, 1, 1, 3, 4};
    std::span<const double> rest(numbers);
    const Mlp first = read_mlp(rest), second = read_mlp(rest);
    EXPECT_THAT(first.layers[0].weights, testing::ElementsAre(0.5F, -1.0F));
    EXPECT_THAT(first.layers[0].bias, testing::ElementsAre(0.25F));
    EXPECT_THAT(second.layers[0].bias, testing::ElementsAre(4.0F));
    EXPECT_TRUE(rest.empty());
}

TEST(FieldModelErrors, ShortOrSillyTablesAreRefused) {
    const std::array<double, 4> numbers = {1, 2, 1, 0.5};
    std::span<const double> rest(numbers);
    EXPECT_THAT([&] { read_mlp(rest); },
                testing::ThrowsMessage<InvalidInput>("the network table ends 1 numbers too early"));
    const std::array<double, 3> silly = {1, 0, 1};
    std::span<const double> other(silly);
    EXPECT_THAT([&] { read_mlp(other); },
                testing::ThrowsMessage<InvalidInput>(
                    "the network table has a layer of size 0, must be in [1, 4096]"));
}

}  // namespace
}  // namespace scree::vision
