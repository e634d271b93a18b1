#include "base/whole_file.h"

#include "base/error.h"
#include "tests/support/temp_dir.h"

#include <gmock/gmock.h>

namespace scree {
namespace {

namespace fs = std::filesystem;

int entries_in(const fs::path& folder) {
    return static_cast<int>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator{}));
}

TEST(WholeFile, WritesAndReadsBack) {
    const test::TempDir dir;
    write_whole_file(dir / "a.txt", std::string_view("one\0two", 7));
    EXPECT_EQ(read_whole_file(dir / "a.txt", 100), std::string("one\0two", 7));
    EXPECT_EQ(entries_in(dir.path()), 1);
}

TEST(WholeFile, RefusesWhatIsLargerThanTheLimit) {
    const test::TempDir dir;
    write_whole_file(dir / "a.txt", std::string_view("12345"));
    EXPECT_NO_THROW(read_whole_file(dir / "a.txt", 5));
    EXPECT_THROW(read_whole_file(dir / "a.txt", 4), IoError);
}

TEST(WholeFile, NamesTheFileInEveryError) {
    const test::TempDir dir;
    EXPECT_THAT([&] { read_whole_file(dir / "none", 9); },
                testing::ThrowsMessage<IoError>(testing::HasSubstr("none")));
    EXPECT_THAT([&] { read_whole_file(dir.path(), 9); },
                testing::ThrowsMessage<IoError>(testing::HasSubstr("it is a folder")));
    EXPECT_THAT([&] { write_whole_file(dir.path(), std::string_view("x")); },
                testing::ThrowsMessage<IoError>(testing::HasSubstr("a folder of that name")));
}

TEST(OutputBatch, LeavesNothingWithoutCommit) {
    const test::TempDir dir;
    {
        OutputBatch batch;
        write_staged_file(batch.stage(dir / "deep/er/a.txt"), std::string_view("x"));
    }
    EXPECT_EQ(entries_in(dir.path()), 0);
}

TEST(OutputBatch, CommitsAllOrFailsBeforeTheFirst) {
    const test::TempDir dir;
    {
        OutputBatch batch;
        write_staged_file(batch.stage(dir / "a.txt"), std::string_view("x"));
        batch.stage(dir / "b.txt");  // never written
        EXPECT_THROW(batch.commit(), IoError);
    }
    EXPECT_EQ(entries_in(dir.path()), 0);
    OutputBatch batch;
    write_staged_file(batch.stage(dir / "a.txt"), std::string_view("x"));
    write_staged_file(batch.stage(dir / "b.txt"), std::string_view("y"));
    batch.commit();
    EXPECT_EQ(entries_in(dir.path()), 2);
}

TEST(WholeFile, SaysWhenTheDiskIsFull) {
    if (!fs::exists("/dev/full"))
        GTEST_SKIP() << "no /dev/full here";
    EXPECT_THAT([] { write_staged_file("/dev/full", std::string_view("x")); },
                testing::ThrowsMessage<IoError>(testing::HasSubstr("/dev/full")));
}

}  // namespace
}  // namespace scree
