#include "meshing/rocks/rock_mesh.h"

#include "base/error.h"
#include "base/parallel.h"
#include "meshing/mesh/weld.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/rock_samples.h"

#include <map>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

constexpr double kPi = std::numbers::pi;

vision::RockSet set_of(const std::vector<vision::Rock>& rocks, int width = 900, int height = 600) {
    vision::RockSet set = test::rock_set(0, 0, width, height);
    set.rocks = rocks;
    return set;
}

RockMesh mesh_of(const vision::Rock& rock, const RockMeshOptions& options = {}) {
    return build_rock_meshes(set_of({rock}), options).at(0);
}

double degrees_between(const glm::vec3& a, const glm::vec3& b) {
    const glm::dvec3 x(a);
    const glm::dvec3 y(b);
    return std::atan2(glm::length(glm::cross(x, y)), glm::dot(x, y)) * 180.0 / kPi;
}

class RockMeshes : public testing::TestWithParam<unsigned> {};  // the parameter is a seed

TEST_P(RockMeshes, AreSolidsForAnyOutline) {
    const unsigned seed = GetParam();
    Rng rng({.seed = seed, .stream = 2});
    std::vector<vision::Rock> rocks;
    for (unsigned i = 0; i < 6; ++i) {
        rocks.push_back(test::jagged_rock({400, 300}, 1e-4, rng.uniform(1, 300), seed * 10 + i));
        rocks.push_back(test::lobed_rock({20, 580}, rng.uniform(2, 200), seed * 10 + i));
        rocks.back().depth = static_cast<float>(std::exp(rng.uniform(-9, 9)));
    }
    for (const bool seam : {false, true}) {
        const auto meshes = build_rock_meshes(
            set_of(rocks), {.max_segments = 3 + static_cast<int>(rng.below(40)),
                            .min_segments = 3,
                            .rings = seam ? 2 + static_cast<int>(rng.below(30)) : 0,
                            .seam = seam});
        for (const RockMesh& rock : meshes) {
            SCOPED_TRACE(rock.source);
            test::expect_valid(rock.mesh);
        }
    }
}

TEST_P(RockMeshes, LieBetweenTheirBounds) {
    for (const RockMesh& rock : build_rock_meshes(test::rock_set(20, GetParam()))) {
        ASSERT_GT(rock.inscribed_radius, 0.0F);
        EXPECT_LE(rock.inscribed_radius, rock.bounding_radius);
        for (const glm::vec3& p : rock.mesh.positions) {
            EXPECT_LE(glm::length(p), rock.bounding_radius);
            EXPECT_GE(glm::length(p), rock.inscribed_radius);
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(p, rock.box_min)));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(p, rock.box_max)));
        }
        for (const glm::uvec3& t : rock.mesh.triangles) {  // points inside the faces, too
            const glm::vec3 middle =
                (rock.mesh.positions[t.x] + rock.mesh.positions[t.y] + rock.mesh.positions[t.z]) /
                3.0F;
            EXPECT_GE(glm::length(middle), rock.inscribed_radius * 0.999999F);
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Seeds, RockMeshes, testing::Range(0U, 12U));

TEST(RockMesh, LiteralGridHasTheCountsOfTheSourceAndStillCloses) {
    const vision::Rock rock = test::lobed_rock({300, 200}, 40, 7);
    const RockMesh literal = mesh_of(rock, {.reading = Reading::Literal});
    EXPECT_EQ(literal.segments, 30);
    EXPECT_EQ(literal.rings, 16);
    EXPECT_EQ(literal.mesh.positions.size(), 527U);
    EXPECT_EQ(literal.mesh.triangles.size(), 992U);
    const TopologyReport report = analyse_topology(literal.mesh);
    EXPECT_EQ(report.n_collapsed, 92U);
    EXPECT_EQ(report.n_triangles, 900U);
    EXPECT_TRUE(report.closed && report.manifold && report.oriented);
    EXPECT_EQ(report.genus, 0);
    EXPECT_GT(signed_volume(literal.mesh), 0.0);
    const RockMesh sound = mesh_of(rock, {.sampling = RadiusSampling::Point});
    EXPECT_NEAR(signed_volume(literal.mesh), signed_volume(sound.mesh),
                0.002 * signed_volume(sound.mesh));
    EXPECT_EQ(sound.mesh.triangles.size(), 900U);
}

TEST(RockMesh, VolumeApproachesTheClosedForm) {
    const vision::Rock rock = test::lobed_rock({300, 200}, 40, 3);
    const double exact = ellipsoid_volume(rock.outline.radii, rock.depth) * 1e-9;
    double last = 1.0;
    for (const int n : {20, 60, 180, 720}) {
        const double off = 1.0 - signed_volume(mesh_of(rock, {.max_segments = n}).mesh) / exact;
        EXPECT_LT(std::abs(off), last);
        last = std::abs(off);
    }
    EXPECT_LT(last, 1e-3);
}

// The table of A.17; its shape is not given, this one reproduces it.
TEST(RockMesh, FewSegmentsLoseTheVolumeOfTheTable) {
    const std::map<int, double> table = {{3, 0.29},  {5, 0.54},  {8, 0.78},   {12, 0.88},
                                         {16, 0.93}, {20, 0.95}, {30, 0.977}, {60, 0.994}};
    const vision::Rock rock = test::rock_of(test::outline_of({300, 200}, [](double a) {
        return 40.0 * (1.0 + 0.2 * std::cos(3 * a) + 0.1 * std::sin(5 * a));
    }));
    const double exact = ellipsoid_volume(rock.outline.radii, rock.depth) * 1e-9;
    for (const auto& [n, share] : table) {
        RockMeshOptions options{.max_segments = n, .min_segments = 3};
        options.sampling = RadiusSampling::Point;
        EXPECT_NEAR(signed_volume(mesh_of(rock, options).mesh) / exact, share, 0.007)
            << n << " segments";
        options.compensate_volume = true;
        EXPECT_NEAR(signed_volume(mesh_of(rock, options).mesh) / exact, 1.0, 1e-5)
            << n << " segments";
    }
}

TEST(RockMesh, SphereHasRadialNormalsAndItsRadius) {
    const vision::Rock ball =
        test::rock_of(test::outline_of({450, 300}, [](double) { return 50; }));
    const RockMesh mesh = mesh_of(ball, {.max_segments = 48});
    for (std::size_t i = 0; i < mesh.mesh.positions.size(); ++i) {
        EXPECT_NEAR(glm::length(mesh.mesh.positions[i]), 0.05, 1e-7);
        EXPECT_LT(degrees_between(mesh.mesh.normals[i], mesh.mesh.positions[i]), 1e-3);
    }
    EXPECT_NEAR(mesh.bounding_radius, 0.05, 1e-6);
    EXPECT_EQ(mesh.position, glm::vec3(0.0F));
}

// A surface point of (3.5) in metres, the picture stretched along each axis.
struct Stretched {
    glm::dvec3 scale;
    double depth;
    double radius(double a) const { return 40.0 * (1.0 + 0.2 * std::cos(3 * a)); }
    glm::dvec3 operator()(double a, double e) const {
        return scale * glm::dvec3(radius(a) * std::cos(a) * std::cos(e), depth * std::sin(e),
                                  radius(a) * std::sin(a) * std::cos(e));
    }
    glm::dvec3 normal(double a, double e) const {  // by differences
        constexpr double kStep = 1e-5;
        const Stretched& x = *this;
        return glm::normalize(
            glm::cross(x(a, e + kStep) - x(a, e - kStep), x(a + kStep, e) - x(a - kStep, e)));
    }
};

struct NormalErrors {
    double mean = 0.0;
    double most = 0.0;
};

// Errors in degrees over the vertices between the poles of a 360 x 16 mesh of that surface.
NormalErrors normal_errors(RockMeshOptions options) {
    options.max_segments = 360;
    options.rings = 16;
    options.region_width = 1.8;  // twice the picture's pixels in millimetres along x
    options.region_depth = 0.6;
    Stretched surface{{0.002, std::hypot(1.8, 0.6) / std::hypot(900.0, 600.0), 0.001}, 22.0};
    vision::Rock rock =
        test::rock_of(test::outline_of({450, 300}, [&](double a) { return surface.radius(a); }));
    rock.depth = static_cast<float>(surface.depth);
    const RockMesh mesh = mesh_of(rock, options);
    const bool literal = options.reading == Reading::Literal;
    NormalErrors errors;
    int n = 0;
    for (int k = 1; k < 16; ++k) {
        for (int s = 0; s < 360; ++s, ++n) {
            const auto i = static_cast<std::size_t>(literal ? k * 361 + s : 1 + (k - 1) * 360 + s);
            const double a = 2.0 * kPi * s / 360;
            const double e = -0.5 * kPi + kPi * k / 16;
            EXPECT_LT(glm::length(glm::dvec3(mesh.mesh.positions[i]) - surface(a, e)), 1e-6);
            const double off =
                degrees_between(mesh.mesh.normals[i], glm::vec3(surface.normal(a, e)));
            errors.mean += off;
            errors.most = std::max(errors.most, off);
        }
    }
    errors.mean /= n;
    return errors;
}

TEST(RockMesh, ExactNormalsAgreeWithDifferences) {
    EXPECT_LT(normal_errors({}).most, 0.1);
}

TEST(RockMesh, PrintedNormalsAreWrong) {
    EXPECT_GT(normal_errors({.reading = Reading::Literal}).mean, 90.0);
}

TEST(RockMesh, ApproximateNormalsPointAwayFromTheCentre) {
    const NormalErrors errors = normal_errors({.normals = NormalForm::Approximate});
    EXPECT_GT(errors.mean, 10.0);
    EXPECT_LT(errors.most, 75.0);
    const RockMesh mesh =
        mesh_of(test::lobed_rock({300, 200}, 40, 7), {.normals = NormalForm::Approximate});
    for (std::size_t i = 0; i < mesh.mesh.positions.size(); ++i)
        EXPECT_LT(degrees_between(mesh.mesh.normals[i], mesh.mesh.positions[i]), 0.01);
}

TEST(RockMesh, TextureCoordinatesPointBackToThePicture) {
    const vision::RockSet set = test::rock_set(30, 5);
    for (const RockMesh& rock : build_rock_meshes(set)) {
        for (std::size_t i = 0; i < rock.mesh.positions.size(); ++i) {
            const glm::vec3 world = rock.mesh.positions[i] + rock.position;
            const glm::vec2 picture((world.x + 0.45F) / 0.9F, (world.z + 0.3F) / 0.6F);
            const glm::vec2 inside = glm::clamp(picture, glm::vec2(0.0F), glm::vec2(1.0F));
            EXPECT_LT(glm::length(rock.mesh.texcoords[i] - inside), 1e-5F);
        }
    }
    EXPECT_TRUE(build_rock_meshes(set, {.texcoords = false})[0].mesh.texcoords.empty());
}

TEST(RockMesh, StandsWhereThePictureShowsIt) {
    const vision::Rock rock = test::lobed_rock({0, 600}, 40, 1);
    const RockMesh half = mesh_of(rock);
    EXPECT_NEAR(half.position.x, -0.45, 1e-6);
    EXPECT_NEAR(half.position.z, 0.3, 1e-6);
    EXPECT_EQ(half.position.y, 0.0F);
    const RockMesh resting = mesh_of(rock, {.base = RockBase::Resting});
    EXPECT_NEAR(resting.position.y + resting.box_min.y, 0.0, 1e-7);
    EXPECT_EQ(resting.mesh.positions, half.mesh.positions);
}

TEST(RockMesh, SegmentsFollowTheSize) {
    const vision::RockSet set =
        set_of({test::lobed_rock({9, 9}, 40, 1), test::lobed_rock({9, 9}, 20, 1),
                test::lobed_rock({9, 9}, 0.001, 1)});
    const auto meshes = build_rock_meshes(set, {.min_segments = 3});
    EXPECT_EQ(meshes[0].segments, 30);
    EXPECT_EQ(meshes[1].segments, 16);
    EXPECT_EQ(meshes[2].segments, 3);
    EXPECT_EQ(build_rock_meshes(set, {.max_segments = 5})[2].segments, 5);
    EXPECT_EQ(build_rock_meshes(set, {.size_lod = false})[2].segments, 30);
}

TEST(RockMesh, MeetsAVertexBudgetWithoutRepeatedPlaces) {
    const RockMesh mesh =
        mesh_of(test::lobed_rock({300, 200}, 40, 7), {.max_segments = 64, .rings = 41});
    EXPECT_EQ(mesh.mesh.positions.size(), 2562U);
    EXPECT_EQ(weld(mesh.mesh).positions.size(), 2562U);
}

TEST(RockMesh, ThreadsDoNotMatter) {
    const vision::RockSet set = test::rock_set(100, 9);
    const auto many = build_rock_meshes(set);
    const ThreadLimit one(1);
    const auto few = build_rock_meshes(set);
    for (std::size_t i = 0; i < many.size(); ++i) {
        EXPECT_EQ(many[i].mesh.positions, few[i].mesh.positions);
        EXPECT_EQ(many[i].mesh.normals, few[i].mesh.normals);
    }
}

TEST(RockMeshErrors, NameTheRockAndTheValue) {
    vision::Rock rock = test::lobed_rock({300, 200}, 40, 1);
    rock.outline.radii[7] = -2.0F;
    EXPECT_THAT(
        [&] { mesh_of(rock); },
        testing::ThrowsMessage<InvalidInput>(
            "rock 0 has a radius of -2 px at 7 degrees, must be positive and at most 1e+06"));
    rock = test::lobed_rock({300, 200}, 40, 1);
    rock.depth = NAN;
    EXPECT_THROW(mesh_of(rock), InvalidInput);
    rock = test::lobed_rock({NAN, 200}, 40, 1);
    EXPECT_THROW(mesh_of(rock), InvalidInput);
    EXPECT_THAT([&] { mesh_of(rock, {.max_segments = 2}); },
                testing::ThrowsMessage<InvalidOption>("max-segments is 2, must be in [3, 720]"));
    EXPECT_THROW(mesh_of(rock, {.rings = 1}), InvalidOption);
}

TEST(RockMeshErrors, RefuseMoreVerticesThanFit) {
    const std::vector<vision::Rock> rocks(400, test::lobed_rock({300, 200}, 40, 1));
    EXPECT_THROW(build_rock_meshes(set_of(rocks), {.max_segments = 720, .rings = 720}),
                 InvalidInput);
}

TEST(RockMesh, NoRocksGiveNoMeshes) {
    EXPECT_TRUE(build_rock_meshes(set_of({})).empty());
}

}  // namespace
}  // namespace scree::meshing
