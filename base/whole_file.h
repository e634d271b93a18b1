#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scree {

/// Files that appear together or not at all.
///
/// Every output is written under a temporary name in the folder of its own; `commit()` gives all
/// of them their names. Destroyed before that, it removes what was written, so a failed or
/// interrupted run leaves nothing half done.
class OutputBatch {
public:
    OutputBatch() = default;
    ~OutputBatch();
    OutputBatch(const OutputBatch&) = delete;
    OutputBatch& operator=(const OutputBatch&) = delete;

    /// The temporary path to write what shall become `target`; the extension is kept.
    /// Missing folders are made.
    /// @throw IoError  the folder cannot be made, or `target` is a directory.
    std::filesystem::path stage(const std::filesystem::path& target);

    /// Move every staged file to its name.
    /// @throw IoError  a staged file is missing or cannot be renamed.
    void commit();

private:
    struct Entry {
        std::filesystem::path temporary;
        std::filesystem::path target;
    };
    std::vector<Entry> entries_;
    std::vector<std::filesystem::path> made_folders_;
};

/// Write `bytes` to `path` whole or not at all.
/// @throw IoError  names the path and the system's reason.
void write_whole_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_whole_file(const std::filesystem::path& path, std::string_view text);

/// Write to a path that is temporary already (from OutputBatch::stage), checking every byte out.
void write_staged_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_staged_file(const std::filesystem::path& path, std::string_view text);

/// The same for what is made piece by piece.
class StagedFile {
public:
    /// @throw IoError  the file cannot be opened.
    explicit StagedFile(const std::filesystem::path& path);
    ~StagedFile();
    StagedFile(const StagedFile&) = delete;
    StagedFile& operator=(const StagedFile&) = delete;

    /// @throw IoError  names the path and the system's reason.
    void write(std::span<const std::uint8_t> bytes);

    /// The last call; without it the file is not finished.
    /// @throw IoError  names the path and the system's reason.
    void close();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// All bytes of a file.
/// @throw IoError  it cannot be read, is no regular file, or is larger than `max_bytes`.
std::string read_whole_file(const std::filesystem::path& path, std::size_t max_bytes);

}  // namespace scree
