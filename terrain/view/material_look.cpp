#include "terrain/view/material_look.h"

#include <array>

namespace scree::terrain {

std::vector<MaterialLook> plain_looks(const DescriptionMap& map) {
    // Sand, mud, grey gravel, turf, chalk, clay: then again.
    constexpr std::array<glm::vec3, 6> kColours{
        glm::vec3(0.78F, 0.68F, 0.52F), glm::vec3(0.36F, 0.28F, 0.22F),
        glm::vec3(0.55F, 0.55F, 0.56F), glm::vec3(0.40F, 0.46F, 0.28F),
        glm::vec3(0.82F, 0.81F, 0.77F), glm::vec3(0.62F, 0.40F, 0.30F)};
    std::vector<MaterialLook> looks(map.materials.size());
    for (std::size_t i = 0; i < looks.size(); ++i)
        looks[i].colour = kColours[i % kColours.size()];
    return looks;
}

}  // namespace scree::terrain
