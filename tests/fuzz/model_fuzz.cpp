#include "base/error.h"
#include "vision/learned/outline_network.h"

#include <cmath>
#include <cstdlib>
#include <vector>

// Any bytes are a network that gives finite logits for a small picture, or an error of ours.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scree::vision;
    constexpr int kSide = kNetworkStep;
    try {
        const OutlineNetwork network({reinterpret_cast<const char*>(data), size}, "input");
        NetworkRun run(network);
        const std::vector<float> picture(std::size_t{3} * kSide * kSide, 0.5F);
        std::vector<float> logits(std::size_t{kFieldChannels} * kSide * kSide);
        run.evaluate(picture, kSide, kSide, logits);
        for (const float value : logits)
            if (!std::isfinite(value))
                std::abort();
    } catch (const scree::Error&) {
    }
    return 0;
}
