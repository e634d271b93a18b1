#pragma once

#include <filesystem>
#include <string_view>

#include <gtest/gtest.h>

namespace scree::test {

/// How far a picture may drift from the kept one.
struct Tolerance {
    double fail = 0.004;         ///< A value this far off (0..1) counts as different...
    double fail_percent = 0.02;  ///< ...this many percent may be different...
    double hard_fail = 0.012;    ///< ...but not one may be off by more than this.
};

/// Compare a written picture with tests/golden/<name>. With SCREE_UPDATE_GOLDEN=1 in the
/// environment the kept picture is replaced instead, and the change shows up in review.
///
/// On failure the picture, the kept one and eight times their difference lie in
/// golden-failures/ of the build folder.
testing::AssertionResult matches_golden(const std::filesystem::path& actual, std::string_view name,
                                        const Tolerance& tolerance = {});

}  // namespace scree::test
