#include "apps/step_log.h"

#include "base/error.h"
#include "base/number_text.h"
#include "base/whole_file.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace scree::apps {
namespace {

constexpr std::size_t kLargestLog = std::size_t{1} << 30U;

}  // namespace

void StepLog::resume(std::int64_t steps) {
    rows_.clear();
    first_ = steps;
    std::error_code ignored;
    if (steps <= 0 || !std::filesystem::exists(file_, ignored))
        return;
    const std::string bytes = read_whole_file(file_, kLargestLog);
    std::string_view rest = bytes;
    const auto line = [&rest] {
        const std::string_view found = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(rest.size(), found.size() + 1));
        return found;
    };
    if (line() != header_)
        return;
    std::vector<std::string> rows;
    for (std::int64_t step = 1; step <= steps; ++step) {
        const std::string_view row = line();
        if (!row.starts_with(std::to_string(step) + ","))
            return;
        rows.emplace_back(row);
    }
    rows_ = std::move(rows);
    first_ = 0;
}

void StepLog::add(std::int64_t step, const std::string& values) {
    const std::int64_t n = step - first_;
    if (n < 0) {
        rows_.clear();  // gone back to before the log began
        first_ = step;
    } else if (n <= static_cast<std::int64_t>(rows_.size())) {
        rows_.resize(static_cast<std::size_t>(n));
    } else {
        rows_.push_back(std::to_string(step) + "," + values);
    }
}

std::string StepLog::text() const {
    std::string text = header_ + "\n";
    for (const std::string& row : rows_)
        text += row + "\n";
    return text;
}

CsvRow& CsvRow::put_text(const std::string& text) {
    if (!empty_)
        text_ += ',';
    empty_ = false;
    text_ += text;
    return *this;
}

std::string CsvRow::text_of(double value) {
    std::string text;
    if (std::isfinite(value))
        append_number(text, value);
    return text;
}

std::string CsvRow::text_of(std::int64_t value) {
    return std::to_string(value);
}

}  // namespace scree::apps
