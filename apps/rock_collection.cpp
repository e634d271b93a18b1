#include "apps/rock_collection.h"

#include "base/parallel.h"
#include "meshing/render/raster_view.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/ext/matrix_transform.hpp>

namespace scree::apps {

Collection make_collection(const meshing::ProceduralRockOptions& options, int count) {
    Collection all;
    all.rocks.resize(static_cast<std::size_t>(count));
    parallel_for_each_index(0, all.rocks.size(), 1, [&](std::size_t i) {
        auto one = options;
        one.seed += static_cast<std::int64_t>(i);
        all.rocks[i] = meshing::make_procedural_rock(one);
    });
    const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
    float radius = 0.0F;
    for (const auto& made : all.rocks)
        radius = std::max(radius, made.rock.bounding_radius);
    const float step = 2.1F * radius;
    all.side = step * static_cast<float>(columns);
    for (int i = 0; i < count; ++i) {
        const auto shift = [&](int n) {
            return (static_cast<float>(n) + 0.5F) * step - all.side / 2;
        };
        all.places.push_back(all.rocks[static_cast<std::size_t>(i)].rock.position +
                             glm::vec3(shift(i % columns), 0.0F, shift(i / columns)));
    }
    return all;
}

meshing::GltfScene scene_of(const Collection& all, std::int64_t first_seed) {
    meshing::GltfScene scene;
    scene.name = "procedural rocks";
    for (std::size_t i = 0; i < all.rocks.size(); ++i) {
        meshing::GltfNode node;
        node.name = "rock_seed_" + std::to_string(first_seed + static_cast<std::int64_t>(i));
        node.mesh = static_cast<int>(i);
        node.transform.translation = all.places[i];
        node.extras = {{"amplitude", all.rocks[i].amplitude}};
        scene.meshes.push_back({node.name, all.rocks[i].rock.mesh});
        scene.nodes.push_back(std::move(node));
    }
    return scene;
}

Photo picture_of(const Collection& all) {
    meshing::ViewScene scene;
    scene.ground_size = {all.side, all.side};
    for (std::size_t i = 0; i < all.rocks.size(); ++i)
        scene.objects.push_back(
            {&all.rocks[i].rock.mesh, glm::translate(glm::mat4(1.0F), all.places[i])});
    return meshing::draw_view(scene, {.width = 900}).clay;
}

}  // namespace scree::apps
