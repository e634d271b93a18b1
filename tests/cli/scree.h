#pragma once

#include "tests/support/run_program.h"

#include <string>
#include <vector>

namespace scree::test {

/// Run the program that was built with the tests.
inline ProgramRun scree(const std::vector<std::string>& words, const ProgramSetup& setup = {}) {
    return run_program(SCREE_PROGRAM, words, setup);
}

}  // namespace scree::test
