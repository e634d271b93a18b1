#pragma once

#include "vision/classical/classical_edge_detector.h"
#include "vision/training/tool_files.h"

#include <array>
#include <string>

namespace scree::training {

/// The edge field of a photograph as the scripts name it: a file ending in ".f32" holds float32
/// planes of boundary, inside and distance at the photograph's size, whoever made them; any other
/// holds the numbers of the classical networks, which then fill the field.
/// @throw IoError       the file cannot be read.
/// @throw InvalidInput  the planes are not of the photograph's size.
inline vision::EdgeField read_field(const Photo& photo, const std::string& path) {
    if (!path.ends_with(".f32")) {
        const auto numbers = read_numbers(path);
        const vision::FieldModel model = vision::read_field_model(numbers);
        return vision::ClassicalEdgeDetector(model).detect(photo);
    }
    const auto values = read_all<float>(path);
    if (values.size() != 3 * photo.size())
        fail<InvalidInput>(path, " holds ", values.size(), " values, expected three planes of ",
                           photo.width(), " x ", photo.height());
    vision::EdgeField field;
    auto from = values.begin();
    for (FloatRaster* plane : std::array{&field.boundary, &field.inside, &field.distance}) {
        *plane = FloatRaster(photo.width(), photo.height());
        const auto to = from + static_cast<std::ptrdiff_t>(photo.size());
        std::copy(from, to, plane->begin());
        from = to;
    }
    return field;
}

}  // namespace scree::training
