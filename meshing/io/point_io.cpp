#include "meshing/io/point_io.h"

#include "base/whole_file.h"
#include "meshing/io/mesh_codecs.h"

#include <algorithm>
#include <cctype>

namespace scree::meshing {

PointFormat point_format_of(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".ply")
        return PointFormat::Ply;
    if (ending == ".las")
        return PointFormat::Las;
    fail<IoError>("cannot read points from ", path.string(), ": its name must end in .ply or .las",
                  ending == ".laz" ? "; write the .laz file as .las first" : "");
}

PointCloud decode_points(std::span<const std::uint8_t> bytes, PointFormat format,
                         std::string_view name, const MeshLimits& limits) {
    const io::Source source{
        {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name, limits};
    if (bytes.size() > limits.max_bytes)
        source.refuse("it has ", bytes.size(), " bytes, at most ", limits.max_bytes, " are read");
    return format == PointFormat::Las ? io::decode_las(source) : io::decode_ply_points(source);
}

PointCloud read_points(const std::filesystem::path& path, const MeshLimits& limits) {
    const PointFormat format = point_format_of(path);
    const std::string bytes = read_whole_file(path, limits.max_bytes);
    return decode_points({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                         format, path.string(), limits);
}

}  // namespace scree::meshing
