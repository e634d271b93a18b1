#include "vision/learned/learned_edge_detector.h"

#include "base/error.h"
#include "base/progress.h"
#include "vision/learned/level_picture.h"
#include "vision/learned/scale_choice.h"

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
    Meter(Progress* progress, const Photo& photo, int levels, bool doubled)
        : progress_(progress), all_(doubled ? 4.0 * static_cast<double>(photo.size()) : 0.0) {
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
    double all_, done_ = 0.0, a_tile_ = 0.0;
};

// Whether a scale is stored at half its size, as the doubled picture is.
enum class Stored { AsItIs, Halved };

struct Work {
    const LearnedOptions& options;
    NetworkRun network;
    Meter meter;
};

void add_level(const LevelPicture& level, const FineShare& share, Stored stored, Work& work,
               LogitPlanes& planes) {
    const int most = work.options.tile / kNetworkStep * kNetworkStep;
    const auto columns = plan_tiles(level.padded.width(), most, work.options.margin);
    const auto rows = plan_tiles(level.padded.height(), most, work.options.margin);
    work.meter.begin_level(static_cast<double>(level.width) * level.height,
                           columns.size() * rows.size());
    std::vector<float> input, logits;
    for (std::size_t j = 0; j < rows.size(); ++j) {
        for (std::size_t i = 0; i < columns.size(); ++i) {
            work.meter.next_tile();
            FineTile tile{columns[i], rows[j], tile_weights(columns, i), tile_weights(rows, j)};
            if (stored == Stored::Halved)
                tile = halved(tile);
            if (share.nothing_in(tile.columns, tile.rows))
                continue;
            fill_input(level, columns[i], rows[j], input);
            logits.resize(input.size() / 3 * kFieldChannels);
            work.network.evaluate(input, columns[i].size, rows[j].size, logits);
            if (stored == Stored::Halved)
                halve_planes(logits, columns[i].size, rows[j].size);
            add_tile(tile, logits, share, planes);
        }
    }
}

LogitPlanes empty_planes(int width, int height) {
    LogitPlanes planes;
    planes.fill(FloatRaster(width, height));
    return planes;
}

// A scale, with the next coarser one standing in where it is not needed.
LogitPlanes level_planes(const Photo& picture, const LogitPlanes* coarser, Work& work) {
    const int width = picture.width(), height = picture.height();
    LogitPlanes planes = empty_planes(width, height);
    FineShare share;
    if (coarser != nullptr && work.options.adapt) {
        share = choose_share(*coarser, width, height, {work.options.full, work.options.none});
        for (std::size_t i = 0; i < planes.size(); ++i)
            planes[i] = enlarged((*coarser)[i], width, height);
    }
    make_room(planes, share);
    add_level(level_picture(picture), share, Stored::AsItIs, work, planes);
    return planes;
}

// The picture at twice its size, needed only around tiny rocks.
LogitPlanes doubled_planes(const Photo& photo, const LogitPlanes& single, Work& work) {
    const int width = photo.width(), height = photo.height();
    FineShare share;
    LogitPlanes planes = single;
    if (work.options.adapt) {
        const double full = 2 * work.options.tiny;  // choose_share() counts pixels twice as fine
        share = choose_share(single, width, height, {full, 1.5 * full, false});
    }
    if (share.nothing_in({0, width}, {0, height}))
        return planes;
    make_room(planes, share);
    add_level(level_picture(doubled(photo)), share, Stored::Halved, work, planes);
    return planes;
}

}  // namespace

LearnedEdgeDetector::LearnedEdgeDetector(const LearnedOptions& options, OutlineNetwork network,
                                         FusionModel fusion)
    : options_(options), network_(std::move(network)), fusion_(std::move(fusion)) {
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
    Work work{options_, NetworkRun(network_), Meter(progress, photo, n, fusion_.reads_doubled)};
    LevelStack stack;
    stack.levels.resize(static_cast<std::size_t>(n));
    for (auto level = static_cast<std::size_t>(n); level-- > 0;) {
        const bool coarsest = level + 1 == stack.levels.size();
        stack.levels[level] = level_planes(level == 0 ? photo : coarser[level - 1],
                                           coarsest ? nullptr : &stack.levels[level + 1], work);
    }
    if (fusion_.reads_doubled)
        stack.doubled.push_back(doubled_planes(photo, stack.levels[0], work));
    return fuse_levels(std::move(stack), fusion_);
}

}  // namespace scree::vision
