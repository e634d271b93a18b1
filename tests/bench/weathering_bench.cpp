// Weathering of triangle meshes: weathering/<what>/<vertices>. SCREE_BENCH_MESH names an OBJ, PLY,
// OFF, STL or GLB file to measure instead of a lumpy sphere of as many vertices as the Stanford
// bunny; its size then stands in the name.
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "meshing/curvature/mean_curvature.h"
#include "meshing/io/mesh_io.h"
#include "meshing/mesh/cleaning.h"
#include "meshing/mesh/normals.h"
#include "terrain/surface/weathering.h"
#include "tests/support/sphere_meshes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <malloc.h>
#include <map>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <benchmark/benchmark.h>

namespace {

using namespace scree;
using meshing::CurvatureMethod;
using meshing::TriMesh;
using OpenMeshType = OpenMesh::TriMesh_ArrayKernelT<>;

constexpr std::size_t kBunny = 34834;
constexpr glm::dvec3 kAxes(1.0, 0.8, 0.6);

std::map<std::size_t, TriMesh>& bodies() {
    static std::map<std::size_t, TriMesh> known;
    return known;
}

const TriMesh& body(std::size_t n) {
    TriMesh& mesh = bodies()[n];
    if (mesh.positions.empty())
        mesh = test::lumpy_sphere(n);
    return mesh;
}

// Vertices of the body that is measured with the baselines.
std::size_t main_size() {
    const char* const path = std::getenv("SCREE_BENCH_MESH");
    if (path == nullptr)
        return kBunny;
    TriMesh mesh = meshing::read_mesh(path).mesh;
    meshing::clean_mesh(mesh, {.weld = true});
    const std::size_t n = mesh.positions.size();
    bodies()[n] = std::move(mesh);
    return n;
}

std::size_t bytes_in_use() {
    return mallinfo2().uordblks + mallinfo2().hblkhd;
}

void note_bytes(benchmark::State& state, std::size_t before, std::size_t n_vertices) {
    state.counters["bytes_per_vertex"] =
        static_cast<double>(bytes_in_use() - before) / static_cast<double>(n_vertices);
}

// Curvature, umbrella vectors and displacement.
void step(benchmark::State& state) {
    TriMesh mesh = body(static_cast<std::size_t>(state.range(0)));
    const std::size_t before = bytes_in_use();
    const auto adjacency = meshing::build_adjacency(mesh);
    terrain::StepScratch scratch;
    for (auto _ : state)
        terrain::weathering_step(mesh, adjacency, {}, scratch);
    note_bytes(state, before, mesh.positions.size());
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

// The same with removal of small faces and a test for self-intersections after every step.
void step_checked(benchmark::State& state) {
    const TriMesh& mesh = body(static_cast<std::size_t>(state.range(0)));
    const std::size_t before = bytes_in_use();
    terrain::Weathering run(mesh, {.steps = 1'000'000, .check_every = 1});
    run.advance();
    for (auto _ : state)
        run.advance();
    // The run's own copy of the mesh is not beyond it.
    const std::size_t own = 12 * mesh.positions.size() + 12 * mesh.triangles.size();
    note_bytes(state, before + own, mesh.positions.size());
    state.counters["collapsed"] = static_cast<double>(run.report().n_collapsed);
    state.counters["restarts"] = run.report().restarts;
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

double rms_error(const TriMesh& mesh, const std::vector<float>& curvature) {
    double sum = 0.0;
    for (std::size_t v = 0; v < curvature.size(); ++v) {
        const double exact = test::ellipsoid_mean_curvature(glm::dvec3(mesh.positions[v]), kAxes);
        sum += std::pow(static_cast<double>(curvature[v]) / exact - 1.0, 2);
    }
    return std::sqrt(sum / static_cast<double>(curvature.size()));
}

// An estimator on one thread; its error on the ellipsoid 1 : 0.8 : 0.6 through random points.
void curvature(benchmark::State& state, CurvatureMethod method) {
    const auto n = static_cast<std::size_t>(state.range(0));
    const ThreadLimit one(1);
    const TriMesh mesh = test::ellipsoid(test::random_sphere_points(n, 1), kAxes);
    const auto adjacency = meshing::build_adjacency(mesh);
    const auto normals = meshing::vertex_normals(mesh, adjacency);
    std::vector<float> result(n);
    meshing::CurvatureScratch scratch;
    for (auto _ : state)
        meshing::mean_curvature(mesh, adjacency, normals, method, scratch, result);
    state.counters["rms_error"] = rms_error(mesh, result);
}

OpenMeshType half_edges_of(const TriMesh& mesh) {
    OpenMeshType result;
    std::vector<OpenMeshType::VertexHandle> handles;
    for (const glm::vec3& p : mesh.positions)
        handles.push_back(result.add_vertex({p.x, p.y, p.z}));
    for (const glm::uvec3& t : mesh.triangles)
        result.add_face(handles[t.x], handles[t.y], handles[t.z]);
    result.request_face_normals();
    result.request_vertex_normals();
    result.update_normals();
    return result;
}

double own_step_seconds(const TriMesh& start) {
    TriMesh mesh = start;
    const auto adjacency = meshing::build_adjacency(mesh);
    terrain::StepScratch scratch;
    double best = 1e9;
    for (int i = 0; i < 20; ++i) {
        Stopwatch watch;
        terrain::weathering_step(mesh, adjacency, {}, scratch);
        best = std::min(best, watch.lap());
    }
    return best;
}

// How many of our steps fit into one iteration, both at their best.
void note_ratio(benchmark::State& state, double best, const TriMesh& mesh) {
    state.counters["ratio_to_step"] = best / own_step_seconds(mesh);
}

// The cotangent form written as a loop over OpenMesh's half-edges: curvature alone.
void openmesh_cotan(benchmark::State& state) {
    const TriMesh& mesh = body(static_cast<std::size_t>(state.range(0)));
    OpenMeshType half_edges = half_edges_of(mesh);
    std::vector<double> result(half_edges.n_vertices());
    double best = 1e9;
    for (auto _ : state) {
        Stopwatch watch;
        for (const auto v : half_edges.vertices()) {
            OpenMesh::Vec3d sum(0, 0, 0);
            double area = 0.0;
            const OpenMesh::Vec3d here(half_edges.point(v));
            for (const auto h : v.outgoing_halfedges()) {
                const OpenMesh::Vec3d a(half_edges.point(h.to()));
                const OpenMesh::Vec3d b(half_edges.point(h.next().to()));
                const OpenMesh::Vec3d c(half_edges.point(h.opp().next().to()));
                const double twice = ((a - here) % (b - here)).norm();
                const double at_b = dot(here - b, a - b) / twice;
                const double at_c = dot(here - c, a - c) / ((a - here) % (c - here)).norm();
                sum += (at_b + at_c) * (here - a);
                area += twice / 6.0;
            }
            result[static_cast<std::size_t>(v.idx())] =
                dot(sum, OpenMesh::Vec3d(half_edges.normal(v))) / (4.0 * area);
        }
        best = std::min(best, watch.lap());
        benchmark::DoNotOptimize(result.data());
    }
    note_ratio(state, best, mesh);
}

// OpenMesh's own Laplacian smoother, one iteration.
void openmesh_smoother(benchmark::State& state) {
    const TriMesh& mesh = body(static_cast<std::size_t>(state.range(0)));
    OpenMeshType half_edges = half_edges_of(mesh);
    using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<OpenMeshType>;
    Smoother smoother(half_edges);
    smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C0);
    double best = 1e9;
    for (auto _ : state) {
        Stopwatch watch;
        smoother.smooth(1);
        best = std::min(best, watch.lap());
    }
    note_ratio(state, best, mesh);
}

void add(const char* name, std::int64_t n, void (*body_of)(benchmark::State&)) {
    benchmark::RegisterBenchmark((std::string("weathering/") + name).c_str(), body_of)
        ->Arg(n)
        ->Unit(benchmark::kMillisecond);
}

const bool kRegistered = [] {
    const auto n = static_cast<std::int64_t>(main_size());
    add("step", n, step);
    add("step_checked", n, step_checked);
    add("curvature_quadric", n,
        [](benchmark::State& state) { curvature(state, CurvatureMethod::Quadric); });
    add("curvature_tensor", n,
        [](benchmark::State& state) { curvature(state, CurvatureMethod::Tensor); });
    add("curvature_cotangent", n,
        [](benchmark::State& state) { curvature(state, CurvatureMethod::Cotangent); });
    add("openmesh_cotan", n, openmesh_cotan);
    add("openmesh_smoother", n, openmesh_smoother);
    for (const std::int64_t larger : {250'000, 500'000, 1'000'000, 2'000'000}) {
        add("step", larger, step);
        add("step_checked", larger, step_checked);
    }
    return true;
}();

}  // namespace
