#include "base/options.h"

#include <limits>

#include <gmock/gmock.h>

namespace scree {
namespace {

enum class Colour { Red, Green };

constexpr std::string_view kColourNames[] = {"red", "green"};

constexpr std::span<const std::string_view> names_of(Colour) {
    return kColourNames;
}

struct PaintOptions {
    double share = 0.5;
    int coats = 2;
    Colour colour = Colour::Red;
    bool gloss = false;
};

template <class Visitor>
void describe(PaintOptions& o, Visitor&& field) {
    field("share", o.share, FieldInfo{.min = 0, .max = 1, .help = "part that is painted"});
    field("coats", o.coats, FieldInfo{.min = 1, .max = 9, .unit = "layers", .help = "coats"});
    field("colour", o.colour, FieldInfo{.help = "which paint"});
    field("gloss", o.gloss, FieldInfo{.help = "shiny"});
}

TEST(Options, AcceptDefaultsAndTheEndsOfARange) {
    EXPECT_NO_THROW(check(PaintOptions{}));
    EXPECT_NO_THROW(check(PaintOptions{.share = 0, .coats = 9}));
}

TEST(Options, NameTheValueAndTheRange) {
    EXPECT_THAT([] { check(PaintOptions{.coats = 12}); },
                testing::ThrowsMessage<InvalidOption>("coats is 12, must be in [1, 9] layers"));
    EXPECT_THAT([] { check(PaintOptions{.share = -1}); },
                testing::ThrowsMessage<InvalidOption>("share is -1, must be in [0, 1]"));
}

TEST(Options, RejectNaNAndUnnamedEnumerators) {
    EXPECT_THROW(check(PaintOptions{.share = std::numeric_limits<double>::quiet_NaN()}),
                 InvalidOption);
    EXPECT_THROW(check(PaintOptions{.colour = static_cast<Colour>(7)}), InvalidOption);
}

}  // namespace
}  // namespace scree
