#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace scree::vision {

/// How a field of a protobuf message is stored.
enum class Wire : unsigned { Varint = 0, Fixed64 = 1, Bytes = 2, Fixed32 = 5 };

/// One field of a message.
struct WireField {
    unsigned number = 0;
    Wire wire = Wire::Varint;
    std::uint64_t value = 0;  ///< Of a varint or a fixed number.
    std::string_view bytes;   ///< Of a string, a nested message or packed numbers.
};

/// The fields of a message in the order of the file; nested messages are not opened.
/// @throw InvalidInput  the bytes are no whole message, or hold more than a million fields.
std::vector<WireField> wire_fields(std::string_view message);

/// Varints of a repeated field, packed or single.
/// @throw InvalidInput  the bytes are cut off, or the field is no varint.
void append_varints(const WireField& field, std::vector<std::int64_t>& values);

/// Append one field to a message.
void put_varint(std::string& message, unsigned number, std::uint64_t value);
void put_bytes(std::string& message, unsigned number, std::string_view bytes);
void put_float(std::string& message, unsigned number, float value);

}  // namespace scree::vision
