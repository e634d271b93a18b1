#include "base/whole_file.h"

#include "base/error.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>
#include <unistd.h>

namespace scree {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// Unique within the process by a counter and between processes by the process number.
fs::path temporary_name(const fs::path& target) {
    static std::atomic<unsigned> counter{0};
    const std::string mark =
        ".scree-" + std::to_string(::getpid()) + "-" + std::to_string(counter.fetch_add(1)) + ".";
    return target.parent_path() / (mark + target.filename().string());
}

// Makes missing folders one by one so that a failed run can take back exactly those it made.
void make_folders(const fs::path& folder, std::vector<fs::path>& made) {
    std::error_code error;
    if (folder.empty() || fs::is_directory(folder, error))
        return;
    make_folders(folder.parent_path(), made);
    if (!fs::create_directory(folder, error) && error)
        fail<IoError>("cannot make folder ", folder.string(), ": ", error.message(),
                      "; choose a folder you may write to");
    made.push_back(folder);
}

}  // namespace

OutputBatch::~OutputBatch() {
    std::error_code ignored;
    for (const Entry& entry : entries_)
        fs::remove(entry.temporary, ignored);
    for (auto folder = made_folders_.rbegin(); folder != made_folders_.rend(); ++folder)
        fs::remove(*folder, ignored);  // fails, as it should, where something else lies in it
}

fs::path OutputBatch::stage(const fs::path& target) {
    std::error_code error;
    if (fs::is_directory(target, error))
        fail<IoError>("cannot write ", target.string(), ": a folder of that name is there");
    make_folders(target.parent_path(), made_folders_);
    entries_.push_back({temporary_name(target), target});
    return entries_.back().temporary;
}

void OutputBatch::commit() {
    std::error_code error;
    for (const Entry& entry : entries_)
        if (!fs::is_regular_file(entry.temporary, error))
            fail<IoError>("cannot write ", entry.target.string(), ": it was never finished");
    for (const Entry& entry : entries_) {
        fs::rename(entry.temporary, entry.target, error);
        if (error)
            fail<IoError>("cannot write ", entry.target.string(), ": ", error.message());
    }
    entries_.clear();
    made_folders_.clear();
}

struct StagedFile::State {
    fs::path path;
    File file;

    [[noreturn]] void refuse(int reason) const {
        fail<IoError>("cannot write ", path.string(), ": ", std::strerror(reason),
                      "; free some space or choose another folder");
    }
};

StagedFile::StagedFile(const fs::path& path)
    : state_(std::make_unique<State>(State{path, File(std::fopen(path.c_str(), "wb"))})) {
    if (!state_->file)
        fail<IoError>("cannot write ", path.string(), ": ", std::strerror(errno));
}

StagedFile::~StagedFile() = default;

void StagedFile::write(std::span<const std::uint8_t> bytes) {
    // Without bytes the pointer may be null.
    if (!bytes.empty() &&
        std::fwrite(bytes.data(), 1, bytes.size(), state_->file.get()) != bytes.size())
        state_->refuse(errno);
}

void StagedFile::close() {
    if (std::fflush(state_->file.get()) != 0)
        state_->refuse(errno);
    if (std::fclose(state_->file.release()) != 0)
        state_->refuse(errno);
}

void write_staged_file(const fs::path& path, std::span<const std::uint8_t> bytes) {
    StagedFile file(path);
    file.write(bytes);
    file.close();
}

void write_staged_file(const fs::path& path, std::string_view text) {
    write_staged_file(path,
                      std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void write_whole_file(const fs::path& path, std::span<const std::uint8_t> bytes) {
    OutputBatch batch;
    write_staged_file(batch.stage(path), bytes);
    batch.commit();
}

void write_whole_file(const fs::path& path, std::string_view text) {
    write_whole_file(path,
                     std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

std::string read_whole_file(const fs::path& path, std::size_t max_bytes) {
    std::error_code error;
    if (fs::is_directory(path, error))
        fail<IoError>("cannot read ", path.string(), ": it is a folder, name a file in it");
    File file(std::fopen(path.c_str(), "rb"));
    if (!file)
        fail<IoError>("cannot read ", path.string(), ": ", std::strerror(errno));
    std::string text;
    char block[1 << 16];
    std::size_t n = 0;
    while ((n = std::fread(block, 1, sizeof block, file.get())) > 0) {
        if (text.size() + n > max_bytes)
            fail<IoError>("cannot read ", path.string(), ": larger than the limit of ", max_bytes,
                          " bytes");
        text.append(block, n);
    }
    if (std::ferror(file.get()) != 0)
        fail<IoError>("cannot read ", path.string(), ": ", std::strerror(errno));
    return text;
}

}  // namespace scree
