#include "meshing/render/raster_view.h"

#include "base/error.h"
#include "base/options.h"
#include "base/parallel.h"
#include "meshing/render/rasteriser.h"
#include "meshing/render/view_camera.h"
#include "meshing/render/view_light.h"
#include "meshing/render/view_texture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace scree::meshing {
namespace {

constexpr std::size_t kPiece = 4096;
constexpr double kMostVertices = 1 << 30;
constexpr glm::vec3 kKeyColour{1.0F, 0.96F, 0.90F};
constexpr glm::vec3 kSkyColour{0.86F, 0.93F, 1.0F};
constexpr glm::vec3 kClay{0.56F, 0.54F, 0.51F};  // linear light, like all that follow
constexpr glm::vec3 kClayGround{0.42F, 0.42F, 0.43F};
constexpr glm::vec3 kBackdropTop{0.92F, 0.93F, 0.95F};
constexpr glm::vec3 kBackdropBottom{0.80F, 0.81F, 0.83F};

// Everything in world space in one list; the ground's two triangles come last.
struct World {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> texcoords;  // negative where the object has none
    std::vector<glm::uvec3> triangles;
    std::size_t ground_begin = 0;  // first triangle of the ground
    float object_radius = 0.0F;
};

std::vector<glm::vec3> vertex_normals(const TriMesh& mesh) {
    std::vector<glm::vec3> normals(mesh.positions.size(), glm::vec3(0.0F));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3& a = mesh.positions[t.x];
        const glm::vec3 area = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
        for (const std::uint32_t corner : {t.x, t.y, t.z})
            normals[corner] += area;
    }
    return normals;
}

struct Offset {
    std::size_t vertex = 0;
    std::size_t triangle = 0;
};

// Half the longest side of the object's box in the ground plane, metres.
float append(const ViewObject& object, const Offset& at, World& world) {
    const TriMesh& mesh = *object.mesh;
    const glm::mat3 turn(object.world_from_object);
    const auto normals = mesh.normals.empty() ? vertex_normals(mesh) : std::vector<glm::vec3>();
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(std::numeric_limits<float>::lowest());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 p(object.world_from_object * glm::vec4(mesh.positions[i], 1.0F));
        const glm::vec3 n = turn * (normals.empty() ? mesh.normals[i] : normals[i]);
        const float length = glm::length(n);
        world.positions[at.vertex + i] = p;
        world.normals[at.vertex + i] = length > 0.0F ? n / length : glm::vec3(0, 1, 0);
        world.texcoords[at.vertex + i] =
            mesh.texcoords.empty() ? glm::vec2(-1.0F) : mesh.texcoords[i];
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        world.triangles[at.triangle + i] =
            mesh.triangles[i] + static_cast<std::uint32_t>(at.vertex);
    return mesh.positions.empty() ? 0.0F : 0.5F * std::max(high.x - low.x, high.z - low.z);
}

void append_ground(const glm::vec2& size, World& world) {
    world.ground_begin = world.triangles.size();
    if (!(size.x > 0.0F && size.y > 0.0F))
        return;
    const auto first = static_cast<std::uint32_t>(world.positions.size());
    for (const glm::vec2& corner : {glm::vec2(0, 0), {0, 1}, {1, 1}, {1, 0}}) {
        const glm::vec2 place = (corner - 0.5F) * size;
        world.positions.emplace_back(place.x, 0.0F, place.y);
        world.normals.emplace_back(0.0F, 1.0F, 0.0F);
        world.texcoords.push_back(corner);
    }
    world.triangles.emplace_back(first, first + 1, first + 2);
    world.triangles.emplace_back(first, first + 2, first + 3);
}

World gather(const ViewScene& scene) {
    std::vector<Offset> offsets(scene.objects.size() + 1);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        if (scene.objects[i].mesh == nullptr)
            fail<InvalidInput>("object ", i, " of the view has no mesh");
        const TriMesh& mesh = *scene.objects[i].mesh;
        if (i == 0 || scene.objects[i - 1].mesh != &mesh)  // instances follow each other
            check_mesh(mesh);
        offsets[i + 1] = {offsets[i].vertex + mesh.positions.size(),
                          offsets[i].triangle + mesh.triangles.size()};
    }
    if (static_cast<double>(offsets.back().vertex) > kMostVertices ||
        static_cast<double>(offsets.back().triangle) > kMostVertices)
        fail<InvalidInput>("the view has ", offsets.back().vertex,
                           " vertices, at most 2^30 can be drawn");
    World world;
    world.positions.resize(offsets.back().vertex);
    world.normals.resize(offsets.back().vertex);
    world.texcoords.resize(offsets.back().vertex);
    world.triangles.resize(offsets.back().triangle);
    std::vector<float> radii(scene.objects.size());
    parallel_for_each_index(0, scene.objects.size(), 8, [&](std::size_t i) {
        radii[i] = append(scene.objects[i], offsets[i], world);
    });
    double squares = 0.0;
    double cubes = 0.0;
    for (const float r : radii) {  // weighted by area, so that dust does not count
        squares += static_cast<double>(r) * r;
        cubes += static_cast<double>(r) * r * r;
    }
    world.object_radius = squares > 0.0 ? static_cast<float>(cubes / squares) : 0.0F;
    append_ground(scene.ground_size, world);
    if (world.triangles.empty())
        fail<InvalidInput>("the view has nothing to draw: no triangle and no ground");
    return world;
}

struct Shades {
    glm::vec3 textured{0.0F};
    glm::vec3 clay{0.0F};
};

// What a sample needs to be shaded; built once, read by every thread.
struct Studio {
    World world;
    ViewCamera camera;  // in samples
    std::vector<glm::vec3> screen;
    Visibility seen;
    std::optional<ViewLight> light;
    glm::vec3 to_light{0.0F};
    Photo photo;  // empty: clay alone
    float photo_on_ground = 1.0F;
};

struct Surface {
    glm::vec3 point, normal;
    glm::vec2 texcoord;
};

// The seen point by barycentric weights at the sample, corrected for perspective.
Surface surface_at(const Studio& studio, std::uint32_t triangle, const glm::vec2& sample) {
    const glm::uvec3& t = studio.world.triangles[triangle];
    const glm::vec3& a = studio.screen[t.x];
    const glm::vec3& b = studio.screen[t.y];
    const glm::vec3& c = studio.screen[t.z];
    const glm::vec2 ab(b - a);
    const glm::vec2 ac(c - a);
    const glm::vec2 ap = sample - glm::vec2(a);
    const float area = ab.x * ac.y - ab.y * ac.x;
    const float part = std::abs(area) > 1e-12F ? 1.0F / area : 0.0F;  // 0: a sliver's first corner
    const float v = std::clamp((ap.x * ac.y - ap.y * ac.x) * part, 0.0F, 1.0F);
    const float w = std::clamp((ab.x * ap.y - ab.y * ap.x) * part, 0.0F, 1.0F - v);
    glm::vec3 share((1.0F - v - w) * a.z, v * b.z, w * c.z);
    share /= share.x + share.y + share.z;
    const World& world = studio.world;
    const auto mixed = [&](const auto& values) {
        return values[t.x] * share.x + values[t.y] * share.y + values[t.z] * share.z;
    };
    const glm::vec3 normal = mixed(world.normals);
    const float length = glm::length(normal);  // 0 where opposite normals meet
    return {mixed(world.positions), length > 0.0F ? normal / length : glm::vec3(0, 1, 0),
            mixed(world.texcoords)};
}

Shades shade(const Studio& studio, std::uint32_t triangle, const glm::vec2& sample) {
    const Surface surface = surface_at(studio, triangle, sample);
    const bool ground = triangle >= studio.world.ground_begin;
    const float facing = std::max(0.0F, glm::dot(surface.normal, studio.to_light));
    const float key = facing > 0.0F ? facing * studio.light->lit(surface.point, surface.normal) : 0;
    const float sky = studio.light->open_sky(surface.point) * (0.6F + 0.4F * surface.normal.y);
    Shades out;
    const glm::vec3 clay = ground ? kClayGround : kClay;
    out.clay = clay * (kKeyColour * (1.02F * key) + kSkyColour * (0.42F * sky));
    if (studio.photo.empty())
        return out;
    // A photograph carries its own light and shade: less key light, more sky than on clay.
    const bool covered = surface.texcoord.x >= 0.0F;
    const glm::vec3 colour = covered ? light_at(studio.photo, surface.texcoord) : clay;
    const float gain = ground ? studio.photo_on_ground : 1.0F;
    out.textured = colour * gain * (kKeyColour * (0.85F * key) + kSkyColour * (0.70F * sky));
    return out;
}

void draw_rows(const Studio& studio, int supersampling, std::size_t row, ViewPictures& out) {
    const int y = static_cast<int>(row);
    const float part = 1.0F / static_cast<float>(supersampling * supersampling);
    const float depth = static_cast<float>(y) / static_cast<float>(out.clay.height());
    const glm::vec3 backdrop = glm::mix(kBackdropTop, kBackdropBottom, depth);
    for (int x = 0; x < out.clay.width(); ++x) {
        Shades sum;
        for (int k = 0; k < supersampling * supersampling; ++k) {
            const int u = x * supersampling + k % supersampling;
            const int v = y * supersampling + k / supersampling;
            const std::uint32_t triangle = studio.seen.triangle(u, v);
            const glm::vec2 centre(static_cast<float>(u) + 0.5F, static_cast<float>(v) + 0.5F);
            const Shades one = triangle == kNoTriangle ? Shades{backdrop, backdrop}
                                                       : shade(studio, triangle, centre);
            sum.textured += one.textured;
            sum.clay += one.clay;
        }
        const auto byte = [&](const glm::vec3& c) {
            return glm::u8vec3(coded_byte(c.x * part), coded_byte(c.y * part),
                               coded_byte(c.z * part));
        };
        out.clay(x, y) = byte(sum.clay);
        if (!out.textured.empty())
            out.textured(x, y) = byte(sum.textured);
    }
}

}  // namespace

ViewPictures draw_view(const ViewScene& scene, const ViewOptions& options) {
    check(options);
    Studio studio;
    studio.world = gather(scene);
    const ViewCamera camera =
        fit_camera(studio.world.positions,
                   {options.width, options.azimuth, options.elevation, options.field_of_view});
    studio.camera = camera;
    const auto samples = static_cast<float>(options.supersampling);
    studio.camera.scale *= samples;
    studio.screen.resize(studio.world.positions.size());
    parallel_for_each_index(0, studio.screen.size(), kPiece, [&](std::size_t i) {
        studio.screen[i] = studio.camera.project(studio.world.positions[i]);
    });
    studio.seen =
        rasterise(studio.screen, studio.world.triangles, camera.width * options.supersampling,
                  camera.height * options.supersampling);
    studio.to_light = sky_direction(options.light_azimuth, options.light_elevation);
    studio.light.emplace(
        ViewGeometry{studio.world.positions, studio.world.triangles, studio.world.object_radius},
        studio.to_light);
    studio.photo_on_ground = static_cast<float>(options.photo_on_ground);
    ViewPictures out;
    out.clay = Photo(camera.width, camera.height);
    if (scene.photo != nullptr && !scene.photo->empty()) {
        const int fine = camera.width * options.supersampling;
        studio.photo = shrunk_photo(*scene.photo, std::max(1, scene.photo->width() / fine));
        out.textured = out.clay;
    }
    parallel_for_each_index(0, static_cast<std::size_t>(camera.height), 8, [&](std::size_t row) {
        draw_rows(studio, options.supersampling, row, out);
    });
    return out;
}

Photo side_by_side(const Photo& left, const Photo& right, int gap) {
    if (left.empty() || right.empty() || left.height() != right.height() || gap < 0)
        fail<InvalidInput>("pictures ", left.height(), " and ", right.height(),
                           " pixels high do not fit beside each other");
    Photo out(left.width() + gap + right.width(), left.height(), glm::u8vec3(255));
    for (int y = 0; y < out.height(); ++y) {
        std::copy_n(left.row(y), left.width(), out.row(y));
        std::copy_n(right.row(y), right.width(), out.row(y) + left.width() + gap);
    }
    return out;
}

}  // namespace scree::meshing
