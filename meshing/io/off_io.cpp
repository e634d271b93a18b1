#include "meshing/io/mesh_codecs.h"
#include "meshing/io/text_scanner.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scree::meshing::io {
namespace {

class OffReader {
public:
    explicit OffReader(const Source& source)
        : source_(source), scanner_(source.bytes), builder_(source) {}

    MeshFile read() {
        const std::string_view mark = scanner_.word_anywhere();
        if (mark != "OFF" && mark != "COFF")
            source_.refuse("it does not begin with OFF or COFF");
        coloured_ = mark == "COFF";
        const auto n_vertices = number<std::size_t>();
        const auto n_faces = number<std::size_t>();
        number<std::size_t>();  // edges: nobody counts them
        // A vertex takes six bytes at least, a face eight.
        if (n_vertices > source_.bytes.size() / 6 || n_faces > source_.bytes.size() / 8)
            source_.refuse("it declares ", n_vertices, " vertices and ", n_faces, " faces in ",
                           source_.bytes.size(), " bytes");
        builder_.expect(n_vertices, n_faces);
        for (std::size_t i = 0; i < n_vertices; ++i)
            read_vertex();
        for (std::size_t i = 0; i < n_faces; ++i)
            read_face();
        return builder_.finish();
    }

private:
    template <class Number>
    Number number() {
        Number value{};
        if (!parse(scanner_.word_anywhere(), value))
            source_.refuse("line ", scanner_.line_number(), " holds no number where one is needed");
        return value;
    }

    void read_vertex() {
        const auto x = number<double>();
        const auto y = number<double>();
        builder_.add_vertex(x, y, number<double>());
        if (!coloured_)
            return;
        std::array<double, 4> colour{};
        for (double& c : colour)
            c = std::clamp(number<double>(), 0.0, 255.0);
        const double unit = std::max({colour[0], colour[1], colour[2], colour[3]}) > 1.0 ? 1 : 255;
        const auto byte = [unit](double c) {
            return static_cast<std::uint8_t>(std::isnan(c) ? 0L : std::lround(c * unit));
        };
        builder_.file.colours.emplace_back(byte(colour[0]), byte(colour[1]), byte(colour[2]));
    }

    void read_face() {
        const auto n = number<std::size_t>();
        if (n > source_.bytes.size())
            source_.refuse("a face declares ", n, " corners");
        polygon_.clear();
        for (std::size_t k = 0; k < n; ++k)
            polygon_.push_back(number<std::uint32_t>());
        while (!scanner_.word().empty()) {  // colours of faces, up to the end of the line
        }
        builder_.add_polygon(polygon_);
    }

    const Source& source_;
    TextScanner scanner_;
    Builder builder_;
    std::vector<std::uint32_t> polygon_;
    bool coloured_ = false;
};

}  // namespace

MeshFile decode_off(const Source& source) {
    return OffReader(source).read();
}

std::string encode_off(const MeshFile& file) {
    std::string text = file.colours.empty() ? "OFF\n" : "COFF\n";
    put(text, file.mesh.positions.size());
    text += ' ';
    put(text, file.mesh.triangles.size());
    text += " 0\n";
    for (std::size_t i = 0; i < file.mesh.positions.size(); ++i) {
        const glm::vec3& p = file.mesh.positions[i];
        put(text, p.x);
        text += ' ';
        put(text, p.y);
        text += ' ';
        put(text, p.z);
        if (!file.colours.empty()) {
            for (int k = 0; k < 3; ++k) {
                text += ' ';
                put(text, static_cast<unsigned>(file.colours[i][k]));
            }
            text += " 255";
        }
        text += '\n';
    }
    for (const glm::uvec3& t : file.mesh.triangles) {
        text += '3';
        for (int k = 0; k < 3; ++k) {
            text += ' ';
            put(text, t[k]);
        }
        text += '\n';
    }
    return text;
}

}  // namespace scree::meshing::io
