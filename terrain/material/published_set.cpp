#include "terrain/material/published_set.h"

#include <string_view>

namespace scree::terrain {

void stage_shaders(const DescriptionMap& map, const std::filesystem::path& folder,
                   OutputBatch& batch, const ShaderOptions& options) {
    const GroundShaders shaders = ground_shaders(map.materials, map.cell_size, options);
    write_staged_file(batch.stage(folder / kFragmentFile), std::string_view(shaders.fragment));
    write_staged_file(batch.stage(folder / kEvaluationFile), std::string_view(shaders.evaluation));
}

ConversionReport stage_published_set(const DescriptionMap& map, int bits,
                                     const std::filesystem::path& folder, OutputBatch& batch,
                                     const ShaderOptions& options) {
    ConversionReport report;
    const RgbaMap rgba = pack_map(map, bits, &report);
    vision::write_rgba_png(batch.stage(folder / "map_rgba.png"), rgba.picture);
    const std::string ids = ids_to_text(rgba.ids, folder);
    write_staged_file(batch.stage(folder / "map_ids.txt"), std::string_view(ids));
    stage_shaders(map, folder, batch, options);
    return report;
}

}  // namespace scree::terrain
