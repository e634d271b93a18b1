#pragma once

#include <cstdint>

namespace scree {

/// Names one stream of random numbers: the same key gives the same numbers on every machine,
/// whatever was drawn before and on whichever thread.
struct RandomKey {
    std::uint64_t seed = 0;    ///< Chosen by the user.
    std::uint64_t stream = 0;  ///< What the numbers are for; a constant of the caller.
    std::uint64_t step = 0;    ///< Iteration, or 0.
    std::uint64_t cell = 0;    ///< Element, or 0.
};

/// Small keyed generator (SplitMix64). No standard distributions: they differ between libraries.
class Rng {
public:
    explicit Rng(const RandomKey& key);

    std::uint64_t bits();                     ///< 64 random bits.
    double uniform();                         ///< In [0, 1).
    double uniform(double low, double high);  ///< In [low, high).
    std::uint64_t below(std::uint64_t n);     ///< In [0, n), unbiased. @pre n > 0.
    double normal();                          ///< Mean 0, variance 1.

private:
    std::uint64_t state_;
};

}  // namespace scree
