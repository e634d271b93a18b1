#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace scree {

/// While it lives, parallel loops use at most this many threads.
///
/// Results never depend on it. Limits nest; the smallest one holds.
class ThreadLimit {
public:
    /// @param n_threads  At least 1; 0 leaves the machine's own count.
    explicit ThreadLimit(int n_threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Call `body(first, last)` for pieces that together cover [begin, end), in parallel.
///
/// Pieces are `grain` indices long whatever the thread count, so a body that writes only to the
/// slots of its own indices gives the same result on every run. An exception ends the loop and
/// is thrown again here.
void parallel_for(std::size_t begin, std::size_t end, std::size_t grain,
                  const std::function<void(std::size_t first, std::size_t last)>& body);

/// Call `body(i)` for every i in [begin, end), in parallel, `grain` indices at a time.
template <class Body>
void parallel_for_each_index(std::size_t begin, std::size_t end, std::size_t grain, Body&& body) {
    parallel_for(begin, end, grain, [&body](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            body(i);
    });
}

/// Run both, possibly at the same time.
void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second);

}  // namespace scree
