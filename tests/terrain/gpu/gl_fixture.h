#pragma once

#include "terrain/gpu/gl_context.h"

#include <gtest/gtest.h>

namespace scree::terrain::test {

/// A test that draws in software; skipped, with the reason, where nothing can.
class GlTest : public testing::Test {
protected:
    void SetUp() override {
        auto attempt = GlContext::try_make({.software = true});
        if (!attempt.context)
            GTEST_SKIP() << attempt.reason;
        context_ = std::move(attempt.context);
    }

    GlContext& context() { return *context_; }

private:
    std::unique_ptr<GlContext> context_;
};

}  // namespace scree::terrain::test
