#include "terrain/view/material_look.h"

#include "base/error.h"
#include "terrain/material/material_pictures.h"

#include <array>

namespace scree::terrain {

std::vector<MaterialLook> plain_looks(const DescriptionMap& map) {
    // Sand, mud, grey gravel, turf, chalk, clay: then again.
    constexpr std::array<glm::vec3, 6> kColours{
        glm::vec3(0.78F, 0.68F, 0.52F), glm::vec3(0.36F, 0.28F, 0.22F),
        glm::vec3(0.55F, 0.55F, 0.56F), glm::vec3(0.40F, 0.46F, 0.28F),
        glm::vec3(0.82F, 0.81F, 0.77F), glm::vec3(0.62F, 0.40F, 0.30F)};
    constexpr double kWetRepose = 20.0;  // soil that holds less than this slope is wet, and shines
    std::vector<MaterialLook> looks(map.materials.size());
    for (std::size_t i = 0; i < looks.size(); ++i) {
        looks[i].colour = kColours[i % kColours.size()];
        looks[i].size_m = map.materials[i].textures.size_m;
        looks[i].roughness = map.materials[i].soil.repose_deg < kWetRepose ? 0.55F : 0.92F;
    }
    return looks;
}

std::vector<MaterialLook> load_looks(const DescriptionMap& map) {
    std::vector<MaterialLook> looks = plain_looks(map);
    for (std::size_t i = 0; i < looks.size(); ++i) {
        const Material& material = map.materials[i];
        MaterialPictures pictures;
        try {
            pictures = read_material_pictures(material.textures);
        } catch (const IoError& error) {
            fail<IoError>("material '", material.name, "': ", error.what());
        } catch (const InvalidInput& error) {
            fail<InvalidInput>("material '", material.name, "': ", error.what());
        }
        looks[i].albedo = std::move(pictures.albedo);
        looks[i].displacement = std::move(pictures.displacement);
        looks[i].normal = std::move(pictures.normal);
    }
    return looks;
}

}  // namespace scree::terrain
