# Every package is named once. Modules link the imported targets privately.
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(OpenCV REQUIRED COMPONENTS core imgproc dnn)
find_package(Ceres REQUIRED)
find_package(OpenImageIO REQUIRED)
find_package(OpenMesh REQUIRED)
find_library(SCREE_DEFLATE deflate REQUIRED)  # linked by its name
mark_as_advanced(SCREE_DEFLATE)
find_package(TinyGLTF REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(CLI11 REQUIRED)
find_package(epoxy REQUIRED)
