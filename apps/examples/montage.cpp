// Pictures beside each other, brought to one height; a slash begins the next row. Makes
// docs/images/.
//
//   build/release/apps/examples/montage docs/images/ground.jpg 1200 a.png b.png / c.png d.png

#include "base/number_text.h"
#include "base/whole_file.h"
#include "meshing/render/raster_view.h"
#include "vision/image_io.h"

#include <algorithm>
#include <exception>
#include <iostream>
#include <span>
#include <string_view>
#include <vector>

#include <glm/common.hpp>

namespace {

using scree::Photo;

constexpr int kGap = 6;  // px

// Mean of the pixels below each new one; pictures are made smaller, or little larger.
Photo at_height(const Photo& picture, int height) {
    const double scale = static_cast<double>(picture.height()) / height;
    const int width = std::max(1, static_cast<int>(picture.width() / scale));
    Photo out(width, height);
    for (int y = 0; y < height; ++y) {
        const int y0 = static_cast<int>(y * scale);
        const int y1 = std::clamp(static_cast<int>((y + 1) * scale), y0 + 1, picture.height());
        for (int x = 0; x < width; ++x) {
            const int x0 = static_cast<int>(x * scale);
            const int x1 = std::clamp(static_cast<int>((x + 1) * scale), x0 + 1, picture.width());
            glm::dvec3 sum(0.0);
            for (int v = y0; v < y1; ++v)
                for (int u = x0; u < x1; ++u)
                    sum += glm::dvec3(picture(u, v));
            out(x, y) = glm::u8vec3(glm::round(sum / static_cast<double>((x1 - x0) * (y1 - y0))));
        }
    }
    return out;
}

// Beside each other, so high that they fill the width.
Photo row_of(const std::vector<Photo>& pictures, int width) {
    double aspect = 0.0;
    for (const Photo& picture : pictures)
        aspect += static_cast<double>(picture.width()) / picture.height();
    const int room = width - kGap * (static_cast<int>(pictures.size()) - 1);
    const int height = std::max(1, static_cast<int>(room / aspect));
    Photo row = at_height(pictures[0], height);
    for (std::size_t i = 1; i < pictures.size(); ++i)
        row = scree::meshing::side_by_side(row, at_height(pictures[i], height), kGap);
    return row;
}

// Below each other, with white where one is narrower.
Photo stacked(const Photo& above, const Photo& below) {
    Photo out(std::max(above.width(), below.width()), above.height() + kGap + below.height(),
              glm::u8vec3(255));
    for (int y = 0; y < above.height(); ++y)
        std::copy_n(above.row(y), above.width(), out.row(y));
    for (int y = 0; y < below.height(); ++y)
        std::copy_n(below.row(y), below.width(), out.row(above.height() + kGap + y));
    return out;
}

Photo montage(int width, std::span<char*> words) {
    Photo all;
    std::vector<Photo> row;
    const auto end_row = [&] {
        if (!row.empty())
            all = all.empty() ? row_of(row, width) : stacked(all, row_of(row, width));
        row.clear();
    };
    for (const std::string_view word : words)
        if (word == "/")
            end_row();
        else
            row.push_back(scree::vision::read_photo(word).pixels);
    end_row();
    return all;
}

}  // namespace

int main(int n_words, char** words) {
    const auto width = n_words > 3 ? scree::parse_number<int>(words[2]) : std::nullopt;
    if (!width || *width < 64 || *width > 8192) {
        std::cerr << "usage: montage OUT.jpg WIDTH PICTURE... [/ PICTURE...]\n";
        return 2;
    }
    try {
        const Photo all = montage(*width, {words + 3, static_cast<std::size_t>(n_words - 3)});
        scree::write_whole_file(words[1], scree::vision::encode_jpeg(all, 85));
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "montage: " << error.what() << '\n';
        return 1;
    }
}
