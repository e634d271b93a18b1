scree_add_test(terrain/surface/wet_erosion LIBS scree::terrain LABELS threads)
scree_add_test(terrain/surface/sediment LIBS scree::terrain)
scree_add_test(terrain/surface/erosion_loop LIBS scree::terrain)
scree_add_test(terrain/surface/erosion_scene LIBS scree::terrain)
