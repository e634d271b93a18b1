#pragma once

#include "vision/classical/merge_tree.h"

namespace scree::vision {

/// How the hierarchy of regions is cut from an edge field.
struct HierarchyOptions {
    double inside = 0.3;   ///< Least inside value of a pixel that may belong to a rock.
    double smooth = 1.0;   ///< Width of the blur before the basins are sought, pixels.
    double depth = 0.5;    ///< Weight of the distance channel in the relief.
    double highest = 0.9;  ///< Borders stronger than this are never removed.
};

struct RegionHierarchy {
    BasinMap basins;
    MergeTree tree;
};

/// Basins of the field and their unions. An empty inside or distance channel is filled first.
RegionHierarchy region_hierarchy(const Photo& photo, const EdgeField& field,
                                 const HierarchyOptions& options = {});

}  // namespace scree::vision
