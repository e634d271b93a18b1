#include "meshing/gltf/texture_atlas.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/gltf/check_gltf.h"
#include "meshing/gltf/gltf_write.h"
#include "tests/support/sample_scenes.h"

#include <cmath>

#include <glm/common.hpp>
#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

std::vector<TextureBox> random_boxes(int n, std::uint64_t seed) {
    Rng rng({.seed = seed});
    std::vector<TextureBox> boxes;
    for (int i = 0; i < n; ++i) {
        const glm::vec2 low(rng.uniform(0.0, 0.9), rng.uniform(0.0, 0.9));
        const auto side = static_cast<float>(rng.uniform(0.01, 0.2));
        boxes.push_back({low, glm::min(low + side, glm::vec2(1.0F))});
    }
    return boxes;
}

glm::ivec3 looked_up(const Photo& photo, const glm::vec2& t) {
    const int x = static_cast<int>(t.x * static_cast<float>(photo.width()));
    const int y = static_cast<int>(t.y * static_cast<float>(photo.height()));
    return photo(std::clamp(x, 0, photo.width() - 1), std::clamp(y, 0, photo.height() - 1));
}

TEST(TextureAtlas, EveryBoxShowsTheColoursItHad) {
    const Photo photo = test::sample_photo();
    const auto boxes = random_boxes(15, 2);
    const TextureAtlas atlas = pack_textures(photo, boxes);
    EXPECT_EQ(atlas.reduction, 1);
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (int k = 0; k < 100; ++k) {
            // Centres of pixels, so that rounding cannot choose a neighbour.
            const glm::vec2 size(photo.width(), photo.height());
            const glm::vec2 share(0.1F * static_cast<float>(k % 10) + 0.05F,
                                  0.1F * static_cast<float>(k / 10) + 0.05F);
            const glm::vec2 t =
                (glm::floor(glm::mix(boxes[i].low, boxes[i].high, share) * size) + 0.5F) / size;
            const glm::vec2 moved = t * atlas.moves[i].scale + atlas.moves[i].offset;
            ASSERT_EQ(looked_up(atlas.picture, moved), looked_up(photo, t)) << i << " " << k;
        }
}

TEST(TextureAtlas, TilesDoNotOverlapAndStayInside) {
    const auto boxes = random_boxes(40, 3);
    const TextureAtlas atlas = pack_textures(test::sample_photo(), boxes);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const TextureBox& a = atlas.moves[i].tile;
        EXPECT_GE(a.low.x, 0.0F);
        EXPECT_LE(a.high.y, 1.0F + 1e-6F);
        for (std::size_t j = 0; j < i; ++j) {
            const TextureBox& b = atlas.moves[j].tile;
            const float slack = 1e-6F;
            EXPECT_TRUE(a.high.x <= b.low.x + slack || b.high.x <= a.low.x + slack ||
                        a.high.y <= b.low.y + slack || b.high.y <= a.low.y + slack);
        }
    }
}

TEST(TextureAtlas, IsReducedUntilItFits) {
    const auto boxes = random_boxes(40, 4);
    const TextureAtlas atlas =
        pack_textures(test::sample_photo(), boxes, {.max_side = 64, .margin = 1});
    EXPECT_GT(atlas.reduction, 1);
    EXPECT_LE(atlas.picture.width(), 64);
    EXPECT_LE(atlas.picture.height(), 64);
}

TEST(TextureAtlas, ReducedPhotosHoldMeans) {
    Photo photo(3, 2, glm::u8vec3(10));
    photo(0, 0) = glm::u8vec3(50);
    EXPECT_EQ(reduced_photo(photo, 1), photo);
    const Photo half = reduced_photo(photo, 2);
    EXPECT_EQ(half.width(), 2);
    EXPECT_EQ(half.height(), 1);
    EXPECT_EQ(half(0, 0), glm::u8vec3(20));
    EXPECT_EQ(half(1, 0), glm::u8vec3(10));
}

TEST(TextureAtlas, ScenesCarryOnlyWhatTheyShow) {
    GltfScene scene = test::rocks_scene(8, 16);
    scene.meshes.resize(3);
    scene.nodes.resize(3);
    const std::size_t whole = scene.texture.size();
    const ThreadLimit one(1);
    use_texture_atlas(scene, test::sample_photo());
    EXPECT_LT(scene.texture.size(), whole / 2);
    for (const GltfFinding& finding : check_glb(encode_glb(scene)))
        ADD_FAILURE() << finding.what;
    for (const GltfMesh& mesh : scene.meshes)
        for (const glm::vec2& t : mesh.geometry.texcoords)
            ASSERT_TRUE(t.x >= 0.0F && t.x <= 1.0F && t.y >= 0.0F && t.y <= 1.0F);
}

TEST(TextureAtlas, NoBoxesAndCoordinatesOutsideDoNoHarm) {
    EXPECT_EQ(pack_textures(test::sample_photo(), {}).picture.size(), 1U);
    const TextureBox far_off{{-3.0F, 2.0F}, {9.0F, 4.0F}};
    const TextureAtlas atlas = pack_textures(test::sample_photo(), {&far_off, 1});
    EXPECT_EQ(atlas.picture.width(), 480);
}

TEST(TextureAtlasErrors, NameTheBox) {
    const TextureBox bad{{0.5F, 0.5F}, {0.4F, 0.6F}};
    EXPECT_THROW(pack_textures(Photo(), {}), InvalidInput);
    EXPECT_THAT(
        [&] {
            pack_textures(test::sample_photo(), {&bad, 1});
        },
        testing::ThrowsMessage<InvalidInput>("box 0 of the texture atlas is no box"));
    EXPECT_THROW(reduced_photo(Photo(2, 2), 0), InvalidInput);
    const std::vector<TextureBox> many(10000);
    EXPECT_THROW(pack_textures(test::sample_photo(), many, {.max_side = 64}), InvalidInput);
}

}  // namespace
}  // namespace scree::meshing
