#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace scree::fuzz {

/// A file in memory with a path, for readers that want one. Its name ends in `.tga`, the one
/// format that has no mark of its own.
class MemoryFile {
public:
    MemoryFile() : descriptor_(::memfd_create("fuzz", 0)) {
        std::string folder =
            (std::filesystem::temp_directory_path() / "scree-fuzz-XXXXXX").string();
        if (descriptor_ < 0 || ::mkdtemp(folder.data()) == nullptr)
            std::abort();
        path_ = std::filesystem::path(folder) / "input.tga";
        std::filesystem::create_symlink("/proc/self/fd/" + std::to_string(descriptor_), path_);
    }
    ~MemoryFile() {
        std::error_code ignored;
        std::filesystem::remove_all(path_.parent_path(), ignored);
        ::close(descriptor_);
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    /// Replace what it holds.
    const std::filesystem::path& hold(const std::uint8_t* data, std::size_t size) const {
        if (::ftruncate(descriptor_, 0) != 0 ||
            ::pwrite(descriptor_, data, size, 0) != static_cast<ssize_t>(size))
            std::abort();
        return path_;
    }

private:
    int descriptor_;
    std::filesystem::path path_;
};

}  // namespace scree::fuzz
