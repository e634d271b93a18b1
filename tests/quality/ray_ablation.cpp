// What the source's chain (rays, turning-angle filter, centroid iteration, Bezier gaps) adds to the
// regions of the classical method, on the same edge field: docs/vision-classical.md shows the
// table.
//
//   ray_ablation [FOLDER ...]     folders of the shared labelled photographs; all three by default
#include "tests/support/shared_data.h"
#include "vision/classical/candidate_outline_finder.h"
#include "vision/classical/classical_edge_detector.h"
#include "vision/data/metrics.h"
#include "vision/image_io.h"
#include "vision/thesis/ray_outline_finder.h"
#include "vision/thesis/slice_tracer.h"

#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace scree;
using namespace scree::vision;

constexpr float kEdge = 0.5F;  // boundary from which on a pixel stops a ray

Mask edges_of(const EdgeField& field) {
    Mask edges(field.boundary.width(), field.boundary.height());
    for (std::size_t i = 0; i < edges.size(); ++i)
        edges.data()[i] = field.boundary.data()[i] >= kEdge ? 1 : 0;
    return edges;
}

ThesisOptions unscaled() {
    ThesisOptions options;
    options.working_width = 0;
    options.greatest_radius = 1e5;
    return options;
}

double support(const FloatRaster& boundary, const Outline& outline) {
    double sum = 0.0;
    for (int k = 0; k < kRadii; ++k) {
        const glm::dvec2 p = border_point(outline, k);
        if (p.x >= 0.0 && p.y >= 0.0 && p.x < boundary.width() && p.y < boundary.height())
            sum += static_cast<double>(boundary(static_cast<int>(p.x), static_cast<int>(p.y)));
    }
    return sum / kRadii;
}

// Ways to draw the rocks of one photograph, in the order of kWays.
std::vector<std::vector<Outline>> draw(const Photo& photo) {
    const EdgeField field = ClassicalEdgeDetector().detect(photo);
    const std::vector<Outline> regions = CandidateOutlineFinder().find(photo, field);
    const SliceTracer tracer(edges_of(field), unscaled());
    std::vector<Outline> rays = regions;
    std::vector<Outline> better = regions;
    for (std::size_t i = 0; i < regions.size(); ++i) {
        const auto slice = tracer.trace(regions[i].centre);
        if (!slice)
            continue;
        rays[i] = slice->outline;
        rays[i].confidence = regions[i].confidence;
        const double growth = equivalent_diameter(rays[i]) / equivalent_diameter(regions[i]);
        if (growth > 0.7 && growth < 1.4 &&
            support(field.boundary, rays[i]) > support(field.boundary, regions[i]) + 0.02)
            better[i] = rays[i];
    }
    return {regions, rays, better, RayOutlineFinder(unscaled()).find(photo, field)};
}

constexpr const char* kWays[] = {
    "regions, as shipped",
    "the same rocks, redrawn by rays from their centres",
    "redrawn where that lies on more boundary",
    "rays alone: grid, culling, quality filters",
};

void report(const std::string& folder) {
    std::vector<std::vector<LabelScore>> scores(std::size(kWays));
    for (const auto& pair : test::labelled_photos(folder)) {
        const Photo photo = read_photo(pair.photo).pixels;
        const LabelMap truth = read_labels(pair.labels);
        const auto drawn = draw(photo);
        for (std::size_t way = 0; way < drawn.size(); ++way)
            scores[way].push_back(
                score_labels(paint_labels(drawn[way], photo.width(), photo.height()), truth));
    }
    for (std::size_t way = 0; way < scores.size(); ++way) {
        const LabelScore mean = mean_score(scores[way]);
        std::printf("%-8s %-52s AP50 %.3f  IoU %.3f\n", folder.c_str(), kWays[way], mean.ap50,
                    mean.iou);
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (test::shared_data().empty()) {
        std::fprintf(stderr, "labelled photographs not found: set SCREE_SHARED_DATA\n");
        return 1;
    }
    const std::vector<std::string> given(argv + 1, argv + argc);
    for (const std::string& folder :
         given.empty() ? std::vector<std::string>{"gravel", "outcrop", "sand"} : given)
        report(folder);
    return 0;
}
