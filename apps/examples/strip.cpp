// The picture on top of the README: photograph, outlines, meshes, clay.
//
//   build/release/apps/examples/strip gravel.png docs/images/strip.jpg

#include "base/whole_file.h"
#include "meshing/gltf/texture_atlas.h"
#include "meshing/render/raster_view.h"
#include "meshing/rocks/rock_mesh.h"
#include "meshing/rocks/world_frame.h"
#include "vision/data/overlay.h"
#include "vision/image_io.h"
#include "vision/rock_extraction.h"

#include <algorithm>
#include <exception>
#include <iostream>

#include <glm/ext/matrix_transform.hpp>

namespace {

using scree::Photo;

constexpr int kHeight = 256;  // px
constexpr int kWidth = 1200;
constexpr int kGap = 4;

// Cut above and below alike, or continued there by its first and last row.
Photo at_height(const Photo& picture) {
    Photo out(picture.width(), kHeight);
    const int shift = (picture.height() - kHeight) / 2;
    for (int y = 0; y < kHeight; ++y)
        std::copy_n(picture.row(std::clamp(y + shift, 0, picture.height() - 1)), picture.width(),
                    out.row(y));
    return out;
}

scree::meshing::ViewPictures views_of(const scree::vision::RockSet& set, const Photo& photo,
                                      int width) {
    const auto meshes = scree::meshing::build_rock_meshes(set);
    const auto region = scree::meshing::region_of(set);
    scree::meshing::ViewScene scene;
    scene.photo = &photo;
    scene.ground_size = {region.width, region.depth};
    for (const auto& rock : meshes)
        scene.objects.push_back({&rock.mesh, glm::translate(glm::mat4(1.0F), rock.position)});
    return scree::meshing::draw_view(scene, {.width = width, .supersampling = 3});
}

void make_strip(const char* photo_path, const char* strip_path) {
    const Photo photo = scree::vision::read_photo(photo_path).pixels;
    const auto found = scree::vision::extract_rocks(photo);
    const int factor = std::max(1, photo.height() / kHeight);
    const Photo overlay = scree::vision::draw_overlay(photo, found.rocks, {.line_width = factor});
    const int room = kWidth - 3 * kGap - 2 * (photo.width() / factor);
    const auto views = views_of(found.rocks, photo, std::clamp(room / 2, 200, 600));
    Photo strip = at_height(scree::meshing::reduced_photo(photo, factor));
    for (const Photo& next :
         {scree::meshing::reduced_photo(overlay, factor), views.textured, views.clay})
        strip = scree::meshing::side_by_side(strip, at_height(next), kGap);
    scree::write_whole_file(strip_path, scree::vision::encode_jpeg(strip, 90));
}

}  // namespace

int main(int n_words, char** words) {
    if (n_words != 3) {
        std::cerr << "usage: strip PHOTO STRIP.jpg\n";
        return 2;
    }
    try {
        make_strip(words[1], words[2]);
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "strip: " << error.what() << '\n';
        return 1;
    }
}
