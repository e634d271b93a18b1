#include "base/error.h"
#include "meshing/io/point_io.h"

#include <cmath>
#include <cstdlib>

// Any bytes are points, each with a class and finite, or an error of ours.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scree;
    const meshing::MeshLimits limits{.max_bytes = 1 << 20, .max_vertices = 10'000};
    try {
        const auto cloud =
            meshing::decode_points({data, size}, meshing::PointFormat::Las, "fuzz", limits);
        if (cloud.points.empty() || cloud.classes.size() != cloud.points.size())
            std::abort();
        for (const glm::dvec3& p : cloud.points)
            if (!std::isfinite(p.x + p.y + p.z))
                std::abort();
    } catch (const Error&) {
    }
    return 0;
}
