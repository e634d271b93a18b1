#include "meshing/mesh/weld.h"

#include <array>
#include <bit>
#include <unordered_map>

namespace scree::meshing {
namespace {

using Place = std::array<std::uint32_t, 3>;

struct PlaceHash {
    std::size_t operator()(const Place& place) const {
        std::uint64_t h = 0x9e3779b97f4a7c15ULL;
        for (const std::uint32_t bits : place)
            h = (h ^ bits ^ (h >> 29)) * 0xbf58476d1ce4e5b9ULL;
        return static_cast<std::size_t>(h ^ (h >> 32));
    }
};

Place place_of(const glm::vec3& p) {
    const glm::vec3 positive_zero = p + 0.0F;  // -0 and 0 are one place
    return {std::bit_cast<std::uint32_t>(positive_zero.x),
            std::bit_cast<std::uint32_t>(positive_zero.y),
            std::bit_cast<std::uint32_t>(positive_zero.z)};
}

}  // namespace

std::vector<std::uint32_t> weld_map(const TriMesh& mesh) {
    std::unordered_map<Place, std::uint32_t, PlaceHash> places;
    places.reserve(mesh.positions.size());
    std::vector<std::uint32_t> map;
    map.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions)
        map.push_back(places.try_emplace(place_of(p), static_cast<std::uint32_t>(places.size()))
                          .first->second);
    return map;
}

TriMesh weld(const TriMesh& mesh) {
    const std::vector<std::uint32_t> map = weld_map(mesh);
    TriMesh welded;
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
