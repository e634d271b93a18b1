#include "testdata/other_pictures.h"

#include "base/error.h"
#include "base/random.h"
#include "testdata/lattice_noise.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <opencv2/imgproc.hpp>

namespace scree::test {
namespace {

cv::Mat canvas_of(Photo& photo) {
    return cv::Mat(photo.height(), photo.width(), CV_8UC3, photo.data());
}

// Every pixel on its own.
template <class Colour>
void fill(Photo& photo, Colour&& colour) {
    for (int y = 0; y < photo.height(); ++y)
        for (int x = 0; x < photo.width(); ++x) {
            const glm::dvec3 c = glm::clamp(colour(x, y), 0.0, 255.0);
            photo(x, y) = glm::u8vec3(c + 0.5);
        }
}

glm::dvec3 brick_colour(std::uint64_t seed, int x, int y) {
    constexpr int kWide = 90;
    constexpr int kHigh = 36;
    constexpr int kJoint = 6;
    const int row = y / kHigh;
    const int shifted = x + (row % 2) * kWide / 2;
    const double rough =
        12.0 * (lattice(seed, x, y) - 0.5) + 50.0 * fractal_noise(seed + 1, x, y, 12.0, 3);
    if (y % kHigh < kJoint || shifted % kWide < kJoint)
        return glm::dvec3(165.0 + 0.5 * rough);
    const double tone = 0.75 + 0.5 * lattice(seed + 2, shifted / kWide, row);
    return glm::dvec3(150.0, 75.0, 60.0) * tone + rough;
}

void draw_text(Photo& photo, std::uint64_t seed) {
    cv::Mat canvas = canvas_of(photo);
    canvas.setTo(cv::Scalar(245, 244, 240));
    Rng rng({.seed = seed});
    for (int y = 20; y < photo.height(); y += 18) {
        std::string line;
        for (int k = 0; k < photo.width() / 9; ++k)
            line += rng.uniform() < 0.17 ? ' ' : static_cast<char>('a' + rng.below(26));
        cv::putText(canvas, line, {10, y}, cv::FONT_HERSHEY_PLAIN, 0.9, {25, 25, 25}, 1,
                    cv::LINE_AA);
    }
}

void draw_grass(Photo& photo, std::uint64_t seed) {
    cv::Mat canvas = canvas_of(photo);
    canvas.setTo(cv::Scalar(25, 40, 20));
    Rng rng({.seed = seed});
    for (int k = 0; k < photo.width() * photo.height() / 75; ++k) {
        const double x = rng.uniform(0.0, photo.width());
        const double y = rng.uniform(0.0, photo.height() + 60.0);
        const double length = rng.uniform(30.0, 90.0);
        const double lean = 0.4 * rng.normal();
        const double light = rng.uniform(0.4, 1.2);
        const cv::Point foot(static_cast<int>(x), static_cast<int>(y));
        const cv::Point tip(static_cast<int>(x + length * std::sin(lean)),
                            static_cast<int>(y - length * std::cos(lean)));
        const int width = 1 + static_cast<int>(rng.below(3));
        cv::line(canvas, foot, tip, cv::Scalar(80, 150, 50) * light, width, cv::LINE_AA);
    }
}

void draw_face(Photo& photo) {
    cv::Mat canvas = canvas_of(photo);
    const double unit = std::min(photo.width(), photo.height()) / 512.0;
    const auto at = [&](double x, double y) {
        return cv::Point(static_cast<int>(0.5 * photo.width() + unit * (x - 256.0)),
                         static_cast<int>(0.5 * photo.height() + unit * (y - 256.0)));
    };
    const auto oval = [&](cv::Point centre, double a, double b, int until, cv::Scalar colour) {
        cv::ellipse(canvas, centre, {static_cast<int>(unit * a), static_cast<int>(unit * b)}, 0.0,
                    until < 0 ? 180.0 : 0.0, std::abs(until), colour, cv::FILLED, cv::LINE_AA);
    };
    canvas.setTo(cv::Scalar(160, 180, 200));
    oval(at(256, 270), 140, 185, 360, {225, 185, 150});
    oval(at(256, 170), 150, 110, -360, {60, 40, 30});
    for (const double x : {205.0, 307.0}) {
        oval(at(x, 250), 24, 12, 360, {250, 250, 250});
        oval(at(x, 250), 9, 9, 360, {20, 40, 60});
    }
    oval(at(256, 370), 45, 16, 180, {180, 70, 70});
    cv::line(canvas, at(256, 260), at(246, 320), {190, 150, 120}, 4, cv::LINE_AA);
    cv::GaussianBlur(canvas, canvas, cv::Size(), 1.5);
}

}  // namespace

Photo draw_subject(Subject subject, int width, int height, std::uint64_t seed) {
    if (std::min(width, height) < 32 || std::max(width, height) > 4096)
        fail<InvalidOption>("the picture would be ", width, " x ", height,
                            " pixels, each side must be in [32, 4096]");
    Photo photo(width, height);
    Rng rng({.seed = seed});
    switch (subject) {
        case Subject::Black:
            break;
        case Subject::White:
            fill(photo, [](int, int) { return glm::dvec3(255.0); });
            break;
        case Subject::Noise:
            fill(photo, [&](int, int) {
                return glm::dvec3(rng.uniform(), rng.uniform(), rng.uniform()) * 255.0;
            });
            break;
        case Subject::Gradient:
            fill(photo, [&](int x, int) { return glm::dvec3(255.0 * x / width); });
            break;
        case Subject::Clouds:
            fill(photo, [&](int x, int y) {
                return glm::dvec3(128.0 + 110.0 * fractal_noise(seed, x, y, 120.0, 6));
            });
            break;
        case Subject::Bricks:
            fill(photo, [&](int x, int y) { return brick_colour(seed, x, y); });
            break;
        case Subject::Stripes:
            fill(photo, [](int x, int) { return glm::dvec3(127.0 + 120.0 * std::sin(x / 9.0)); });
            break;
        case Subject::Text:
            draw_text(photo, seed);
            break;
        case Subject::Grass:
            draw_grass(photo, seed);
            break;
        case Subject::Face:
            draw_face(photo);
            break;
    }
    return photo;
}

}  // namespace scree::test
