#pragma once

#include "base/error.h"
#include "base/raster.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace scree::training {

/// All values of a raw binary file.
/// @throw IoError  it cannot be read.
template <class T>
std::vector<T> read_all(const std::string& path) {
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    if (!in)
        fail<IoError>("cannot read ", path);
    std::vector<T> values(static_cast<std::size_t>(in.tellg()) / sizeof(T));
    in.seekg(0);
    in.read(reinterpret_cast<char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(T)));
    return values;
}

/// Write values as a raw binary file.
/// @throw IoError  it cannot be written.
template <class T>
void write_all(const std::string& path, const T* values, std::size_t n) {
    std::ofstream out(path, std::ios::binary);
    out.write(reinterpret_cast<const char*>(values), static_cast<std::streamsize>(n * sizeof(T)));
    if (!out)
        fail<IoError>("cannot write ", path);
}

/// A photograph from 8-bit RGB values, row by row.
inline Photo read_raw(const std::string& path, const std::string& width,
                      const std::string& height) {
    Photo photo(std::stoi(width), std::stoi(height));
    const auto values = read_all<glm::u8vec3>(path);
    if (values.size() != photo.size())
        fail<InvalidInput>(path, " holds ", values.size(), " pixels, expected ", photo.size());
    std::copy(values.begin(), values.end(), photo.begin());
    return photo;
}

/// The numbers of a trained model.
inline std::vector<double> read_numbers(const std::string& path) {
    const auto values = read_all<float>(path);
    return {values.begin(), values.end()};
}

}  // namespace scree::training
