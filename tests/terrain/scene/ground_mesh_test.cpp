#include "terrain/scene/ground_mesh.h"

#include "base/error.h"
#include "meshing/mesh/topology.h"

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

Heightfield tilted(int width, int height) {
    Heightfield field{FloatRaster(width, height), 0.5};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            field.heights(x, y) = static_cast<float>(0.25 * x - 0.125 * y);
    return field;
}

TEST(GroundMesh, IsTheSurfaceThroughTheCentres) {
    for (const int side : {3, 7, 100}) {
        const meshing::TriMesh mesh = ground_mesh(tilted(9, 6), side);
        const auto report = meshing::analyse_topology(mesh);
        EXPECT_TRUE(report.manifold);
        EXPECT_EQ(report.n_boundaries, 1U);
        EXPECT_EQ(mesh.positions.size(),
                  static_cast<std::size_t>(std::min(side, 9) * std::min(side, 6)));
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::vec3& p = mesh.positions[i];
            EXPECT_NEAR(p.y, 0.5 * (p.x - 0.25) - 0.25 * (p.z - 0.25), 1e-5);
            EXPECT_GT(mesh.normals[i].y, 0.8F);
            EXPECT_NEAR(mesh.texcoords[i].x, p.x / 4.5, 1e-6);
        }
        EXPECT_NEAR(mesh.positions.back().x, 4.25, 1e-6);
    }
    EXPECT_THROW(ground_mesh(tilted(4, 4), 1), InvalidInput);
}

TEST(GroundMesh, ThePictureShowsEveryMaterial) {
    DescriptionMap map;
    map.cell_size = 0.5;
    map.ids = Raster<std::uint8_t>(9, 6, std::uint8_t{3});
    map.ids(8, 5) = 1;
    map.materials.resize(2);
    map.materials[0].id = 1;
    map.materials[1].id = 3;
    MaterialLook red;
    red.colour = {1, 0, 0};
    MaterialLook checked;
    checked.albedo = Photo(2, 1, glm::u8vec3(10));
    checked.albedo(1, 0) = glm::u8vec3(200);
    checked.size_m = 1.0;
    const Photo picture = ground_picture(tilted(9, 6), map, {red, checked}, 18);
    EXPECT_EQ(picture.width(), 18);
    EXPECT_EQ(picture.height(), 12);
    EXPECT_EQ(picture(17, 11), glm::u8vec3(255, 0, 0));
    EXPECT_EQ(picture(0, 0), glm::u8vec3(10));
    EXPECT_EQ(picture(3, 0), glm::u8vec3(200));
    EXPECT_EQ(picture(4, 0), glm::u8vec3(10));
}

}  // namespace
}  // namespace scree::terrain
