#pragma once

#include "vision/learned/protobuf_wire.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace scree::vision {

inline constexpr std::int64_t kOnnxFloat = 1, kOnnxInt64 = 7, kOnnxHalf = 10;  ///< Data types.

/// Numbers of an ONNX file: weights, or a constant.
struct OnnxTensor {
    std::string name;
    std::vector<std::int64_t> dims;  ///< At most four.
    std::int64_t type = 0;           ///< kOnnxFloat or kOnnxInt64.
    std::string raw;                 ///< The values, little-endian, 4 or 8 bytes each.

    std::size_t n_values() const { return raw.size() / (type == kOnnxInt64 ? 8 : 4); }
};

/// Read a TensorProto; half precision is widened to single.
/// @throw InvalidInput  it is cut off, of another type, too large, stored outside the file, has
///                      other dimensions than values, or a value that is not finite.
OnnxTensor read_tensor(std::string_view message);

/// The same as a message again.
std::string written(const OnnxTensor& tensor);

/// The bytes of a name, or of a nested message.
/// @throw InvalidInput  the field is stored as something else, or a name is beyond 4096 bytes.
std::string_view text_of(const WireField& field);
std::string_view message_of(const WireField& field);

}  // namespace scree::vision
