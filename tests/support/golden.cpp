#include "tests/support/golden.h"

#include "vision/image_io.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

namespace scree::test {
namespace {

namespace fs = std::filesystem;

struct Drift {
    double different_percent = 0.0;
    double greatest = 0.0;
};

Drift drift_between(const Photo& a, const Photo& b, double fail) {
    Drift drift;
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        int most = 0;
        for (int c = 0; c < 3; ++c)
            most = std::max(most, std::abs(int{a.data()[i][c]} - int{b.data()[i][c]}));
        different += most / 255.0 > fail ? 1 : 0;
        drift.greatest = std::max(drift.greatest, most / 255.0);
    }
    drift.different_percent =
        100.0 * static_cast<double>(different) / static_cast<double>(a.size());
    return drift;
}

Photo magnified_difference(const Photo& a, const Photo& b) {
    Photo out(a.width(), a.height());
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 3; ++c)
            out.data()[i][c] = static_cast<std::uint8_t>(
                std::min(255, 8 * std::abs(int{a.data()[i][c]} - int{b.data()[i][c]})));
    return out;
}

fs::path leave_pictures(const Photo& got, const Photo& wanted, std::string_view name) {
    const fs::path folder = fs::path(SCREE_GOLDEN_FAILURES) / fs::path(name).stem();
    fs::create_directories(folder);
    vision::write_png(folder / "got.png", got);
    vision::write_png(folder / "wanted.png", wanted);
    if (got.width() == wanted.width() && got.height() == wanted.height())
        vision::write_png(folder / "difference.png", magnified_difference(got, wanted));
    return folder;
}

}  // namespace

testing::AssertionResult matches_golden(const fs::path& actual, std::string_view name,
                                        const Tolerance& tolerance) {
    const fs::path kept = fs::path(SCREE_SOURCE_DIR) / "tests" / "golden" / name;
    const char* update = std::getenv("SCREE_UPDATE_GOLDEN");
    if (update != nullptr && std::string_view(update) == "1") {
        fs::create_directories(kept.parent_path());
        fs::copy_file(actual, kept, fs::copy_options::overwrite_existing);
        return testing::AssertionSuccess() << kept << " was replaced";
    }
    if (!fs::exists(kept))
        return testing::AssertionFailure()
               << kept << " is not there; SCREE_UPDATE_GOLDEN=1 makes it from " << actual;
    const Photo got = vision::read_photo(actual).pixels;
    const Photo wanted = vision::read_photo(kept).pixels;
    if (got.width() != wanted.width() || got.height() != wanted.height())
        return testing::AssertionFailure()
               << name << " is " << got.width() << " x " << got.height() << ", kept is "
               << wanted.width() << " x " << wanted.height() << "; see "
               << leave_pictures(got, wanted, name);
    const Drift drift = drift_between(got, wanted, tolerance.fail);
    if (drift.different_percent <= tolerance.fail_percent && drift.greatest <= tolerance.hard_fail)
        return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << name << ": " << drift.different_percent << " % of the pixels differ, the worst by "
           << drift.greatest << "; see " << leave_pictures(got, wanted, name);
}

}  // namespace scree::test
