#include "vision/classical/merge_tree.h"

#include <algorithm>
#include <queue>
#include <tuple>
#include <unordered_map>

namespace scree::vision {
namespace {

struct Contact {
    int a = -1;  // -1 once the contact is gone
    int b = -1;
    BorderStats border;
    float pass = 0;
};

constexpr float kStandsOut = 0.15F;  // least height of a peak over its pass

void add_side(BorderStats& stats, float strength, float depth) {
    stats.depth += depth;
    stats.length += 1;
    stats.sum += strength;
    stats.weak += strength < 0.25F ? 1.0F : 0.0F;
    stats.middling += strength < 0.5F ? 1.0F : 0.0F;
}

void subtract_twice(BorderStats& stats, const BorderStats& o) {
    stats.length -= 2 * o.length;
    stats.sum -= 2 * o.sum;
    stats.weak -= 2 * o.weak;
    stats.middling -= 2 * o.middling;
    stats.depth -= 2 * o.depth;
}

void add_pixel(AreaStats& s, int x, int y, const EdgeField& field, float luma) {
    const double px = x + 0.5, py = y + 0.5;
    s.area += 1;
    s.x += px;
    s.y += py;
    s.xx += px * px;
    s.yy += py * py;
    s.xy += px * py;
    s.inside += field.inside(x, y);
    s.boundary += field.boundary(x, y);
    s.distance += field.distance(x, y);
    s.luma += luma;
    s.luma2 += luma * luma;
    s.deepest = std::max(s.deepest, field.distance(x, y));
}

// Contacts between basins, found by a key of the two numbers, kept in order of first sight.
class Contacts {
public:
    Contact& between(int a, int b) {
        const auto [low, high] = std::minmax(a, b);
        const auto key = static_cast<std::uint64_t>(low) << 32U | static_cast<std::uint32_t>(high);
        const auto [at, fresh] = index_.try_emplace(key, list.size());
        if (fresh)
            list.push_back({low, high, {}});
        return list[at->second];
    }

    std::vector<Contact> list;

private:
    std::unordered_map<std::uint64_t, std::size_t> index_;
};

class Builder {
public:
    Builder(const BasinMap& basins, const EdgeField& field, const FloatRaster& luma)
        : basins_(basins), field_(field) {
        tree_.n_basins = basins.count;
        tree_.nodes.resize(static_cast<std::size_t>(basins.count));
        tree_.nodes.reserve(static_cast<std::size_t>(2 * basins.count));
        measure(luma);
        touching_.resize(tree_.nodes.size());
        for (std::size_t i = 0; i < contacts_.list.size(); ++i) {
            touching_[static_cast<std::size_t>(contacts_.list[i].a)].push_back(i);
            touching_[static_cast<std::size_t>(contacts_.list[i].b)].push_back(i);
            push(i);
        }
    }

    MergeTree merged(float highest) {
        while (!queue_.empty()) {
            const auto [height, contact, version] = queue_.top();
            queue_.pop();
            if (contacts_.list[contact].a < 0 || version != version_[contact])
                continue;
            if (height > highest)
                break;
            unite(contact, height);
        }
        return std::move(tree_);
    }

private:
    using Entry = std::tuple<float, std::size_t, int>;  // height, contact, version of the contact

    void measure(const FloatRaster& luma) {
        const auto& labels = basins_.labels;
        for (int y = 0; y < labels.height(); ++y)
            for (int x = 0; x < labels.width(); ++x) {
                const int label = labels(x, y);
                if (label != kNoBasin)
                    add_pixel(node(label).pixels, x, y, field_, luma(x, y));
                side(x, y, x + 1, y);
                side(x, y, x, y + 1);
                if (label != kNoBasin)
                    node(label).frame += static_cast<float>((x == 0) + (y == 0));
            }
    }

    void side(int x, int y, int u, int v) {
        const auto& labels = basins_.labels;
        const int a = labels(x, y);
        if (!labels.contains(u, v)) {
            if (a != kNoBasin)
                node(a).frame += 1;
            return;
        }
        const int b = labels(u, v);
        if (a == b)
            return;
        const float strength = std::max(field_.boundary(x, y), field_.boundary(u, v));
        const float depth = std::min(field_.distance(x, y), field_.distance(u, v));
        for (const int label : {a, b})
            if (label != kNoBasin) {
                add_side(node(label).outer, strength, depth);
                if (a == kNoBasin || b == kNoBasin)
                    add_side(node(label).open, strength, depth);
            }
        if (a != kNoBasin && b != kNoBasin) {
            Contact& contact = contacts_.between(a, b);
            add_side(contact.border, strength, depth);
            contact.pass = std::max(contact.pass, depth);
        }
    }

    RegionNode& node(int i) { return tree_.nodes[static_cast<std::size_t>(i)]; }

    void push(std::size_t contact) {
        version_.resize(std::max(version_.size(), contact + 1), 0);
        queue_.emplace(contacts_.list[contact].border.mean(), contact, ++version_[contact]);
    }

    void unite(std::size_t contact, float height) {
        const auto [a, b, border, pass] = contacts_.list[contact];
        const int c = static_cast<int>(tree_.nodes.size());
        tree_.nodes.push_back(node(a));
        RegionNode& whole = tree_.nodes.back();
        const RegionNode& other = node(b);
        whole.left = a;
        whole.right = b;
        whole.height = height;
        whole.pass = pass;
        const float stands = std::min(whole.pixels.deepest, other.pixels.deepest) - pass;
        whole.split = std::max({whole.split, other.split, stands});
        whole.peaks += other.peaks - (stands < kStandsOut ? 1 : 0);
        whole.pixels += other.pixels;
        whole.outer += other.outer;
        subtract_twice(whole.outer, border);
        whole.open += other.open;
        whole.removed += other.removed;
        whole.removed += border;
        whole.frame += other.frame;
        whole.strongest = std::max({whole.strongest, other.strongest, height});
        node(a).parent = node(b).parent = c;
        contacts_.list[contact].a = -1;
        rewire(a, b, c);
    }

    // Contacts of both parts become contacts of the whole; two with the same neighbour become one.
    void rewire(int a, int b, int c) {
        touching_.emplace_back();
        seen_.resize(tree_.nodes.size(), kNone);
        std::vector<std::size_t> kept;
        for (const int part : {a, b})
            for (const std::size_t i : touching_[static_cast<std::size_t>(part)]) {
                Contact& contact = contacts_.list[i];
                if (contact.a < 0)
                    continue;
                const int neighbour = contact.a == part ? contact.b : contact.a;
                std::size_t& twin = seen_[static_cast<std::size_t>(neighbour)];
                if (twin == kNone) {
                    contact = {c, neighbour, contact.border, contact.pass};
                    twin = i;
                    kept.push_back(i);
                } else {
                    contacts_.list[twin].border += contact.border;
                    contacts_.list[twin].pass = std::max(contacts_.list[twin].pass, contact.pass);
                    contact.a = -1;
                    push(twin);
                }
            }
        for (const std::size_t i : kept)
            seen_[static_cast<std::size_t>(contacts_.list[i].b)] = kNone;
        touching_[static_cast<std::size_t>(a)].clear();
        touching_[static_cast<std::size_t>(b)].clear();
        touching_[static_cast<std::size_t>(c)] = std::move(kept);
    }

    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    const BasinMap& basins_;
    const EdgeField& field_;
    MergeTree tree_;
    Contacts contacts_;
    std::vector<std::vector<std::size_t>> touching_;  // contacts of each region
    std::vector<std::size_t> seen_;
    std::vector<int> version_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

BorderStats& BorderStats::operator+=(const BorderStats& o) {
    length += o.length;
    sum += o.sum;
    weak += o.weak;
    middling += o.middling;
    depth += o.depth;
    return *this;
}

AreaStats& AreaStats::operator+=(const AreaStats& o) {
    area += o.area;
    x += o.x;
    y += o.y;
    xx += o.xx;
    yy += o.yy;
    xy += o.xy;
    inside += o.inside;
    boundary += o.boundary;
    distance += o.distance;
    luma += o.luma;
    luma2 += o.luma2;
    deepest = std::max(deepest, o.deepest);
    return *this;
}

MergeTree build_merge_tree(const BasinMap& basins, const EdgeField& field, const FloatRaster& luma,
                           float highest) {
    return Builder(basins, field, luma).merged(highest);
}

}  // namespace scree::vision
