#include "vision/data/size_plot.h"

#include "base/options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace scree::vision {
namespace {

constexpr int kFine = 2;  // drawn twice as large, then halved: even lines and letters
constexpr int kShift = 4;

const cv::Scalar kInk(45, 48, 54);
const cv::Scalar kGrid(226, 229, 233);
const cv::Scalar kFaint(120, 126, 135);
const cv::Scalar kNumberColour(28, 98, 178);
const cv::Scalar kAreaColour(214, 120, 30);
constexpr std::array<double, 3> kMarked = {0.16, 0.50, 0.84};
constexpr std::array<const char*, 3> kMarkedNames = {"D16", "D50", "D84"};

enum class Align { Left, Centre, Right };

// Coordinates in pixels of the finished plot.
struct Canvas {
    cv::Mat image;
    cv::Rect2d frame;  // of the axes
    double low = 1.0;  // diameters at the frame's left and right
    double high = 10.0;

    double x_of(double diameter) const {
        return frame.x + frame.width * std::log(diameter / low) / std::log(high / low);
    }
    double y_of(double share) const { return frame.y + frame.height * (1.0 - share); }

    static cv::Point fixed(const cv::Point2d& p) {
        const double scale = kFine * (1 << kShift);
        return {static_cast<int>(std::lround(p.x * scale)),
                static_cast<int>(std::lround(p.y * scale))};
    }
    void line(const cv::Point2d& a, const cv::Point2d& b, const cv::Scalar& colour,
              double width = 1.0) {
        cv::line(image, fixed(a), fixed(b), colour, static_cast<int>(std::lround(width * kFine)),
                 cv::LINE_AA, kShift);
    }
    void dashed(const cv::Point2d& a, const cv::Point2d& b, const cv::Scalar& colour) {
        const double length = cv::norm(b - a);
        const cv::Point2d along = (b - a) / std::max(length, 1e-9);
        for (double at = 0.0; at < length; at += 9.0)
            line(a + along * at, a + along * std::min(at + 5.0, length), colour);
    }
    static cv::Size text_extent(const std::string& words, double size) {
        const double scale = kFine * size / 22.0;  // capitals of this face are 22 px high at 1
        return cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, scale, kFine, nullptr);
    }
    static double text_width(const std::string& words, double size) {
        return static_cast<double>(text_extent(words, size).width) / kFine;
    }
    void text(const std::string& words, const cv::Point2d& at, Align align,
              const cv::Scalar& colour, double size = 13.0) {
        const cv::Size extent = text_extent(words, size);
        const int left = align == Align::Left ? 0 : extent.width;
        const int shift = align == Align::Centre ? extent.width / 2 : left;
        const cv::Point origin(static_cast<int>(std::lround(at.x * kFine)) - shift,
                               static_cast<int>(std::lround(at.y * kFine)) + extent.height / 2);
        cv::putText(image, words, origin, cv::FONT_HERSHEY_SIMPLEX, kFine * size / 22.0, colour,
                    kFine, cv::LINE_AA);
    }
};

std::string number(double value) {
    char text[32];
    if (value >= 99.95)
        std::snprintf(text, sizeof text, "%.0f", value);
    else
        std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

// 1, 2 and 5 times the powers of ten between the two.
std::vector<double> ticks_between(double low, double high) {
    std::vector<double> ticks;
    for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, power) <= high;
         ++power)
        for (const double step : {1.0, 2.0, 5.0}) {
            const double tick = step * std::pow(10.0, power);
            if (tick >= low && tick <= high)
                ticks.push_back(tick);
        }
    return ticks;
}

void choose_range(const GrainSizeCurve& curve, double unit, Canvas& canvas) {
    if (curve.grains.empty())
        return;
    canvas.low = curve.grains.front().diameter_px * unit / 1.12;
    canvas.high = curve.grains.back().diameter_px * unit * 1.12;
    while (ticks_between(canvas.low, canvas.high).size() < 3) {
        canvas.low /= 1.25;
        canvas.high *= 1.25;
    }
}

void draw_axes(const GrainSizeCurve& curve, Canvas& canvas) {
    const cv::Rect2d& f = canvas.frame;
    for (const double tick : ticks_between(canvas.low, canvas.high)) {
        const double x = canvas.x_of(tick);
        canvas.line({x, f.y}, {x, f.y + f.height}, kGrid);
        canvas.text(number(tick), {x, f.y + f.height + 16}, Align::Centre, kInk);
    }
    for (int percent = 0; percent <= 100; percent += 20) {
        const double y = canvas.y_of(percent / 100.0);
        canvas.line({f.x, y}, {f.x + f.width, y}, kGrid);
        canvas.text(std::to_string(percent), {f.x - 9, y}, Align::Right, kInk);
    }
    canvas.line({f.x, f.y}, {f.x, f.y + f.height}, kInk);
    canvas.line({f.x, f.y + f.height}, {f.x + f.width, f.y + f.height}, kInk);
    canvas.text("equivalent diameter, " + curve.unit(), {f.x + 0.5 * f.width, f.y + f.height + 40},
                Align::Centre, kInk, 14);
    canvas.text("% finer", {f.x - 42, f.y - 22}, Align::Left, kInk, 14);
}

void draw_curve(const GrainSizeCurve& curve, double unit, bool by_area, Canvas& canvas) {
    std::vector<cv::Point> points;
    double before = 0.0;
    for (const Grain& grain : curve.grains) {
        const double share = by_area ? grain.finer_by_area : grain.finer_by_number;
        const double x = canvas.x_of(grain.diameter_px * unit);
        points.push_back(Canvas::fixed({x, canvas.y_of(before)}));
        points.push_back(Canvas::fixed({x, canvas.y_of(share)}));
        before = share;
    }
    cv::polylines(canvas.image, points, false, by_area ? kAreaColour : kNumberColour, 2 * kFine,
                  cv::LINE_AA, kShift);
}

void draw_marks(const GrainSizeCurve& curve, bool by_area, Canvas& canvas) {
    const GrainPercentiles& d = by_area ? curve.by_area : curve.by_number;
    const std::array<double, 3> values = {d.d16, d.d50, d.d84};
    const cv::Scalar& colour = by_area ? kAreaColour : kNumberColour;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double x = canvas.x_of(values[i]);
        const double y = canvas.y_of(kMarked[i]);
        canvas.dashed({canvas.frame.x, y}, {x, y}, kFaint);
        canvas.dashed({x, y}, {x, canvas.frame.y + canvas.frame.height}, kFaint);
        cv::circle(canvas.image, Canvas::fixed({x, y}), kFine * 5 << kShift, colour, cv::FILLED,
                   cv::LINE_AA, kShift);
        // Beside the mark where the curve leaves room: right of it, left of it near the top.
        const bool right = x + 130 < canvas.frame.x + canvas.frame.width;
        canvas.text(std::string(kMarkedNames[i]) + "  " + number(values[i]) + " " + curve.unit(),
                    {right ? x + 12 : x - 12, y + (right ? 13 : -12)},
                    right ? Align::Left : Align::Right, kInk, 15);
    }
}

void draw_legend(const GrainSizeCurve& curve, Canvas& canvas) {
    const double y = canvas.frame.y - 22;
    double x = canvas.frame.x + canvas.frame.width;
    for (const bool by_area : {true, false}) {
        const std::string words = by_area ? "by area" : "by number";
        canvas.text(words, {x, y}, Align::Right, kInk, 14);
        x -= Canvas::text_width(words, 14) + 10;
        canvas.line({x - 26, y}, {x, y}, by_area ? kAreaColour : kNumberColour, 2.0);
        x -= 26 + 22;
    }
    const std::size_t n = curve.grains.size();
    canvas.text(std::to_string(n) + (n == 1 ? " rock" : " rocks"), {x, y}, Align::Right, kFaint,
                14);
}

Photo halved(const cv::Mat& fine, int width, int height) {
    Photo out(width, height);
    cv::Mat target(height, width, CV_8UC3, out.data());
    cv::resize(fine, target, target.size(), 0, 0, cv::INTER_AREA);
    return out;
}

}  // namespace

Photo draw_size_plot(const GrainSizeCurve& curve, const SizePlotOptions& options) {
    check(options);
    Canvas canvas;
    canvas.image =
        cv::Mat(options.height * kFine, options.width * kFine, CV_8UC3, cv::Scalar(255, 255, 255));
    canvas.frame = cv::Rect2d(64, 52, options.width - 64 - 32, options.height - 52 - 64);
    const double unit = curve.millimetres_per_px > 0.0 ? curve.millimetres_per_px : 1.0;
    choose_range(curve, unit, canvas);
    draw_axes(curve, canvas);
    if (curve.grains.empty()) {
        canvas.text("no rocks found", {0.5 * options.width, 0.5 * options.height}, Align::Centre,
                    kFaint, 20);
        return halved(canvas.image, options.width, options.height);
    }
    draw_curve(curve, unit, !options.by_area, canvas);
    draw_curve(curve, unit, options.by_area, canvas);
    draw_marks(curve, options.by_area, canvas);
    draw_legend(curve, canvas);
    return halved(canvas.image, options.width, options.height);
}

}  // namespace scree::vision
