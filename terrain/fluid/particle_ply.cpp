#include "terrain/fluid/particle_ply.h"

#include <bit>
#include <cstring>

namespace scree::terrain {
namespace {

template <class Value>
void append_little(std::string& bytes, Value value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
}

}  // namespace

std::string particles_as_ply(const FluidState& state) {
    static_assert(std::endian::native == std::endian::little);
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(state.size()) +
        "\nproperty float x\nproperty float y\nproperty float z\nproperty float vx\n"
        "property float vy\nproperty float vz\nproperty uint id\nproperty uchar touching\n"
        "end_header\n";
    bytes.reserve(bytes.size() + 29 * state.size());
    for (std::size_t i = 0; i < state.size(); ++i) {
        for (int c = 0; c < 3; ++c)
            append_little(bytes, state.positions[i][c]);
        for (int c = 0; c < 3; ++c)
            append_little(bytes, state.velocities[i][c]);
        append_little(bytes, static_cast<std::uint32_t>(state.ids[i]));
        append_little(bytes, static_cast<std::uint8_t>(state.contacts[i].touching() ? 1 : 0));
    }
    return bytes;
}

}  // namespace scree::terrain
