#include "meshing/rocks/procedural_rock.h"

#include "base/error.h"
#include "meshing/mesh/weld.h"
#include "tests/support/mesh_checks.h"

#include <map>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree::meshing {
namespace {

constexpr WorleyComponent kComponents[] = {WorleyComponent::First, WorleyComponent::Second,
                                           WorleyComponent::Third, WorleyComponent::Edges};

// Every face looks away from the centre, so a ray from there leaves through one face only.
bool star_shaped(const TriMesh& mesh) {
    for (const glm::uvec3& t : mesh.triangles)
        if (glm::dot(glm::dvec3(mesh.positions[t.x]),
                     glm::cross(glm::dvec3(mesh.positions[t.y]),
                                glm::dvec3(mesh.positions[t.z]))) <= 0.0)
            return false;
    return true;
}

class ProceduralRocks : public testing::TestWithParam<unsigned> {};  // the parameter is a seed

TEST_P(ProceduralRocks, AreStarShapedSolids) {
    const std::int64_t seed = GetParam();
    for (const WorleyComponent component : kComponents) {
        for (const bool texcoords : {false, true}) {
            ProceduralRockOptions options{.amplitude = 0.9,
                                          .points = 3 + 7 * static_cast<int>(seed)};
            options.form = WorleyForm::Radial;
            options.radial = component;
            options.segments = 24;
            options.texcoords = texcoords;
            options.seed = seed;
            const ProceduralRock radial = make_procedural_rock(options);
            test::expect_valid(radial.rock.mesh);
            EXPECT_TRUE(star_shaped(radial.rock.mesh));
            EXPECT_EQ(radial.halvings, 0);  // this form is regular whatever the noise
            EXPECT_EQ(radial.amplitude, 0.9);

            options.form = WorleyForm::Axes;
            options.along_x = component;
            const ProceduralRock axes = make_procedural_rock(options);
            test::expect_valid(axes.rock.mesh);
            EXPECT_TRUE(star_shaped(axes.rock.mesh));
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Seeds, ProceduralRocks, testing::Range(0U, 8U));

TEST(ProceduralRock, WithoutNoiseIsAnEllipsoid) {
    const ProceduralRock rock =
        make_procedural_rock({.width = 2, .height = 4, .depth = 6, .amplitude = 0});
    for (std::size_t i = 0; i < rock.rock.mesh.positions.size(); ++i) {
        const glm::vec3 p = rock.rock.mesh.positions[i];
        EXPECT_NEAR(p.x * p.x + p.y * p.y / 4 + p.z * p.z / 9, 1.0F, 1e-5F);
        const glm::vec3 normal = glm::normalize(glm::vec3(p.x, p.y / 4, p.z / 9));
        EXPECT_GT(glm::dot(normal, rock.rock.mesh.normals[i]), 0.999F);
    }
}

TEST(ProceduralRock, IsTheSameForTheSameSeed) {
    const TriMesh first = make_procedural_rock({.seed = 4}).rock.mesh;
    EXPECT_EQ(first.positions, make_procedural_rock({.seed = 4}).rock.mesh.positions);
    EXPECT_EQ(first.normals, make_procedural_rock({.seed = 4}).rock.mesh.normals);
    EXPECT_NE(first.positions, make_procedural_rock({.seed = 5}).rock.mesh.positions);
}

TEST(ProceduralRock, SeamAndPolesAreWhole) {
    for (const WorleyForm form : {WorleyForm::Radial, WorleyForm::Axes}) {
        const TriMesh mesh = make_procedural_rock({.form = form, .texcoords = true}).rock.mesh;
        std::map<std::uint32_t, glm::vec3> normal_at;
        const auto place = weld_map(mesh);
        for (std::size_t i = 0; i < place.size(); ++i)
            EXPECT_EQ(normal_at.try_emplace(place[i], mesh.normals[i]).first->second,
                      mesh.normals[i]);
        EXPECT_EQ(normal_at.size(), 2U + 64U * 32U);
    }
}

TEST(ProceduralRock, RingsShrinkToThePole) {
    for (const WorleyForm form : {WorleyForm::Radial, WorleyForm::Axes}) {
        const TriMesh mesh =
            make_procedural_rock({.form = form, .segments = 16, .rings = 2000}).rock.mesh;
        const glm::vec3 pole = mesh.positions.front();
        for (std::size_t s = 1; s <= 16; ++s)  // 0.05 m times a step of pi / 2000, or a few
            EXPECT_LT(glm::length(mesh.positions[s] - pole), 4.0F * 0.05F * 3.1416F / 2000.0F);
    }
}

TEST(ProceduralRock, TextureCoordinatesGoRoundOnce) {
    const TriMesh mesh = make_procedural_rock({.texcoords = true}).rock.mesh;
    for (const glm::uvec3& t : mesh.triangles) {
        const float u[] = {mesh.texcoords[t.x].x, mesh.texcoords[t.y].x, mesh.texcoords[t.z].x};
        EXPECT_LT(*std::max_element(u, u + 3) - *std::min_element(u, u + 3), 1.01F / 64.0F);
    }
    EXPECT_EQ(mesh.texcoords.front().y, 1.0F);  // the south pole is at the picture's bottom
    EXPECT_EQ(mesh.texcoords.back().y, 0.0F);
}

TEST(ProceduralRock, HalvesTheAmplitudeWhereTheSurfaceFolds) {
    int halved = 0;
    for (std::int64_t seed = 0; seed < 4; ++seed) {
        const ProceduralRock rock = make_procedural_rock({.amplitude = 0.9,
                                                          .points = 200,
                                                          .form = WorleyForm::Axes,
                                                          .along_x = WorleyComponent::Edges,
                                                          .segments = 64,
                                                          .seed = seed});
        EXPECT_TRUE(star_shaped(rock.rock.mesh));
        EXPECT_EQ(rock.amplitude, 0.9 * std::pow(0.5, rock.halvings));
        halved += rock.halvings > 0 ? 1 : 0;
    }
    EXPECT_GT(halved, 0);
}

TEST(ProceduralRock, BoundsHoldItAndItRestsOnTheGround) {
    const ProceduralRock made = make_procedural_rock({.base = RockBase::Resting});
    const RockMesh& rock = made.rock;
    EXPECT_EQ(rock.position.y, -rock.box_min.y);
    for (const glm::vec3& p : rock.mesh.positions) {
        EXPECT_LE(glm::length(p), rock.bounding_radius);
        EXPECT_GE(glm::length(p), rock.inscribed_radius);
    }
    EXPECT_GT(rock.inscribed_radius, 0.02F);
}

TEST(ProceduralRockErrors, NameTheValue) {
    EXPECT_THAT([] { make_procedural_rock({.amplitude = 2}); },
                testing::ThrowsMessage<InvalidOption>("amplitude is 2, must be in [0, 0.9]"));
    EXPECT_THROW(make_procedural_rock({.rings = 1}), InvalidOption);
    EXPECT_THROW(make_procedural_rock({.points = 2}), InvalidOption);
}

}  // namespace
}  // namespace scree::meshing
