#include "vision/thesis/slice_finder.h"

#include "base/parallel.h"
#include "vision/thesis/polygon.h"
#include "vision/thesis/sampling.h"

#include <cmath>
#include <cstdlib>

namespace scree::vision {
namespace {

constexpr std::size_t kBatch = 16;       // samples traced ahead at once
constexpr std::size_t kLookAhead = 200;  // samples searched for ones worth tracing ahead
constexpr int kApart = 80;               // px between samples of a batch: likely other rocks

// The state of the sequential part: which pixels slices cover, which nodes are struck off.
class Culling {
public:
    Culling(const RayCaster& caster, const ThesisOptions& options)
        : options_(options), covered_(caster.width(), caster.height()) {}

    bool is_struck(glm::ivec2 node) const { return covered_(node.x, node.y) != 0; }

    /// Take the slice in unless too much of it lies on earlier ones; then it only covers.
    void take(Slice&& slice, SliceSet& result) {
        std::size_t n_pixels = 0;
        std::size_t n_shared = 0;
        for_each_inside_run(slice.contour, covered_.width(), covered_.height(),
                            [&](int y, int from, int to) {
                                for (int x = from; x < to; ++x) {
                                    ++n_pixels;
                                    n_shared += covered_(x, y) != 0 ? 1U : 0U;
                                }
                            });
        const double overlap =
            n_pixels == 0 ? 0.0 : static_cast<double>(n_shared) / static_cast<double>(n_pixels);
        if (overlap > options_.greatest_overlap) {
            ++result.n_overlapping;
            return;
        }
        for_each_inside_run(slice.contour, covered_.width(), covered_.height(),
                            [&](int y, int from, int to) {
                                for (int x = from; x < to; ++x)
                                    covered_(x, y) = 1;
                            });
        result.slices.push_back(std::move(slice));
    }

private:
    const ThesisOptions& options_;
    Mask covered_;
};

struct Job {
    std::optional<Slice> slice;
    bool is_done = false;
};

glm::dvec2 centre_of(glm::ivec2 node) {
    return glm::dvec2(node) + 0.5;
}

void decide(std::optional<Slice>&& slice, Culling& culling, SliceSet& result) {
    ++result.n_traced;
    if (slice)
        culling.take(std::move(*slice), result);
    else
        ++result.n_rejected;
}

// The next sample and later ones likely to matter still when their turn comes.
std::vector<std::size_t> choose_batch(const std::vector<glm::ivec2>& nodes,
                                      const std::vector<Job>& jobs, std::size_t first,
                                      const Culling& culling) {
    std::vector<std::size_t> batch;
    const std::size_t end = std::min(nodes.size(), first + kLookAhead);
    for (std::size_t i = first; i < end && batch.size() < kBatch; ++i) {
        if (jobs[i].is_done || culling.is_struck(nodes[i]))
            continue;
        bool apart = true;
        for (const std::size_t j : batch) {
            const glm::ivec2 way = nodes[i] - nodes[j];
            apart = apart && std::max(std::abs(way.x), std::abs(way.y)) >= kApart;
        }
        if (apart)
            batch.push_back(i);
    }
    return batch;
}

}  // namespace

SliceSet find_slices(const Mask& edges, const ThesisOptions& options) {
    check_thesis(options);
    SliceSet result;
    if (edges.empty())
        return result;
    const SliceTracer tracer(edges, options);
    const auto nodes = visiting_order(tracer.caster(), options);
    result.n_samples = nodes.size();
    Culling culling(tracer.caster(), options);
    std::vector<Job> jobs(nodes.size());
    std::size_t next = 0;
    while (next < nodes.size()) {
        if (culling.is_struck(nodes[next])) {
            ++next;
        } else if (jobs[next].is_done) {
            decide(std::move(jobs[next].slice), culling, result);
            ++next;
        } else {
            const auto batch = choose_batch(nodes, jobs, next, culling);
            parallel_for_each_index(0, batch.size(), 1, [&](std::size_t b) {
                jobs[batch[b]] = {tracer.trace(centre_of(nodes[batch[b]])), true};
            });
        }
    }
    return result;
}

SliceSet find_slices_serially(const Mask& edges, const ThesisOptions& options) {
    check_thesis(options);
    SliceSet result;
    if (edges.empty())
        return result;
    const SliceTracer tracer(edges, options);
    const auto nodes = visiting_order(tracer.caster(), options);
    result.n_samples = nodes.size();
    Culling culling(tracer.caster(), options);
    for (const glm::ivec2 node : nodes)
        if (!culling.is_struck(node))
            decide(tracer.trace(centre_of(node)), culling, result);
    return result;
}

}  // namespace scree::vision
