#include "terrain/gpu/gl_context.h"

#include "tests/terrain/gpu/gl_fixture.h"

#include <thread>

namespace scree::terrain {
namespace {

class GlContexts : public test::GlTest {};

TEST_F(GlContexts, NamesItsDeviceAndLimits) {
    EXPECT_FALSE(context().device().empty());
    EXPECT_TRUE(context().is_software());
    EXPECT_GE(context().max_texture_size(), 16384);
    EXPECT_GE(context().max_texture_layers(), 256);
}

TEST_F(GlContexts, TwoLiveSideBySideAndTheOtherOutlivesOne) {
    auto other = GlContext::make({.software = true});
    context().make_current();
    other->make_current();
    other.reset();
    EXPECT_NO_THROW(context().make_current());
    EXPECT_NO_THROW(GlContext::make({.software = true}));
    EXPECT_NO_THROW(context().make_current());
}

TEST_F(GlContexts, AnotherThreadMakesItsOwnButCannotTakeThisOne) {
    context().make_current();
    std::string device;
    bool refused = false;
    std::thread thread([&] {
        try {
            context().make_current();
        } catch (const DeviceError&) {
            refused = true;
        }
        device = GlContext::make({.software = true})->device();
    });
    thread.join();
    EXPECT_TRUE(refused);
    EXPECT_EQ(device, context().device());
}

TEST(GlContextAttempt, GivesAContextOrAReason) {
    const auto attempt = GlContext::try_make();
    EXPECT_NE(attempt.context == nullptr, attempt.reason.empty());
}

}  // namespace
}  // namespace scree::terrain
