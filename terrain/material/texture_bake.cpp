#include "terrain/material/texture_bake.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/bake/normal_map.h"
#include "terrain/material/corner_blend.h"
#include "terrain/material/hat_blend.h"
#include "terrain/material/map_check.h"
#include "terrain/material/repeating_texture.h"

#include <algorithm>
#include <cmath>

namespace scree::terrain {
namespace {

/// One material, ready to be read.
struct Look {
    RepeatingTexture<glm::vec3> albedo;
    RepeatingTexture<glm::vec3> normal;
    RepeatingTexture<float> displacement;
    glm::vec3 plain{};  // linear light
};

Photo normals_of(const Material& material, const MaterialPictures& pictures, bool derive) {
    if (!pictures.normal.empty() || !derive || pictures.displacement.empty())
        return pictures.normal;
    const double texel = material.textures.size_m / pictures.displacement.width();
    return meshing::normal_map({pictures.displacement, texel}, {.wraps = true});
}

Look look_of(const Material& material, const MaterialPictures& pictures, double pixel_m,
             bool derive) {
    const double size = material.textures.size_m;
    Look look;
    if (!pictures.albedo.empty())
        look.albedo = {linear_light(pictures.albedo), size, pixel_m};
    const Photo normals = normals_of(material, pictures, derive);
    if (!normals.empty())
        look.normal = {unit_normals(normals), size, pixel_m};
    if (!pictures.displacement.empty())
        look.displacement = {pictures.displacement, size, pixel_m};
    look.plain = linear_light(Photo(1, 1, material_colour(material)))(0, 0);
    return look;
}

/// Shares of materials at a place, by either blend.
class Blender {
public:
    Blender(const DescriptionMap& map, bool literal)
        : map_(map), fades_(fade_table(map.materials)) {
        if (literal)
            hats_ = hat_breaks(map.materials);
    }

    /// Call use(slot, share) for every material at a place in cells.
    template <class Use>
    void at(double x, double y, std::vector<double>& scratch, Use&& use) const {
        if (hats_.empty()) {
            const CornerWeights corners =
                corner_weights(map_.ids, fades_, static_cast<float>(x), static_cast<float>(y));
            for (std::size_t k = 0; k < static_cast<std::size_t>(corners.count); ++k)
                if (corners.weights[k] > 0.0F)
                    use(static_cast<std::size_t>(corners.slots[k]), corners.weights[k]);
            return;
        }
        scratch.resize(hats_.size());
        hat_weights(hats_, filtered_id(map_.ids, x, y), scratch);
        for (std::size_t slot = 0; slot < scratch.size(); ++slot)
            if (scratch[slot] > 0.0)
                use(slot, static_cast<float>(scratch[slot]));
    }

private:
    const DescriptionMap& map_;
    FadeTable fades_;
    std::vector<HatBreaks> hats_;
};

struct PixelGrid {
    int width;
    int height;
    double pixel_m;
};

// Square pixels: the shorter side may reach up to half a pixel beyond the map or end before it.
PixelGrid pixel_grid(const DescriptionMap& map, int size) {
    const int longer = std::max(map.ids.width(), map.ids.height());
    const double pixels_per_cell = static_cast<double>(size) / longer;
    const auto side = [&](int cells) {
        return std::max(1, static_cast<int>(std::lround(cells * pixels_per_cell)));
    };
    return {side(map.ids.width()), side(map.ids.height()), map.cell_size / pixels_per_cell};
}

void bake_row(const DescriptionMap& map, const Blender& blender, const std::vector<Look>& looks,
              const PixelGrid& grid, int y, BakedGround& baked) {
    std::vector<double> scratch;
    for (int x = 0; x < grid.width; ++x) {
        const glm::dvec2 ground = glm::dvec2(x + 0.5, y + 0.5) * grid.pixel_m;
        glm::vec3 light(0.0F);
        glm::vec3 normal(0.0F);
        float height = 0.0F;
        blender.at(ground.x / map.cell_size, ground.y / map.cell_size, scratch,
                   [&](std::size_t slot, float share) {
                       const Look& look = looks[slot];
                       light += share * (look.albedo.empty() ? look.plain
                                                             : look.albedo.at(ground.x, ground.y));
                       normal += share * (look.normal.empty() ? glm::vec3(0.0F, 0.0F, 1.0F)
                                                              : look.normal.at(ground.x, ground.y));
                       if (!look.displacement.empty())
                           height += share * look.displacement.at(ground.x, ground.y);
                   });
        baked.albedo(x, y) = srgb_colour(light);
        baked.normal(x, y) = normal_colour(normal);
        baked.displacement.metres(x, y) = height;
    }
}

}  // namespace

BakedGround bake_textures(const DescriptionMap& map, const std::vector<MaterialPictures>& pictures,
                          const BakeOptions& options, Progress* progress) {
    check(options);
    report_progress(progress, "baking textures", 0.0);
    check_map(map, "the map to bake");
    if (pictures.size() != map.materials.size())
        fail<InvalidInput>("there are pictures of ", pictures.size(), " materials, the map has ",
                           map.materials.size());
    const PixelGrid grid = pixel_grid(map, options.size);
    std::vector<Look> looks;
    for (std::size_t i = 0; i < pictures.size(); ++i)
        looks.push_back(
            look_of(map.materials[i], pictures[i], grid.pixel_m, options.derive_normals));
    const Blender blender(map, options.literal_hat);
    BakedGround baked;
    baked.albedo = Photo(grid.width, grid.height);
    baked.normal = Photo(grid.width, grid.height);
    baked.displacement = {FloatRaster(grid.width, grid.height), grid.pixel_m};
    parallel_for_each_index(0, static_cast<std::size_t>(grid.height), 8, [&](std::size_t y) {
        stop_if_cancelled(progress, "baking textures");
        bake_row(map, blender, looks, grid, static_cast<int>(y), baked);
    });
    return baked;
}

BakedGround bake_texture_files(const DescriptionMap& map, const BakeOptions& options) {
    check(options);
    check_map(map, "the map to bake");
    std::vector<MaterialPictures> pictures;
    for (const Material& material : map.materials)
        pictures.push_back(read_material_pictures(material.textures));
    return bake_textures(map, pictures, options);
}

}  // namespace scree::terrain
