#include "meshing/mesh/adjacency.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

constexpr std::size_t kGrain = 4096;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMaxTriangles = std::size_t{1} << 30;
// Above this many spokes, looking one up by going through all of them would be quadratic.
constexpr std::size_t kFewSpokes = 24;

// A triangle seen from one of its vertices: the edges towards `next` and `previous` bound it.
struct Spoke {
    std::uint32_t next = 0;
    std::uint32_t previous = 0;
    std::uint32_t corner = 0;
};

// Orders the triangles around one vertex; keeps its memory for the next vertex.
class FanSorter {
public:
    std::vector<Spoke> spokes;              // in: any order
    std::vector<std::uint32_t> corners;     // out: in fan order
    std::vector<std::uint32_t> neighbours;  // out
    bool rim = false;
    bool irregular = false;

    void sort() {
        corners.clear();
        neighbours.clear();
        rim = irregular = false;
        if (spokes.empty())
            return;
        used_.assign(spokes.size(), 0);
        if (spokes.size() > kFewSpokes)
            index_spokes();
        std::size_t n_fans = 0;
        for (std::size_t i = 0; i < spokes.size(); ++i)  // open fans begin at a rim
            if (used_[i] == 0 && !has_previous(spokes[i].next)) {
                follow(i);
                ++n_fans;
            }
        rim = n_fans > 0;
        for (std::size_t i = 0; i < spokes.size(); ++i)
            if (used_[i] == 0) {
                follow(i);
                ++n_fans;
            }
        irregular = n_fans != 1;
        drop_repeated();
    }

private:
    void index_spokes() {
        by_next_.resize(spokes.size());
        by_previous_.resize(spokes.size());
        for (std::uint32_t i = 0; i < spokes.size(); ++i) {
            by_next_[i] = {spokes[i].next, i};
            by_previous_[i] = spokes[i].previous;
        }
        std::sort(by_next_.begin(), by_next_.end());
        std::sort(by_previous_.begin(), by_previous_.end());
        skip_.assign(spokes.size(), 0);
    }

    bool has_previous(std::uint32_t vertex) const {
        if (spokes.size() > kFewSpokes)
            return std::binary_search(by_previous_.begin(), by_previous_.end(), vertex);
        return std::any_of(spokes.begin(), spokes.end(),
                           [&](const Spoke& s) { return s.previous == vertex; });
    }

    // The first spoke not yet used that starts at the vertex.
    std::size_t unused_from(std::uint32_t vertex) {
        if (spokes.size() <= kFewSpokes) {
            for (std::size_t i = 0; i < spokes.size(); ++i)
                if (spokes[i].next == vertex && used_[i] == 0)
                    return i;
            return kNone;
        }
        const auto group = std::lower_bound(by_next_.begin(), by_next_.end(),
                                            std::pair<std::uint32_t, std::uint32_t>(vertex, 0));
        std::uint32_t& skip = skip_[static_cast<std::size_t>(group - by_next_.begin()) %
                                    spokes.size()];  // used ones at the group's head
        for (auto it = group + skip; it < by_next_.end() && it->first == vertex; ++it, ++skip)
            if (used_[it->second] == 0)
                return it->second;
        return kNone;
    }

    void follow(std::size_t i) {
        const std::uint32_t start = spokes[i].next;
        std::uint32_t end = start;
        while (i != kNone) {
            used_[i] = 1;
            corners.push_back(spokes[i].corner);
            neighbours.push_back(spokes[i].next);
            end = spokes[i].previous;
            i = end == start ? kNone : unused_from(end);
        }
        if (end != start) {
            neighbours.push_back(end);
            rim = true;
        }
    }

    void drop_repeated() {
        const auto repeats = [this] {
            if (neighbours.size() > kFewSpokes) {
                sorted_ = neighbours;
                std::sort(sorted_.begin(), sorted_.end());
                return std::adjacent_find(sorted_.begin(), sorted_.end()) != sorted_.end();
            }
            for (std::size_t i = 1; i < neighbours.size(); ++i)
                for (std::size_t j = 0; j < i; ++j)
                    if (neighbours[i] == neighbours[j])
                        return true;
            return false;
        };
        if (!repeats())
            return;
        rim = irregular = true;
        std::sort(neighbours.begin(), neighbours.end());
        neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    }

    std::vector<std::uint8_t> used_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_next_;
    std::vector<std::uint32_t> by_previous_;
    std::vector<std::uint32_t> skip_;
    std::vector<std::uint32_t> sorted_;
};

void check_triangles(const TriMesh& mesh) {
    const std::size_t n = mesh.positions.size();
    if (mesh.triangles.size() > kMaxTriangles)
        fail<InvalidInput>("the mesh has ", mesh.triangles.size(), " triangles, at most ",
                           kMaxTriangles, " are supported");
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& t = mesh.triangles[i];
        if (t.x >= n || t.y >= n || t.z >= n)
            fail<InvalidInput>("triangle ", i, " names vertex ", std::max({t.x, t.y, t.z}),
                               ", the mesh has ", n);
        if (t.x == t.y || t.y == t.z || t.z == t.x)
            fail<InvalidInput>("triangle ", i, " names vertex ", t.x == t.y ? t.x : t.z,
                               " twice; clean the mesh first");
    }
}

// Corners dealt out to their vertices, in the order of the mesh.
void deal_corners(const TriMesh& mesh, Adjacency& out) {
    out.first_corner.assign(mesh.positions.size() + 1, 0);
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            ++out.first_corner[t[k] + 1];
    std::partial_sum(out.first_corner.begin(), out.first_corner.end(), out.first_corner.begin());
    out.corners.resize(3 * mesh.triangles.size());
    std::uint32_t corner = 0;
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            out.corners[out.first_corner[t[k]]++] = corner++;
    // Every start has moved to the next one's.
    std::move_backward(out.first_corner.begin(), out.first_corner.end() - 1,
                       out.first_corner.end());
    out.first_corner.front() = 0;
}

// Neighbours found in one piece of the vertices, before it is known where they go.
using Piece = std::vector<std::uint32_t>;

void sort_piece(const TriMesh& mesh, Adjacency& out, std::size_t first, std::size_t last,
                Piece& piece) {
    FanSorter fan;
    piece.reserve(7 * (last - first));
    for (std::size_t v = first; v < last; ++v) {
        fan.spokes.clear();
        for (const std::uint32_t c : out.corners_of(v)) {
            const glm::uvec3 t = vertices_from(mesh, c);
            fan.spokes.push_back({t.y, t.z, c});
        }
        fan.sort();
        std::copy(fan.corners.begin(), fan.corners.end(),
                  out.corners.begin() + out.first_corner[v]);
        out.first_neighbour[v + 1] = static_cast<std::uint32_t>(fan.neighbours.size());
        out.rim[v] = fan.rim ? 1 : 0;
        out.irregular[v] = fan.irregular ? 1 : 0;
        piece.insert(piece.end(), fan.neighbours.begin(), fan.neighbours.end());
    }
}

}  // namespace

Adjacency build_adjacency(const TriMesh& mesh) {
    check_triangles(mesh);
    const std::size_t n = mesh.positions.size();
    Adjacency out;
    deal_corners(mesh, out);
    out.first_neighbour.assign(n + 1, 0);
    out.rim.assign(n, 0);
    out.irregular.assign(n, 0);
    std::vector<Piece> pieces((n + kGrain - 1) / kGrain);
    parallel_for_each_index(0, pieces.size(), 1, [&](std::size_t i) {
        sort_piece(mesh, out, i * kGrain, std::min(n, (i + 1) * kGrain), pieces[i]);
    });
    std::partial_sum(out.first_neighbour.begin(), out.first_neighbour.end(),
                     out.first_neighbour.begin());
    out.neighbours.resize(out.first_neighbour[n]);
    parallel_for_each_index(0, pieces.size(), 1, [&](std::size_t i) {
        std::copy(pieces[i].begin(), pieces[i].end(),
                  out.neighbours.begin() + out.first_neighbour[i * kGrain]);
    });
    return out;
}

std::uint32_t triangle_across(const TriMesh& mesh, const Adjacency& adjacency,
                              std::uint32_t corner) {
    const glm::uvec3 own = vertices_from(mesh, corner);
    for (const std::uint32_t c : adjacency.corners_of(own.y)) {
        const glm::uvec3 t = vertices_from(mesh, c);
        if (c / 3 != corner / 3 && (t.y == own.z || t.z == own.z))
            return c / 3;
    }
    return kNoFace;
}

double mean_edge_length(const TriMesh& mesh, const Adjacency& adjacency) {
    const std::size_t n = adjacency.n_vertices();
    std::vector<double> sums((n + kGrain - 1) / kGrain, 0.0);
    parallel_for_each_index(0, sums.size(), 1, [&](std::size_t piece) {
        double sum = 0.0;
        for (std::size_t v = piece * kGrain; v < std::min(n, (piece + 1) * kGrain); ++v)
            for (const std::uint32_t w : adjacency.neighbours_of(v))
                if (w > v) {
                    const glm::dvec3 edge(mesh.positions[w] - mesh.positions[v]);
                    sum += std::sqrt(glm::dot(edge, edge));
                }
        sums[piece] = sum;
    });
    const double total = std::accumulate(sums.begin(), sums.end(), 0.0);
    return adjacency.n_edges() == 0 ? 0.0 : total / static_cast<double>(adjacency.n_edges());
}

}  // namespace scree::meshing
