#include "meshing/io/mesh_codecs.h"
#include "meshing/io/text_scanner.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace scree::meshing::io {
namespace {

enum class Type { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };
enum class Coding { Text, Little, Big };

struct Property {
    std::string_view name;
    Type type = Type::Float;
    bool is_list = false;
    Type count_type = Type::Uint8;
};

struct Element {
    std::string_view name;
    std::size_t count = 0;
    std::vector<Property> properties;
};

std::size_t size_of(Type type) {
    constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}

bool type_of(std::string_view word, Type& type) {
    constexpr std::array<std::array<std::string_view, 2>, 8> kWords = {{{"char", "int8"},
                                                                        {"uchar", "uint8"},
                                                                        {"short", "int16"},
                                                                        {"ushort", "uint16"},
                                                                        {"int", "int32"},
                                                                        {"uint", "uint32"},
                                                                        {"float", "float32"},
                                                                        {"double", "float64"}}};
    for (std::size_t i = 0; i < kWords.size(); ++i)
        if (word == kWords[i][0] || word == kWords[i][1]) {
            type = static_cast<Type>(i);
            return true;
        }
    return false;
}

// The numbers of the body, one after the other, whatever their coding.
class Body {
public:
    Body(const Source& source, std::string_view bytes, Coding coding)
        : source_(source), bytes_(bytes), scanner_(bytes), coding_(coding) {}

    double number(Type type) {
        if (coding_ == Coding::Text) {
            double value = 0.0;
            if (!parse(scanner_.word_anywhere(), value))
                source_.refuse("line ", scanner_.line_number(),
                               " of the data holds no number where one is needed");
            return value;
        }
        const std::size_t size = size_of(type);
        if (bytes_.size() < size)
            source_.refuse("it ends too soon");
        std::array<char, 8> at{};
        std::copy_n(bytes_.data(), size, at.data());
        bytes_.remove_prefix(size);
        if ((coding_ == Coding::Big) != (std::endian::native == std::endian::big))
            std::reverse(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(size));
        return decode(at.data(), type);
    }

    // A count or an index.
    std::size_t whole(Type type, std::string_view what) {
        const double value = number(type);
        if (!(value >= 0.0 && value <= 4294967295.0 && value == std::floor(value)))
            source_.refuse("it has ", value, " as ", what);
        return static_cast<std::size_t>(value);
    }

    // Numbers of at least so many bytes each may still follow.
    bool can_hold(std::size_t n, std::size_t bytes_each) const {
        const std::size_t left = coding_ == Coding::Text ? scanner_.n_left() : bytes_.size();
        return bytes_each == 0 || n <= left / bytes_each + 1;
    }
    Coding coding() const { return coding_; }

private:
    template <class T>
    static double as(const char* at) {
        T value{};
        std::memcpy(&value, at, sizeof value);
        return static_cast<double>(value);
    }

    static double decode(const char* at, Type type) {
        switch (type) {
            case Type::Int8:
                return as<std::int8_t>(at);
            case Type::Uint8:
                return as<std::uint8_t>(at);
            case Type::Int16:
                return as<std::int16_t>(at);
            case Type::Uint16:
                return as<std::uint16_t>(at);
            case Type::Int32:
                return as<std::int32_t>(at);
            case Type::Uint32:
                return as<std::uint32_t>(at);
            case Type::Float:
                return as<float>(at);
            case Type::Double:
                return as<double>(at);
        }
        return 0.0;
    }

    const Source& source_;
    std::string_view bytes_;
    TextScanner scanner_;
    Coding coding_;
};

class PlyReader {
public:
    explicit PlyReader(const Source& source, std::vector<glm::dvec3>* exact = nullptr)
        : source_(source), builder_(source) {
        builder_.exact = exact;
    }

    MeshFile read() {
        const std::string_view bytes = read_header();
        Body body(source_, bytes, coding_);
        for (const Element& element : elements_) {
            check_count(element, body);
            if (element.name == "vertex")
                read_vertices(element, body);
            else if (element.name == "face")
                read_faces(element, body);
            else
                pass_over(element, body);
        }
        return builder_.finish();
    }

private:
    std::string_view read_header() {
        TextScanner scanner(source_.bytes);
        if (!scanner.next_line() || scanner.word() != "ply")
            source_.refuse("it does not begin with 'ply'");
        bool has_format = false;
        while (scanner.next_line()) {
            const std::string_view word = scanner.word();
            if (word == "format") {
                read_format(scanner.word());
                has_format = true;
            } else if (word == "element") {
                Element element;
                element.name = scanner.word();
                if (!parse(scanner.word(), element.count) || elements_.size() >= 64)
                    source_.refuse("line ", scanner.line_number(), " names no element and count");
                elements_.push_back(element);
            } else if (word == "property") {
                read_property(scanner);
            } else if (word == "end_header") {
                if (!has_format)
                    source_.refuse("its header names no format");
                return scanner.rest();
            }
        }
        source_.refuse("its header has no end");
    }

    void read_format(std::string_view word) {
        if (word == "ascii")
            coding_ = Coding::Text;
        else if (word == "binary_little_endian")
            coding_ = Coding::Little;
        else if (word == "binary_big_endian")
            coding_ = Coding::Big;
        else
            source_.refuse("its format '", word.substr(0, 40),
                           "' is not ascii, binary_little_endian or binary_big_endian");
    }

    void read_property(TextScanner& scanner) {
        Property property;
        std::string_view word = scanner.word();
        if (word == "list") {
            property.is_list = true;
            if (!type_of(scanner.word(), property.count_type))
                source_.refuse("line ", scanner.line_number(), " names a type that is none");
            word = scanner.word();
        }
        if (!type_of(word, property.type) || elements_.empty() ||
            elements_.back().properties.size() >= 256)
            source_.refuse("line ", scanner.line_number(), " describes no property");
        property.name = scanner.word();
        elements_.back().properties.push_back(property);
    }

    // A declared count that the bytes cannot hold costs nothing.
    void check_count(const Element& element, const Body& body) const {
        std::size_t least = 0;
        for (const Property& p : element.properties)
            least += body.coding() == Coding::Text ? 2 : size_of(p.is_list ? p.count_type : p.type);
        if (element.count > 0 && (least == 0 || !body.can_hold(element.count, least)))
            source_.refuse("it declares ", element.count, " of '", element.name.substr(0, 40),
                           "', more than its bytes can hold");
    }

    static int place_of(const Element& element, std::string_view name) {
        for (std::size_t i = 0; i < element.properties.size(); ++i)
            if (element.properties[i].name == name && !element.properties[i].is_list)
                return static_cast<int>(i);
        return -1;
    }

    void read_record(const Element& element, Body& body) {
        values_.clear();
        for (const Property& p : element.properties) {
            if (!p.is_list) {
                values_.push_back(body.number(p.type));
                continue;
            }
            values_.push_back(0.0);
            for (std::size_t n = body.whole(p.count_type, "the length of a list"); n > 0; --n)
                body.number(p.type);
        }
    }

    void read_vertices(const Element& element, Body& body) {
        std::array<int, 3> at{};
        std::array<int, 3> colour{};
        for (std::size_t k = 0; k < 3; ++k) {
            at[k] = place_of(element, std::array{"x", "y", "z"}[k]);
            colour[k] = place_of(element, std::array{"red", "green", "blue"}[k]);
        }
        if (at[0] < 0 || at[1] < 0 || at[2] < 0)
            source_.refuse("its vertices have no x, y and z");
        const bool coloured = colour[0] >= 0 && colour[1] >= 0 && colour[2] >= 0;
        builder_.expect(element.count, 0);
        for (std::size_t i = 0; i < element.count; ++i) {
            read_record(element, body);
            const auto value = [this](int place) {
                return values_[static_cast<std::size_t>(place)];
            };
            builder_.add_vertex(value(at[0]), value(at[1]), value(at[2]));
            if (!coloured)
                continue;
            const auto byte = [&](std::size_t k) {
                const Type type = element.properties[static_cast<std::size_t>(colour[k])].type;
                const double unit = type == Type::Float || type == Type::Double ? 255.0 : 1.0;
                const double c = value(colour[k]) * unit;
                return static_cast<std::uint8_t>(
                    std::isnan(c) ? 0L : std::lround(std::clamp(c, 0.0, 255.0)));
            };
            builder_.file.colours.emplace_back(byte(0), byte(1), byte(2));
        }
    }

    void read_faces(const Element& element, Body& body) {
        if (element.count > source_.limits.max_triangles)
            source_.refuse("it declares ", element.count, " faces, at most ",
                           source_.limits.max_triangles, " triangles are read");
        builder_.file.mesh.triangles.reserve(element.count);
        for (std::size_t i = 0; i < element.count; ++i)
            for (const Property& p : element.properties) {
                if (!p.is_list) {
                    body.number(p.type);
                    continue;
                }
                const std::size_t n = body.whole(p.count_type, "the length of a list");
                if (!body.can_hold(n, body.coding() == Coding::Text ? 2 : size_of(p.type)))
                    source_.refuse("a face declares ", n, " corners, more than its bytes hold");
                if (p.name != "vertex_indices" && p.name != "vertex_index") {
                    for (std::size_t k = 0; k < n; ++k)
                        body.number(p.type);
                    continue;
                }
                polygon_.clear();
                for (std::size_t k = 0; k < n; ++k)
                    polygon_.push_back(static_cast<std::uint32_t>(body.whole(p.type, "an index")));
                builder_.add_polygon(polygon_);
            }
    }

    void pass_over(const Element& element, Body& body) {
        for (std::size_t i = 0; i < element.count; ++i)
            read_record(element, body);
    }

    const Source& source_;
    Builder builder_;
    Coding coding_ = Coding::Text;
    std::vector<Element> elements_;
    std::vector<double> values_;
    std::vector<std::uint32_t> polygon_;
};

template <class Number>
void put_little(std::string& out, Number value) {
    std::array<char, sizeof value> bytes{};
    std::memcpy(bytes.data(), &value, sizeof value);
    if constexpr (std::endian::native == std::endian::big)
        std::reverse(bytes.begin(), bytes.end());
    out.append(bytes.data(), bytes.size());
}

std::string header_of(const MeshFile& file, bool text) {
    std::string out = "ply\nformat ";
    out += text ? "ascii" : "binary_little_endian";
    out += " 1.0\nelement vertex ";
    put(out, file.mesh.positions.size());
    out += "\nproperty float x\nproperty float y\nproperty float z\n";
    if (!file.colours.empty())
        out += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    out += "element face ";
    put(out, file.mesh.triangles.size());
    return out + "\nproperty list uchar uint vertex_indices\nend_header\n";
}

void put_text(std::string& out, const MeshFile& file) {
    for (std::size_t i = 0; i < file.mesh.positions.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            if (k > 0)
                out += ' ';
            put(out, file.mesh.positions[i][k]);
        }
        for (int k = 0; k < 3 && !file.colours.empty(); ++k) {
            out += ' ';
            put(out, static_cast<unsigned>(file.colours[i][k]));
        }
        out += '\n';
    }
    for (const glm::uvec3& t : file.mesh.triangles) {
        out += '3';
        for (int k = 0; k < 3; ++k) {
            out += ' ';
            put(out, t[k]);
        }
        out += '\n';
    }
}

void put_binary(std::string& out, const MeshFile& file) {
    out.reserve(out.size() + 15 * file.mesh.positions.size() + 13 * file.mesh.triangles.size());
    for (std::size_t i = 0; i < file.mesh.positions.size(); ++i) {
        for (int k = 0; k < 3; ++k)
            put_little(out, file.mesh.positions[i][k]);
        for (int k = 0; k < 3 && !file.colours.empty(); ++k)
            put_little(out, file.colours[i][k]);
    }
    for (const glm::uvec3& t : file.mesh.triangles) {
        out += '\3';
        for (int k = 0; k < 3; ++k)
            put_little(out, t[k]);
    }
}

}  // namespace

MeshFile decode_ply(const Source& source) {
    return PlyReader(source).read();
}

PointCloud decode_ply_points(const Source& source) {
    PointCloud cloud;
    PlyReader(source, &cloud.points).read();
    return cloud;
}

std::string encode_ply(const MeshFile& file, bool text) {
    std::string out = header_of(file, text);
    if (text)
        put_text(out, file);
    else
        put_binary(out, file);
    return out;
}

}  // namespace scree::meshing::io
