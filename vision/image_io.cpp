#include "vision/image_io.h"

#include "base/error.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/whole_file.h"
#include "vision/exif_orientation.h"
#include "vision/picture_error.h"
#include "vision/picture_header.h"
#include "vision/png_encoder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>
#include <system_error>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <glm/common.hpp>

namespace scree::vision {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScale = "scree:metres_per_pixel";
constexpr const char* kLow = "scree:metres_min";
constexpr const char* kHigh = "scree:metres_max";

void check_size(double width, double height, const fs::path& path, const ReadLimits& limits) {
    if (width * height > limits.max_pixels)
        fail<InvalidInput>(path.string(), " has ", width, " x ", height, " pixels, the limit is ",
                           limits.max_pixels, "; scale it down or raise the limit");
}

// Some readers take memory for the whole picture, or decode it, as they open it: the size is asked
// of the header first, and only formats whose header is understood are opened at all.
std::unique_ptr<OIIO::ImageInput> open_picture(const fs::path& path, const ReadLimits& limits) {
    const PictureHeader header = read_picture_header(path);
    check_size(header.width, header.height, path, limits);
    OIIO::geterror();  // forget what earlier calls on this thread left
    auto input = OIIO::ImageInput::create(header.format);
    if (!input)
        fail<IoError>("cannot read ", path.string(), ": OpenImageIO was built without ",
                      header.format);
    OIIO::ImageSpec hints;
    hints["oiio:UnassociatedAlpha"] = 1;
    OIIO::ImageSpec spec;
    if (!input->open(path.string(), spec, hints))
        fail<IoError>("cannot read ", path.string(), ": ", one_line(input->geterror()));
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
        fail<InvalidInput>(path.string(), " has no pixels");
    if (spec.depth > 1 || spec.deep || spec.nchannels > 64)
        fail<InvalidInput>(path.string(), " is no flat picture with at most 64 channels");
    check_size(spec.width, spec.height, path, limits);
    return input;
}

void read_into(OIIO::ImageInput& input, const fs::path& path, int n_channels, OIIO::TypeDesc type,
               void* values) {
    if (!input.read_image(0, 0, 0, n_channels, type, values) || input.has_error())
        fail<IoError>("cannot read ", path.string(), ": ", one_line(input.geterror()));
}

template <class T>
std::vector<T> read_channels(OIIO::ImageInput& input, const fs::path& path, int n_channels,
                             OIIO::TypeDesc type) {
    const OIIO::ImageSpec& spec = input.spec();
    std::vector<T> values(static_cast<std::size_t>(spec.width) *
                          static_cast<std::size_t>(spec.height) *
                          static_cast<std::size_t>(n_channels));
    read_into(input, path, n_channels, type, values.data());
    return values;
}

float srgb_from_linear(float light) {
    const float v = std::clamp(light, 0.0F, 1.0F);
    return v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1.0F / 2.4F) - 0.055F;
}

bool is_float(const OIIO::ImageSpec& spec) {
    return spec.format.is_floating_point();
}

std::uint8_t coded_byte(float light, const fs::path& path) {
    if (!std::isfinite(light))
        fail<InvalidInput>(path.string(), " holds values that are no numbers");
    return static_cast<std::uint8_t>(std::lround(255.0F * srgb_from_linear(light)));
}

Photo read_colours(OIIO::ImageInput& input, const fs::path& path) {
    const OIIO::ImageSpec spec = input.spec();
    Photo photo(spec.width, spec.height);
    const int n = spec.nchannels >= 3 ? 3 : 1;
    if (n == 3 && !is_float(spec)) {
        static_assert(sizeof(glm::u8vec3) == 3);
        read_into(input, path, 3, OIIO::TypeDesc::UINT8, photo.data());
        return photo;
    }
    std::vector<std::uint8_t> coded;
    if (is_float(spec)) {
        const auto light = read_channels<float>(input, path, n, OIIO::TypeDesc::FLOAT);
        coded.resize(light.size());
        std::transform(light.begin(), light.end(), coded.begin(),
                       [&](float v) { return coded_byte(v, path); });
    } else {
        coded = read_channels<std::uint8_t>(input, path, n, OIIO::TypeDesc::UINT8);
    }
    for (std::size_t i = 0; i < photo.size(); ++i)
        photo.data()[i] = n == 3 ? glm::u8vec3(coded[3 * i], coded[3 * i + 1], coded[3 * i + 2])
                                 : glm::u8vec3(coded[i]);
    return photo;
}

// Text metadata of formats without typed attributes comes back as a string.
double number_attribute(const OIIO::ImageSpec& spec, const char* name, double otherwise) {
    const OIIO::ParamValue* found = spec.find_attribute(name);
    if (found == nullptr)
        return otherwise;
    double value = otherwise;
    if (found->type() == OIIO::TypeDesc::STRING)
        value = parse_number<double>(found->get_string()).value_or(otherwise);
    else if (found->type() == OIIO::TypeDesc::DOUBLE)
        value = found->get<double>();
    else
        value = found->get_float(static_cast<float>(otherwise));
    return std::isfinite(value) ? value : otherwise;
}

double scale_attribute(const OIIO::ImageSpec& spec) {
    const double scale = number_attribute(spec, kScale, 0.0);
    return scale > 0.0 && scale <= 1e6 ? scale : 0.0;
}

// Encodes in memory: writers to a file lose the error of a full disk when they close it.
std::vector<std::uint8_t> encoded(const std::string& name, OIIO::ImageSpec spec,
                                  OIIO::TypeDesc type, const void* pixels) {
    std::vector<std::uint8_t> bytes;
    OIIO::Filesystem::IOVecOutput proxy(bytes);
    OIIO::Filesystem::IOProxy* pointer = &proxy;
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &pointer);
    OIIO::geterror();  // forget what earlier calls on this thread left
    const auto output = OIIO::ImageOutput::create(name);
    if (!output)
        fail<IoError>("cannot write ", name, ": ", one_line(OIIO::geterror()));
    if (!output->open(name, spec) || !output->write_image(type, pixels) || !output->close())
        fail<IoError>("cannot write ", name, ": ", one_line(output->geterror()));
    return bytes;
}

template <class T>
PngPicture png_of(const Raster<T>& picture, int n_channels, int bits) {
    return {static_cast<std::size_t>(picture.width()), static_cast<std::size_t>(picture.height()),
            n_channels, bits, picture.data()};
}

void write_encoded(const fs::path& path, const PngPicture& picture) {
    if (picture.width == 0 || picture.height == 0)
        fail<IoError>("cannot write ", path.string(), ": a picture needs pixels");
    write_staged_file(path, encode_png(picture));
}

std::string exact(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

}  // namespace

PhotoFile read_photo(const fs::path& path, const ReadLimits& limits) {
    const auto input = open_picture(path, limits);
    const int orientation = input->spec().get_int_attribute("Orientation", 1);
    PhotoFile file;
    file.metres_per_pixel = scale_attribute(input->spec());
    file.pixels = upright(read_colours(*input, path), orientation);
    return file;
}

int count_channels(const fs::path& path, const ReadLimits& limits) {
    return open_picture(path, limits)->spec().nchannels;
}

LabelMap read_labels(const fs::path& path, const ReadLimits& limits) {
    if (const int bits = read_picture_header(path).bits; bits > 0 && bits < 8)
        fail<InvalidInput>(path.string(), " is no label map: it has ", bits,
                           " bits a pixel, 8 or 16 are needed");  // the reader would spread them
    const auto input = open_picture(path, limits);
    const OIIO::ImageSpec spec = input->spec();
    const bool wide = spec.format == OIIO::TypeDesc::UINT16;
    if (spec.nchannels != 1 || !(wide || spec.format == OIIO::TypeDesc::UINT8))
        fail<InvalidInput>(path.string(),
                           " is no label map: one channel of 8 or 16 bits is needed, it has ",
                           spec.nchannels, " of ", spec.format.c_str());
    LabelMap labels(spec.width, spec.height);
    if (wide) {
        const auto values = read_channels<std::uint16_t>(*input, path, 1, OIIO::TypeDesc::UINT16);
        std::copy(values.begin(), values.end(), labels.begin());
    } else {
        const auto values = read_channels<std::uint8_t>(*input, path, 1, OIIO::TypeDesc::UINT8);
        std::copy(values.begin(), values.end(), labels.begin());
    }
    return labels;
}

HeightImage read_heights(const fs::path& path, const ReadLimits& limits) {
    const auto input = open_picture(path, limits);
    const OIIO::ImageSpec spec = input->spec();
    const auto values = read_channels<float>(*input, path, 1, OIIO::TypeDesc::FLOAT);
    const double low = number_attribute(spec, kLow, 0.0);
    const double high = number_attribute(spec, kHigh, 1.0);
    const bool scaled = !is_float(spec);
    HeightImage heights{FloatRaster(spec.width, spec.height), scale_attribute(spec),
                        !scaled || spec.find_attribute(kHigh) != nullptr};
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i]))
            fail<InvalidInput>(path.string(), " holds heights that are no numbers");
        heights.metres.data()[i] =
            scaled ? static_cast<float>(low + (high - low) * values[i]) : values[i];
    }
    return heights;
}

RgbaImage read_rgba(const fs::path& path, const ReadLimits& limits) {
    const auto input = open_picture(path, limits);
    const OIIO::ImageSpec spec = input->spec();
    const bool wide = spec.format == OIIO::TypeDesc::UINT16;
    if (spec.nchannels != 4 || !(wide || spec.format == OIIO::TypeDesc::UINT8))
        fail<InvalidInput>(path.string(), " has ", spec.nchannels, " channels of ",
                           spec.format.c_str(), ", four of 8 or 16 bits are needed");
    RgbaImage picture{Raster<glm::u16vec4>(spec.width, spec.height), wide ? 16 : 8};
    static_assert(sizeof(glm::u16vec4) == 8);
    if (wide) {
        read_into(*input, path, 4, OIIO::TypeDesc::UINT16, picture.values.data());
        return picture;
    }
    const auto bytes = read_channels<std::uint8_t>(*input, path, 4, OIIO::TypeDesc::UINT8);
    for (std::size_t i = 0; i < picture.values.size(); ++i)
        picture.values.data()[i] = {bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2],
                                    bytes[4 * i + 3]};
    return picture;
}

std::vector<NamedPlane> read_planes(const fs::path& path, const ReadLimits& limits) {
    const auto input = open_picture(path, limits);
    const OIIO::ImageSpec spec = input->spec();
    if (!is_float(spec))
        fail<InvalidInput>(path.string(), " holds whole numbers, a float picture is needed");
    check_size(static_cast<double>(spec.width) * spec.nchannels, spec.height, path, limits);
    const int n = spec.nchannels;
    const auto values = read_channels<float>(*input, path, n, OIIO::TypeDesc::FLOAT);
    std::vector<NamedPlane> planes;
    for (int c = 0; c < n; ++c) {
        planes.push_back({spec.channel_name(c), FloatRaster(spec.width, spec.height)});
        FloatRaster& plane = planes.back().values;
        for (std::size_t i = 0; i < plane.size(); ++i) {
            const float value =
                values[i * static_cast<std::size_t>(n) + static_cast<std::size_t>(c)];
            if (!std::isfinite(value))
                fail<InvalidInput>(path.string(), " holds values that are no numbers in channel ",
                                   planes.back().name);
            plane.data()[i] = value;
        }
    }
    return planes;
}

void write_png(const fs::path& path, const Photo& picture) {
    PngPicture png = png_of(picture, 3, 8);
    png.is_srgb = true;
    write_encoded(path, png);
}

void write_data_png(const fs::path& path, const Photo& picture) {
    write_encoded(path, png_of(picture, 3, 8));
}

void write_png(const fs::path& path, const Raster<std::uint8_t>& picture) {
    write_encoded(path, png_of(picture, 1, 8));
}

void write_labels(const fs::path& path, const LabelMap& labels) {
    PngPicture png = png_of(labels, 1, 16);
    png.filter = PngFilter::Above;
    write_encoded(path, png);
}

void write_heights_exr(const fs::path& path, const HeightImage& heights) {
    if (heights.metres.empty())
        fail<IoError>("cannot write ", path.string(), ": a picture needs pixels");
    OIIO::ImageSpec spec(heights.metres.width(), heights.metres.height(), 1, OIIO::TypeDesc::FLOAT);
    spec.channelnames = {"Y"};
    spec["compression"] = "none";  // relief leaves zip a twentieth to save, for ten times the time
    spec.attribute(kScale, OIIO::TypeDesc::DOUBLE, &heights.metres_per_pixel);
    spec["ImageDescription"] = "heights in metres";
    spec["DateTime"] = "1970:01:01 00:00:00";  // else the present: same heights, other bytes
    write_staged_file(path,
                      encoded(path.string(), spec, OIIO::TypeDesc::FLOAT, heights.metres.data()));
}

void write_heights_png(const fs::path& path, const HeightImage& heights) {
    const auto [low, high] = std::minmax_element(heights.metres.begin(), heights.metres.end());
    const float base = heights.metres.empty() ? 0.0F : *low;
    const float span = heights.metres.empty() || *high <= base ? 1.0F : *high - base;
    Raster<std::uint16_t> coded(heights.metres.width(), heights.metres.height());
    parallel_for(0, coded.size(), 1 << 16, [&](std::size_t first, std::size_t last) {
        const float* in = heights.metres.data();
        for (std::size_t i = first; i < last; ++i)
            coded.data()[i] = static_cast<std::uint16_t>(65535.0F * ((in[i] - base) / span) + 0.5F);
    });
    PngPicture png = png_of(coded, 1, 16);
    png.texts = {{kLow, exact(double{base})},
                 {kHigh, exact(double{base} + double{span})},
                 {kScale, exact(heights.metres_per_pixel)}};
    write_encoded(path, png);
}

void write_rgba_png(const fs::path& path, const RgbaImage& picture) {
    const Raster<glm::u16vec4>& values = picture.values;
    if (picture.bits == 16) {
        write_encoded(path, png_of(values, 4, 16));
        return;
    }
    Raster<glm::u8vec4> bytes(values.width(), values.height());
    for (std::size_t i = 0; i < values.size(); ++i)
        bytes.data()[i] = glm::u8vec4(glm::min(values.data()[i], glm::u16vec4(255)));
    write_encoded(path, png_of(bytes, 4, 8));
}

void write_planes_exr(const fs::path& path, std::span<const NamedPlane> planes) {
    if (planes.empty())
        fail<InvalidInput>(path.string(), " would hold no channels");
    const FloatRaster& first = planes.front().values;
    const std::size_t n = planes.size();
    OIIO::ImageSpec spec(first.width(), first.height(), static_cast<int>(n), OIIO::TypeDesc::FLOAT);
    std::vector<float> values(n * first.size());
    for (std::size_t c = 0; c < n; ++c) {
        if (planes[c].values.width() != first.width() ||
            planes[c].values.height() != first.height())
            fail<InvalidInput>(path.string(), ": plane ", planes[c].name, " has another size than ",
                               planes.front().name);
        spec.channelnames[c] = planes[c].name;
        for (std::size_t i = 0; i < first.size(); ++i)
            values[i * n + c] = planes[c].values.data()[i];
    }
    spec.alpha_channel = -1;
    spec["compression"] = "zip";
    spec["DateTime"] = "1970:01:01 00:00:00";  // else the present: same planes, other bytes
    write_staged_file(path, encoded(path.string(), spec, OIIO::TypeDesc::FLOAT, values.data()));
}

std::vector<std::uint8_t> encode_jpeg(const Photo& picture, int quality) {
    OIIO::ImageSpec spec(picture.width(), picture.height(), 3, OIIO::TypeDesc::UINT8);
    spec["Compression"] = "jpeg:" + std::to_string(std::clamp(quality, 1, 100));
    return encoded("texture.jpg", spec, OIIO::TypeDesc::UINT8, picture.data());
}

}  // namespace scree::vision
