#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace scree::test {

/// What a program said and how it ended.
struct ProgramRun {
    int status = -1;  ///< Exit status; 128 + N if signal N ended it.
    std::string output;
    std::string errors;
};

struct ProgramSetup {
    std::filesystem::path folder;  ///< To run in; empty for the present one.
    int interrupt_after_ms = -1;   ///< Send SIGINT after so long; -1 never.
    long largest_file = -1;        ///< Most bytes of a file it may write; -1 without limit.
    int timeout_ms = 120000;       ///< It is killed after so long.
};

/// Run a program and wait for its end. Standard input is empty.
/// @throw std::runtime_error  it cannot be started.
ProgramRun run_program(const std::filesystem::path& program, const std::vector<std::string>& words,
                       const ProgramSetup& setup = {});

}  // namespace scree::test
