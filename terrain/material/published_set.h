#pragma once

#include "base/whole_file.h"
#include "terrain/material/description_map.h"
#include "terrain/material/map_rgba.h"
#include "terrain/material/shader_templates.h"

#include <filesystem>

namespace scree::terrain {

inline constexpr const char* kFragmentFile = "ground.frag.glsl";
inline constexpr const char* kEvaluationFile = "ground.tese.glsl";

/// Stage the two shaders of a map for `folder`.
void stage_shaders(const DescriptionMap& map, const std::filesystem::path& folder,
                   OutputBatch& batch, const ShaderOptions& options = {});

/// Stage the four files that the published editor saves (`rocks-and-deformer.md` D.3, D.5):
/// `map_rgba.png`, `map_ids.txt` and both shaders.
/// @return  What the picture could not keep.
/// @throw InvalidInput, InvalidOption, IoError
ConversionReport stage_published_set(const DescriptionMap& map, int bits,
                                     const std::filesystem::path& folder, OutputBatch& batch,
                                     const ShaderOptions& options = {});

}  // namespace scree::terrain
