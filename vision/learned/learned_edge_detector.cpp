#include "vision/learned/learned_edge_detector.h"

#include "base/error.h"
#include "base/progress.h"
#include "vision/learned/level_fusion.h"
#include "vision/learned/level_picture.h"

#include <algorithm>

namespace scree::vision {
namespace {

constexpr int kLeastSide = 32;     // of a level, px
constexpr int kEighthFrom = 2400;  // longest side of a photograph from which 1/8 is looked at
constexpr int kUsualLevels = 3;

int levels_of(const Photo& photo, const LearnedOptions& options) {
    const int longest = std::max(photo.width(), photo.height());
    const int shortest = std::min(photo.width(), photo.height());
    int n = std::min(options.levels, longest >= kEighthFrom ? kUsualLevels + 1 : kUsualLevels);
    while (n > 1 && shortest >> (n - 1) < kLeastSide)
        --n;
    return n;
}

// Says how far the work is, counted in pixels of all levels.
class Meter {
public:
    Meter(Progress* progress, const Photo& photo, int levels) : progress_(progress) {
        for (int level = 0; level < levels; ++level)
            all_ += static_cast<double>(photo.size()) / static_cast<double>(1U << (2 * level));
    }
    void begin_level(double pixels, std::size_t n_tiles) {
        a_tile_ = pixels / static_cast<double>(n_tiles);
    }
    void next_tile() {
        report_progress(progress_, "finding edges", std::min(1.0, done_ / all_));
        done_ += a_tile_;
    }

private:
    Progress* progress_;
    double all_ = 0.0, done_ = 0.0, a_tile_ = 0.0;
};

void add_level(const LevelPicture& level, const FineShare& share, const LearnedOptions& options,
               NetworkRun& network, Meter& meter, LogitPlanes& fused) {
    const int most = options.tile / kNetworkStep * kNetworkStep;
    const auto columns = plan_tiles(level.padded.width(), most, options.margin);
    const auto rows = plan_tiles(level.padded.height(), most, options.margin);
    meter.begin_level(static_cast<double>(level.width) * level.height,
                      columns.size() * rows.size());
    std::vector<float> input, logits;
    for (std::size_t j = 0; j < rows.size(); ++j) {
        for (std::size_t i = 0; i < columns.size(); ++i) {
            meter.next_tile();
            if (share.nothing_in(columns[i], rows[j]))
                continue;
            fill_input(level, columns[i], rows[j], input);
            logits.resize(input.size() / 3 * kFieldChannels);
            network.evaluate(input, columns[i].size, rows[j].size, logits);
            add_tile({columns[i], rows[j], tile_weights(columns, i), tile_weights(rows, j)}, logits,
                     share, fused);
        }
    }
}

// The mean of this level and of `n_coarser` coarser ones.
void fuse_level(const Photo& picture, int n_coarser, const LearnedOptions& options,
                NetworkRun& network, Meter& meter, LogitPlanes& fused) {
    const int width = picture.width(), height = picture.height();
    FineShare share{1.0F / static_cast<float>(n_coarser + 1), {}};
    if (n_coarser > 0 && options.adapt)
        share = choose_share(fused, width, height, share.most, {options.full, options.none});
    for (FloatRaster& plane : fused)
        plane = n_coarser > 0 ? doubled(plane, width, height) : FloatRaster(width, height);
    make_room(fused, share);
    add_level(level_picture(picture), share, options, network, meter, fused);
}

}  // namespace

LearnedEdgeDetector::LearnedEdgeDetector(const LearnedOptions& options, OutlineNetwork network)
    : options_(options), network_(std::move(network)) {
    check(options_);
    if (options_.none <= options_.full)
        fail<InvalidOption>("none is ", options_.none, " px, must be above full, which is ",
                            options_.full, " px");
}

EdgeField LearnedEdgeDetector::detect(const Photo& photo, Progress* progress) const {
    if (photo.empty())
        fail<InvalidInput>("the photograph has no pixels");
    const int n = levels_of(photo, options_);
    std::vector<Photo> coarser;
    for (int level = 1; level < n; ++level)
        coarser.push_back(halved(level == 1 ? photo : coarser.back()));
    NetworkRun network(network_);
    Meter meter(progress, photo, n);
    LogitPlanes fused;
    for (int level = n - 1; level >= 0; --level) {
        const Photo& picture = level == 0 ? photo : coarser[static_cast<std::size_t>(level - 1)];
        fuse_level(picture, n - 1 - level, options_, network, meter, fused);
    }
    for (FloatRaster& plane : fused)
        squash(plane);
    return {std::move(fused[0]), std::move(fused[1]), std::move(fused[2])};
}

}  // namespace scree::vision
