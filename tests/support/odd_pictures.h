#pragma once

#include "base/raster.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace scree::test {

/// The bytes of a PNG file with one palette entry a value.
std::string palette_png(const Raster<std::uint8_t>& indices,
                        const std::vector<glm::u8vec3>& palette);

/// A PNG file of a few bytes that claims to be this large.
std::string huge_png(std::uint32_t width, std::uint32_t height);

/// Write the photograph in another form; the ending of the path chooses the format.
enum class Form { Grey, Sixteen, Alpha, Cmyk, Animated };
void write_in_form(const std::filesystem::path& path, const Photo& photo, Form form);

}  // namespace scree::test
