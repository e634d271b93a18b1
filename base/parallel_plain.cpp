// The same loops over std::thread, built instead of parallel.cpp for the thread sanitizer: oneTBB
// as packaged is not instrumented, so its hand-overs look like races; here every one is seen.
#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace scree {
namespace {

std::atomic<int> thread_limit{0};

int n_workers(std::size_t n_pieces) {
    constexpr int kWorkers = 4;
    const int limit = thread_limit.load();
    const int wanted = limit > 0 ? std::min(limit, kWorkers) : kWorkers;
    return static_cast<int>(std::min<std::size_t>(n_pieces, static_cast<std::size_t>(wanted)));
}

}  // namespace

struct ThreadLimit::State {
    explicit State(int n) : previous(thread_limit.exchange(n)) {}
    ~State() { thread_limit.store(previous); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    int previous;
};

ThreadLimit::ThreadLimit(int n_threads) {
    if (n_threads < 0)
        fail<InvalidOption>("threads is ", n_threads, ", must be 0 (all) or more");
    if (n_threads > 0)
        state_ = std::make_unique<State>(n_threads);
}

ThreadLimit::~ThreadLimit() = default;

void parallel_for(std::size_t begin, std::size_t end, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
    if (begin >= end)
        return;
    const std::size_t step = std::max<std::size_t>(1, grain);
    const std::size_t n_pieces = (end - begin + step - 1) / step;
    std::atomic<std::size_t> next{0};
    std::exception_ptr thrown;
    std::mutex guard;
    const auto work = [&] {
        for (std::size_t piece = next++; piece < n_pieces; piece = next++) {
            try {
                const std::size_t first = begin + piece * step;
                body(first, std::min(end, first + step));
            } catch (...) {
                const std::lock_guard lock(guard);
                thrown = std::current_exception();
                next = n_pieces;
            }
        }
    };
    std::vector<std::thread> workers;
    for (int i = 1; i < n_workers(n_pieces); ++i)
        workers.emplace_back(work);
    work();
    for (std::thread& worker : workers)
        worker.join();
    if (thrown)
        std::rethrow_exception(thrown);
}

void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second) {
    parallel_for(0, 2, 1, [&](std::size_t piece, std::size_t) { piece == 0 ? first() : second(); });
}

}  // namespace scree
