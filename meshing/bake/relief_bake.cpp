#include "meshing/bake/relief_bake.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/bake/height_bake.h"
#include "vision/outline.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scree::meshing {
namespace {

constexpr double kGapsPerDetail = 6.0;  // depth of the deepest gap over the change of a rock
constexpr std::size_t kRowsAPiece = 64;

double median(std::vector<double> values) {
    if (values.empty())
        return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void check_planes(const vision::RockSet& rocks, const ReliefPlanes& planes) {
    const auto check_size = [&](const char* what, int width, int height) {
        if (width != rocks.width || height != rocks.height)
            fail<InvalidInput>("the ", what, " has ", width, " x ", height,
                               " pixels, the rocks were found on ", rocks.width, " x ",
                               rocks.height);
    };
    check_size("relief signal", planes.signal.width(), planes.signal.height());
    check_size("label map", planes.labels.width(), planes.labels.height());
    // Counted rather than stopped at the first, so that the loops run in vector registers.
    std::size_t n_bad = 0;
    for (const float s : planes.signal)
        n_bad += std::abs(s) <= 1.0F ? 0 : 1;
    if (n_bad > 0)
        fail<InvalidInput>("the relief signal holds ", n_bad, " values outside [-1, 1]");
    std::uint16_t greatest = 0;
    for (const std::uint16_t label : planes.labels)
        greatest = label > greatest ? label : greatest;
    if (greatest > rocks.rocks.size())
        fail<InvalidInput>("the label map names rock ", greatest, " of ", rocks.rocks.size());
}

struct Mean {
    double sum = 0.0;
    double weight = 0.0;
};

// Weighted means of the signal, one a label. Pieces of rows sum apart and are added in their order,
// so that the threads do not matter; a piece holds only the labels that it meets.
std::vector<float> mean_by_rock(const FloatRaster& signal, const FloatRaster& domes,
                                const LabelMap& labels, std::size_t n_labels) {
    std::vector<Mean> means(n_labels);
    const auto height = static_cast<std::size_t>(labels.height());
    const std::size_t n_pieces = (height + kRowsAPiece - 1) / kRowsAPiece;
    std::vector<std::vector<std::pair<std::uint16_t, Mean>>> pieces(n_pieces);
    parallel_for_each_index(0, n_pieces, 1, [&](std::size_t piece) {
        std::vector<Mean> own(n_labels);
        const std::size_t last = std::min(height, (piece + 1) * kRowsAPiece);
        for (std::size_t row = piece * kRowsAPiece; row < last; ++row) {
            const int y = static_cast<int>(row);
            const float* weight = domes.row(y);
            const float* s = signal.row(y);
            const std::uint16_t* label = labels.row(y);
            for (int x = 0; x < labels.width(); ++x) {
                Mean& mean = own[label[x]];
                mean.sum += static_cast<double>(weight[x] * s[x]);
                mean.weight += static_cast<double>(weight[x]);
            }
        }
        for (std::size_t label = 1; label < n_labels; ++label)
            if (own[label].weight > 0.0)
                pieces[piece].emplace_back(static_cast<std::uint16_t>(label), own[label]);
    });
    for (const auto& piece : pieces)
        for (const auto& [label, mean] : piece) {
            means[label].sum += mean.sum;
            means[label].weight += mean.weight;
        }
    std::vector<float> result(n_labels, 0.0F);
    for (std::size_t label = 1; label < n_labels; ++label)
        if (means[label].weight > 0.0)
            result[label] = static_cast<float>(means[label].sum / means[label].weight);
    return result;
}

}  // namespace

double typical_radius(const vision::RockSet& rocks) {
    std::vector<double> radii;
    for (const vision::Rock& rock : rocks.rocks)
        radii.push_back(0.5 * vision::equivalent_diameter(rock.outline));
    return median(std::move(radii));
}

vision::HeightImage bake_displacement(const vision::RockSet& rocks, const ReliefPlanes& planes,
                                      const ReliefOptions& options) {
    check(options);
    check_planes(rocks, planes);
    vision::HeightImage heights = bake_displacement(rocks);
    if (options.detail == 0.0 || rocks.rocks.empty())
        return heights;
    std::vector<double> depths;
    for (const vision::Rock& rock : rocks.rocks)
        depths.push_back(static_cast<double>(rock.depth));
    const auto& [signal, labels] = planes;
    const std::vector<float> means =
        mean_by_rock(signal, heights.metres, labels, rocks.rocks.size() + 1);
    const auto detail = static_cast<float>(options.detail);
    const auto half_gap = static_cast<float>(0.5 * kGapsPerDetail * options.detail *
                                             median(std::move(depths)) * scale_of(rocks));
    parallel_for_each_index(
        0, static_cast<std::size_t>(rocks.height), kRowsAPiece, [&](std::size_t row) {
            const int y = static_cast<int>(row);
            float* metres = heights.metres.row(y);
            const float* s = planes.signal.row(y);
            const std::uint16_t* label = planes.labels.row(y);
            for (int x = 0; x < rocks.width; ++x) {
                const float gap = half_gap * (s[x] - 1.0F);
                const float rock = metres[x] * (1.0F + detail * (s[x] - means[label[x]]));
                metres[x] = label[x] == 0 && metres[x] == 0.0F ? gap : rock;
            }
        });
    return heights;
}

}  // namespace scree::meshing
