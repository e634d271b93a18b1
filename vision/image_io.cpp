#include "vision/image_io.h"

#include "base/error.h"

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

namespace scree::vision {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScale = "scree:metres_per_pixel";
constexpr const char* kLow = "scree:metres_min";
constexpr const char* kHigh = "scree:metres_max";

std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ')
        text.pop_back();
    return text.empty() ? "unknown or damaged format" : text;
}

std::unique_ptr<OIIO::ImageInput> open_picture(const fs::path& path, const ReadLimits& limits) {
    std::error_code error;
    if (!fs::exists(path, error))
        fail<IoError>("cannot read ", path.string(), ": no such file");
    if (fs::is_directory(path, error))
        fail<IoError>("cannot read ", path.string(), ": it is a folder, name a picture in it");
    if (fs::file_size(path, error) == 0)
        fail<IoError>("cannot read ", path.string(), ": the file is empty");
    OIIO::ImageSpec hints;
    hints["oiio:UnassociatedAlpha"] = 1;
    auto input = OIIO::ImageInput::open(path.string(), &hints);
    if (!input)
        fail<IoError>("cannot read ", path.string(), ": ", one_line(OIIO::geterror()));
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
        fail<InvalidInput>(path.string(), " has no pixels");
    if (spec.depth > 1 || spec.nchannels > 64)
        fail<InvalidInput>(path.string(), " is no flat picture with at most 64 channels");
    const double pixels = static_cast<double>(spec.width) * spec.height;
    if (pixels > limits.max_pixels)
        fail<InvalidInput>(path.string(), " has ", spec.width, " x ", spec.height,
                           " pixels, the limit is ", limits.max_pixels,
                           "; scale it down or raise the limit");
    return input;
}

template <class T>
std::vector<T> read_channels(OIIO::ImageInput& input, const fs::path& path, int n_channels,
                             OIIO::TypeDesc type) {
    const OIIO::ImageSpec& spec = input.spec();
    std::vector<T> values(static_cast<std::size_t>(spec.width) *
                          static_cast<std::size_t>(spec.height) *
                          static_cast<std::size_t>(n_channels));
    if (!input.read_image(0, 0, 0, n_channels, type, values.data()))
        fail<IoError>("cannot read ", path.string(), ": ", one_line(input.geterror()));
    return values;
}

float srgb_from_linear(float light) {
    const float v = std::clamp(light, 0.0F, 1.0F);
    return v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1.0F / 2.4F) - 0.055F;
}

bool is_float(const OIIO::ImageSpec& spec) {
    return spec.format.is_floating_point();
}

glm::u8vec3 pick_colour(const std::uint8_t* pixel, int n_channels) {
    return n_channels >= 3 ? glm::u8vec3(pixel[0], pixel[1], pixel[2]) : glm::u8vec3(pixel[0]);
}

std::uint8_t coded_byte(float light, const fs::path& path) {
    if (!std::isfinite(light))
        fail<InvalidInput>(path.string(), " holds values that are no numbers");
    return static_cast<std::uint8_t>(std::lround(255.0F * srgb_from_linear(light)));
}

Photo read_colours(OIIO::ImageInput& input, const fs::path& path) {
    const OIIO::ImageSpec spec = input.spec();
    const int n = spec.nchannels >= 3 ? 3 : 1;
    Photo photo(spec.width, spec.height);
    if (is_float(spec)) {
        const auto values = read_channels<float>(input, path, n, OIIO::TypeDesc::FLOAT);
        std::vector<std::uint8_t> coded(values.size());
        std::transform(values.begin(), values.end(), coded.begin(),
                       [&](float v) { return coded_byte(v, path); });
        for (std::size_t i = 0; i < photo.size(); ++i)
            photo.data()[i] = pick_colour(&coded[i * static_cast<std::size_t>(n)], n);
        return photo;
    }
    const auto values = read_channels<std::uint8_t>(input, path, n, OIIO::TypeDesc::UINT8);
    for (std::size_t i = 0; i < photo.size(); ++i)
        photo.data()[i] = pick_colour(&values[i * static_cast<std::size_t>(n)], n);
    return photo;
}

// Where the value of pixel (x, y) of the upright picture lies in the stored one, after EXIF.
glm::ivec2 stored_pixel(int orientation, int x, int y, int stored_width, int stored_height) {
    const int right = stored_width - 1;
    const int bottom = stored_height - 1;
    switch (orientation) {
        case 2:
            return {right - x, y};
        case 3:
            return {right - x, bottom - y};
        case 4:
            return {x, bottom - y};
        case 5:
            return {y, x};
        case 6:
            return {y, bottom - x};
        case 7:
            return {right - y, bottom - x};
        case 8:
            return {right - y, x};
        default:
            return {x, y};
    }
}

template <class T>
Raster<T> upright(Raster<T> stored, int orientation) {
    if (orientation < 2 || orientation > 8)
        return stored;
    const bool turned = orientation >= 5;
    Raster<T> result(turned ? stored.height() : stored.width(),
                     turned ? stored.width() : stored.height());
    for (int y = 0; y < result.height(); ++y)
        for (int x = 0; x < result.width(); ++x) {
            const glm::ivec2 p = stored_pixel(orientation, x, y, stored.width(), stored.height());
            result(x, y) = stored(p.x, p.y);
        }
    return result;
}

// Text metadata of formats without typed attributes comes back as a string.
double number_attribute(const OIIO::ImageSpec& spec, const char* name, double otherwise) {
    const std::string text = spec.get_string_attribute(name);
    const double value =
        text.empty()
            ? static_cast<double>(spec.get_float_attribute(name, static_cast<float>(otherwise)))
            : OIIO::Strutil::stof(text);
    return std::isfinite(value) ? value : otherwise;
}

void write_pixels(const fs::path& path, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                  const void* pixels) {
    auto output = OIIO::ImageOutput::create(path.string());
    if (!output)
        fail<IoError>("cannot write ", path.string(), ": ", one_line(OIIO::geterror()));
    if (!output->open(path.string(), spec))
        fail<IoError>("cannot write ", path.string(), ": ", one_line(output->geterror()));
    if (!output->write_image(type, pixels) || !output->close())
        fail<IoError>("cannot write ", path.string(), ": ", one_line(output->geterror()),
                      "; free some space or choose another folder");
}

OIIO::ImageSpec png_spec(int width, int height, int n_channels, OIIO::TypeDesc type) {
    OIIO::ImageSpec spec(width, height, n_channels, type);
    spec["png:compressionLevel"] = 3;  // half the time of the default for a few percent in size
    return spec;
}

std::string exact(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

}  // namespace

PhotoFile read_photo(const fs::path& path, const ReadLimits& limits) {
    const auto input = open_picture(path, limits);
    const int orientation = input->spec().get_int_attribute("Orientation", 1);
    PhotoFile file;
    file.metres_per_pixel = std::max(0.0, number_attribute(input->spec(), kScale, 0.0));
    file.pixels = upright(read_colours(*input, path), orientation);
    return file;
}

LabelMap read_labels(const fs::path& path, const ReadLimits& limits) {
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
    HeightImage heights{FloatRaster(spec.width, spec.height),
                        std::max(0.0, number_attribute(spec, kScale, 0.0))};
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i]))
            fail<InvalidInput>(path.string(), " holds heights that are no numbers");
        heights.metres.data()[i] =
            scaled ? static_cast<float>(low + (high - low) * values[i]) : values[i];
    }
    return heights;
}

void write_png(const fs::path& path, const Photo& picture) {
    OIIO::ImageSpec spec = png_spec(picture.width(), picture.height(), 3, OIIO::TypeDesc::UINT8);
    spec["oiio:ColorSpace"] = "sRGB";
    write_pixels(path, spec, OIIO::TypeDesc::UINT8, picture.data());
}

void write_png(const fs::path& path, const Raster<std::uint8_t>& picture) {
    write_pixels(path, png_spec(picture.width(), picture.height(), 1, OIIO::TypeDesc::UINT8),
                 OIIO::TypeDesc::UINT8, picture.data());
}

void write_labels(const fs::path& path, const LabelMap& labels) {
    write_pixels(path, png_spec(labels.width(), labels.height(), 1, OIIO::TypeDesc::UINT16),
                 OIIO::TypeDesc::UINT16, labels.data());
}

void write_heights_exr(const fs::path& path, const HeightImage& heights) {
    OIIO::ImageSpec spec(heights.metres.width(), heights.metres.height(), 1, OIIO::TypeDesc::FLOAT);
    spec.channelnames = {"Y"};
    spec["compression"] = "zip";
    spec[kScale] = static_cast<float>(heights.metres_per_pixel);
    spec["ImageDescription"] = "heights in metres";
    write_pixels(path, spec, OIIO::TypeDesc::FLOAT, heights.metres.data());
}

void write_heights_png(const fs::path& path, const HeightImage& heights) {
    const auto [low, high] = std::minmax_element(heights.metres.begin(), heights.metres.end());
    const float base = heights.metres.empty() ? 0.0F : *low;
    const float span = heights.metres.empty() || *high <= base ? 1.0F : *high - base;
    Raster<std::uint16_t> coded(heights.metres.width(), heights.metres.height());
    std::transform(heights.metres.begin(), heights.metres.end(), coded.begin(), [&](float h) {
        return static_cast<std::uint16_t>(std::lround(65535.0F * (h - base) / span));
    });
    OIIO::ImageSpec spec = png_spec(coded.width(), coded.height(), 1, OIIO::TypeDesc::UINT16);
    spec[kLow] = exact(base);
    spec[kHigh] = exact(static_cast<double>(base) + span);
    spec[kScale] = exact(heights.metres_per_pixel);
    write_pixels(path, spec, OIIO::TypeDesc::UINT16, coded.data());
}

std::vector<std::uint8_t> encode_jpeg(const Photo& picture, int quality) {
    std::vector<std::uint8_t> bytes;
    OIIO::Filesystem::IOVecOutput proxy(bytes);
    auto output = OIIO::ImageOutput::create("texture.jpg");
    OIIO::ImageSpec spec(picture.width(), picture.height(), 3, OIIO::TypeDesc::UINT8);
    spec["Compression"] = "jpeg:" + std::to_string(std::clamp(quality, 1, 100));
    OIIO::Filesystem::IOProxy* pointer = &proxy;
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &pointer);
    const bool done = output && output->open("texture.jpg", spec) &&
                      output->write_image(OIIO::TypeDesc::UINT8, picture.data()) && output->close();
    if (!done)
        fail<IoError>("cannot encode the photograph as JPEG: ",
                      one_line(output ? output->geterror() : OIIO::geterror()));
    return bytes;
}

}  // namespace scree::vision
