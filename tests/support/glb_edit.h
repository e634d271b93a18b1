#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace scree::test {

using Glb = std::vector<std::uint8_t>;

inline std::uint32_t word_at(const Glb& glb, std::size_t at) {
    std::uint32_t word = 0;
    std::memcpy(&word, glb.data() + at, sizeof word);
    return word;
}

inline void set_word(Glb& glb, std::size_t at, std::uint32_t word) {
    std::memcpy(glb.data() + at, &word, sizeof word);
}

/// The JSON part of a GLB file.
inline std::string json_of(const Glb& glb) {
    return {glb.begin() + 20, glb.begin() + 20 + word_at(glb, 12)};
}

/// The same file with another JSON part.
inline Glb with_json(const Glb& glb, std::string json) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string old(glb.begin(), glb.end());
    const std::string text = old.substr(0, 20) + json + old.substr(20 + word_at(glb, 12));
    Glb out(text.begin(), text.end());
    set_word(out, 8, static_cast<std::uint32_t>(out.size()));
    set_word(out, 12, static_cast<std::uint32_t>(json.size()));
    return out;
}

/// The same file with the first `from` of its JSON replaced; the same bytes if there is none.
inline Glb edited(const Glb& glb, std::string_view from, std::string_view to) {
    std::string json = json_of(glb);
    const auto at = json.find(from);
    if (at == std::string::npos)
        return glb;
    return with_json(glb, json.replace(at, from.size(), to));
}

}  // namespace scree::test
