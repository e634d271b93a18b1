#pragma once

// Inside the users of OpenImageIO alone; not installed.

#include <algorithm>
#include <string>

namespace scree::vision {

/// What OpenImageIO said of a failure, as part of a sentence.
inline std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ')
        text.pop_back();
    return text.empty() ? "unknown or damaged format" : text;
}

}  // namespace scree::vision
