#include "meshing/io/mesh_codecs.h"
#include "meshing/io/text_scanner.h"
#include "meshing/mesh/weld.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include <glm/geometric.hpp>

namespace scree::meshing::io {
namespace {

constexpr std::size_t kHeader = 84;
constexpr std::size_t kRecord = 50;  // normal, three corners, two bytes

std::uint32_t little_endian(const char* at) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i)
        value = value << 8U | static_cast<unsigned char>(at[i]);
    return value;
}

void put_little_endian(std::string& out, std::uint32_t value) {
    for (int i = 0; i < 4; ++i)
        out += static_cast<char>(value >> (8 * i) & 0xFFU);
}

float float_at(const char* at) {
    const std::uint32_t bits = little_endian(at);
    float value = 0.0F;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

void put_float(std::string& out, float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    put_little_endian(out, bits);
}

// Three vertices a triangle, welded afterwards.
class Soup {
public:
    explicit Soup(const Source& source)
        : source_(source),
          limits_{source.limits.max_bytes, 3 * source.limits.max_triangles,
                  source.limits.max_triangles},
          raised_{source.bytes, source.name, limits_},
          builder_(raised_) {}

    void expect(std::size_t n) { builder_.expect(3 * n, n); }
    void add_corner(double x, double y, double z) { builder_.add_vertex(x, y, z); }
    std::size_t n_corners() const { return builder_.file.mesh.positions.size(); }
    void close_triangle() {
        const auto n = static_cast<std::uint32_t>(n_corners());
        builder_.add_polygon(std::array{n - 3, n - 2, n - 1});
    }
    MeshFile finish() {
        MeshFile file = builder_.finish();
        file.mesh = weld(file.mesh);
        if (file.mesh.positions.size() > source_.limits.max_vertices)
            source_.refuse("it has more than ", source_.limits.max_vertices, " vertices");
        return file;
    }

private:
    const Source& source_;
    MeshLimits limits_;
    Source raised_;
    Builder builder_;
};

MeshFile decode_binary(const Source& source) {
    const std::size_t n = little_endian(source.bytes.data() + 80);
    Soup soup(source);
    soup.expect(n);
    for (std::size_t i = 0; i < n; ++i) {
        const char* const record = source.bytes.data() + kHeader + i * kRecord;
        for (std::size_t k = 1; k < 4; ++k)
            soup.add_corner(float_at(record + 12 * k), float_at(record + 12 * k + 4),
                            float_at(record + 12 * k + 8));
        soup.close_triangle();
    }
    return soup.finish();
}

MeshFile decode_text(const Source& source) {
    TextScanner scanner(source.bytes);
    Soup soup(source);
    std::size_t in_face = 0;
    while (scanner.next_line()) {
        const std::string_view kind = scanner.word();
        if (kind == "vertex") {
            std::array<double, 3> p{};
            for (double& c : p)
                if (!parse(scanner.word(), c))
                    source.refuse("line ", scanner.line_number(),
                                  " has no three numbers after 'vertex'");
            soup.add_corner(p[0], p[1], p[2]);
            ++in_face;
        } else if (kind == "endfacet") {
            if (in_face != 3)
                source.refuse("line ", scanner.line_number(), " ends a facet of ", in_face,
                              " vertices");
            soup.close_triangle();
            in_face = 0;
        }
    }
    if (in_face != 0)
        source.refuse("it ends within a facet");
    return soup.finish();
}

glm::vec3 normal_of(const TriMesh& mesh, const glm::uvec3& t) {
    const glm::dvec3 a(mesh.positions[t.x]);
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
    const double length = glm::length(normal);
    return length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0F);
}

void put_words(std::string& text, std::string_view name, const glm::vec3& v) {
    text += name;
    for (int k = 0; k < 3; ++k) {
        text += ' ';
        put(text, v[k]);
    }
    text += '\n';
}

}  // namespace

MeshFile decode_stl(const Source& source) {
    const std::size_t size = source.bytes.size();
    // Some programs begin binary files with "solid" too, so the size decides.
    if (size >= kHeader && (size - kHeader) / kRecord == little_endian(source.bytes.data() + 80) &&
        (size - kHeader) % kRecord == 0)
        return decode_binary(source);
    if (!source.bytes.starts_with("solid"))
        source.refuse("it neither begins with 'solid' nor holds as many triangles as it declares");
    return decode_text(source);
}

std::string encode_stl(const MeshFile& file, bool text) {
    const TriMesh& mesh = file.mesh;
    if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max())
        fail<InvalidInput>("STL holds at most 4294967295 triangles, the mesh has ",
                           mesh.triangles.size());
    std::string out;
    if (text) {
        out = "solid mesh\n";
        for (const glm::uvec3& t : mesh.triangles) {
            put_words(out, "facet normal", normal_of(mesh, t));
            out += "outer loop\n";
            for (int k = 0; k < 3; ++k)
                put_words(out, "vertex", mesh.positions[t[k]]);
            out += "endloop\nendfacet\n";
        }
        return out + "endsolid mesh\n";
    }
    out.assign(80, ' ');
    out.reserve(kHeader + kRecord * mesh.triangles.size());
    put_little_endian(out, static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 normal = normal_of(mesh, t);
        for (int k = 0; k < 3; ++k)
            put_float(out, normal[k]);
        for (int corner = 0; corner < 3; ++corner)
            for (int k = 0; k < 3; ++k)
                put_float(out, mesh.positions[t[corner]][k]);
        out.append(2, '\0');
    }
    return out;
}

}  // namespace scree::meshing::io
