#include "terrain/material/map_files.h"

#include "base/error.h"
#include "terrain/material/map_check.h"
#include "terrain/material/materials_json.h"
#include "vision/image_io.h"

#include <string>
#include <vector>

namespace scree::terrain {
namespace {

namespace fs = std::filesystem;

void take_planes(DescriptionMap& map, const fs::path& path) {
    for (vision::NamedPlane& plane : vision::read_planes(path, {.max_pixels = 3 * kMaxMapCells})) {
        if (plane.name == "repose")
            map.repose = std::move(plane.values);
        else if (plane.name == "mobility")
            map.mobility = std::move(plane.values);
        else if (plane.name == "diffusion")
            map.diffusion = std::move(plane.values);
        else
            fail<InvalidInput>(path.string(), " has the channel ", plane.name.substr(0, 64),
                               "; known are repose, mobility and diffusion");
    }
}

std::vector<vision::NamedPlane> planes_of(const DescriptionMap& map) {
    std::vector<vision::NamedPlane> planes;
    if (!map.diffusion.empty())
        planes.push_back({"diffusion", map.diffusion});
    if (!map.mobility.empty())
        planes.push_back({"mobility", map.mobility});
    if (!map.repose.empty())
        planes.push_back({"repose", map.repose});
    return planes;
}

}  // namespace

Raster<std::uint8_t> read_ids(const fs::path& path) {
    const LabelMap values = vision::read_labels(path, {.max_pixels = kMaxMapCells});
    Raster<std::uint8_t> ids(values.width(), values.height());
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const int value = values.data()[i];
        if (value > 255)
            fail<InvalidInput>(path.string(), " holds the id ", value, ", ids are 0 to 255");
        ids.data()[i] = static_cast<std::uint8_t>(value);
    }
    return ids;
}

DescriptionMap read_description_map(const fs::path& path) {
    const fs::path file = fs::is_directory(path) ? path / "materials.json" : path;
    MaterialTable table = read_materials(file);
    if (table.ids.empty())
        fail<InvalidInput>(file.string(),
                           " is a table of materials alone; a map needs the member ids, a picture");
    DescriptionMap map;
    map.cell_size = table.cell_size;
    map.materials = std::move(table.materials);
    map.ids = read_ids(table.ids);
    if (!table.parameters.empty())
        take_planes(map, table.parameters);
    check_map(map, file.string());
    return map;
}

void stage_description_map(const DescriptionMap& map, const fs::path& folder, OutputBatch& batch) {
    check_map(map, "the map");
    MaterialTable table{map.cell_size, folder / "ids.png", {}, map.materials};
    const std::vector<vision::NamedPlane> planes = planes_of(map);
    if (!planes.empty()) {
        table.parameters = folder / "params.exr";
        vision::write_planes_exr(batch.stage(table.parameters), planes);
    }
    vision::write_png(batch.stage(table.ids), map.ids);
    write_staged_file(batch.stage(folder / "materials.json"), materials_to_json(table, folder));
}

void write_description_map(const DescriptionMap& map, const fs::path& folder) {
    OutputBatch batch;
    stage_description_map(map, folder, batch);
    batch.commit();
}

}  // namespace scree::terrain
