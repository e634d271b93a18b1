#include "meshing/mesh/tri_mesh.h"
#include "vision/outline.h"

#include <iostream>

// A program outside the tree: one disc, painted and measured through the installed headers.
int main() {
    scree::vision::Outline disc;
    disc.centre = {50.0, 50.0};
    disc.radii.fill(20.0F);
    const auto labels = scree::vision::paint_labels({disc}, 100, 100);
    const double volume = scree::meshing::signed_volume({});
    std::cout << scree::vision::equivalent_diameter(disc) << ' ' << labels.size() << ' ' << volume
              << '\n';
    return labels(50, 50) == 1 ? 0 : 1;
}
