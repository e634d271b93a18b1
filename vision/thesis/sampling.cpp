#include "vision/thesis/sampling.h"

#include <algorithm>

namespace scree::vision {

std::vector<glm::ivec2> grid_nodes(int width, int height, int spacing) {
    const int columns = std::max(1, width / spacing);
    const int rows = std::max(1, height / spacing);
    std::vector<glm::ivec2> nodes;
    nodes.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            nodes.emplace_back(std::min(width - 1, i * spacing + spacing / 2),
                               std::min(height - 1, j * spacing + spacing / 2));
    return nodes;
}

std::vector<glm::ivec2> visiting_order(const RayCaster& caster, const ThesisOptions& options) {
    auto nodes = grid_nodes(caster.width(), caster.height(), options.grid_spacing);
    std::erase_if(nodes, [&](glm::ivec2 p) { return caster.clearance(p.x, p.y) == 0; });
    if (options.order == VisitOrder::DeepestFirst)
        std::stable_sort(nodes.begin(), nodes.end(), [&](glm::ivec2 a, glm::ivec2 b) {
            return caster.clearance(a.x, a.y) > caster.clearance(b.x, b.y);
        });
    return nodes;
}

}  // namespace scree::vision
