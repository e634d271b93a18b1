#include "terrain/scene/ground_mesh.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace scree::terrain {
namespace {

std::size_t look_of(const DescriptionMap& map, int id) {
    for (std::size_t i = 0; i < map.materials.size(); ++i)
        if (map.materials[i].id == id)
            return i;
    return 0;
}

glm::u8vec3 nearest_texel(const Photo& photo, double u, double v) {
    const auto at = [](double t, int n) {
        return std::clamp(static_cast<int>((t - std::floor(t)) * n), 0, n - 1);
    };
    return photo(at(u, photo.width()), at(v, photo.height()));
}

}  // namespace

meshing::TriMesh ground_mesh(const Heightfield& field, int most_side) {
    check_heightfield(field);
    if (most_side < 2)
        fail<InvalidInput>("a ground's mesh of ", most_side,
                           " vertices along a side is none, at least 2 are needed");
    const int columns = std::min(field.heights.width(), most_side);
    const int rows = std::min(field.heights.height(), most_side);
    const double size = field.cell_size;
    const double wide = size * field.heights.width();
    const double deep = size * field.heights.height();
    const double step_x = (wide - size) / (columns - 1);
    const double step_z = (deep - size) / (rows - 1);
    meshing::TriMesh mesh;
    mesh.positions.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    mesh.normals.resize(mesh.positions.size());
    mesh.texcoords.resize(mesh.positions.size());
    parallel_for_each_index(0, static_cast<std::size_t>(rows), 16, [&](std::size_t row) {
        for (int i = 0; i < columns; ++i) {
            const double x = 0.5 * size + i * step_x;
            const double z = 0.5 * size + static_cast<double>(row) * step_z;
            const double dx = height_at(field, x + size, z) - height_at(field, x - size, z);
            const double dz = height_at(field, x, z + size) - height_at(field, x, z - size);
            const std::size_t at =
                row * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i);
            mesh.positions[at] = glm::vec3(glm::dvec3(x, height_at(field, x, z), z));
            mesh.normals[at] = glm::vec3(glm::normalize(glm::dvec3(-dx, 2.0 * size, -dz)));
            mesh.texcoords[at] = glm::vec2(glm::dvec2(x / wide, z / deep));
        }
    });
    const auto index = [columns](int i, int j) {
        return static_cast<std::uint32_t>(j * columns + i);
    };
    for (int j = 0; j + 1 < rows; ++j)
        for (int i = 0; i + 1 < columns; ++i) {
            mesh.triangles.emplace_back(index(i, j), index(i, j + 1), index(i + 1, j + 1));
            mesh.triangles.emplace_back(index(i, j), index(i + 1, j + 1), index(i + 1, j));
        }
    return mesh;
}

Photo ground_picture(const Heightfield& field, const DescriptionMap& map,
                     const std::vector<MaterialLook>& looks, int side) {
    const double wide = field.cell_size * field.heights.width();
    const double deep = field.cell_size * field.heights.height();
    const double pixel = std::max(wide, deep) / std::max(side, 1);
    Photo out(std::max(1, static_cast<int>(std::lround(wide / pixel))),
              std::max(1, static_cast<int>(std::lround(deep / pixel))));
    parallel_for_each_index(0, static_cast<std::size_t>(out.height()), 16, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < out.width(); ++x) {
            const double px = (x + 0.5) * wide / out.width();
            const double pz = (y + 0.5) * deep / out.height();
            const int mx = std::clamp(static_cast<int>(px / map.cell_size), 0, map.ids.width() - 1);
            const int mz =
                std::clamp(static_cast<int>(pz / map.cell_size), 0, map.ids.height() - 1);
            const MaterialLook& look = looks[look_of(map, map.ids(mx, mz))];
            out(x, y) = look.albedo.empty()
                            ? glm::u8vec3(glm::round(255.0F * glm::clamp(look.colour, 0.0F, 1.0F)))
                            : nearest_texel(look.albedo, px / look.size_m, pz / look.size_m);
        }
    });
    return out;
}

}  // namespace scree::terrain
