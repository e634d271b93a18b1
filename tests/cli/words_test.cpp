#include "apps/commands.h"
#include "tests/cli/scree.h"

#include <gmock/gmock.h>

namespace scree {
namespace {

using test::ProgramRun;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Words, VersionAndOverview) {
    EXPECT_EQ(test::scree({"--version"}).output, "scree 0.1.0\n");
    const ProgramRun help = test::scree({"--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_THAT(help.errors, IsEmpty());
    for (const apps::Command& command : apps::commands())
        EXPECT_THAT(help.output, HasSubstr("  " + command.words.name + " "));
    const ProgramRun nothing = test::scree({});
    EXPECT_EQ(nothing.status, 2);
    EXPECT_EQ(nothing.errors, help.output);
}

TEST(Words, EveryCommandHasHelpWithAnExample) {
    for (const apps::Command& command : apps::commands()) {
        for (const char* word : {"--help", "-h"}) {
            const ProgramRun help = test::scree({command.words.name, word});
            EXPECT_EQ(help.status, 0) << command.words.name;
            EXPECT_THAT(help.output, HasSubstr("usage: scree " + command.words.name));
            EXPECT_THAT(help.output, HasSubstr("example:\n  scree " + command.words.name + " "));
            EXPECT_THAT(help.errors, IsEmpty());
        }
        const ProgramRun late = test::scree({command.words.name, "--no-such-flag", "--help"});
        EXPECT_EQ(late.status, 0) << command.words.name;
    }
}

TEST(Words, WrongOnesGetStatusTwoAndAHint) {
    const ProgramRun unknown = test::scree({"no-such-command"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_THAT(unknown.errors, HasSubstr("there is no command 'no-such-command'"));
    for (const apps::Command& command : apps::commands()) {
        const ProgramRun run = test::scree({command.words.name, "--no-such-flag"});
        EXPECT_EQ(run.status, 2) << command.words.name;
        EXPECT_THAT(run.output, IsEmpty());
        EXPECT_THAT(run.errors, HasSubstr("scree " + command.words.name + ": '--no-such-flag'"));
        EXPECT_THAT(run.errors, HasSubstr(command.words.example));
    }
}

}  // namespace
}  // namespace scree
