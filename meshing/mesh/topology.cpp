#include "meshing/mesh/topology.h"

#include "meshing/mesh/weld.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

using HalfEdgeMesh = OpenMesh::TriConnectivity;  // places stay in the TriMesh

// A side of a triangle: its lower and higher place, and which corner of which triangle starts it.
struct Side {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t corner;  // 3 * triangle + corner
    bool forward;          // runs from low to high

    bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

// By lower place, then higher one, then corner. Few sides share a lower place, so they are dealt
// out to it first.
std::vector<Side> sorted_sides(const TriMesh& mesh) {
    const std::size_t n_sides = 3 * mesh.triangles.size();
    const auto side = [&](std::uint32_t corner) {
        const glm::uvec3& t = mesh.triangles[corner / 3];
        const std::uint32_t a = t[static_cast<int>(corner % 3)];
        const std::uint32_t b = t[static_cast<int>((corner + 1) % 3)];
        return Side{std::min(a, b), std::max(a, b), corner, a < b};
    };
    std::vector<std::uint32_t> end(mesh.positions.size() + 1, 0);
    for (std::uint32_t c = 0; c < n_sides; ++c)
        ++end[side(c).low + 1];
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<Side> sides(n_sides);
    for (std::uint32_t c = 0; c < n_sides; ++c)
        sides[end[side(c).low]++] = side(c);
    std::size_t first = 0;
    for (std::size_t place = 0; place < mesh.positions.size(); first = end[place++])
        std::sort(sides.begin() + static_cast<std::ptrdiff_t>(first),
                  sides.begin() + static_cast<std::ptrdiff_t>(end[place]),
                  [](const Side& a, const Side& b) {
                      return std::tie(a.high, a.corner) < std::tie(b.high, b.corner);
                  });
    return sides;
}

// Corners of triangles, joined into the fans around their places.
class Fans {
public:
    explicit Fans(std::size_t n_corners) : parent_(n_corners) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    std::uint32_t find(std::uint32_t c) {
        while (parent_[c] != c)
            c = parent_[c] = parent_[parent_[c]];
        return c;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t x = find(a);
        const std::uint32_t y = find(b);
        parent_[std::max(x, y)] = std::min(x, y);
    }

private:
    std::vector<std::uint32_t> parent_;
};

std::uint32_t next_corner(std::uint32_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

// What the list of edges alone tells; joins the fans of triangles that share an edge.
struct EdgeFacts {
    std::size_t n_edges = 0;
    bool closed = true;
    bool manifold = true;
    bool oriented = true;
};

EdgeFacts look_at_edges(const std::vector<Side>& sides, Fans& fans) {
    EdgeFacts facts;
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].same_edge(sides[i]))
            ++end;
        ++facts.n_edges;
        facts.closed &= end - i == 2;
        facts.manifold &= end - i <= 2;
        for (std::size_t j = i + 1; j < end; ++j) {
            const Side& a = sides[i];
            const Side& b = sides[j];
            const bool opposed = a.forward != b.forward;
            facts.oriented &= opposed;
            fans.join(a.corner, opposed ? next_corner(b.corner) : b.corner);
            fans.join(next_corner(a.corner), opposed ? b.corner : next_corner(b.corner));
        }
        i = end;
    }
    facts.closed &= !sides.empty();
    return facts;
}

// One half-edge vertex a fan, so that every triangle can be added.
HalfEdgeMesh half_edges_of(const TriMesh& mesh, Fans& fans) {
    HalfEdgeMesh half_edges;
    std::vector<HalfEdgeMesh::VertexHandle> vertex(3 * mesh.triangles.size());
    for (std::uint32_t c = 0; c < vertex.size(); ++c)
        vertex[c] = fans.find(c) == c ? half_edges.add_vertex() : vertex[fans.find(c)];
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        half_edges.add_face(vertex[3 * t], vertex[3 * t + 1], vertex[3 * t + 2]);
    return half_edges;
}

std::size_t count_boundaries(const HalfEdgeMesh& mesh) {
    std::vector<bool> seen(mesh.n_halfedges(), false);
    std::size_t loops = 0;
    for (const auto start : mesh.halfedges()) {
        if (!start.is_boundary() || seen[static_cast<std::size_t>(start.idx())])
            continue;
        ++loops;
        for (auto h = start; !seen[static_cast<std::size_t>(h.idx())]; h = h.next())
            seen[static_cast<std::size_t>(h.idx())] = true;
    }
    return loops;
}

std::size_t count_pieces(const HalfEdgeMesh& mesh) {
    std::vector<bool> seen(mesh.n_faces(), false);
    std::vector<OpenMesh::SmartFaceHandle> open;
    std::size_t pieces = 0;
    for (const auto start : mesh.faces()) {
        if (seen[static_cast<std::size_t>(start.idx())])
            continue;
        ++pieces;
        seen[static_cast<std::size_t>(start.idx())] = true;
        open.assign(1, start);
        while (!open.empty()) {
            const auto face = open.back();
            open.pop_back();
            for (const auto& neighbour : face.faces()) {
                if (!seen[static_cast<std::size_t>(neighbour.idx())]) {
                    seen[static_cast<std::size_t>(neighbour.idx())] = true;
                    open.push_back(neighbour);
                }
            }
        }
    }
    return pieces;
}

std::size_t count_thin(const TriMesh& mesh) {
    return static_cast<std::size_t>(
        std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const glm::uvec3& t) {
            const glm::dvec3 a(mesh.positions[t.x]);
            const glm::dvec3 normal = glm::cross(glm::dvec3(mesh.positions[t.y]) - a,
                                                 glm::dvec3(mesh.positions[t.z]) - a);
            return glm::dot(normal, normal) == 0.0;
        }));
}

std::size_t count_used(const TriMesh& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const glm::uvec3& t : mesh.triangles)
        used[t.x] = used[t.y] = used[t.z] = true;
    return static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
}

std::size_t count_fans(Fans& fans, std::size_t n_corners) {
    std::size_t n = 0;
    for (std::uint32_t c = 0; c < n_corners; ++c)
        n += fans.find(c) == c ? 1U : 0U;
    return n;
}

// All of the report that needs no half-edges.
TopologyReport report_without_half_edges(const TriMesh& mesh, const TriMesh& welded, Fans& fans) {
    TopologyReport report;
    report.n_vertices = count_used(welded);
    report.n_triangles = welded.triangles.size();
    report.n_collapsed = mesh.triangles.size() - welded.triangles.size();
    report.n_thin = count_thin(welded);
    const EdgeFacts facts = look_at_edges(sorted_sides(welded), fans);
    report.n_edges = facts.n_edges;
    report.closed = facts.closed;
    report.oriented = facts.oriented && facts.manifold;
    report.manifold =
        report.oriented && count_fans(fans, 3 * welded.triangles.size()) == report.n_vertices;
    return report;
}

// The side of a triangle that a vertex looks at.
struct Opposite {
    std::uint32_t from;
    std::uint32_t to;
};

bool is_one_ring(std::span<const Opposite> sides) {
    std::size_t at = 0;
    for (std::size_t n_seen = 1; n_seen <= sides.size(); ++n_seen) {
        const auto next = std::find_if(sides.begin(), sides.end(), [&](const Opposite& side) {
            return side.from == sides[at].to;
        });
        if (next == sides.end())
            return false;
        at = static_cast<std::size_t>(next - sides.begin());
        if (at == 0)
            return n_seen == sides.size();
    }
    return false;
}

// Whether the triangles around every place form one ring: then the mesh is closed, oriented and
// manifold. A quick look that says no as well where very many triangles meet.
bool is_plainly_closed(const TriMesh& welded) {
    constexpr std::uint32_t kMostAtAPlace = 64;
    std::vector<std::uint32_t> end(welded.positions.size() + 1, 0);
    for (const glm::uvec3& t : welded.triangles)
        for (int k = 0; k < 3; ++k)
            ++end[t[k] + 1];
    if (std::any_of(end.begin(), end.end(), [](std::uint32_t n) { return n > kMostAtAPlace; }))
        return false;
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<Opposite> sides(3 * welded.triangles.size());
    for (const glm::uvec3& t : welded.triangles)
        for (int k = 0; k < 3; ++k)
            sides[end[t[k]]++] = {t[(k + 1) % 3], t[(k + 2) % 3]};
    std::size_t first = 0;
    for (std::size_t place = 0; place < welded.positions.size(); first = end[place++])
        if (first < end[place] && !is_one_ring(std::span(sides).subspan(first, end[place] - first)))
            return false;
    return true;
}

}  // namespace

TopologyReport analyse_topology(const TriMesh& mesh) {
    check_mesh(mesh);
    const TriMesh welded = weld(mesh);
    Fans fans(3 * welded.triangles.size());
    TopologyReport report = report_without_half_edges(mesh, welded, fans);
    if (!report.oriented)
        return report;
    const HalfEdgeMesh half_edges = half_edges_of(welded, fans);
    report.n_boundaries = count_boundaries(half_edges);
    report.n_pieces = count_pieces(half_edges);
    if (report.closed && report.manifold) {
        const auto euler = static_cast<long long>(report.n_vertices) -
                           static_cast<long long>(report.n_edges) +
                           static_cast<long long>(report.n_triangles);
        report.genus = static_cast<int>(static_cast<long long>(report.n_pieces) - euler / 2);
    }
    return report;
}

std::string solid_defect(const TriMesh& mesh) {
    check_mesh(mesh);
    if (mesh.triangles.empty())
        return "the mesh has no triangle";
    const TriMesh welded = weld(mesh);
    if (welded.triangles.size() == mesh.triangles.size() && count_thin(welded) == 0 &&
        is_plainly_closed(welded) && signed_volume(mesh) > 0.0)
        return {};
    Fans fans(3 * welded.triangles.size());
    const TopologyReport report = report_without_half_edges(mesh, welded, fans);
    if (report.n_collapsed > 0)
        return std::to_string(report.n_collapsed) + " triangles name one place twice";
    if (report.n_thin > 0)
        return std::to_string(report.n_thin) + " triangles have no area";
    if (!report.closed)
        return "the mesh is not closed: some edge has not two triangles";
    if (!report.oriented)
        return "neighbouring triangles disagree on which side is out";
    if (!report.manifold)
        return "the mesh touches itself at a vertex";
    if (!(signed_volume(mesh) > 0.0))
        return "the mesh encloses no positive volume";
    return {};
}

}  // namespace scree::meshing
