#pragma once

// Shared by the writer and the reader of rocks.json; not installed.

#include <string_view>

namespace scree::vision::rocks_file {

inline constexpr std::string_view kFormat = "scree-rocks";
inline constexpr int kPlainVersion = 1;
inline constexpr int kLikenessVersion = 2;  // the same and the likeness to gravel

}  // namespace scree::vision::rocks_file
