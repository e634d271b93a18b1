#include "meshing/io/mesh_codecs.h"
#include "meshing/io/text_scanner.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace scree::meshing::io {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

class ObjReader {
public:
    explicit ObjReader(const Source& source)
        : source_(source), scanner_(source.bytes), builder_(source) {}

    MeshFile read() {
        while (scanner_.next_line()) {
            const std::string_view kind = scanner_.word();
            if (kind == "v")
                read_vertex();
            else if (kind == "vt")
                read_texcoord();
            else if (kind == "f")
                read_face();
        }
        MeshFile file = builder_.finish();
        set_texcoords(file.mesh);
        return file;
    }

private:
    [[noreturn]] void refuse(std::string_view what) const {
        source_.refuse("line ", scanner_.line_number(), " ", what);
    }

    double number(std::string_view what) {
        double value = 0.0;
        if (!parse(scanner_.word(), value))
            refuse(what);
        return value;
    }

    void read_vertex() {
        const double x = number("has no three numbers after 'v'");
        const double y = number("has no three numbers after 'v'");
        builder_.add_vertex(x, y, number("has no three numbers after 'v'"));
    }

    void read_texcoord() {
        const double u = number("has no two numbers after 'vt'");
        const double v = number("has no two numbers after 'vt'");
        if (!std::isfinite(static_cast<float>(u)) || !std::isfinite(static_cast<float>(v)))
            refuse("has a texture coordinate that is no number");
        texcoords_.emplace_back(u, 1.0 - v);  // glTF counts from the top
    }

    // Counted from 1, or backwards from the last one.
    std::uint32_t index(std::string_view word, std::size_t n) const {
        std::int64_t value = 0;
        if (!parse(word, value) || value == 0 || value > std::int64_t{kNone} - 1 ||
            value < -static_cast<std::int64_t>(n))
            refuse("has a face with an index that names nothing");
        return static_cast<std::uint32_t>(value > 0 ? value - 1
                                                    : static_cast<std::int64_t>(n) + value);
    }

    void read_face() {
        polygon_.clear();
        for (std::string_view word = scanner_.word(); !word.empty() && word.front() != '#';
             word = scanner_.word()) {
            const std::size_t slash = word.find('/');
            polygon_.push_back(index(word.substr(0, slash), builder_.file.mesh.positions.size()));
            if (slash == std::string_view::npos)
                continue;
            word.remove_prefix(slash + 1);
            const std::string_view coordinate = word.substr(0, word.find('/'));
            if (!coordinate.empty())
                note_texcoord(polygon_.back(), index(coordinate, texcoords_.size()));
        }
        if (polygon_.size() < 3)
            refuse("has a face with less than three corners");
        builder_.add_polygon(polygon_);
    }

    void note_texcoord(std::uint32_t vertex, std::uint32_t texcoord) {
        if (vertex >= source_.limits.max_vertices || vertex >= builder_.file.mesh.positions.size())
            return;
        if (vertex >= texcoord_of_.size())
            texcoord_of_.resize(builder_.file.mesh.positions.size(), kNone);
        if (texcoord_of_[vertex] != kNone && texcoord_of_[vertex] != texcoord)
            one_each_ = false;
        texcoord_of_[vertex] = texcoord;
    }

    void set_texcoords(TriMesh& mesh) const {
        if (!one_each_ || texcoord_of_.size() != mesh.positions.size())
            return;
        for (const std::uint32_t t : texcoord_of_)
            if (t >= texcoords_.size())
                return;
        for (const std::uint32_t t : texcoord_of_)
            mesh.texcoords.push_back(texcoords_[t]);
    }

    const Source& source_;
    TextScanner scanner_;
    Builder builder_;
    std::vector<std::uint32_t> polygon_;
    std::vector<glm::vec2> texcoords_;
    std::vector<std::uint32_t> texcoord_of_;
    bool one_each_ = true;
};

}  // namespace

MeshFile decode_obj(const Source& source) {
    return ObjReader(source).read();
}

std::string encode_obj(const MeshFile& file) {
    const TriMesh& mesh = file.mesh;
    std::string text;
    text.reserve(36 * mesh.positions.size() + 24 * mesh.triangles.size());
    for (const glm::vec3& p : mesh.positions) {
        text += "v ";
        put(text, p.x);
        text += ' ';
        put(text, p.y);
        text += ' ';
        put(text, p.z);
        text += '\n';
    }
    for (const glm::vec2& t : mesh.texcoords) {
        text += "vt ";
        put(text, t.x);
        text += ' ';
        put(text, 1.0F - t.y);
        text += '\n';
    }
    for (const glm::uvec3& t : mesh.triangles) {
        text += 'f';
        for (int k = 0; k < 3; ++k) {
            text += ' ';
            put(text, t[k] + 1);
            if (!mesh.texcoords.empty()) {
                text += '/';
                put(text, t[k] + 1);
            }
        }
        text += '\n';
    }
    return text;
}

}  // namespace scree::meshing::io
