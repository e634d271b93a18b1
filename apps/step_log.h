#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace scree::apps {

/// A row a step, as CSV. Rows of steps that were taken back go; a run that was stopped goes on with
/// the rows that it had written.
class StepLog {
public:
    /// @param header  Names of the columns, the first of which is `step`, without a line end.
    StepLog(std::filesystem::path file, std::string header)
        : file_(std::move(file)), header_(std::move(header)) {}

    /// Go on after so many steps: rows up to there are taken from the file if it is this log's and
    /// has them all; else the log begins there.
    void resume(std::int64_t steps);

    /// Take down a step. A step that has its row already makes the later ones void.
    /// @param values  The other columns, without the step.
    void add(std::int64_t step, const std::string& values);

    std::string text() const;
    const std::filesystem::path& file() const { return file_; }

private:
    std::filesystem::path file_;
    std::string header_;
    std::vector<std::string> rows_;  // of steps first_ + 1 and on
    std::int64_t first_ = 0;
};

/// Numbers as one row: shortest digits that read back the same, commas between.
class CsvRow {
public:
    template <class Number>
    CsvRow& put(Number value) {
        return put_text(text_of(value));
    }
    CsvRow& put_text(const std::string& text);
    const std::string& text() const { return text_; }

private:
    static std::string text_of(double value);
    static std::string text_of(std::int64_t value);
    static std::string text_of(float value) { return text_of(static_cast<double>(value)); }
    static std::string text_of(int value) { return text_of(std::int64_t{value}); }
    static std::string text_of(std::size_t value) {
        return text_of(static_cast<std::int64_t>(value));
    }
    std::string text_;
    bool empty_ = true;
};

}  // namespace scree::apps
