#include "vision/thesis/thinning.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace scree::vision {
namespace {

// Bit i of a code is neighbour i: north, then clockwise.
bool deletable(unsigned code, int subiteration) {
    const auto on = [code](int i) { return static_cast<int>((code >> (i % 8)) & 1U); };
    int crossings = 0;
    int pairs_first = 0;
    int pairs_second = 0;
    for (int i = 0; i < 8; i += 2) {
        crossings += (on(i) == 0 && (on(i + 1) | on(i + 2)) != 0) ? 1 : 0;
        pairs_first += on(i + 7) | on(i);
        pairs_second += on(i) | on(i + 1);
    }
    const int pairs = std::min(pairs_first, pairs_second);
    const int side = subiteration == 0 ? ((on(4) | on(5) | (1 - on(7))) & on(6))
                                       : ((on(0) | on(1) | (1 - on(3))) & on(2));
    return crossings == 1 && pairs >= 2 && pairs <= 3 && side == 0;
}

using Table = std::array<bool, 256>;

Table table_of(int subiteration) {
    Table table{};
    for (unsigned code = 0; code < 256; ++code)
        table[code] = deletable(code, subiteration);
    return table;
}

Mask padded(const Mask& edges) {
    Mask result(edges.width() + 2, edges.height() + 2);
    for (int y = 0; y < edges.height(); ++y)
        for (int x = 0; x < edges.width(); ++x)
            result(x + 1, y + 1) = edges(x, y) != 0 ? 1 : 0;
    return result;
}

}  // namespace

Mask thinned(const Mask& edges) {
    Mask work = padded(edges);
    const std::array<Table, 2> tables{table_of(0), table_of(1)};
    const std::ptrdiff_t row = work.width();
    const std::array<std::ptrdiff_t, 8> around{-row, 1 - row, 1,  row + 1,
                                               row,  row - 1, -1, -row - 1};
    std::vector<std::ptrdiff_t> pixels;
    for (std::size_t i = 0; i < work.size(); ++i)
        if (work.data()[i] != 0)
            pixels.push_back(static_cast<std::ptrdiff_t>(i));

    std::vector<std::ptrdiff_t> doomed;
    bool changed = true;
    while (changed) {
        changed = false;
        for (const Table& table : tables) {
            doomed.clear();
            std::size_t n_kept = 0;
            for (const std::ptrdiff_t p : pixels) {
                unsigned code = 0;
                for (unsigned i = 0; i < 8; ++i)
                    code |= static_cast<unsigned>(work.data()[p + around[i]]) << i;
                if (table[code])
                    doomed.push_back(p);
                else
                    pixels[n_kept++] = p;
            }
            pixels.resize(n_kept);
            for (const std::ptrdiff_t p : doomed)
                work.data()[p] = 0;
            changed = changed || !doomed.empty();
        }
    }
    Mask result(edges.width(), edges.height());
    for (int y = 0; y < edges.height(); ++y)
        for (int x = 0; x < edges.width(); ++x)
            result(x, y) = work(x + 1, y + 1);
    return result;
}

}  // namespace scree::vision
