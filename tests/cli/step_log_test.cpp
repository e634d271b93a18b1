#include "apps/step_log.h"

#include "base/whole_file.h"
#include "tests/support/temp_dir.h"

#include <limits>

#include <gtest/gtest.h>

namespace scree {
namespace {

using apps::CsvRow;
using apps::StepLog;

StepLog log_of(const std::filesystem::path& file, int steps) {
    StepLog log(file, "step,a");
    for (int i = 1; i <= steps; ++i)
        log.add(i, std::to_string(10 * i));
    return log;
}

TEST(StepLog, DropsTheRowsOfStepsTakenBack) {
    StepLog log = log_of("", 4);
    log.add(2, "");  // gone back: step 2 has its row
    log.add(3, "31");
    EXPECT_EQ(log.text(), "step,a\n1,10\n2,20\n3,31\n");
    log.add(0, "");
    log.add(1, "7");
    EXPECT_EQ(log.text(), "step,a\n1,7\n");
}

TEST(StepLog, GoesOnWithTheRowsOfItsFile) {
    const test::TempDir dir;
    const auto file = dir / "steps.csv";
    write_whole_file(file, log_of(file, 5).text());
    StepLog log(file, "step,a");
    log.resume(3);
    log.add(4, "40");
    EXPECT_EQ(log.text(), log_of(file, 4).text());
}

TEST(StepLog, BeginsAnewWithoutItsRows) {
    const test::TempDir dir;
    const auto file = dir / "steps.csv";
    for (const char* bytes : {"step,b\n1,2\n2,3\n", "step,a\n1,10\n", "step,a\n1,10\n3,10\n", ""}) {
        write_whole_file(file, std::string_view(bytes));
        StepLog log(file, "step,a");
        log.resume(2);
        log.add(3, "30");
        EXPECT_EQ(log.text(), "step,a\n3,30\n") << bytes;
        log.add(1, "");  // back to before it began
        log.add(2, "20");
        EXPECT_EQ(log.text(), "step,a\n2,20\n");
    }
    StepLog none(dir / "none.csv", "step,a");
    none.resume(7);
    EXPECT_EQ(none.text(), "step,a\n");
}

TEST(CsvRow, WritesNumbersThatReadBack) {
    CsvRow row;
    row.put(0.1).put(3).put(std::size_t{7}).put(1.5F).put(std::numeric_limits<double>::infinity());
    EXPECT_EQ(row.text(), "0.1,3,7,1.5,");
}

}  // namespace
}  // namespace scree
