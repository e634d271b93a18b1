#include "apps/commands.h"
#include "base/whole_file.h"
#include "tests/cli/scree.h"

#include <cstdlib>

#include <gmock/gmock.h>

namespace scree {
namespace {

// The box of a command in docs/commands.md begins with the line that asks for its help.
TEST(CommandsPage, ShowsWhatTheCommandsSay) {
    const std::filesystem::path path =
        std::filesystem::path(SCREE_SOURCE_DIR) / "docs" / "commands.md";
    std::string page = read_whole_file(path, 1 << 20);
    const bool update = std::getenv("SCREE_UPDATE_GOLDEN") != nullptr;
    for (const apps::Command& command : apps::commands()) {
        const std::string first = "```text\n$ scree " + command.words.name + " --help\n";
        const auto begin = page.find(first);
        ASSERT_NE(begin, std::string::npos) << "no box for " << command.words.name;
        const auto start = begin + first.size();
        const auto end = page.find("```", start);
        ASSERT_NE(end, std::string::npos);
        const std::string help = test::scree({command.words.name, "--help"}).output;
        if (update)
            page.replace(start, end - start, help);
        else
            EXPECT_EQ(page.substr(start, end - start), help)
                << "run this test with SCREE_UPDATE_GOLDEN=1";
    }
    if (update)
        write_whole_file(path, page);
}

}  // namespace
}  // namespace scree
