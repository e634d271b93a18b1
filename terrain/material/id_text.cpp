#include "terrain/material/id_text.h"

#include "base/error.h"
#include "base/number_text.h"
#include "base/whole_file.h"
#include "terrain/material/map_check.h"
#include "terrain/material/materials_json.h"

#include <algorithm>
#include <optional>
#include <set>

namespace scree::terrain {
namespace {

namespace fs = std::filesystem;

constexpr int kVersion = 1;
constexpr std::size_t kFields = 9;
constexpr std::size_t kLongestShown = 64;
constexpr double kMaxMobility = 16.0;  // as describe(Soil&) says
constexpr double kMaxDiffusion = 4.0;

// ---- writing

std::string number(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

std::string as_word(const std::string& text) {
    const bool plain =
        !text.empty() && text != "-" && text.find_first_of(" \t\"\\#") == std::string::npos;
    if (plain)
        return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            quoted += '\\';
        quoted += c;
    }
    quoted += '"';
    return quoted;
}

std::string file_word(const fs::path& path, const fs::path& folder) {
    return path.empty() ? "-" : as_word(relative_text(path, folder));
}

std::string hat_word(double value, const HatShape& hat) {
    return hat == HatShape{} ? "-" : number(value);
}

void check_maximum(double value, double most, std::string_view name, std::string_view source) {
    if (!(value > 0.0 && value <= most))
        fail<InvalidInput>(source, ": ", name, " is ", value, ", must be in (0, ", most, "]");
}

// ---- reading

struct Word {
    std::string text;
    bool quoted = false;

    bool is_none() const { return !quoted && text == "-"; }
};

struct Line {
    std::vector<Word> words;
    std::string place;  // file and number
};

class WordReader {
public:
    WordReader(std::string_view text, const std::string& place) : text_(text), place_(place) {}

    /// The next word; nothing at the end of the line or at a comment.
    std::optional<Word> next() {
        while (at_ < text_.size() && is_space(text_[at_]))
            ++at_;
        if (at_ == text_.size() || text_[at_] == '#')
            return std::nullopt;
        return text_[at_] == '"' ? Word{quoted(), true} : Word{plain(), false};
    }

private:
    static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r'; }

    std::string plain() {
        const std::size_t start = at_;
        while (at_ < text_.size() && !is_space(text_[at_]) && text_[at_] != '#')
            ++at_;
        return std::string(text_.substr(start, at_ - start));
    }

    std::string quoted() {
        std::string result;
        for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
            if (text_[at_] == '\\' && ++at_ == text_.size())
                break;
            result += text_[at_];
        }
        if (at_ == text_.size())
            fail<InvalidInput>(place_, ": a quoted word has no end");
        ++at_;
        return result;
    }

    std::string_view text_;
    const std::string& place_;
    std::size_t at_ = 0;
};

std::vector<Line> lines_of(std::string_view text, const std::string& source) {
    std::vector<Line> lines;
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        Line line{{}, source + ":" + std::to_string(number)};
        WordReader reader(text.substr(0, end), line.place);
        while (auto found = reader.next()) {
            line.words.push_back(*std::move(found));
            if (line.words.size() > kFields)
                fail<InvalidInput>(line.place, ": more than ", kFields, " words");
        }
        if (!line.words.empty())
            lines.push_back(std::move(line));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

double number_in(const Line& line, const Word& word, double low, double high) {
    const auto value = parse_number<double>(word.text);
    if (!value || !(*value >= low && *value <= high))
        fail<InvalidInput>(line.place, ": '", word.text.substr(0, kLongestShown),
                           "' should be a number in [", low, ", ", high, "]");
    return *value;
}

int integer_in(const Line& line, const Word& word, int low, int high) {
    const auto value = parse_number<int>(word.text);
    if (!value || *value < low || *value > high)
        fail<InvalidInput>(line.place, ": '", word.text.substr(0, kLongestShown),
                           "' should be a whole number in [", low, ", ", high, "]");
    return *value;
}

bool is_header(const std::string& word) {
    return word == "version" || word == "mobility_max" || word == "diffusion_max" ||
           word == "cell_size";
}

void take_header(IdFile& file, const Line& line, std::set<std::string>& seen) {
    const std::string& name = line.words[0].text;
    if (line.words.size() != 2)
        fail<InvalidInput>(line.place, ": '", name, "' needs one number behind it");
    if (!seen.insert(name).second)
        fail<InvalidInput>(line.place, ": '", name, "' is given twice");
    if (!file.materials.empty())
        fail<InvalidInput>(line.place, ": '", name, "' must stand before the first material");
    const Word& value = line.words[1];
    if (name == "version")
        integer_in(line, value, kVersion, kVersion);
    else if (name == "mobility_max")
        file.mobility_max = number_in(line, value, 1e-12, kMaxMobility);
    else if (name == "diffusion_max")
        file.diffusion_max = number_in(line, value, 1e-12, kMaxDiffusion);
    else
        file.cell_size = number_in(line, value, 1e-9, 1e6);
}

Material material_from(const Line& line, const fs::path& folder) {
    if (line.words.size() != kFields)
        fail<InvalidInput>(line.place, ": ", line.words.size(), " words, ", kFields,
                           " are needed: id name albedo displacement normal gravel a b c");
    const auto path = [&](std::size_t i) {
        return line.words[i].is_none() ? fs::path() : resolved_path(line.words[i].text, folder);
    };
    Material material;
    material.id = integer_in(line, line.words[0], 0, 255);
    material.name = line.words[1].text;
    material.textures.albedo = path(2);
    material.textures.displacement = path(3);
    material.textures.normal = path(4);
    material.gravel = integer_in(line, line.words[5], 0, 1) == 1;
    const auto hat = [&](std::size_t i) {
        return line.words[i].is_none() ? -1.0 : number_in(line, line.words[i], 0.0, 1.0);
    };
    material.hat = {hat(6), hat(7), hat(8)};
    return material;
}

}  // namespace

std::string ids_to_text(const IdFile& file, const fs::path& folder) {
    check_materials(file.materials, "the id file");
    check_maximum(file.mobility_max, kMaxMobility, "mobility_max", "the id file");
    check_maximum(file.diffusion_max, kMaxDiffusion, "diffusion_max", "the id file");
    std::string text =
        "# Ids of a description map: R repose / 90 deg, G mobility, B diffusion, A id\n";
    text += "version " + std::to_string(kVersion) + "\n";
    text += "mobility_max " + number(file.mobility_max) + "\n";
    text += "diffusion_max " + number(file.diffusion_max) + "\n";
    if (file.cell_size > 0.0)
        text += "cell_size " + number(file.cell_size) + "\n";
    text += "# id name albedo displacement normal gravel a b c\n";
    for (const Material& material : file.materials) {
        const MaterialTextures& textures = material.textures;
        const HatShape& hat = material.hat;
        for (const std::string& part :
             {std::to_string(material.id), as_word(material.name),
              file_word(textures.albedo, folder), file_word(textures.displacement, folder),
              file_word(textures.normal, folder)})
            text.append(part).append(" ");
        text += material.gravel ? "1" : "0";
        for (const double value : {hat.start, hat.peak, hat.end})
            text.append(" ").append(hat_word(value, hat));
        text += '\n';
    }
    return text;
}

IdFile ids_from_text(std::string_view text, const std::string& source, const fs::path& folder) {
    if (text.size() > kMaxIdFileBytes)
        fail<InvalidInput>(source, " has ", text.size(), " bytes, the limit is ", kMaxIdFileBytes);
    IdFile file;
    std::set<std::string> seen;
    for (const Line& line : lines_of(text, source)) {
        if (is_header(line.words[0].text)) {
            take_header(file, line, seen);
            continue;
        }
        if (seen.count("version") == 0)
            fail<InvalidInput>(line.place, ": the line 'version ", kVersion,
                               "' must stand before the first material");
        if (file.materials.size() == kMaxMaterials)
            fail<InvalidInput>(line.place, ": more than ", kMaxMaterials, " materials");
        const Material material = material_from(line, folder);
        check_materials({material}, line.place);
        for (const Material& other : file.materials)
            if (other.id == material.id || other.name == material.name)
                fail<InvalidInput>(line.place, ": the id or the name of material ", other.id,
                                   " is given a second time");
        file.materials.push_back(material);
    }
    std::stable_sort(file.materials.begin(), file.materials.end(),
                     [](const Material& a, const Material& b) { return a.id < b.id; });
    check_materials(file.materials, source);
    return file;
}

IdFile read_id_file(const fs::path& path) {
    return ids_from_text(read_whole_file(path, kMaxIdFileBytes), path.string(), path.parent_path());
}

}  // namespace scree::terrain
