#pragma once

#include <string>

namespace scree::terrain {

/// Which of the sound scheme's forms a shader is made for.
struct DeformerShaderForm {
    bool weighted = false;  ///< Slide by weighted angle instead of by excess.
    bool palette = true;    ///< Soils by an index into a table instead of cell by cell.
};

/// Up to four iterations without loads in tiles with a halo.
std::string sound_tiles_glsl(const DeformerShaderForm& form);
/// One iteration under loads.
std::string sound_loads_glsl(const DeformerShaderForm& form);
/// One iteration of the published scheme, loads or not; heights instead of displacements.
std::string literal_glsl(const DeformerShaderForm& form);

}  // namespace scree::terrain
