#include "meshing/mesh/small_faces.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/mesh/half_edge_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>

#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

constexpr std::size_t kGrain = 4096;
constexpr int kMostPasses = 8;
constexpr double kSliverShare = 0.1;  // of the shortest edge: lower triangles are slivers
constexpr double kMostTurn = 0.5;     // cosine of 60 degrees

using Handle = OpenMesh::SmartVertexHandle;
using Half = OpenMesh::SmartHalfedgeHandle;

struct Seeds {
    std::vector<std::array<std::uint32_t, 2>> edges;  // the lower vertex first
    std::vector<std::uint32_t> slivers;               // triangles

    bool empty() const { return edges.empty() && slivers.empty(); }
};

glm::dvec3 normal_of(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::dvec3 origin(a);
    return glm::cross(glm::dvec3(b) - origin, glm::dvec3(c) - origin);
}

double square_between(const glm::vec3& a, const glm::vec3& b) {
    const glm::dvec3 d = glm::dvec3(a) - glm::dvec3(b);
    return glm::dot(d, d);
}

bool is_sliver(const TriMesh& mesh, const glm::uvec3& t, double shortest) {
    const glm::vec3& a = mesh.positions[t.x];
    const glm::vec3& b = mesh.positions[t.y];
    const glm::vec3& c = mesh.positions[t.z];
    const std::array<double, 3> squares = {square_between(a, b), square_between(b, c),
                                           square_between(c, a)};
    const auto [least, most] = std::minmax_element(squares.begin(), squares.end());
    const glm::dvec3 normal = normal_of(a, b, c);
    const double low = kSliverShare * shortest;
    return *least >= shortest * shortest && glm::dot(normal, normal) < low * low * *most;
}

Seeds find_seeds(const TriMesh& mesh, const Adjacency& adjacency, double shortest) {
    const std::size_t n = mesh.positions.size();
    std::vector<Seeds> pieces((std::max(n, mesh.triangles.size()) + kGrain - 1) / kGrain);
    parallel_for_each_index(0, pieces.size(), 1, [&](std::size_t i) {
        const std::size_t first = i * kGrain;
        for (std::size_t v = first; v < std::min(n, first + kGrain); ++v)
            for (const std::uint32_t w : adjacency.neighbours_of(v))
                if (w > v &&
                    square_between(mesh.positions[v], mesh.positions[w]) < shortest * shortest)
                    pieces[i].edges.push_back({static_cast<std::uint32_t>(v), w});
        for (std::size_t t = first; t < std::min(mesh.triangles.size(), first + kGrain); ++t)
            if (is_sliver(mesh, mesh.triangles[t], shortest))
                pieces[i].slivers.push_back(static_cast<std::uint32_t>(t));
    });
    Seeds all;
    for (const Seeds& piece : pieces) {
        all.edges.insert(all.edges.end(), piece.edges.begin(), piece.edges.end());
        all.slivers.insert(all.slivers.end(), piece.slivers.begin(), piece.slivers.end());
    }
    return all;
}

// The seeds' vertices and all around them, without those where the mesh is no manifold.
std::vector<std::uint32_t> core_of(const TriMesh& mesh, const Adjacency& adjacency,
                                   const Seeds& seeds) {
    std::vector<std::uint32_t> core;
    const auto add = [&](std::uint32_t v) {
        core.push_back(v);
        const auto ring = adjacency.neighbours_of(v);
        core.insert(core.end(), ring.begin(), ring.end());
    };
    for (const auto& edge : seeds.edges) {
        add(edge[0]);
        add(edge[1]);
    }
    for (const std::uint32_t t : seeds.slivers)
        for (int k = 0; k < 3; ++k)
            add(mesh.triangles[t][k]);
    std::sort(core.begin(), core.end());
    core.erase(std::unique(core.begin(), core.end()), core.end());
    std::erase_if(core, [&](std::uint32_t v) { return adjacency.irregular[v] != 0; });
    return core;
}

// Edits of one patch.
class Editor {
public:
    Editor(HalfEdgePatch& patch, double shortest, SmallFaceReport& report)
        : patch_(patch), shortest_(shortest), report_(report) {}

    void drop_tetrahedra(const Seeds& seeds) {
        for (const auto& edge : seeds.edges) {
            const Handle v = patch_.find(edge[0]);
            if (v.is_valid() && !v.deleted() && is_small_tetrahedron(v))
                drop_piece(v);
        }
    }

    void collapse_edges(const Seeds& seeds) {
        for (const auto& edge : seeds.edges) {
            const Handle a = patch_.find(edge[0]);
            const Handle b = patch_.find(edge[1]);
            if (a.is_valid() && b.is_valid())
                push(a, b);
        }
        while (!queue_.empty()) {
            const auto [square, first, second] = queue_.top();
            queue_.pop();
            const Handle a = patch_.find(first);
            const Handle b = patch_.find(second);
            if (a.deleted() || b.deleted() || square_between(patch_.at(a), patch_.at(b)) != square)
                continue;  // an edit has changed it
            const Half half = patch_.edges.find_halfedge(a, b);
            if (half.is_valid())
                try_collapse(half);
        }
    }

    void turn_slivers(const Seeds& seeds) {
        for (const std::uint32_t t : seeds.slivers) {
            const auto at = std::lower_bound(patch_.triangle.begin(), patch_.triangle.end(), t);
            if (at == patch_.triangle.end() || *at != t)
                continue;
            const auto face = OpenMesh::make_smart(
                OpenMesh::FaceHandle(static_cast<int>(at - patch_.triangle.begin())), patch_.edges);
            if (!face.deleted())
                try_turn(face);
        }
    }

private:
    using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;

    void push(const Handle& a, const Handle& b) {
        const double square = square_between(patch_.at(a), patch_.at(b));
        if (square < shortest_ * shortest_ && patch_.free(a) && patch_.free(b))
            queue_.emplace(square, std::min(patch_.name(a), patch_.name(b)),
                           std::max(patch_.name(a), patch_.name(b)));
    }

    bool is_small_tetrahedron(const Handle& v) const {
        const auto closed_three = [&](const Handle& w) {
            return patch_.free(w) && w.valence() == 3 && !w.is_boundary();
        };
        if (!closed_three(v))
            return false;
        std::vector<Handle> all = {v};
        for (const Handle& w : v.vertices())
            all.push_back(w);
        for (const Handle& a : all)
            for (const Handle& b : all)
                if (!closed_three(b) ||
                    square_between(patch_.at(a), patch_.at(b)) >= shortest_ * shortest_ ||
                    (a != b && !patch_.edges.find_halfedge(a, b).is_valid()))
                    return false;
        return true;
    }

    void drop_piece(const Handle& v) {
        std::vector<OpenMesh::SmartFaceHandle> faces;
        for (const Handle& w : v.vertices())
            for (const auto& face : w.faces())
                faces.push_back(face);
        for (const auto& face : faces)
            if (!face.deleted())
                patch_.edges.delete_face(face, true);
        ++report_.n_vanished;
    }

    // By the mesh's own names: copies of a border vertex are the same one.
    std::vector<std::uint32_t> ring_names(const Handle& v) const {
        std::vector<std::uint32_t> names;
        for (const Handle& w : v.vertices())
            names.push_back(patch_.name(w));
        std::sort(names.begin(), names.end());
        return names;
    }

    // The link condition: the ends share the corners that face the edge and nothing else.
    bool keeps_topology(const Half& half) const {
        if (!patch_.edges.is_collapse_ok(half))
            return false;
        const auto a = ring_names(half.from());
        const auto b = ring_names(half.to());
        std::vector<std::uint32_t> common;
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
        const std::size_t n_faces =
            (half.is_boundary() ? 0U : 1U) + (half.opp().is_boundary() ? 0U : 1U);
        return common.size() == n_faces;
    }

    // No triangle that stays turns far or loses its area when `moved` goes to `target`.
    bool keeps_shape(const Handle& moved, const Handle& other, const glm::vec3& target) const {
        const double least = 1e-10 * shortest_ * shortest_;  // 1e-12 e_avg^2
        for (const Half& out : moved.outgoing_halfedges()) {
            if (out.is_boundary())
                continue;
            const Handle b = out.to();
            const Handle c = out.next().to();
            if (b == other || c == other)
                continue;
            const glm::dvec3 before = normal_of(patch_.at(moved), patch_.at(b), patch_.at(c));
            const glm::dvec3 after = normal_of(target, patch_.at(b), patch_.at(c));
            const double lengths = glm::length(before) * glm::length(after);
            if (0.5 * glm::length(after) < least ||
                (lengths > 0.0 && glm::dot(before, after) < kMostTurn * lengths))
                return false;
        }
        return true;
    }

    void try_collapse(Half half) {
        const bool from_rim = half.from().is_boundary();
        const bool to_rim = half.to().is_boundary();
        // The end that stays: the one on the rim, else the one listed first.
        if (from_rim != to_rim ? from_rim : patch_.name(half.from()) < patch_.name(half.to()))
            half = half.opp();
        const Handle gone = half.from();
        const Handle stays = half.to();
        const glm::vec3 target =
            from_rim || to_rim
                ? patch_.at(stays)
                : glm::vec3(0.5 * (glm::dvec3(patch_.at(gone)) + glm::dvec3(patch_.at(stays))));
        if (!keeps_topology(half) || !keeps_shape(gone, stays, target) ||
            !keeps_shape(stays, gone, target))
            return;
        patch_.edges.collapse(half);
        patch_.position[static_cast<std::size_t>(stays.idx())] = target;
        ++report_.n_collapsed;
        for (const Handle& w : stays.vertices())
            push(stays, w);
    }

    void try_turn(const OpenMesh::SmartFaceHandle& face) {
        Half longest = face.halfedge();
        for (const Half& half : face.halfedges())
            if (square_between(patch_.at(half.from()), patch_.at(half.to())) >
                square_between(patch_.at(longest.from()), patch_.at(longest.to())))
                longest = half;
        if (longest.edge().is_boundary() || !patch_.edges.is_flip_ok(longest.edge()))
            return;
        const Handle a = longest.from();
        const Handle b = longest.to();
        const Handle c = longest.next().to();
        const Handle d = longest.opp().next().to();
        if (!patch_.free(c) && !patch_.free(d))
            return;  // they may be joined outside the patch
        const auto ring = ring_names(patch_.free(c) ? c : d);
        if (std::binary_search(ring.begin(), ring.end(), patch_.name(patch_.free(c) ? d : c)))
            return;
        const glm::dvec3 whole = normal_of(patch_.at(b), patch_.at(a), patch_.at(d));
        const glm::dvec3 first = normal_of(patch_.at(a), patch_.at(d), patch_.at(c));
        const glm::dvec3 second = normal_of(patch_.at(d), patch_.at(b), patch_.at(c));
        const glm::dvec3 old = normal_of(patch_.at(a), patch_.at(b), patch_.at(c));
        const auto agrees = [&](const glm::dvec3& n) {
            return glm::dot(n, whole) > kMostTurn * glm::length(n) * glm::length(whole) &&
                   glm::length(n) > glm::length(old);
        };
        if (!agrees(first) || !agrees(second))
            return;
        patch_.edges.flip(longest.edge());
        ++report_.n_flipped;
    }

    HalfEdgePatch& patch_;
    double shortest_;
    SmallFaceReport& report_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

void write_positions(TriMesh& mesh, const HalfEdgePatch& patch) {
    for (std::size_t i = 0; i < patch.vertex.size(); ++i)
        if (patch.is_free[i] != 0)
            mesh.positions[patch.vertex[i]] = patch.position[i];
}

// Put what the patch became back into the mesh and close the gaps.
void write_back(TriMesh& mesh, const HalfEdgePatch& patch, SmallFaceReport& report) {
    write_positions(mesh, patch);
    std::vector<std::uint8_t> gone(mesh.triangles.size(), 0);
    for (const auto face : patch.edges.all_faces()) {
        const std::uint32_t t = patch.triangle[static_cast<std::size_t>(face.idx())];
        if (face.deleted()) {
            gone[t] = 1;
            continue;
        }
        int k = 0;
        for (const Handle& v : face.vertices())
            mesh.triangles[t][k++] = patch.name(v);
    }
    std::vector<std::uint8_t> vertex_gone(mesh.positions.size(), 0);
    for (const auto v : patch.edges.all_vertices())
        if (v.deleted() && patch.free(v))
            vertex_gone[patch.name(v)] = 1;
    std::vector<std::uint32_t> new_index(mesh.positions.size());
    std::uint32_t n = 0;
    for (std::uint32_t v = 0; v < new_index.size(); ++v) {
        new_index[v] = n;
        if (vertex_gone[v] != 0)
            continue;
        mesh.positions[n] = mesh.positions[v];
        if (!mesh.texcoords.empty())
            mesh.texcoords[n] = mesh.texcoords[v];
        report.kept_vertices[n++] = report.kept_vertices[v];
    }
    mesh.positions.resize(n);
    mesh.texcoords.resize(mesh.texcoords.empty() ? 0 : n);
    report.kept_vertices.resize(n);
    n = 0;
    for (std::uint32_t t = 0; t < gone.size(); ++t) {
        if (gone[t] != 0)
            continue;
        const glm::uvec3& old = mesh.triangles[t];
        mesh.triangles[n] = {new_index[old.x], new_index[old.y], new_index[old.z]};
        report.kept_triangles[n++] = report.kept_triangles[t];
    }
    mesh.triangles.resize(n);
    report.kept_triangles.resize(n);
}

// Whether anything changed.
bool run_pass(TriMesh& mesh, Adjacency& adjacency, const Seeds& seeds, double shortest,
              const std::function<void()>& before_change, SmallFaceReport& report) {
    HalfEdgePatch patch(mesh, adjacency, core_of(mesh, adjacency, seeds));
    if (!patch.whole)
        return false;
    SmallFaceReport done;
    Editor editor(patch, shortest, done);
    editor.drop_tetrahedra(seeds);
    editor.collapse_edges(seeds);
    editor.turn_slivers(seeds);
    if (done.n_collapsed + done.n_flipped + done.n_vanished == 0)
        return false;
    if (!report.changed) {
        if (before_change)
            before_change();
        report.kept_triangles.resize(mesh.triangles.size());
        report.kept_vertices.resize(mesh.positions.size());
        std::iota(report.kept_triangles.begin(), report.kept_triangles.end(), 0U);
        std::iota(report.kept_vertices.begin(), report.kept_vertices.end(), 0U);
        mesh.normals.clear();
        report.changed = true;
    }
    report.n_collapsed += done.n_collapsed;
    report.n_flipped += done.n_flipped;
    report.n_vanished += done.n_vanished;
    write_back(mesh, patch, report);
    adjacency = build_adjacency(mesh);
    return true;
}

}  // namespace

SmallFaceReport remove_small_faces(TriMesh& mesh, Adjacency& adjacency, double shortest,
                                   const std::function<void()>& before_change) {
    if (adjacency.n_vertices() != mesh.positions.size())
        fail<InvalidInput>("the mesh has ", mesh.positions.size(), " vertices, its adjacency ",
                           adjacency.n_vertices());
    SmallFaceReport report;
    for (int pass = 0; pass < kMostPasses; ++pass) {
        const Seeds seeds = find_seeds(mesh, adjacency, shortest);
        report.n_blocked = seeds.edges.size();
        if (seeds.empty() || !run_pass(mesh, adjacency, seeds, shortest, before_change, report))
            break;
    }
    return report;
}

}  // namespace scree::meshing
