#include "meshing/mesh/cleaning.h"

#include "meshing/mesh/weld.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

// A side of a triangle and the corner that it starts at.
struct Side {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t corner;

    auto key() const { return std::tie(low, high, corner); }
    bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

std::uint32_t next_corner(std::uint32_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

std::uint32_t vertex_at(const TriMesh& mesh, std::uint32_t corner) {
    return mesh.triangles[corner / 3][static_cast<int>(corner % 3)];
}

std::vector<Side> sorted_sides(const TriMesh& mesh) {
    std::vector<Side> sides(3 * mesh.triangles.size());
    for (std::uint32_t c = 0; c < sides.size(); ++c) {
        const std::uint32_t a = vertex_at(mesh, c);
        const std::uint32_t b = vertex_at(mesh, next_corner(c));
        sides[c] = {std::min(a, b), std::max(a, b), c};
    }
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.key() < b.key(); });
    return sides;
}

// Call body(first, last) for the sides of every edge.
template <class Body>
void for_each_edge(const std::vector<Side>& sides, Body&& body) {
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].same_edge(sides[i]))
            ++end;
        body(i, end);
        i = end;
    }
}

void weld_vertices(TriMesh& mesh, CleanReport& report) {
    const std::vector<std::uint32_t> map = weld_map(mesh);
    std::vector<std::uint32_t> first;  // vertex of each place
    for (std::uint32_t v = 0; v < map.size(); ++v)
        if (map[v] == first.size())
            first.push_back(v);
    report.n_welded = map.size() - first.size();
    if (report.n_welded == 0)
        return;
    for (glm::uvec3& t : mesh.triangles)
        t = {first[map[t.x]], first[map[t.y]], first[map[t.z]]};
}

bool has_no_area(const TriMesh& mesh, const glm::uvec3& t) {
    if (t.x == t.y || t.y == t.z || t.z == t.x)
        return true;
    const glm::dvec3 a(mesh.positions[t.x]);
    const glm::dvec3 u = glm::dvec3(mesh.positions[t.y]) - a;
    const glm::dvec3 v = glm::dvec3(mesh.positions[t.z]) - a;
    const glm::dvec3 normal = glm::cross(u, v);
    return !(glm::dot(normal, normal) > 1e-24 * glm::dot(u, u) * glm::dot(v, v));
}

void drop_useless(TriMesh& mesh, CleanReport& report) {
    report.n_degenerate =
        std::erase_if(mesh.triangles, [&](const glm::uvec3& t) { return has_no_area(mesh, t); });
    using Key = std::array<std::uint32_t, 4>;  // vertices in order, then the place in the list
    std::vector<Key> keys;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& t = mesh.triangles[i];
        Key key = {t.x, t.y, t.z, i};
        std::sort(key.begin(), key.begin() + 3);
        keys.push_back(key);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint8_t> repeated(mesh.triangles.size(), 0);
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (std::equal(keys[i].begin(), keys[i].begin() + 3, keys[i - 1].begin()))
            repeated[keys[i][3]] = 1;
    std::size_t i = 0;
    report.n_duplicate =
        std::erase_if(mesh.triangles, [&](const glm::uvec3&) { return repeated[i++] != 0; });
}

// Triangles over edges that two of them share, for a walk over a piece.
std::vector<std::uint32_t> corner_across(const std::vector<Side>& sides) {
    constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    std::vector<std::uint32_t> across(sides.size(), kNone);
    for_each_edge(sides, [&](std::size_t first, std::size_t last) {
        if (last - first != 2)
            return;
        across[sides[first].corner] = sides[first + 1].corner;
        across[sides[first + 1].corner] = sides[first].corner;
    });
    return across;
}

// Make each piece agree with its majority, and a closed mesh face outwards.
void orient(TriMesh& mesh, CleanReport& report) {
    const std::vector<std::uint32_t> across = corner_across(sorted_sides(mesh));
    enum : std::uint8_t { kUnseen, kKept, kTurned };
    std::vector<std::uint8_t> state(mesh.triangles.size(), kUnseen);
    std::vector<std::uint32_t> piece;
    for (std::uint32_t start = 0; start < state.size(); ++start) {
        if (state[start] != kUnseen)
            continue;
        piece.assign(1, start);
        state[start] = kKept;
        for (std::size_t i = 0; i < piece.size(); ++i)
            for (std::uint32_t c = 3 * piece[i]; c < 3 * piece[i] + 3; ++c) {
                const std::uint32_t other = across[c];
                if (other == 0xFFFFFFFFU || state[other / 3] != kUnseen)
                    continue;
                // Both sides start at one vertex: the neighbour faces the other way.
                const bool against = vertex_at(mesh, c) == vertex_at(mesh, other);
                state[other / 3] = against == (state[piece[i]] == kKept) ? kTurned : kKept;
                piece.push_back(other / 3);
            }
        const auto n_turned = static_cast<std::size_t>(std::count_if(
            piece.begin(), piece.end(), [&](std::uint32_t t) { return state[t] == kTurned; }));
        const std::uint8_t minority = 2 * n_turned > piece.size() ? kKept : kTurned;
        for (const std::uint32_t t : piece)
            if (state[t] == minority) {
                std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
                ++report.n_flipped;
            }
    }
    const bool closed = std::find(across.begin(), across.end(), 0xFFFFFFFFU) == across.end();
    if (closed && signed_volume(mesh) < 0.0) {
        for (glm::uvec3& t : mesh.triangles)
            std::swap(t.y, t.z);
        report.n_flipped = mesh.triangles.size() - report.n_flipped;
    }
}

class Fans {
public:
    explicit Fans(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }
    std::uint32_t find(std::uint32_t c) {
        while (parent_[c] != c)
            c = parent_[c] = parent_[parent_[c]];
        return c;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parent_;
};

// Give every fan of triangles a vertex of its own; the first keeps the old one.
void split_fans(TriMesh& mesh, CleanReport& report) {
    const std::vector<Side> sides = sorted_sides(mesh);
    Fans fans(sides.size());
    for_each_edge(sides, [&](std::size_t first, std::size_t last) {
        if (last - first == 1)
            return;
        const std::uint32_t a = sides[first].corner;
        const std::uint32_t b = sides[first + 1].corner;
        if (last - first > 2 || vertex_at(mesh, a) == vertex_at(mesh, b)) {
            ++report.n_cut_edges;
            return;
        }
        fans.join(a, next_corner(b));
        fans.join(next_corner(a), b);
    });
    constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    std::vector<std::uint32_t> vertex_of_fan(sides.size(), kNone);
    std::vector<std::uint8_t> taken(mesh.positions.size(), 0);
    for (std::uint32_t c = 0; c < sides.size(); ++c) {
        std::uint32_t& own = vertex_of_fan[fans.find(c)];
        const std::uint32_t old = vertex_at(mesh, c);
        if (own == kNone && taken[old] == 0) {
            own = old;
            taken[old] = 1;
        } else if (own == kNone) {
            own = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.push_back(glm::vec3(mesh.positions[old]));
            if (!mesh.texcoords.empty())
                mesh.texcoords.push_back(glm::vec2(mesh.texcoords[old]));
            report.source.push_back(old);
            ++report.n_split;
        }
        mesh.triangles[c / 3][static_cast<int>(c % 3)] = own;
    }
}

void drop_unused(TriMesh& mesh, CleanReport& report) {
    std::vector<std::uint8_t> used(mesh.positions.size(), 0);
    for (const glm::uvec3& t : mesh.triangles)
        used[t.x] = used[t.y] = used[t.z] = 1;
    std::vector<std::uint32_t> place(used.size());
    std::uint32_t n = 0;
    for (std::uint32_t v = 0; v < used.size(); ++v) {
        place[v] = n;
        if (used[v] == 0)
            continue;
        mesh.positions[n] = mesh.positions[v];
        if (!mesh.texcoords.empty())
            mesh.texcoords[n] = mesh.texcoords[v];
        report.source[n++] = report.source[v];
    }
    report.n_unused = used.size() - n - report.n_welded;
    mesh.positions.resize(n);
    mesh.texcoords.resize(mesh.texcoords.empty() ? 0 : n);
    report.source.resize(n);
    for (glm::uvec3& t : mesh.triangles)
        t = {place[t.x], place[t.y], place[t.z]};
}

}  // namespace

CleanReport clean_mesh(TriMesh& mesh, const CleanOptions& options) {
    check_mesh(mesh);
    CleanReport report;
    report.source.resize(mesh.positions.size());
    std::iota(report.source.begin(), report.source.end(), 0U);
    mesh.normals.clear();
    if (options.weld)
        weld_vertices(mesh, report);
    drop_useless(mesh, report);
    orient(mesh, report);
    split_fans(mesh, report);
    drop_unused(mesh, report);
    return report;
}

std::string clean_text(const CleanReport& report) {
    std::string text;
    const auto add = [&text](std::size_t n, std::string_view one, std::string_view many) {
        if (n == 0)
            return;
        text += (text.empty() ? "" : ", ") + std::to_string(n) + ' ';
        text += n == 1 ? one : many;
    };
    add(report.n_welded, "vertex joined", "vertices joined");
    add(report.n_degenerate, "triangle without area dropped", "triangles without area dropped");
    add(report.n_duplicate, "repeated triangle dropped", "repeated triangles dropped");
    add(report.n_flipped, "triangle turned round", "triangles turned round");
    add(report.n_cut_edges, "edge cut", "edges cut");
    add(report.n_split, "vertex split", "vertices split");
    add(report.n_unused, "unused vertex dropped", "unused vertices dropped");
    return text;
}

}  // namespace scree::meshing
