#include "core/observe/disk_space.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace forage::observe {

DiskSpace::DiskSpace(const std::string& path) : file_(open(path.c_str(), O_WRONLY | O_CLOEXEC)) {}

DiskSpace::~DiskSpace() {
    if (file_ < 0) return;
    struct stat now {};
    // Releases the space after the end of the file, also when the end does not change.
    if (fstat(file_, &now) != 0 || ftruncate(file_, now.st_size) != 0) errno = 0;
    close(file_);
}

void DiskSpace::reserve(std::uint64_t bytes) {
    struct stat now {};
    if (file_ < 0 || fstat(file_, &now) != 0) return;
    rlimit most{};
    if (getrlimit(RLIMIT_FSIZE, &most) == 0 && most.rlim_cur != RLIM_INFINITY &&
        static_cast<std::uint64_t>(now.st_size) + bytes > most.rlim_cur)
        throw std::runtime_error(std::strerror(EFBIG));
    if (fallocate(file_, FALLOC_FL_KEEP_SIZE, now.st_size, static_cast<off_t>(bytes)) != 0 &&
        (errno == ENOSPC || errno == EDQUOT || errno == EFBIG))
        throw std::runtime_error(std::strerror(errno));
}

}  // namespace forage::observe
