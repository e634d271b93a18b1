#include "base/whole_file.h"
#include "tests/cli/folder.h"
#include "tests/cli/scree.h"
#include "tests/support/temp_dir.h"
#include "tests/support/tiny_network.h"
#include "vision/data/rocks_json.h"

#include <filesystem>

#include <gmock/gmock.h>

namespace scree {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class Model : public testing::Test {
protected:
    Model() { test::write_test_photo(photo(), 160, 120); }
    fs::path photo() const { return dir_ / "gravel.png"; }
    fs::path out() const { return dir_ / "out"; }

    test::ProgramRun rocks(const fs::path& model, const std::string& method = "learned") const {
        return test::scree({"rocks", photo(), "-o", out(), "--quiet", "--no-refine", "--method",
                            method, "--model", model});
    }

    void expect_refused(const fs::path& model, const std::string& reason) const {
        const test::ProgramRun run = rocks(model);
        EXPECT_EQ(run.status, 1) << model;
        EXPECT_THAT(run.errors,
                    AllOf(StartsWith("scree rocks: "), HasSubstr(model.string()), HasSubstr(reason),
                          HasSubstr("'picture' (1 x 3 x H x W)"), HasSubstr("leave --model out")));
        EXPECT_THAT(run.output, IsEmpty());
        EXPECT_FALSE(fs::exists(out()));
    }

    test::TempDir dir_;
};

TEST_F(Model, AFileMayReplaceTheNetworkThatIsBuiltIn) {
    const test::ProgramRun run =
        rocks(fs::path(SCREE_SOURCE_DIR) / "testdata/networks/pointwise.onnx");
    EXPECT_EQ(run.status, 0) << run.errors;
    EXPECT_EQ(vision::read_rocks_json(out() / "rocks.json").method, "learned");
}

TEST_F(Model, WhatIsNoNetworkIsRefused) {
    write_whole_file(dir_ / "empty.onnx", std::string_view());
    write_whole_file(dir_ / "words.onnx", std::string_view("these are words, not weights"));
    const std::string whole = test::onnx_bytes(test::pointwise_network(3, 1.0F, 0.0F));
    write_whole_file(dir_ / "cut.onnx", std::string_view(whole).substr(0, whole.size() / 2));
    expect_refused(dir_ / "missing.onnx", "no such file");
    expect_refused(dir_ / "empty.onnx", "empty");
    expect_refused(dir_ / "words.onnx", "protobuf");
    expect_refused(dir_ / "cut.onnx", "cut off");
    expect_refused(photo(), "protobuf");
    expect_refused(dir_.path(), "folder");
}

TEST_F(Model, ForeignNetworksAreRefused) {
    const auto network = [&](const char* name, const test::TinyNetwork& made) {
        write_whole_file(dir_ / name, std::string_view(test::onnx_bytes(made)));
        return dir_ / name;
    };
    expect_refused(network("few.onnx", test::pointwise_network(2, 1.0F, 0.0F)), "1 x 8 x");
    test::TinyNetwork named = test::pointwise_network(3, 1.0F, 0.0F);
    named.inputs = {"image"};
    expect_refused(network("named.onnx", named), "'image'");
    expect_refused(network("wild.onnx", test::pointwise_network(3, 3e38F, 0.0F)), "finite number");
}

TEST_F(Model, OtherMethodsHaveNone) {
    const test::ProgramRun run = rocks(dir_ / "a.onnx", "classical");
    EXPECT_NE(run.status, 0);
    EXPECT_THAT(run.errors, HasSubstr("only the method learned"));
}

}  // namespace
}  // namespace scree
