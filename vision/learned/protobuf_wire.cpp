#include "vision/learned/protobuf_wire.h"

#include "base/error.h"

#include <bit>

namespace scree::vision {
namespace {

constexpr std::size_t kMostFields = 1'000'000;

std::uint64_t take_varint(std::string_view& rest) {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
        if (rest.empty())
            break;
        const auto byte = static_cast<unsigned char>(rest.front());
        rest.remove_prefix(1);
        value |= static_cast<std::uint64_t>(byte & 127U) << shift;
        if (byte < 128U)
            return value;
    }
    fail<InvalidInput>("a number in it is cut off");
}

std::string_view take_bytes(std::string_view& rest, std::uint64_t n) {
    if (n > rest.size())
        fail<InvalidInput>("a part of it is cut off");
    const std::string_view bytes = rest.substr(0, static_cast<std::size_t>(n));
    rest.remove_prefix(bytes.size());
    return bytes;
}

std::uint64_t little_endian(std::string_view bytes) {
    std::uint64_t value = 0;
    for (std::size_t i = bytes.size(); i-- > 0;)
        value = value << 8U | static_cast<unsigned char>(bytes[i]);
    return value;
}

WireField take_field(std::string_view& rest) {
    const std::uint64_t key = take_varint(rest);
    WireField field;
    field.number = static_cast<unsigned>(key >> 3U);
    field.wire = static_cast<Wire>(key & 7U);
    if (field.number == 0 || key >> 3U >= 1U << 29U)
        fail<InvalidInput>("it is no protobuf message");
    switch (field.wire) {
        case Wire::Varint:
            field.value = take_varint(rest);
            break;
        case Wire::Fixed64:
            field.value = little_endian(take_bytes(rest, 8));
            break;
        case Wire::Fixed32:
            field.value = little_endian(take_bytes(rest, 4));
            break;
        case Wire::Bytes:
            field.bytes = take_bytes(rest, take_varint(rest));
            break;
        default:
            fail<InvalidInput>("it is no protobuf message");
    }
    return field;
}

void append_varint(std::string& message, std::uint64_t value) {
    for (; value > 127; value >>= 7U)
        message += static_cast<char>((value & 127U) | 128U);
    message += static_cast<char>(value);
}

void append_key(std::string& message, unsigned number, Wire wire) {
    append_varint(message, std::uint64_t{number} << 3U | static_cast<unsigned>(wire));
}

}  // namespace

std::vector<WireField> wire_fields(std::string_view message) {
    std::vector<WireField> fields;
    while (!message.empty()) {
        if (fields.size() == kMostFields)
            fail<InvalidInput>("it holds more than ", kMostFields, " parts");
        fields.push_back(take_field(message));
    }
    return fields;
}

void append_varints(const WireField& field, std::vector<std::int64_t>& values) {
    if (field.wire == Wire::Varint) {
        values.push_back(static_cast<std::int64_t>(field.value));
        return;
    }
    if (field.wire != Wire::Bytes)
        fail<InvalidInput>("a whole number in it is stored as another kind");
    std::string_view rest = field.bytes;
    while (!rest.empty())
        values.push_back(static_cast<std::int64_t>(take_varint(rest)));
}

void put_varint(std::string& message, unsigned number, std::uint64_t value) {
    append_key(message, number, Wire::Varint);
    append_varint(message, value);
}

void put_bytes(std::string& message, unsigned number, std::string_view bytes) {
    append_key(message, number, Wire::Bytes);
    append_varint(message, bytes.size());
    message += bytes;
}

void put_float(std::string& message, unsigned number, float value) {
    append_key(message, number, Wire::Fixed32);
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (unsigned shift = 0; shift < 32; shift += 8)
        message += static_cast<char>(bits >> shift & 255U);
}

}  // namespace scree::vision
