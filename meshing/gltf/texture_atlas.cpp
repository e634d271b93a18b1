#include "meshing/gltf/texture_atlas.h"

#include "base/error.h"
#include "base/parallel.h"
#include "vision/image_io.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <glm/common.hpp>

namespace scree::meshing {
namespace {

// A part of the photograph, whole pixels, and where it lies in the atlas.
struct Part {
    int left = 0, top = 0, width = 0, height = 0;  // of the photograph
    int column = 0, row = 0;                       // of the atlas
};

Part part_of(const TextureBox& box, const Photo& photo, int margin) {
    const auto edge = [](float share, int size, int shift) {
        const double at = std::clamp(static_cast<double>(share), 0.0, 1.0) * size;
        return std::clamp(static_cast<int>(std::floor(at)) + shift, 0, size);
    };
    Part part;
    part.left = edge(box.low.x, photo.width(), -margin);
    part.top = edge(box.low.y, photo.height(), -margin);
    part.width = std::max(1, edge(box.high.x, photo.width(), margin + 1) - part.left);
    part.height = std::max(1, edge(box.high.y, photo.height(), margin + 1) - part.top);
    return part;
}

int reduced_size(int size, int factor) {
    return (size + factor - 1) / factor;
}

// Shelves of parts, the tallest first; the atlas's size, or nothing if it would be too large.
std::optional<glm::ivec2> place(std::vector<Part>& parts, const std::vector<std::size_t>& order,
                                int factor, int max_side) {
    double area = 0.0;
    int widest = 0;
    for (const Part& part : parts) {
        const int width = reduced_size(part.width, factor);
        area += double(width) * reduced_size(part.height, factor);
        widest = std::max(widest, width);
    }
    const int side = std::max(widest, static_cast<int>(std::ceil(1.05 * std::sqrt(area))));
    if (side > max_side)
        return std::nullopt;
    glm::ivec2 used(0);
    int column = 0;
    int row = 0;
    int next_row = 0;
    for (const std::size_t index : order) {
        Part& part = parts[index];
        const int width = reduced_size(part.width, factor);
        if (column + width > side) {
            column = 0;
            row = next_row;
        }
        part.column = column;
        part.row = row;
        column += width;
        next_row = std::max(next_row, row + reduced_size(part.height, factor));
        used = glm::max(used, glm::ivec2(column, next_row));
    }
    if (used.y > max_side)
        return std::nullopt;
    return used;
}

glm::u8vec3 mean_colour(const Photo& photo, int left, int top, int factor) {
    glm::ivec3 sum(0);
    for (int y = top; y < top + factor; ++y)
        for (int x = left; x < left + factor; ++x)
            sum +=
                glm::ivec3(photo(std::min(x, photo.width() - 1), std::min(y, photo.height() - 1)));
    const int n = factor * factor;
    return glm::u8vec3((sum + n / 2) / n);
}

void copy_part(const Photo& photo, const Part& part, int factor, Photo& atlas) {
    for (int y = 0; y < reduced_size(part.height, factor); ++y)
        for (int x = 0; x < reduced_size(part.width, factor); ++x)
            atlas(part.column + x, part.row + y) =
                mean_colour(photo, part.left + x * factor, part.top + y * factor, factor);
}

TextureMove move_of(const Part& part, int factor, const Photo& photo, const Photo& atlas) {
    const glm::vec2 source(photo.width(), photo.height());
    const glm::vec2 target(atlas.width(), atlas.height());
    const glm::vec2 place(part.column, part.row);
    const auto f = static_cast<float>(factor);
    TextureMove move;
    move.scale = source / (f * target);
    move.offset = (place - glm::vec2(part.left, part.top) / f) / target;
    move.tile.low = place / target;
    move.tile.high = (place + glm::vec2(part.width, part.height) / f) / target;
    return move;
}

TextureBox box_of(const TriMesh& mesh) {
    if (mesh.texcoords.empty())
        return {};
    TextureBox box{mesh.texcoords[0], mesh.texcoords[0]};
    for (const glm::vec2& t : mesh.texcoords) {
        box.low = glm::min(box.low, t);
        box.high = glm::max(box.high, t);
    }
    return box;
}

}  // namespace

TextureAtlas pack_textures(const Photo& photo, std::span<const TextureBox> boxes,
                           const AtlasOptions& options) {
    check(options);
    if (photo.empty())
        fail<InvalidInput>("a texture atlas needs a photograph, it has no pixels");
    std::vector<Part> parts;
    for (const TextureBox& box : boxes) {
        if (!(box.low.x <= box.high.x && box.low.y <= box.high.y))
            fail<InvalidInput>("box ", parts.size(), " of the texture atlas is no box");
        parts.push_back(part_of(box, photo, options.margin));
    }
    std::vector<std::size_t> order(parts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return parts[a].height > parts[b].height;
    });
    TextureAtlas atlas;
    const int most = std::max(photo.width(), photo.height());
    std::optional<glm::ivec2> size = place(parts, order, 1, options.max_side);
    while (!size && atlas.reduction <= most)
        size = place(parts, order, atlas.reduction += 1 + atlas.reduction / 8, options.max_side);
    if (!size)
        fail<InvalidInput>(parts.size(), " parts do not fit into a texture of ", options.max_side,
                           " x ", options.max_side, " pixels, raise max-side");
    atlas.picture = Photo(std::max(size->x, 1), std::max(size->y, 1));
    parallel_for_each_index(0, parts.size(), 1, [&](std::size_t i) {
        copy_part(photo, parts[i], atlas.reduction, atlas.picture);
    });
    for (const Part& part : parts)
        atlas.moves.push_back(move_of(part, atlas.reduction, photo, atlas.picture));
    return atlas;
}

Photo reduced_photo(const Photo& photo, int factor) {
    if (photo.empty() || factor < 1)
        fail<InvalidInput>("a photograph of ", photo.width(), " x ", photo.height(),
                           " pixels cannot be reduced ", factor, " times");
    Photo small(reduced_size(photo.width(), factor), reduced_size(photo.height(), factor));
    parallel_for_each_index(0, static_cast<std::size_t>(small.height()), 16, [&](std::size_t i) {
        const int y = static_cast<int>(i);
        for (int x = 0; x < small.width(); ++x)
            small(x, y) = mean_colour(photo, x * factor, y * factor, factor);
    });
    return small;
}

void use_texture_atlas(GltfScene& scene, const Photo& photo, const AtlasOptions& options) {
    std::vector<TextureBox> boxes;
    for (const GltfMesh& mesh : scene.meshes)
        boxes.push_back(box_of(mesh.geometry));
    const TextureAtlas atlas = pack_textures(photo, boxes, options);
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const TextureMove& move = atlas.moves[i];
        for (glm::vec2& t : scene.meshes[i].geometry.texcoords)
            t = glm::clamp(t * move.scale + move.offset, move.tile.low, move.tile.high);
    }
    scene.texture = vision::encode_jpeg(atlas.picture, options.quality);
}

}  // namespace scree::meshing
