#include "vision/learned/outline_network.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/whole_file.h"
#include "tests/support/temp_dir.h"
#include "tests/support/tiny_network.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace scree::vision {
namespace {

using test::onnx_bytes;
using test::pointwise_network;
using test::TinyNetwork;
using testing::AllOf;
using testing::HasSubstr;

std::vector<float> ramp(std::size_t n) {
    std::vector<float> values(n);
    for (std::size_t i = 0; i < n; ++i)
        values[i] = 0.01F * static_cast<float>(i % 157) - 0.5F;
    return values;
}

// Reading and making ready, as `--model` does.
void use(const std::string& bytes) {
    const OutlineNetwork network(bytes, "a.onnx");
    const NetworkRun run(network);
}

void expect_refused(const TinyNetwork& network, const std::string& reason) {
    EXPECT_THAT([&] { use(onnx_bytes(network)); },
                testing::ThrowsMessage<InvalidInput>(
                    AllOf(HasSubstr("a.onnx"), HasSubstr(reason), HasSubstr("expected is"))))
        << reason;
}

TEST(OutlineNetwork, GivesTheChannelsUnfolded) {
    const OutlineNetwork network(onnx_bytes(pointwise_network(4, 2.0F, 0.5F)), "a.onnx");
    NetworkRun run(network);
    for (const auto& [width, height] : {std::pair{64, 32}, {160, 96}, {64, 32}}) {
        const auto plane = static_cast<std::size_t>(width * height);
        const std::vector<float> input = ramp(3 * plane);
        std::vector<float> logits(3 * plane);
        run.evaluate(input, width, height, logits);
        for (std::size_t i = 0; i < logits.size(); ++i)
            ASSERT_NEAR(logits[i], 2.0F * input[i] + 0.5F * static_cast<float>(i / plane), 1e-6F);
    }
}

TEST(OutlineNetwork, ReadsHalfPrecisionFromAFile) {
    const OutlineNetwork network =
        read_network(SCREE_SOURCE_DIR "/testdata/networks/pointwise.onnx");
    NetworkRun run(network);
    const std::vector<float> input = ramp(3 * 32 * 32);
    std::vector<float> logits(input.size());
    run.evaluate(input, 32, 32, logits);
    for (std::size_t i = 0; i < logits.size(); ++i)
        ASSERT_NEAR(logits[i], 2.0F * input[i] + 0.5F * static_cast<float>(i / 1024) - 0.25F,
                    1e-6F);
}

TEST(OutlineNetwork, TheShippedOneRunsAndDoesNotDependOnTheThreadCount) {
    const std::vector<float> input = ramp(std::size_t{3} * 128 * 96);
    const auto logits = [&](int n_threads) {
        const ThreadLimit limit(n_threads);
        std::vector<float> values(input.size());
        NetworkRun(shipped_network()).evaluate(input, 128, 96, values);
        return values;
    };
    EXPECT_EQ(logits(1), logits(2));
    EXPECT_LE(shipped_network().bytes().size(), std::size_t{10'500'000});  // 5 MB in half precision
}

TEST(OutlineNetwork, ForeignNetworksAreRefused) {
    const TinyNetwork good = pointwise_network(3, 1.0F, 0.0F);
    EXPECT_NO_THROW(use(onnx_bytes(good)));
    const auto with = [&](auto&& change) {
        TinyNetwork network = good;
        change(network);
        return network;
    };
    expect_refused(pointwise_network(2, 1, 0), "gives 1 x 8 x");
    expect_refused(with([](auto& n) { n.outputs = {"field", "more"}; }), "2 outputs");
    expect_refused(with([](auto& n) { n.outputs = {"mask"}; }), "called 'mask'");
    expect_refused(with([](auto& n) { n.inputs = {"image"}; }), "called 'image'");
    expect_refused(with([](auto& n) { n.inputs = {"picture", "scale"}; }), "2 inputs");
    expect_refused(with([](auto& n) { n.input_dims = {1, 1, 64, 64}; }), "1 x 1 x 64 x 64");
    expect_refused(with([](auto& n) { n.nodes[0].type = "Loop"; }), "'Loop'");
    expect_refused(with([](auto& n) { n.nodes[0].inputs[0] = "nothing"; }), "'nothing'");
    expect_refused(with([](auto& n) { n.nodes[0].output = "weights"; }), "twice");
    expect_refused(with([](auto& n) { n.nodes[0].numbers[1].second = {1, 1}; }), "it gives 1 x 12");
    expect_refused(with([](auto& n) { n.nodes[0].numbers[1].second = {1 << 20, 2}; }), "1048576");
    expect_refused(with([](auto& n) { n.opset = 3; }), "operator set 3");
    expect_refused(with([](auto& n) { n.weights[1].values.pop_back(); }), "'bias'");
    expect_refused(with([](auto& n) { n.weights[0].dims = {1 << 20, 1 << 20}; }), "'weights'");
}

TEST(OutlineNetwork, NumbersThatAreNoneAreRefused) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        TinyNetwork network = pointwise_network(3, 1.0F, 0.0F);
        network.weights[0].values[5] = bad;
        expect_refused(network, "not all finite");
    }
    // Finite weights can still lead beyond all numbers.
    const OutlineNetwork wild(onnx_bytes(pointwise_network(3, 3e38F, 0.0F)), "a.onnx");
    NetworkRun run(wild);
    const std::vector<float> input(std::size_t{3} * 32 * 32, 100.0F);
    std::vector<float> logits(input.size());
    EXPECT_THAT([&] { run.evaluate(input, 32, 32, logits); },
                testing::ThrowsMessage<InvalidInput>(HasSubstr("not a finite number")));
}

TEST(OutlineNetwork, ANetworkThatNeedsTooMuchMemoryIsRefused) {
    TinyNetwork network = pointwise_network(3, 1.0F, 0.0F);
    network.weights.push_back({"wide", {4096, 3, 1, 1}, std::vector<float>(4096 * 3)});
    network.weights.push_back({"narrow", {3, 4096, 1, 1}, std::vector<float>(4096 * 3)});
    network.nodes.insert(network.nodes.begin(),
                         {"Conv", {"picture", "wide"}, "many", {{"kernel_shape", {1, 1}}}, {}});
    network.nodes.insert(network.nodes.begin() + 1,
                         {"Conv", {"many", "narrow"}, "few", {{"kernel_shape", {1, 1}}}, {}});
    network.nodes[2].inputs[0] = "few";
    expect_refused(network, "bytes a pixel");
}

TEST(OutlineNetwork, CutOrChangedBytesNeverDoHarm) {
    const std::string whole = onnx_bytes(pointwise_network(3, 1.0F, 0.0F));
    for (std::size_t n = 0; n < whole.size(); n += 7)
        EXPECT_THROW(use(whole.substr(0, n)), InvalidInput) << n;
    for (std::size_t at = 0; at < whole.size(); at += 3) {
        for (const int value : {0, 1, 0x7F, 0xFF}) {
            std::string changed = whole;
            changed[at] = static_cast<char>(value);
            try {
                use(changed);
            } catch (const InvalidInput&) {
            }
        }
    }
}

TEST(OutlineNetwork, FilesThatAreNoneAreRefusedWithTheirName) {
    const test::TempDir dir;
    write_whole_file(dir / "empty.onnx", std::string_view());
    write_whole_file(dir / "words.onnx", std::string_view("these are words, not weights"));
    for (const char* name : {"missing.onnx", "empty.onnx", "words.onnx", ""})
        EXPECT_THAT([&] { read_network(dir / name); },
                    testing::ThrowsMessage<InvalidInput>(
                        AllOf(HasSubstr((dir / name).string()), HasSubstr("'picture'"))))
            << name;
}

}  // namespace
}  // namespace scree::vision
