// Writes made-up photographs of gravel with their truth, for training and for looking at.

#include "testdata/gravel_scene.h"
#include "vision/image_io.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

namespace {

struct Request {
    std::filesystem::path folder;
    int count = 16;
    std::uint64_t seed = 1;
    int width = 512;
    int height = 512;
};

constexpr const char* kUsage = "usage: synthetic_photos OUT [--count N] [--seed S] [--size WxH]\n";

bool parse(int argc, char** argv, Request& request) {
    if (argc < 2)
        return false;
    request.folder = argv[1];
    for (int i = 2; i + 1 < argc; i += 2) {
        const std::string word = argv[i];
        const std::string value = argv[i + 1];
        if (word == "--count")
            request.count = std::stoi(value);
        else if (word == "--seed")
            request.seed = std::stoull(value);
        else if (word == "--size") {
            if (std::sscanf(value.c_str(), "%dx%d", &request.width, &request.height) != 2)
                return false;
        } else
            return false;
    }
    return argc % 2 == 0;
}

void write_scene(const Request& request, int index) {
    namespace vision = scree::vision;
    const auto options = scree::test::varied_scene(
        request.seed * 100000 + static_cast<std::uint64_t>(index), request.width, request.height);
    const auto scene = scree::test::make_gravel_scene(options);
    char name[16];
    std::snprintf(name, sizeof name, "%03d_", index);
    const auto path = [&](const char* what) { return request.folder / (std::string(name) + what); };
    vision::write_png(path("image.png"), scene.photo);
    vision::write_labels(path("labels.png"), scene.labels);
    vision::write_png(path("ignore.png"), scene.ignore);
    vision::HeightImage heights{scene.height, 0.001};
    for (float& height : heights.metres)
        height *= 0.001F;
    vision::write_heights_png(path("height.png"), heights);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        Request request;
        if (!parse(argc, argv, request)) {
            std::cerr << kUsage;
            return 2;
        }
        std::filesystem::create_directories(request.folder);
        for (int i = 0; i < request.count; ++i)
            write_scene(request, i);
        return 0;
    } catch (const std::exception& problem) {
        std::cerr << "synthetic_photos: " << problem.what() << '\n';
        return 1;
    }
}
