#include "terrain/material/material_reference.h"

#include "base/error.h"

namespace scree::terrain {

int material_id(const nlohmann::json& value, const JsonPlace& place,
                const std::vector<Material>& materials) {
    const bool by_name = value.is_string();
    if (!by_name && !value.is_number_integer())
        refuse_kind(place, value, "the name or the id of a material");
    const std::string name = by_name ? text_of(value, place) : std::string();
    const int id = by_name ? 0 : integer_of(value, place, 0, 255);
    for (const Material& material : materials)
        if (by_name ? material.name == name : material.id == id)
            return material.id;
    fail<InvalidInput>(place.text(), " is ",
                       by_name ? quoted(name.substr(0, 64)) : std::to_string(id),
                       ", which is no material of the table");
}

}  // namespace scree::terrain
