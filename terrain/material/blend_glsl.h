#pragma once

#include "terrain/material/description_map.h"

#include <string>
#include <string_view>
#include <vector>

namespace scree::terrain {

/// A GLSL literal: a float needs a point or an exponent.
std::string glsl_number(double value);

/// `const TYPE[N] NAME = TYPE[N](...);` with what `text_of` says of each value.
template <class Values, class Text>
std::string glsl_constant(std::string_view type, std::string_view name, const Values& values,
                          Text&& text_of) {
    std::string list;
    for (const auto& value : values) {
        if (!list.empty())
            list += ", ";
        list += text_of(value);
    }
    const std::string array = std::string(type) + "[" + std::to_string(values.size()) + "]";
    std::string text = "const ";
    text.append(array).append(" ").append(name).append(" = ").append(array);
    return text.append("(").append(list).append(");\n");
}

/// GLSL of `ScreeBlend scree_blend(vec2 ground)`, the shares of the materials at a place, and of
/// the tables that it and the texture look-ups read (`rocks-and-deformer.md` D.4).
/// @param materials  As check_materials() has them.
std::string blend_glsl(const std::vector<Material>& materials, double cell_size, bool literal_hat);

}  // namespace scree::terrain
