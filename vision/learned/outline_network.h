#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace scree::vision {

inline constexpr int kFieldChannels =
    3;                                   ///< Boundary, inside, distance: what is read of a network.
inline constexpr int kNetworkStep = 32;  ///< Width and height given to a network are multiples.

/// A convolutional network that tells boundary, inside and distance of every pixel of a picture.
///
/// An ONNX file with one input `picture`, 1 x 3 x H x W, and one output `field`, 1 x 4K x H/2 x
/// W/2, K at least 3: channel 4k + 2i + j holds the k-th value of the pixels (2y + i, 2x + j), as a
/// logit. `docs/vision-learned.md` says which operators it may have.
///
/// Holds bytes only, so it costs no more than its file; a NetworkRun does the work.
class OutlineNetwork {
public:
    /// @param onnx  Bytes of a file, in single or half precision; copied.
    /// @param name  What messages call it.
    /// @throw InvalidInput  it is no such network; the message says what was expected.
    OutlineNetwork(std::string_view onnx, std::string name);

    const std::string& bytes() const { return bytes_; }  ///< Checked, in single precision.
    const std::string& name() const { return name_; }

private:
    std::string bytes_;
    std::string name_;
};

/// The network that the library was built with.
const OutlineNetwork& shipped_network();

/// A network from a file of at most 64 MB.
/// @throw InvalidInput  the file is missing, empty, too large or no such network.
OutlineNetwork read_network(const std::filesystem::path& path);

/// A network made ready to be run; keeps its working memory until it is destroyed.
///
/// Uses as many threads as parallel loops may; the bits of a result do not depend on it. Not for
/// use by two threads at once.
class NetworkRun {
public:
    /// @throw InvalidInput  it cannot be run, or would need more than 4 KB a pixel.
    explicit NetworkRun(const OutlineNetwork& network);
    ~NetworkRun();
    NetworkRun(const NetworkRun&) = delete;
    NetworkRun& operator=(const NetworkRun&) = delete;

    /// @param input   Three planes of width x height.
    /// @param logits  kFieldChannels planes of width x height, overwritten.
    /// @pre   Width and height are multiples of kNetworkStep.
    /// @throw InvalidInput  what the network says is not finite.
    void evaluate(std::span<const float> input, int width, int height, std::span<float> logits);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace scree::vision
