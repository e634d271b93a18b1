#pragma once

#include "base/error.h"

#include <limits>
#include <span>
#include <string_view>
#include <type_traits>

namespace scree {

/// What is known of one field of an options struct; ranges are closed.
struct FieldInfo {
    double min = -std::numeric_limits<double>::max();
    double max = std::numeric_limits<double>::max();
    std::string_view unit = {};
    std::string_view help = {};
};

/// Which form of a published method to run where its printed form has a known defect.
enum class Reading {
    Sound,    ///< What users should get.
    Literal,  ///< What the source prints, kept to reproduce its figures.
};

inline constexpr std::string_view kReadingNames[] = {"sound", "literal"};

/// Words of an enumeration, in the order of its values, starting at zero. Every enumeration that
/// stands in an options struct has an overload beside it.
constexpr std::span<const std::string_view> names_of(Reading) {
    return kReadingNames;
}

/// Throw InvalidOption if any described value is out of its range (NaN always is).
///
/// An options struct has a free function `describe(Options&, Visitor&&)` beside it that calls
/// `visitor(name, member, FieldInfo)` for every member; enumerations must hold a named value.
template <class Options>
void check(Options options) {
    describe(options, [](std::string_view name, const auto& value, const FieldInfo& info) {
        using Value = std::remove_cvref_t<decltype(value)>;
        if constexpr (std::is_enum_v<Value>) {
            const auto index = static_cast<long long>(value);
            if (index < 0 || index >= static_cast<long long>(names_of(Value{}).size()))
                fail<InvalidOption>(name, " holds no named value (", index, ")");
        } else if constexpr (std::is_arithmetic_v<Value>) {
            const auto number = static_cast<double>(value);
            const bool in_range = number >= info.min && number <= info.max;  // false for NaN
            if (!in_range)
                fail<InvalidOption>(name, " is ", number, ", must be in [", info.min, ", ",
                                    info.max, "]", info.unit.empty() ? "" : " ", info.unit);
        }
    });
}

}  // namespace scree
