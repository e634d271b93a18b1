#include "meshing/mesh/weld.h"

#include <array>
#include <bit>

namespace scree::meshing {
namespace {

using Place = std::array<std::uint32_t, 3>;

std::size_t hash_of(const Place& place) {
    std::uint64_t h = 0x9e3779b97f4a7c15ULL;
    for (const std::uint32_t bits : place)
        h = (h ^ bits ^ (h >> 29)) * 0xbf58476d1ce4e5b9ULL;
    return static_cast<std::size_t>(h ^ (h >> 32));
}

Place place_of(const glm::vec3& p) {
    const glm::vec3 positive_zero = p + 0.0F;  // -0 and 0 are one place
    return {std::bit_cast<std::uint32_t>(positive_zero.x),
            std::bit_cast<std::uint32_t>(positive_zero.y),
            std::bit_cast<std::uint32_t>(positive_zero.z)};
}

}  // namespace

std::vector<std::uint32_t> weld_map(const TriMesh& mesh) {
    constexpr std::uint32_t kFree = 0xffffffffU;
    const std::size_t n_slots = std::bit_ceil(2 * mesh.positions.size() + 1);
    std::vector<std::uint32_t> vertex_of_slot(n_slots, kFree);  // the first vertex at the place
    std::vector<std::uint32_t> map;
    map.reserve(mesh.positions.size());
    std::uint32_t n_places = 0;
    for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
        const Place place = place_of(mesh.positions[i]);
        std::size_t slot = hash_of(place) & (n_slots - 1);
        while (vertex_of_slot[slot] != kFree &&
               place_of(mesh.positions[vertex_of_slot[slot]]) != place)
            slot = (slot + 1) & (n_slots - 1);
        if (vertex_of_slot[slot] == kFree) {
            vertex_of_slot[slot] = i;
            map.push_back(n_places++);
        } else {
            map.push_back(map[vertex_of_slot[slot]]);
        }
    }
    return map;
}

TriMesh weld(const TriMesh& mesh) {
    const std::vector<std::uint32_t> map = weld_map(mesh);
    TriMesh welded;
    welded.positions.reserve(mesh.positions.size());
    welded.triangles.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < map.size(); ++i)
        if (map[i] == welded.positions.size())
            welded.positions.push_back(mesh.positions[i]);
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::uvec3 w(map[t.x], map[t.y], map[t.z]);
        if (w.x != w.y && w.y != w.z && w.z != w.x)
            welded.triangles.push_back(w);
    }
    return welded;
}

}  // namespace scree::meshing
