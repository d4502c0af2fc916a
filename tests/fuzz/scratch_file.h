// A file in memory, for readers that need a path.
#pragma once

#include <cstdint>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

namespace forage::test {

/// Writes every input to the same file, whose name ends with `ending`.
class ScratchFile {
  public:
    explicit ScratchFile(const std::string& ending)
        : file_(memfd_create("input", 0)), path_("/tmp/forage_fuzz_" + std::to_string(getpid()) + ending) {
        unlink(path_.c_str());
        (void)!symlink(("/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(file_)).c_str(),
                       path_.c_str());
    }
    ~ScratchFile() { unlink(path_.c_str()), close(file_); }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    const std::string& holding(const std::uint8_t* data, std::size_t size) {
        (void)!ftruncate(file_, 0);
        (void)!pwrite(file_, data, size, 0);
        return path_;
    }

  private:
    int file_;
    std::string path_;
};

}  // namespace forage::test
