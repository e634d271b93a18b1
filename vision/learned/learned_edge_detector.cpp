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
// Of the doubled picture where it is looked at: with the scales at 1 and 1/2 it then counts half as
// much as either of them.
constexpr float kCloserShare = 0.6F;

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

// What the doubled picture would say if it said the same as the scales that are read beside it, so
// that their mean is the same with and without.
LogitPlanes stand_in(const LevelStack& stack) {
    LogitPlanes planes = stack.levels[0];
    if (stack.levels.size() == 1)
        return planes;
    for (std::size_t k = 0; k < planes.size(); ++k) {
        const FloatRaster half =
            enlarged(stack.levels[1][k], planes[k].width(), planes[k].height());
        for (std::size_t i = 0; i < half.size(); ++i)
            planes[k].data()[i] = 0.5F * (planes[k].data()[i] + half.data()[i]);
    }
    return planes;
}

// The picture at twice its size, needed only where the single one leaves open what is rock.
LogitPlanes doubled_planes(const Photo& photo, const LevelStack& stack, Work& work) {
    LogitPlanes planes = stand_in(stack);
    FineShare share;
    if (work.options.adapt) {
        share = choose_doubtful(planes[1], work.options.doubt);
        for (float& part : share.by_place)
            part *= kCloserShare;
    }
    if (share.nothing_in({0, photo.width()}, {0, photo.height()}))
        return planes;
    make_room(planes, share);
    add_level(level_picture(doubled(photo)), share, Stored::Halved, work, planes);
    return planes;
}

bool may_double(const Photo& photo, const LearnedOptions& options, const FusionModel& fusion) {
    return fusion.reads_doubled && 4e-6 * static_cast<double>(photo.size()) <= options.closest;
}

// The same mean without the doubled picture; a network needs all that it was trained with.
FusionModel without_doubled(const FusionModel& fusion) {
    FusionModel plain = fusion;
    plain.reads_doubled = false;
    --plain.n_levels;
    return plain;
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
    const bool doubles = may_double(photo, options_, fusion_);
    Work work{options_, NetworkRun(network_), Meter(progress, photo, n, doubles)};
    LevelStack stack;
    stack.levels.resize(static_cast<std::size_t>(n));
    for (auto level = static_cast<std::size_t>(n); level-- > 0;) {
        const bool coarsest = level + 1 == stack.levels.size();
        stack.levels[level] = level_planes(level == 0 ? photo : coarser[level - 1],
                                           coarsest ? nullptr : &stack.levels[level + 1], work);
    }
    if (doubles)
        stack.doubled.push_back(doubled_planes(photo, stack, work));
    else if (fusion_.reads_doubled && fusion_.n_levels > 1 && fusion_.network.layers.empty())
        return fuse_levels(std::move(stack), without_doubled(fusion_));
    return fuse_levels(std::move(stack), fusion_);
}

}  // namespace scree::vision
