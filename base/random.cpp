#include "base/random.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace scree {
namespace {

std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ULL;

}  // namespace

Rng::Rng(const RandomKey& key) : state_(mix(key.seed + kStep)) {
    state_ = mix(state_ ^ mix(key.stream + 2 * kStep));
    state_ = mix(state_ ^ mix(key.step + 3 * kStep));
    state_ = mix(state_ ^ mix(key.cell + 4 * kStep));
}

std::uint64_t Rng::bits() {
    state_ += kStep;
    return mix(state_);
}

double Rng::uniform() {
    return static_cast<double>(bits() >> 11) * 0x1.0p-53;
}

double Rng::uniform(double low, double high) {
    return low + (high - low) * uniform();
}

std::uint64_t Rng::below(std::uint64_t n) {
    assert(n > 0);
    const std::uint64_t limit = std::numeric_limits<std::uint64_t>::max() / n * n;
    std::uint64_t draw = bits();
    while (draw >= limit)
        draw = bits();
    return draw % n;
}

double Rng::normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

}  // namespace scree
