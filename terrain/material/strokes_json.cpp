#include "base/error.h"
#include "base/number_text.h"
#include "base/whole_file.h"
#include "terrain/material/map_check.h"
#include "terrain/json/strict_json.h"
#include "terrain/material/material_reference.h"
#include "terrain/material/strokes.h"

namespace scree::terrain {
namespace {

using nlohmann::json;

constexpr double kMaxLength = 1e6;
constexpr std::size_t kLargestStroke = 4 * kMaxStrokePoints + 64;  // values and ends of lists

constexpr std::string_view kKindNames[] = {"brush", "polygon", "fill", "undo", "redo"};

glm::dvec2 point_from(const json& value, const JsonPlace& place) {
    if (list_of(value, place, 2).size() != 2)
        fail<InvalidInput>(place.text(), " must have 2 numbers, has ", value.size());
    return {number_of(value[0], place.entry(0), -kMaxLength, kMaxLength),
            number_of(value[1], place.entry(1), -kMaxLength, kMaxLength)};
}

std::vector<glm::dvec2> points_from(JsonObject& object, std::size_t least) {
    std::vector<glm::dvec2> points;
    if (const json* at = object.find("at"))
        points.push_back(point_from(*at, object.at("at")));
    if (const json* list = object.find("points")) {
        const JsonPlace place = object.at("points");
        if (!points.empty())
            fail<InvalidInput>(place.text(), " is given beside at; one of them is enough");
        list_of(*list, place, kMaxStrokePoints);
        points.reserve(list->size());
        for (std::size_t i = 0; i < list->size(); ++i)
            points.push_back(point_from((*list)[i], place.entry(i)));
    }
    if (points.size() < least)
        fail<InvalidInput>(object.place().text(), " has ", points.size(), " points, at least ",
                           least, " are needed, as at or points");
    return points;
}

StrokeKind kind_from(JsonObject& object) {
    const std::string name = text_of(object.get("op"), object.at("op"));
    for (std::size_t i = 0; i < std::size(kKindNames); ++i)
        if (kKindNames[i] == name)
            return static_cast<StrokeKind>(i);
    fail<InvalidInput>(object.at("op").text(), " is ", quoted(name.substr(0, 64)),
                       ", must be brush, polygon, fill, undo or redo");
}

Stroke stroke_from(const json& value, const JsonPlace& place,
                   const std::vector<Material>& materials) {
    JsonObject object(value, place);
    Stroke stroke;
    stroke.kind = kind_from(object);
    if (stroke.kind == StrokeKind::Undo || stroke.kind == StrokeKind::Redo) {
        if (const json* count = object.find("count"))
            stroke.count = integer_of(*count, object.at("count"), 1, static_cast<int>(kMaxStrokes));
        object.finish();
        return stroke;
    }
    stroke.id = material_id(object.get("material"), object.at("material"), materials);
    stroke.points = points_from(object, stroke.kind == StrokeKind::Polygon ? 3 : 1);
    if (stroke.kind == StrokeKind::Brush) {
        stroke.radius = number_of(object.get("radius"), object.at("radius"), 1e-9, kMaxLength);
        stroke.hardness = object.number("hardness", 1.0, 0.0, 1.0);
    }
    if (stroke.kind == StrokeKind::Polygon)
        stroke.fade = object.number("fade", 0.0, 0.0, kMaxLength);
    if (stroke.kind == StrokeKind::Fill && stroke.points.size() > 1)
        fail<InvalidInput>(object.at("points").text(), " of a fill must be one point");
    object.finish();
    return stroke;
}

void take_ground(StrokeScript& script, JsonObject& object, const std::vector<Material>& materials) {
    const json* size = object.find("size");
    const json* cell_size = object.find("cell_size");
    const json* ground = object.find("ground");
    if (size == nullptr && cell_size == nullptr && ground == nullptr)
        return;
    const JsonPlace place = object.at("size");
    if (size == nullptr || cell_size == nullptr || ground == nullptr)
        fail<InvalidInput>(place.text(), ", cell_size and ground must be given together");
    if (list_of(*size, place, 2).size() != 2)
        fail<InvalidInput>(place.text(), " must be the numbers of columns and rows");
    script.width = integer_of((*size)[0], place.entry(0), 1, 1'000'000'000);
    script.height = integer_of((*size)[1], place.entry(1), 1, 1'000'000'000);
    check_map_size(script.width, script.height, place.text());
    script.cell_size = number_of(*cell_size, object.at("cell_size"), 1e-9, kMaxLength);
    script.ground = material_id(*ground, object.at("ground"), materials);
}

// ---- writing

// Not operator+: gcc 12 sees overlaps in it that are not there.
template <class... Parts>
void append(std::string& text, const Parts&... parts) {
    ((text += parts), ...);
}

std::string number(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

void append_stroke(std::string& text, const Stroke& stroke) {
    append(text, "  {\"op\": \"", kKindNames[static_cast<std::size_t>(stroke.kind)], "\"");
    if (stroke.kind == StrokeKind::Undo || stroke.kind == StrokeKind::Redo) {
        append(text, ", \"count\": ", std::to_string(stroke.count), "}");
        return;
    }
    append(text, ", \"points\": [");
    for (std::size_t i = 0; i < stroke.points.size(); ++i)
        append(text, i > 0 ? ", [" : "[", number(stroke.points[i].x), ", ",
               number(stroke.points[i].y), "]");
    append(text, "], \"material\": ", std::to_string(stroke.id));
    if (stroke.kind == StrokeKind::Brush)
        append(text, ", \"radius\": ", number(stroke.radius),
               ", \"hardness\": ", number(stroke.hardness));
    if (stroke.kind == StrokeKind::Polygon)
        append(text, ", \"fade\": ", number(stroke.fade));
    append(text, "}");
}

}  // namespace

std::string strokes_to_json(const StrokeScript& script) {
    std::string text = "{\n \"format\": \"scree-strokes\",\n \"version\": 1,\n";
    if (script.width > 0)
        append(text, " \"size\": [", std::to_string(script.width), ", ",
               std::to_string(script.height), "], \"cell_size\": ", number(script.cell_size),
               ", \"ground\": ", std::to_string(script.ground), ",\n");
    append(text, " \"strokes\": [");
    for (std::size_t i = 0; i < script.strokes.size(); ++i) {
        append(text, i > 0 ? ",\n" : "\n");
        append_stroke(text, script.strokes[i]);
    }
    append(text, "\n ]\n}\n");
    return text;
}

StrokeScript strokes_from_json(std::string_view text, const std::string& source,
                               const std::vector<Material>& materials) {
    if (text.size() > kMaxStrokesBytes)
        fail<InvalidInput>(source, " has ", text.size(), " bytes, the limit is ", kMaxStrokesBytes);
    StrokeScript script;
    const JsonPlace list{source, "strokes"};
    const json root = parse_strict(
        text, source,
        {.list = "strokes",
         .largest = kLargestStroke,
         .take = [&](const json& entry, std::size_t i) {
             if (i >= kMaxStrokes)
                 fail<InvalidInput>(list.text(), " has more than ", kMaxStrokes, " strokes");
             script.strokes.push_back(stroke_from(entry, list.entry(i), materials));
         }});
    JsonObject object(root, {source, ""});
    check_format(object, "scree-strokes");
    list_of(object.get("strokes"), list, 0);
    take_ground(script, object, materials);
    object.finish();
    return script;
}

StrokeScript read_strokes(const std::filesystem::path& path,
                          const std::vector<Material>& materials) {
    return strokes_from_json(read_whole_file(path, kMaxStrokesBytes), path.string(), materials);
}

}  // namespace scree::terrain
