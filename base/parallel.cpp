#include "base/parallel.h"

#include "base/error.h"

#include <algorithm>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>

namespace scree {

struct ThreadLimit::State {
    explicit State(std::size_t n) : control(tbb::global_control::max_allowed_parallelism, n) {}
    tbb::global_control control;
};

ThreadLimit::ThreadLimit(int n_threads) {
    if (n_threads < 0)
        fail<InvalidOption>("threads is ", n_threads, ", must be 0 (all) or more");
    if (n_threads > 0)
        state_ = std::make_unique<State>(static_cast<std::size_t>(n_threads));
}

ThreadLimit::~ThreadLimit() = default;

void parallel_for(std::size_t begin, std::size_t end, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
    if (begin >= end)
        return;
    const std::size_t step = std::max<std::size_t>(1, grain);
    const std::size_t pieces = (end - begin + step - 1) / step;
    tbb::parallel_for(
        std::size_t{0}, pieces,
        [&](std::size_t piece) {
            const std::size_t first = begin + piece * step;
            body(first, std::min(end, first + step));
        },
        tbb::auto_partitioner{});
}

void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second) {
    tbb::parallel_invoke(first, second);
}

}  // namespace scree
