#include "base/whole_file.h"
#include "tests/cli/folder.h"
#include "tests/cli/scree.h"
#include "tests/support/temp_dir.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace scree {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::files_below;
using test::ProgramRun;
using testing::HasSubstr;

class Erode : public testing::Test {
protected:
    fs::path at(const std::string& name) const { return dir_ / name; }

    // A little canyon with rain over it.
    json scene() const {
        return {
            {"format", "scree-erosion"},
            {"version", 1},
            {"mesh",
             {{"ground",
               {{"shape", "canyon"},
                {"length", 1.2},
                {"width", 1.4},
                {"edge", 0.12},
                {"bed_width", 0.5},
                {"bed_depth", 0.4}}}}},
            {"fluid",
             {{"kind", "particles"},
              {"radius", 0.06},
              {"domain", {{"low", {-0.7, -0.5, -0.8}}, {"high", {0.59, 2, 0.8}}}},
              {"sources",
               {{{"centre", {-0.4, 0.3, 0}}, {"velocity", {1, 0, 0}}, {"radius", 0.15}}}}}},
            {"run", {{"steps", 12}, {"warm_up", 10}, {"check_every", 3}}},
            {"output",
             {{"mesh_every", 6}, {"particles_every", 6}, {"checkpoint_every", 3}, {"width", 64}}}};
    }
    void write(const std::string& name, const json& value) const {
        write_whole_file(at(name), value.dump());
    }
    ProgramRun erode(const std::string& scene, const std::string& folder,
                     std::vector<std::string> more = {},
                     const test::ProgramSetup& setup = {}) const {
        std::vector<std::string> words = {"erode", at(scene), "-o", at(folder)};
        words.insert(words.end(), more.begin(), more.end());
        return test::scree(words, setup);
    }

private:
    test::TempDir dir_;
};

TEST_F(Erode, WritesAllFilesTheSameForAnyThreads) {
    write("s.json", scene());
    const ProgramRun one = erode("s.json", "one", {"--threads", "1", "--json"});
    ASSERT_EQ(one.status, 0) << one.errors;
    const json report = json::parse(one.output);
    EXPECT_EQ(report["steps"], 12);
    EXPECT_GT(report["mean_touching"], 5.0);
    EXPECT_LT(report["volume_m3"], report["volume_before_m3"]);
    for (const char* column :
         {"iteration", "affected_vertices", "curvature", "laplacian", "displacement", "fluid"})
        EXPECT_GE(report["milliseconds_per_step"][column], 0.0) << column;
    EXPECT_EQ(files_below(at("one")).size(), report["files"].size());
    ASSERT_EQ(erode("s.json", "two", {"--quiet"}).status, 0);
    auto first = files_below(at("one"));
    auto second = files_below(at("two"));
    EXPECT_EQ(first.size(), second.size());
    for (auto& [name, bytes] : second)
        if (name != "report.json" && name != "checkpoint.bin") {  // they hold times
            EXPECT_TRUE(first[name] == bytes) << name;
        }
    const ProgramRun check =
        test::scree({"check", at("one") / "ground.glb", at("one") / "morph.glb",
                     at("one") / "meshes" / "step_000006.glb"});
    EXPECT_EQ(check.status, 0) << check.output;
}

TEST_F(Erode, TakesAMeshFromAFile) {
    ASSERT_EQ(test::scree({"procedural", "-o", at("rock.glb"), "--segments", "16"}).status, 0);
    json poured = scene();
    poured["mesh"] = {{"file", "rock.glb"}};
    poured["fluid"] = {
        {"kind", "particles"},
        {"radius", 0.08},
        {"domain", {{"low", {-3, -1, -3}}, {"high", {3, 4, 3}}}},
        {"rains", {{{"centre", {0, 2, 0}}, {"width", 1}, {"depth", 1}, {"rate", 400}}}}};
    poured["run"] = {{"steps", 8}, {"warm_up", 20}, {"weathering", 0.2}};
    poured["wear"] = {{"influence", 8}};
    poured["output"] = {{"pictures", false}};
    write("s.json", poured);
    const ProgramRun run = erode("s.json", "out", {"--json"});
    ASSERT_EQ(run.status, 0) << run.errors;
    const json report = json::parse(run.output);
    EXPECT_GT(report["mean_affected"], 3.0);
    EXPECT_LT(report["volume_m3"], report["volume_before_m3"]);
    EXPECT_THAT(run.output, HasSubstr("morph.glb"));
}

TEST_F(Erode, AKilledRunResumesToTheSameResult) {
    json long_scene = scene();
    long_scene["run"]["steps"] = 400;
    long_scene["output"] = {{"checkpoint_every", 3}, {"pictures", false}};
    write("s.json", long_scene);
    // Later and later, until the first checkpoint is there: machines and sanitizers differ.
    test::ProgramSetup setup;
    ProgramRun killed;
    for (int ms = 150; ms < 10'000 && !fs::exists(at("part") / "checkpoint.bin"); ms *= 2) {
        setup.interrupt_after_ms = ms;
        killed = erode("s.json", "part", {"--quiet"}, setup);
        if (killed.status == 0)
            break;
    }
    if (killed.status == 0)
        GTEST_SKIP() << "this machine is too fast to be interrupted";
    EXPECT_EQ(killed.status, 130);
    for (const auto& [name, bytes] : files_below(at("part")))  // nothing half-written
        EXPECT_TRUE(name == "checkpoint.bin" || name == "steps.csv") << name;
    ASSERT_EQ(erode("s.json", "part", {"--resume", "--quiet"}).status, 0);
    ASSERT_EQ(erode("s.json", "whole", {"--quiet"}).status, 0);
    EXPECT_TRUE(read_whole_file(at("part") / "ground.glb", 1 << 26) ==
                read_whole_file(at("whole") / "ground.glb", 1 << 26));
    const std::string steps = read_whole_file(at("whole") / "steps.csv", 1 << 26);
    EXPECT_TRUE(read_whole_file(at("part") / "steps.csv", 1 << 26) == steps);
    EXPECT_EQ(std::count(steps.begin(), steps.end(), '\n'), 401);
}

TEST_F(Erode, RefusesBadScenesAndSaysWhere) {
    const auto refused = [&](const json& value, const char* why) {
        write("bad.json", value);
        const ProgramRun run = erode("bad.json", "none");
        EXPECT_EQ(run.status, 1) << why;
        EXPECT_THAT(run.errors, HasSubstr(why));
        EXPECT_FALSE(fs::exists(at("none")));
    };
    json bad = scene();
    bad["run"]["stops"] = 3;
    refused(bad, "run has the unknown member \"stops\"");
    bad = scene();
    bad["fluid"]["sources"][0]["centre"] = {-0.4, -3, 0};
    refused(bad, "source 0 lies inside the mesh");
    bad = scene();
    bad["wear"] = {{"influence", 0.2}};
    refused(bad, "particles of radius 0.06 m reach only");
    bad = scene();
    bad["mesh"] = {{"file", "missing.glb"}};
    refused(bad, "missing.glb");
    write("s.json", scene());
    write_whole_file(at("d") / "checkpoint.bin", std::string_view("nonsense"));
    const ProgramRun damaged = erode("s.json", "d", {"--resume"});
    EXPECT_EQ(damaged.status, 1);
    EXPECT_THAT(damaged.errors, HasSubstr("is no checkpoint"));
}

}  // namespace
}  // namespace scree
