#include "meshing/mesh/decimation.h"

#include "meshing/mesh/adjacency.h"
#include "meshing/mesh/bounds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <glm/geometric.hpp>

namespace scree::meshing {
namespace {

using HalfEdges = OpenMesh::TriConnectivity;  // places stay in the TriMesh
using Handle = OpenMesh::SmartVertexHandle;
using Half = OpenMesh::SmartHalfedgeHandle;

constexpr double kMostTurn = 0.5;      // cosine of 60 degrees
constexpr double kLeastQuality = 0.1;  // below it no collapse may make a triangle worse
constexpr double kLeastUp = 0.02;      // height of the unit normal, with keep_up
constexpr double kRimWeight = 10.0;    // corners of a rim outlast what is inside

// A weighted sum of squared distances to planes and points (Garland and Heckbert 1997).
struct Quadric {
    // x^T A x + 2 b^T x + c, A symmetric
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    glm::dvec3 b{0.0};
    double c = 0;

    void add_plane(const glm::dvec3& n, const glm::dvec3& through, double weight) {
        const double d = -glm::dot(n, through);
        xx += weight * n.x * n.x;
        xy += weight * n.x * n.y;
        xz += weight * n.x * n.z;
        yy += weight * n.y * n.y;
        yz += weight * n.y * n.z;
        zz += weight * n.z * n.z;
        b += weight * d * n;
        c += weight * d * d;
    }
    void add_point(const glm::dvec3& p, double weight) {
        xx += weight;
        yy += weight;
        zz += weight;
        b -= weight * p;
        c += weight * glm::dot(p, p);
    }
    void add(const Quadric& other) {
        xx += other.xx;
        xy += other.xy;
        xz += other.xz;
        yy += other.yy;
        yz += other.yz;
        zz += other.zz;
        b += other.b;
        c += other.c;
    }
    double at(const glm::dvec3& p) const {
        return p.x * (xx * p.x + 2 * (xy * p.y + xz * p.z)) + p.y * (yy * p.y + 2 * yz * p.z) +
               zz * p.z * p.z + 2 * glm::dot(b, p) + c;
    }
};

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

// 1 for an equilateral triangle, 0 for one without area.
double quality(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 u = b - a, v = c - a, w = c - b;
    const double squares = glm::dot(u, u) + glm::dot(v, v) + glm::dot(w, w);
    return squares > 0.0 ? 2.0 * std::sqrt(3.0) * glm::length(glm::cross(u, v)) / squares : 0.0;
}

class Decimator {
public:
    Decimator(const TriMesh& mesh, const DecimationOptions& options)
        : options_(options), stamps_(mesh.positions.size()), quadrics_(mesh.positions.size()) {
        const Box box = bounding_box(mesh);
        const glm::dvec3 middle = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
        places_.reserve(mesh.positions.size());
        for (const glm::vec3& p : mesh.positions) {
            places_.push_back(glm::dvec3(p) - middle);  // small numbers keep the quadrics exact
            edges_.add_vertex();
        }
        for (const glm::uvec3& t : mesh.triangles) {
            const auto corner = [&](int k) {
                return OpenMesh::VertexHandle(static_cast<int>(t[k]));
            };
            edges_.add_face(corner(0), corner(1), corner(2));
        }
        edges_.request_vertex_status();
        edges_.request_edge_status();
        edges_.request_halfedge_status();
        edges_.request_face_status();
        measure(mesh);
    }

    DecimationReport run() {
        DecimationReport report;
        const auto target = static_cast<std::size_t>(options_.vertices);
        n_left_ = places_.size();
        for (std::size_t before = n_left_ + 1; n_left_ > target && n_left_ < before;) {
            before = n_left_;
            sweep(target);  // again while there is progress: what was illegal may be legal now
        }
        report.n_collapsed = places_.size() - n_left_;
        report.reached = n_left_ <= target;
        return report;
    }

    // The triangles that are left, in their old order, corners in theirs.
    void take_back(TriMesh& mesh, DecimationReport& report) const {
        std::vector<std::uint32_t> now(places_.size());
        for (std::uint32_t v = 0; v < places_.size(); ++v) {
            if (handle(v).deleted())
                continue;
            now[v] = static_cast<std::uint32_t>(report.kept_vertices.size());
            report.kept_vertices.push_back(v);
        }
        TriMesh left;
        for (const std::uint32_t v : report.kept_vertices) {
            left.positions.push_back(mesh.positions[v]);
            if (!mesh.texcoords.empty())
                left.texcoords.push_back(mesh.texcoords[v]);
        }
        for (const auto face : edges_.faces()) {  // passes over deleted ones
            glm::uvec3 t;
            int k = 0;
            for (const Handle& v : face.vertices())
                t[k++] = now[static_cast<std::size_t>(v.idx())];
            left.triangles.push_back(t);
        }
        mesh = std::move(left);
    }

private:
    using Entry = std::tuple<double, std::uint32_t, std::uint32_t, std::uint64_t>;

    Handle handle(std::uint32_t v) const {
        return OpenMesh::make_smart(OpenMesh::VertexHandle(static_cast<int>(v)), edges_);
    }
    static std::uint32_t index(const Handle& v) { return static_cast<std::uint32_t>(v.idx()); }
    const glm::dvec3& at(const Handle& v) const { return places_[index(v)]; }

    void measure(const TriMesh& mesh) {
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::dvec3 twice =
                glm::cross(places_[t.y] - places_[t.x], places_[t.z] - places_[t.x]);
            const double share = glm::length(twice) / 6.0;
            for (int k = 0; k < 3; ++k) {
                quadrics_[t[k]].add_plane(unit(twice), places_[t.x], share);
                quadrics_[t[k]].add_point(places_[t[k]], options_.evenness * share);
            }
        }
        for (const auto half : edges_.halfedges()) {
            if (!half.is_boundary())
                continue;
            const glm::dvec3 along = at(half.to()) - at(half.from());
            const glm::dvec3 inside = at(half.opp().next().to()) - at(half.from());
            const glm::dvec3 across = unit(glm::cross(along, glm::cross(along, inside)));
            for (const Handle& v : {half.from(), half.to()})
                quadrics_[index(v)].add_plane(across, at(half.from()),
                                              kRimWeight * glm::dot(along, along));
        }
    }

    double cost(std::uint32_t from, std::uint32_t to) const {
        Quadric both = quadrics_[from];
        both.add(quadrics_[to]);
        return std::max(0.0, both.at(places_[to]));
    }

    // The cheaper direction of an edge.
    void push(std::uint32_t a, std::uint32_t b) {
        if (a > b)
            std::swap(a, b);
        const double there = cost(a, b), back = cost(b, a);
        const std::uint64_t stamp = stamps_[a] + stamps_[b];
        if (there <= back)
            queue_.emplace(there, a, b, stamp);
        else
            queue_.emplace(back, b, a, stamp);
    }

    void sweep(std::size_t target) {
        for (const auto edge : edges_.edges())
            push(index(edge.v0()), index(edge.v1()));
        while (!queue_.empty() && n_left_ > target) {
            const auto [price, from, to, stamp] = queue_.top();
            queue_.pop();
            if (handle(from).deleted() || handle(to).deleted() ||
                stamps_[from] + stamps_[to] != stamp)
                continue;  // an edit has changed it
            const Half half = edges_.find_halfedge(handle(from), handle(to));
            if (half.is_valid() && !try_collapse(half))
                try_collapse(half.opp());
        }
        queue_ = {};
    }

    // The ends share the corners that face the edge and nothing else, and rims stay rims.
    bool keeps_topology(const Half& half) {  // OpenMesh marks vertices as it looks
        const bool along_rim = half.edge().is_boundary();
        if (half.from().is_boundary() && !along_rim)
            return false;
        // The last triangle of a piece, and the last three sides of a rim.
        if (along_rim && half.to().valence() + half.from().valence() <= 4)
            return false;
        return edges_.is_collapse_ok(half);
    }

    // No triangle around `moved` turns far, stands up or becomes a sliver when it goes to `to`.
    bool keeps_shape(const Handle& moved, const Handle& to) const {
        for (const Half& out : moved.outgoing_halfedges()) {
            if (out.is_boundary())
                continue;
            const Handle b = out.to();
            const Handle c = out.next().to();
            if (b == to || c == to)
                continue;
            const glm::dvec3 was = unit(glm::cross(at(b) - at(moved), at(c) - at(moved)));
            const glm::dvec3 is = unit(glm::cross(at(b) - at(to), at(c) - at(to)));
            if (glm::dot(is, is) == 0.0 ||
                (glm::dot(was, was) > 0.0 && glm::dot(was, is) < kMostTurn))
                return false;
            if (options_.keep_up && was.y > 0.0 && is.y < std::min(kLeastUp, was.y))
                return false;
            const double after = quality(at(to), at(b), at(c));
            if (after < kLeastQuality && after < quality(at(moved), at(b), at(c)))
                return false;
        }
        return true;
    }

    bool try_collapse(const Half& half) {
        const Handle gone = half.from();
        const Handle stays = half.to();
        if (!keeps_topology(half) || !keeps_shape(gone, stays))
            return false;
        quadrics_[index(stays)].add(quadrics_[index(gone)]);
        ++stamps_[index(stays)];
        edges_.collapse(half);
        --n_left_;
        for (const Handle& w : stays.vertices())
            push(index(stays), index(w));
        return true;
    }

    const DecimationOptions& options_;
    HalfEdges edges_;
    std::vector<glm::dvec3> places_;
    std::vector<std::uint64_t> stamps_;  // collapses onto each vertex
    std::vector<Quadric> quadrics_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
    std::size_t n_left_ = 0;
};

// Before half-edges are made: OpenMesh says what it cannot hold to the console.
void check_manifold(const TriMesh& mesh) {
    const Adjacency adjacency = build_adjacency(mesh);
    for (std::size_t v = 0; v < adjacency.n_vertices(); ++v)
        if (adjacency.irregular[v] != 0)
            fail<InvalidInput>("around vertex ", v,
                               " the mesh is no oriented manifold; clean it first");
}

}  // namespace

DecimationReport decimate(TriMesh& mesh, const DecimationOptions& options) {
    check(options);
    check_mesh(mesh);
    mesh.normals.clear();
    if (mesh.triangles.empty())
        fail<InvalidInput>("the mesh has no triangle to decimate");
    check_manifold(mesh);
    Decimator decimator(mesh, options);
    DecimationReport report = decimator.run();
    decimator.take_back(mesh, report);
    return report;
}

}  // namespace scree::meshing
