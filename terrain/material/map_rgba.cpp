#include "terrain/material/map_rgba.h"

#include "base/error.h"
#include "terrain/material/map_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/trigonometric.hpp>

namespace scree::terrain {
namespace {

namespace fs = std::filesystem;

constexpr double kSteepest = 89.0;  // degrees, as describe(Soil&) says
constexpr double kRightAngle = 0.5 * std::numbers::pi;

// One parameter of every cell: the plane where there is one, else the material's own.
class Channel {
public:
    Channel(const FloatRaster& plane, const std::array<double, 256>& of_id,
            const Raster<std::uint8_t>& ids)
        : plane_(plane), of_id_(of_id), ids_(ids) {}

    double at(std::size_t cell) const {
        return plane_.empty() ? of_id_[ids_.data()[cell]] : double{plane_.data()[cell]};
    }

    double greatest() const {
        double most = 0.0;
        for (std::size_t i = 0; i < ids_.size(); ++i)
            most = std::max(most, at(i));
        return most;
    }

private:
    const FloatRaster& plane_;
    const std::array<double, 256>& of_id_;
    const Raster<std::uint8_t>& ids_;
};

template <class Value>
std::array<double, 256> by_id(const std::vector<Material>& materials, Value&& value) {
    std::array<double, 256> result{};
    for (const Material& material : materials)
        result.at(static_cast<std::size_t>(material.id)) = value(material.soil);
    return result;
}

// Write one parameter into a component; the greatest error comes back.
double pack(const Channel& channel, double full, int component, int highest, int steps,
            Raster<glm::u16vec4>& picture) {
    double worst = 0.0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const double value = channel.at(i);
        const auto code = std::clamp(std::lround(value / full * steps), 0L, long{highest});
        picture.data()[i][component] = static_cast<std::uint16_t>(code);
        worst = std::max(worst, std::abs(value - static_cast<double>(code) / steps * full));
    }
    // The float storage of the planes is no loss of the packing.
    return worst <= 1e-7 * full ? 0.0 : worst;
}

std::vector<int> ids_without_cells(const DescriptionMap& map) {
    std::array<bool, 256> used{};
    for (const std::uint8_t id : map.ids)
        used[id] = true;
    std::vector<int> result;
    for (const Material& material : map.materials)
        if (!used[static_cast<std::size_t>(material.id)])
            result.push_back(material.id);
    return result;
}

bool has_textures(const MaterialTextures& textures) {
    return !textures.albedo.empty() || !textures.displacement.empty() || !textures.normal.empty();
}

void note_lost(const DescriptionMap& map, ConversionReport& report) {
    const MaterialTextures plain;
    for (const Material& material : map.materials) {
        const std::string who = "material " + std::to_string(material.id);
        if (material.soil.compaction != 0.0)
            report.lost.push_back(who + ": compaction");
        if (has_textures(material.textures) && material.textures.size_m != plain.size_m)
            report.lost.push_back(who + ": size of its textures in metres");
        if (!material.textures.displacement.empty() &&
            material.textures.displacement_m != plain.displacement_m)
            report.lost.push_back(who + ": height of its displacement in metres");
        if (material.colour)
            report.lost.push_back(who + ": colour");
    }
}

Material as_id_file_has_it(Material material) {
    const MaterialTextures plain;
    material.soil = {};
    material.textures.size_m = plain.size_m;
    material.textures.displacement_m = plain.displacement_m;
    material.colour.reset();
    return material;
}

// Soils from the cells: the value itself where all agree, else the mean.
struct Tally {
    double first = 0.0;
    double sum = 0.0;
    double count = 0.0;
    bool same = true;

    void add(double value) {
        if (count == 0.0)
            first = value;
        same = same && value == first;
        sum += value;
        count += 1.0;
    }
    double value(double otherwise) const {
        return count == 0.0 ? otherwise : same ? first : sum / count;
    }
};

double decoded(const glm::u16vec4& pixel, int component, int steps, double full) {
    return static_cast<double>(pixel[component]) / steps * full;
}

struct Decoding {
    int component;
    double full;
    int steps;
    double most = 1e9;  // a soil's own value ends there; beyond it only a plane can say it
};

// The value of every id, and a plane if some cell differs from its id's.
std::array<double, 256> unpack(const RgbaMap& rgba, const Raster<std::uint8_t>& ids,
                               const Decoding& how, double otherwise, FloatRaster& plane) {
    std::array<Tally, 256> tallies;
    const Raster<glm::u16vec4>& values = rgba.picture.values;
    for (std::size_t i = 0; i < ids.size(); ++i)
        tallies[ids.data()[i]].add(decoded(values.data()[i], how.component, how.steps, how.full));
    std::array<double, 256> result{};
    bool all_same = true;
    for (std::size_t id = 0; id < result.size(); ++id) {
        result[id] = tallies[id].value(otherwise);
        all_same = all_same && tallies[id].same && result[id] <= how.most;
    }
    if (all_same)
        return result;
    plane = FloatRaster(ids.width(), ids.height());
    for (std::size_t i = 0; i < ids.size(); ++i)
        plane.data()[i] =
            static_cast<float>(decoded(values.data()[i], how.component, how.steps, how.full));
    return result;
}

Raster<std::uint8_t> ids_of(const vision::RgbaImage& picture) {
    Raster<std::uint8_t> ids(picture.values.width(), picture.values.height());
    const int full = picture.bits == 16 ? 65535 : 255;
    for (int y = 0; y < ids.height(); ++y)
        for (int x = 0; x < ids.width(); ++x) {
            const glm::u16vec4& pixel = picture.values(x, y);
            const int unit = picture.bits == 16 ? 257 : 1;
            if (pixel.w % unit != 0)
                fail<InvalidInput>("the map's picture: cell (", x, ", ", y, ") has an alpha of ",
                                   pixel.w, ", which is no id; 16-bit ids are multiples of 257");
            if (pixel.x >= full)
                fail<InvalidInput>("the map's picture: cell (", x, ", ", y, ") of id ",
                                   pixel.w / unit, " has a repose of 90 deg, must be in [0, 90)");
            ids(x, y) = static_cast<std::uint8_t>(pixel.w / unit);
        }
    return ids;
}

}  // namespace

RgbaMap pack_map(const DescriptionMap& map, int bits, ConversionReport* report) {
    if (bits != 8 && bits != 16)
        fail<InvalidOption>("bits is ", bits, ", must be 8 or 16");
    check_map(map, "the map");
    const int steps = bits == 16 ? 65535 : 255;
    const auto repose_of =
        by_id(map.materials, [](const Soil& s) { return glm::radians(s.repose_deg); });
    const auto mobility_of = by_id(map.materials, [](const Soil& s) { return s.mobility; });
    const auto diffusion_of = by_id(map.materials, [](const Soil& s) { return s.diffusion; });
    const Channel repose(map.repose, repose_of, map.ids);
    const Channel mobility(map.mobility, mobility_of, map.ids);
    const Channel diffusion(map.diffusion, diffusion_of, map.ids);

    RgbaMap rgba;
    rgba.ids = {std::max(1.0, mobility.greatest()), std::max(1.0, diffusion.greatest()),
                map.cell_size, map.materials};
    for (Material& material : rgba.ids.materials)
        material = as_id_file_has_it(std::move(material));
    rgba.picture = {Raster<glm::u16vec4>(map.ids.width(), map.ids.height()), bits};
    Raster<glm::u16vec4>& out = rgba.picture.values;
    ConversionReport lost;
    lost.repose_deg = glm::degrees(pack(repose, kRightAngle, 0, steps - 1, steps, out));
    lost.mobility = pack(mobility, rgba.ids.mobility_max, 1, steps, steps, out);
    lost.diffusion = pack(diffusion, rgba.ids.diffusion_max, 2, steps, steps, out);
    for (std::size_t i = 0; i < out.size(); ++i)
        out.data()[i].w = static_cast<std::uint16_t>(map.ids.data()[i] * (bits == 16 ? 257 : 1));
    if (report != nullptr) {
        lost.without_cells = ids_without_cells(map);
        note_lost(map, lost);
        *report = std::move(lost);
    }
    return rgba;
}

DescriptionMap unpack_map(const RgbaMap& rgba, double cell_size, ConversionReport* report) {
    const vision::RgbaImage& picture = rgba.picture;
    check_map_size(picture.values.width(), picture.values.height(), "the map's picture");
    const int steps = picture.bits == 16 ? 65535 : 255;
    DescriptionMap map;
    map.ids = ids_of(picture);
    map.cell_size = rgba.ids.cell_size > 0.0 ? rgba.ids.cell_size : cell_size;
    map.materials = rgba.ids.materials;
    const Soil plain;
    const auto repose = unpack(rgba, map.ids, {0, kRightAngle, steps, glm::radians(kSteepest)},
                               glm::radians(plain.repose_deg), map.repose);
    const auto mobility =
        unpack(rgba, map.ids, {1, rgba.ids.mobility_max, steps}, plain.mobility, map.mobility);
    const auto diffusion =
        unpack(rgba, map.ids, {2, rgba.ids.diffusion_max, steps}, plain.diffusion, map.diffusion);
    for (Material& material : map.materials) {
        const auto id = static_cast<std::size_t>(material.id);
        material.soil = plain;
        material.soil.repose_deg = std::min(kSteepest, glm::degrees(repose[id]));
        material.soil.mobility = mobility[id];
        material.soil.diffusion = diffusion[id];
    }
    check_map(map, "the map's picture");
    if (report != nullptr) {
        *report = {};
        report->without_cells = ids_without_cells(map);
    }
    return map;
}

RgbaMap read_rgba_map(const fs::path& picture, const fs::path& id_file) {
    return {vision::read_rgba(picture, {.max_pixels = kMaxMapCells}), read_id_file(id_file)};
}

}  // namespace scree::terrain
