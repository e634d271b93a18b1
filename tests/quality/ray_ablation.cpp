// What each stage adds to a plain watershed of the edge field: the source's chain (rays,
// turning-angle filter, centroid iteration, Bezier gaps), the choice among the regions of a
// hierarchy, and the refinement, all on the same field. docs/vision-learned.md and
// docs/vision-classical.md show the tables.
//
//   ray_ablation [--classical] [FOLDER ...]   folders of the shared labelled photographs; all three
//                                             by default
#include "tests/quality/plain_watershed.h"
#include "tests/support/shared_data.h"
#include "vision/classical/candidate_outline_finder.h"
#include "vision/classical/classical_edge_detector.h"
#include "vision/data/metrics.h"
#include "vision/image_io.h"
#include "vision/learned/learned_edge_detector.h"
#include "vision/refine/refine_outlines.h"
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
std::vector<LabelMap> draw(const Photo& photo, const EdgeDetector& detector,
                           const OutlineFinder& finder) {
    const EdgeField field = detector.detect(photo);
    const std::vector<Outline> regions = finder.find(photo, field);
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
    std::vector<Outline> refined;
    for (const Rock& rock : refine_outlines(photo, field, regions).rocks)
        refined.push_back(rock.outline);
    std::vector<LabelMap> drawn = {test::plain_watershed(field)};
    for (const auto& outlines :
         {RayOutlineFinder(unscaled()).find(photo, field), rays, better, regions, refined})
        drawn.push_back(paint_labels(outlines, photo.width(), photo.height()));
    return drawn;
}

constexpr const char* kWays[] = {
    "plain watershed from the peaks of the distance",
    "rays alone: grid, culling, quality filters",
    "chosen regions, redrawn by rays from their centres",
    "chosen regions, redrawn where that is on more boundary",
    "chosen regions",
    "chosen regions, refined: as shipped",
};

void report(const std::string& folder, const EdgeDetector& detector, const OutlineFinder& finder) {
    std::vector<std::vector<LabelScore>> scores(std::size(kWays));
    for (const auto& pair : test::labelled_photos(folder)) {
        const Photo photo = read_photo(pair.photo).pixels;
        const LabelMap truth = read_labels(pair.labels);
        const auto drawn = draw(photo, detector, finder);
        for (std::size_t way = 0; way < drawn.size(); ++way)
            scores[way].push_back(score_labels(drawn[way], truth));
    }
    for (std::size_t way = 0; way < scores.size(); ++way) {
        const LabelScore mean = mean_score(scores[way]);
        std::printf("%-8s %-56s AP50 %.3f  IoU %.3f  D50 %.3f  D84 %.3f\n", folder.c_str(),
                    kWays[way], mean.ap50, mean.iou, mean.d50_error, mean.d84_error);
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (test::shared_data().empty()) {
        std::fprintf(stderr, "labelled photographs not found: set SCREE_SHARED_DATA\n");
        return 1;
    }
    std::vector<std::string> folders(argv + 1, argv + argc);
    const bool classical = std::erase(folders, "--classical") > 0;
    if (folders.empty())
        folders = {"gravel", "outcrop", "sand"};
    const LearnedEdgeDetector learned;
    const ClassicalEdgeDetector measured;
    const CandidateOutlineFinder finder({},
                                        classical ? trained_score_model() : learned_score_model());
    for (const std::string& folder : folders)
        report(folder, classical ? static_cast<const EdgeDetector&>(measured) : learned, finder);
    return 0;
}
