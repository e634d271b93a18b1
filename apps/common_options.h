#pragma once

#include "base/options.h"

namespace scree::apps {

/// Flags of every command that works for a while.
struct CommonOptions {
    int threads = 0;     ///< Most threads; 0 takes all. No result depends on it.
    bool quiet = false;  ///< Say nothing unless it fails.
    bool json = false;   ///< Print a report for machines instead of one for people.
};

template <class Visitor>
void describe(CommonOptions& o, Visitor&& field) {
    field("threads", o.threads, {.min = 0, .max = 1024, .help = "most threads; 0 takes all"});
    field("quiet", o.quiet, {.help = "say nothing unless it fails"});
    field("json", o.json, {.help = "print a report for machines"});
}

}  // namespace scree::apps
