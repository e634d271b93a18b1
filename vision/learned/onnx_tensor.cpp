#include "vision/learned/onnx_tensor.h"

#include "base/error.h"

#include <cmath>
#include <cstring>

#include <opencv2/core.hpp>

// Field numbers are those of TensorProto in onnx.proto.
namespace scree::vision {
namespace {

// Number of values that the dimensions claim.
std::size_t claimed_values(const OnnxTensor& tensor) {
    std::size_t n = 1;
    for (const std::int64_t dim : tensor.dims) {
        const bool empty_list = dim == 0 && tensor.dims.size() == 1;
        if ((dim < 1 && !empty_list) || dim > 1 << 24)
            fail<InvalidInput>("its tensor '", tensor.name, "' has a dimension of ", dim);
        n *= static_cast<std::size_t>(dim);
        if (n > std::size_t{1} << 28U)
            fail<InvalidInput>("its tensor '", tensor.name, "' is too large");
    }
    return n;
}

void widen(OnnxTensor& tensor) {
    if (tensor.raw.size() % 2 != 0)
        fail<InvalidInput>("its tensor '", tensor.name, "' holds half a number");
    const int n = static_cast<int>(tensor.raw.size() / 2);
    std::string wide(tensor.raw.size() * 2, '\0');
    if (n > 0) {
        const cv::Mat half(1, n, CV_16F, tensor.raw.data());
        cv::Mat single(1, n, CV_32F, wide.data());
        half.convertTo(single, CV_32F);
    }
    tensor.raw = std::move(wide);
    tensor.type = kOnnxFloat;
}

void require_finite(const OnnxTensor& tensor) {
    for (std::size_t at = 0; at + 4 <= tensor.raw.size(); at += 4) {
        float value = 0.0F;
        std::memcpy(&value, tensor.raw.data() + at, sizeof value);
        if (!std::isfinite(value))
            fail<InvalidInput>("its weights '", tensor.name, "' are not all finite numbers");
    }
}

void append_int64(std::string& raw, std::int64_t value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    raw.append(bytes, sizeof value);
}

void read_tensor_field(const WireField& field, OnnxTensor& tensor) {
    switch (field.number) {
        case 1:
            append_varints(field, tensor.dims);
            break;
        case 2:
            tensor.type = static_cast<std::int64_t>(field.value);
            break;
        case 4:  // float_data, packed or one by one
            if (field.wire == Wire::Bytes)
                tensor.raw += field.bytes;
            else
                tensor.raw.append(reinterpret_cast<const char*>(&field.value), 4);
            break;
        case 7: {  // int64_data
            std::vector<std::int64_t> values;
            append_varints(field, values);
            for (const std::int64_t value : values)
                append_int64(tensor.raw, value);
            break;
        }
        case 8:
            tensor.name = text_of(field);
            break;
        case 9:
            tensor.raw += message_of(field);
            break;
        case 12:
            break;  // remark
        default:
            fail<InvalidInput>("its tensors are not stored as plain numbers in the file");
    }
}

}  // namespace

std::string_view text_of(const WireField& field) {
    if (field.wire != Wire::Bytes || field.bytes.size() > 4096)
        fail<InvalidInput>("a name in it is no text");
    return field.bytes;
}

std::string_view message_of(const WireField& field) {
    if (field.wire != Wire::Bytes)
        fail<InvalidInput>("a part of it is stored as another kind");
    return field.bytes;
}

OnnxTensor read_tensor(std::string_view message) {
    OnnxTensor tensor;
    for (const WireField& field : wire_fields(message))
        read_tensor_field(field, tensor);
    if (tensor.dims.size() > 4)
        fail<InvalidInput>("its tensor '", tensor.name, "' has ", tensor.dims.size(),
                           " dimensions");
    if (tensor.type == kOnnxHalf)
        widen(tensor);
    if (tensor.type != kOnnxFloat && tensor.type != kOnnxInt64)
        fail<InvalidInput>("its tensor '", tensor.name, "' is of data type ", tensor.type,
                           ", not of float, float16 or int64");
    const std::size_t width = tensor.type == kOnnxInt64 ? 8 : 4;
    if (tensor.raw.size() % width != 0 || tensor.n_values() != claimed_values(tensor))
        fail<InvalidInput>("its tensor '", tensor.name, "' has ", tensor.raw.size(),
                           " bytes, other than its dimensions say");
    if (tensor.type == kOnnxFloat)
        require_finite(tensor);
    return tensor;
}

std::string written(const OnnxTensor& tensor) {
    std::string out;
    for (const std::int64_t dim : tensor.dims)
        put_varint(out, 1, static_cast<std::uint64_t>(dim));
    put_varint(out, 2, static_cast<std::uint64_t>(tensor.type));
    put_bytes(out, 8, tensor.name);
    put_bytes(out, 9, tensor.raw);
    return out;
}

}  // namespace scree::vision
