#include "vision/learned/outline_network.h"

// The bytes of outline_network.onnx, put between two marks by the assembler: a source with them as
// numbers would take minutes to compile.
__asm__(
    ".pushsection .rodata\n"
    ".balign 16\n"
    ".hidden scree_outline_network_begin\n"
    ".global scree_outline_network_begin\n"
    "scree_outline_network_begin:\n"
    ".incbin \"" SCREE_OUTLINE_NETWORK
    "\"\n"
    ".hidden scree_outline_network_end\n"
    ".global scree_outline_network_end\n"
    "scree_outline_network_end:\n"
    ".byte 0\n"
    ".popsection\n");

extern "C" {
extern const char scree_outline_network_begin[] __attribute__((visibility("hidden")));
extern const char scree_outline_network_end[] __attribute__((visibility("hidden")));
}

namespace scree::vision {

const OutlineNetwork& shipped_network() {
    static const OutlineNetwork network({scree_outline_network_begin, scree_outline_network_end},
                                        "the network that is built in");
    return network;
}

}  // namespace scree::vision
