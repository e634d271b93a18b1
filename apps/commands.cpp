#include "apps/commands.h"

#include <vector>

namespace scree::apps {

std::span<const Command> commands() {
    static const std::vector<Command> table = {
        {{"score", "compare label maps with hand-made ones", "scree score out/labels.png truth.png",
          "Several pairs give a line each and their mean. Label maps have one channel of 8 or 16 "
          "bits; 0 is background and every other value one rock."},
         run_score},
    };
    return table;
}

}  // namespace scree::apps
