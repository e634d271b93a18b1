#include "terrain/material/strokes.h"

#include "base/error.h"
#include "base/random.h"
#include "terrain/material/materials_json.h"
#include "tests/terrain/material/map_samples.h"

#include <cmath>
#include <set>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

Stroke brush(std::vector<glm::dvec2> points, double radius, int id, double hardness = 1.0) {
    Stroke stroke;
    stroke.points = std::move(points);
    stroke.radius = radius;
    stroke.hardness = hardness;
    stroke.id = id;
    return stroke;
}

Stroke shape(StrokeKind kind, std::vector<glm::dvec2> points, int id, double fade = 0.0) {
    Stroke stroke;
    stroke.kind = kind;
    stroke.points = std::move(points);
    stroke.id = id;
    stroke.fade = fade;
    return stroke;
}

Stroke step(StrokeKind kind, int count) {
    Stroke stroke;
    stroke.kind = kind;
    stroke.count = count;
    return stroke;
}

DescriptionMap sand(int width = 40, int height = 30) {
    DescriptionMap map;
    map.cell_size = 0.25;
    map.materials = test::three_materials();
    map.ids = Raster<std::uint8_t>(width, height);
    return map;
}

glm::dvec2 centre(const DescriptionMap& map, int x, int y) {
    return {(x + 0.5) * map.cell_size, (y + 0.5) * map.cell_size};
}

TEST(Strokes, DiscIsTheCellsWithinItsRadius) {
    Rng rng({.seed = 1});
    for (int i = 0; i < 20; ++i) {
        DescriptionMap map = sand();
        const glm::dvec2 at(rng.uniform(-1.0, 11.0), rng.uniform(-1.0, 9.0));
        const double radius = rng.uniform(0.01, 4.0);
        paint(map, {{brush({at}, radius, 3)}});
        for (int y = 0; y < map.ids.height(); ++y)
            for (int x = 0; x < map.ids.width(); ++x)
                EXPECT_EQ(map.ids(x, y) == 3, glm::distance(at, centre(map, x, y)) <= radius);
        EXPECT_TRUE(map.repose.empty());
    }
}

TEST(Strokes, DraggedDiscIsTheUnionOfItsDiscs) {
    DescriptionMap map = sand();
    const glm::dvec2 a(2.0, 1.0), b(7.0, 6.0), c(9.0, 2.0);
    paint(map, {{brush({a, b, c}, 0.8, 7)}});
    DescriptionMap many = sand();
    std::vector<Stroke> discs;
    for (int i = 0; i <= 4000; ++i) {
        discs.push_back(brush({a + (b - a) * (i / 4000.0)}, 0.8, 7));
        discs.push_back(brush({b + (c - b) * (i / 4000.0)}, 0.8, 7));
    }
    paint(many, discs);
    EXPECT_EQ(map.ids, many.ids);
}

// Parameters fade, ids do not, and change where the parameters are half-way.
TEST(Strokes, SoftBrushFadesParametersOnly) {
    DescriptionMap map = sand();
    paint(map, {{brush({{5.0, 3.75}}, 3.0, 3, 0.5)}});
    ASSERT_FALSE(map.mobility.empty());
    for (int y = 0; y < map.ids.height(); ++y)
        for (int x = 0; x < map.ids.width(); ++x) {
            const double distance = glm::distance({5.0, 3.75}, centre(map, x, y));
            EXPECT_EQ(map.ids(x, y) == 3, distance <= 2.25) << distance;
            const double share = (0.5 - map.mobility(x, y)) / 0.25;  // sand to mud
            if (distance <= 1.5 || distance >= 3.0) {
                EXPECT_EQ(map.mobility(x, y), distance <= 1.5 ? 0.25F : 0.5F);
            } else {
                EXPECT_EQ(share >= 0.5, distance <= 2.25);
            }
        }
}

TEST(Strokes, PolygonIsItsInside) {
    DescriptionMap map = sand();
    const std::vector<glm::dvec2> star = {{5, 0.3}, {7.7, 7}, {0.6, 3.1}, {9.4, 2.9}, {2.2, 7.1}};
    paint(map, {{shape(StrokeKind::Polygon, star, 7)}});
    int inside = 0;
    for (int y = 0; y < map.ids.height(); ++y)
        for (int x = 0; x < map.ids.width(); ++x) {
            const glm::dvec2 p = centre(map, x, y);
            bool odd = false;
            for (std::size_t i = 0; i < star.size(); ++i) {
                const glm::dvec2 a = star[i], b = star[(i + 1) % star.size()];
                if ((a.y <= p.y) != (b.y <= p.y) &&
                    p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
                    odd = !odd;
            }
            EXPECT_EQ(map.ids(x, y) == 7, odd);
            inside += odd ? 1 : 0;
        }
    EXPECT_GT(inside, 100);
}

TEST(Strokes, PolygonFadesAcrossItsEdge) {
    DescriptionMap map = sand();
    paint(map, {{shape(StrokeKind::Polygon, {{-9, -9}, {5, -9}, {5, 99}, {-9, 99}}, 7, 2.0)}});
    for (int x = 0; x < 40; ++x) {
        const double inside = 5.0 - (x + 0.5) * 0.25;
        EXPECT_EQ(map.ids(x, 9) == 7, inside >= 0.0);
        if (std::abs(inside) >= 1.0) {
            EXPECT_EQ(map.mobility(x, 9), inside > 0.0 ? 0.8F : 0.5F);
        }
    }
    EXPECT_NEAR(map.mobility(19, 9) + map.mobility(20, 9), 1.3, 1e-6);
}

// Brute force: grow the seed until nothing changes.
TEST(Strokes, FillTakesTheJoinedCellsOfOneId) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        DescriptionMap map = test::random_map(12, 9, seed, false);
        const Raster<std::uint8_t> old = map.ids;
        std::set<std::pair<int, int>> joined{{6, 4}};
        for (std::size_t size = 0; size != joined.size();) {
            size = joined.size();
            for (const auto& [x, y] : std::set(joined))
                for (const auto& [u, v] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}})
                    if (old.contains(u, v) && old(u, v) == old(6, 4))
                        joined.insert({u, v});
        }
        const int id = old(6, 4) == 3 ? 7 : 3;
        paint(map, {{shape(StrokeKind::Fill, {{1.6, 1.1}}, id)}});
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 12; ++x)
                EXPECT_EQ(map.ids(x, y), joined.count({x, y}) > 0 ? id : old(x, y));
    }
}

TEST(Strokes, UndoLeavesTheMapOfTheRest) {
    const auto undo = StrokeKind::Undo, redo = StrokeKind::Redo;
    const Stroke a = brush({{2, 2}}, 1.5, 3, 0.3), b = brush({{3, 2}}, 1.5, 7),
                 c = shape(StrokeKind::Fill, {{9, 7}}, 3);
    const std::vector<Stroke> script{a, b, c, step(undo, 2), b, step(undo, 1), step(redo, 1)};
    EXPECT_THAT(standing_strokes(script), ElementsAre(0, 4));
    EXPECT_THAT(standing_strokes(std::vector{a, b, c, step(undo, 3), step(redo, 2)}),
                ElementsAre(0, 1));
    DescriptionMap map = sand(), rest = sand();
    paint(map, script);
    paint(rest, std::vector{a, b});
    EXPECT_TRUE(test::same_map(map, rest));
    DescriptionMap none = sand();
    paint(none, std::vector{a, step(undo, 1)});
    EXPECT_TRUE(test::same_map(none, sand()));
    EXPECT_THAT(
        [&] {
            standing_strokes(std::vector{a, step(undo, 2)});
        },
        ThrowsMessage<InvalidInput>(HasSubstr("strokes[1] takes back 2 strokes, of 1")));
    EXPECT_THAT(
        [&] {
            standing_strokes(std::vector{a, step(undo, 1), b, step(redo, 1)});
        },
        ThrowsMessage<InvalidInput>(HasSubstr("strokes[3] brings back 1 strokes, of 0")));
}

TEST(Strokes, SayWhatIsWrong) {
    DescriptionMap map = sand();
    const auto refused = [&](const Stroke& stroke, const std::string& words) {
        EXPECT_THAT([&] { paint(map, {{stroke}}); }, ThrowsMessage<InvalidInput>(HasSubstr(words)));
    };
    refused(brush({{1, 1}}, 1, 9), "strokes[0] lays a material that is not");
    refused(brush({}, 1, 3), "too few points");
    refused(brush({{1, NAN}}, 1, 3), "no number");
    refused(brush({{1, 1}}, 0, 3), "radius");
    refused(brush({{1, 1}}, 1, 3, 1.5), "hardness");
    refused(shape(StrokeKind::Polygon, {{1, 1}, {2, 2}}, 3), "too few points");
    refused(shape(StrokeKind::Fill, {{1, 1}, {2, 2}}, 3), "needs one point");
    EXPECT_NO_THROW(paint(map, {{brush({{-1e6, 1e6}}, 1e-3, 3)}}));
    EXPECT_TRUE(test::same_map(map, sand()));
}

constexpr const char* kScript = R"({"format": "scree-strokes", "version": 1, "size": [40, 30],
 "cell_size": 0.25, "ground": "sand", "strokes": [
  {"op": "brush", "at": [2, 2], "radius": 1.5, "hardness": 0.3, "material": "wet mud"},
  {"op": "polygon", "points": [[1, 1], [4, 1], [4, 3]], "fade": 0.5, "material": 7},
  {"op": "undo"}, {"op": "redo", "count": 1},
  {"op": "fill", "at": [9, 7], "material": "pebbles"}]})";

TEST(StrokesJson, IsTheSameAsTheStrokes) {
    const auto materials = test::three_materials();
    const StrokeScript script = strokes_from_json(kScript, "s", materials);
    ASSERT_EQ(script.strokes.size(), 5U);
    DescriptionMap map = sand();
    paint(map, std::vector{brush({{2, 2}}, 1.5, 3, 0.3),
                           shape(StrokeKind::Polygon, {{1, 1}, {4, 1}, {4, 3}}, 7, 0.5),
                           shape(StrokeKind::Fill, {{9, 7}}, 7)});
    EXPECT_TRUE(test::same_map(map, map_from_strokes(script, materials)));
}

TEST(StrokesJson, TheExampleIsAMap) {
    const std::filesystem::path folder = std::filesystem::path(SCREE_SOURCE_DIR) / "testdata/maps";
    const auto materials = read_materials(folder / "materials.json").materials;
    const DescriptionMap map =
        map_from_strokes(read_strokes(folder / "strokes.json", materials), materials);
    EXPECT_EQ(map.ids.width(), 160);
    EXPECT_EQ(map.ids(2, 50), 0);  // the fill was taken back
    EXPECT_EQ(map.ids(118, 20), 2);
    EXPECT_EQ(map.ids(50, 36), 1);
}

TEST(StrokesJson, WritesWhatItReads) {
    const auto materials = test::three_materials();
    const std::string once = strokes_to_json(strokes_from_json(kScript, "s", materials));
    const StrokeScript again = strokes_from_json(once, "again", materials);
    EXPECT_EQ(strokes_to_json(again), once);
    EXPECT_TRUE(
        test::same_map(map_from_strokes(again, materials),
                       map_from_strokes(strokes_from_json(kScript, "s", materials), materials)));
    EXPECT_EQ(strokes_from_json(strokes_to_json({}), "none", materials).width, 0);
}

struct Wrong {
    const char* from;
    const char* to;
    const char* words;
};
class StrokesJsonErrors : public testing::TestWithParam<Wrong> {};

TEST_P(StrokesJsonErrors, NameThePath) {
    std::string text = kScript;
    const auto at = text.find(GetParam().from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, std::string(GetParam().from).size(), GetParam().to);
    EXPECT_THAT(
        [&] { strokes_from_json(text, "s.json", test::three_materials()); },
        ThrowsMessage<InvalidInput>(AllOf(HasSubstr("s.json"), HasSubstr(GetParam().words))));
}
INSTANTIATE_TEST_SUITE_P(
    All, StrokesJsonErrors,
    testing::Values(
        Wrong{"\"radius\": 1.5", "\"radius\": 0", "strokes[0].radius is 0"},
        Wrong{"\"radius\": 1.5, ", "", "strokes[0].radius is missing"},
        Wrong{"\"hardness\": 0.3", "\"softness\": 0.3", "strokes[0] has the unknown member"},
        Wrong{"\"wet mud\"", "\"mud\"", "strokes[0].material is \"mud\""},
        Wrong{"\"at\": [2, 2]", "\"at\": [2]", "strokes[0].at must have 2 numbers"},
        Wrong{"\"at\": [2, 2], ", "", "strokes[0] has 0 points"},
        Wrong{"\"at\": [2, 2]", "\"at\": [2, 2], \"points\": [[1, 1]]", "given beside at"},
        Wrong{"[[1, 1], [4, 1], [4, 3]]", "[[1, 1], [4, 1]]", "strokes[1] has 2 points"},
        Wrong{"[[1, 1], [4, 1], [4, 3]]", "[[1, 1], [4, 1e7], [4, 3]]", "points[1][1] is 1e+07"},
        Wrong{"\"polygon\"", "\"star\"", "strokes[1].op is \"star\""},
        Wrong{"\"count\": 1", "\"count\": 0", "strokes[3].count is 0"},
        Wrong{"{\"op\": \"undo\"}", "7", "strokes[2] must be an object"},
        Wrong{"{\"op\": \"undo\"}", "[]", "strokes[2] must be an object"},
        Wrong{"{\"op\": \"undo\"}", "{\"op\": \"undo\", \"op\": \"redo\"}", "\"op\" twice"},
        Wrong{"\"size\": [40, 30]", "\"size\": [60000, 60000]", "the limit is"},
        Wrong{"\"size\": [40, 30],", "", "must be given together"},
        Wrong{"\"strokes\": [", "\"stroke\": [", "strokes is missing"},
        Wrong{"\"version\": 1", "\"version\": 3", "version is 3"}));

TEST(StrokesJson, OneStrokeMayNotHoldEverything) {
    std::string text = R"({"format": "scree-strokes", "version": 1, "strokes": [{"op": [)";
    for (int i = 0; i < 50'000; ++i)
        text += "1,";
    EXPECT_THAT([&] { strokes_from_json(text, "s", test::three_materials()); },
                ThrowsMessage<InvalidInput>(HasSubstr("strokes[0] holds more than")));
}

}  // namespace
}  // namespace scree::terrain
