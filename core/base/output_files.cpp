#include "core/base/output_files.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

namespace forage {

void check_regular_file(const std::string& path) {
    std::error_code none;
    if (std::filesystem::exists(path, none) && !std::filesystem::is_regular_file(path, none))
        throw std::runtime_error(fmt::format("cannot write '{}': it is not a file", path));
}

void check_output(const std::string& path, const std::string& example, Diagnostics& diagnostics) {
    namespace fs = std::filesystem;
    const std::string directory = fs::path(path).parent_path().string();
    std::error_code none;
    if (!directory.empty()) fs::create_directories(directory, none);
    if (access(directory.empty() ? "." : directory.c_str(), W_OK | X_OK) != 0)
        diagnostics.error({}, fmt::format("cannot write '{}': {}", path, std::strerror(errno)),
                          "name a file in a directory that you may write to");
    else if (fs::exists(path, none) && !fs::is_regular_file(path, none))
        diagnostics.error({}, fmt::format("cannot write '{}': it is not a file", path),
                          fmt::format("name a file, such as {}", example));
}

std::string partial(const std::string& path) { return path + ".part"; }

void finish(const std::string& path) {
    std::error_code error;
    std::filesystem::rename(partial(path), path, error);
    if (error) throw std::runtime_error(fmt::format("cannot write '{}': {}", path, error.message()));
}

std::vector<std::string> remove_unfinished(const std::string& directory) {
    namespace fs = std::filesystem;
    const std::set<fs::path> kinds = {".csv", ".npy", ".unpacked", ".npz",    ".h5",  ".dat", ".json",
                                      ".png", ".svg", ".pdf",      ".forage", ".txt", ".log"};
    std::vector<std::string> out;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(directory, none)) {
        const fs::path name = entry.path().filename();
        const fs::path kind = name.stem().extension();
        const bool ours = entry.is_regular_file(none) || entry.is_symlink(none) ||
                          kind == ".npz";  // archives grow in a folder
        if (name.extension() == ".part" && ours && kinds.contains(kind)) out.push_back(name.string());
    }
    std::ranges::sort(out);
    for (const auto& name : out) fs::remove_all(fs::path(directory) / name, none);
    return out;
}

namespace {

void write_partial(const std::string& path, std::string_view text) {
    check_regular_file(path);
    std::error_code none;
    std::filesystem::remove(partial(path), none);  // a link would lead to another file
    std::ofstream out(partial(path), std::ios::binary);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();
    if (!out) {
        const std::string reason = std::strerror(errno);
        std::error_code ignored;
        std::filesystem::remove(partial(path), ignored);
        throw std::runtime_error(fmt::format("cannot write '{}': {}", path, reason));
    }
}

void flush(const std::string& path, int flags) {
    const int file = open(path.c_str(), flags | O_CLOEXEC);
    const bool fine = file >= 0 && fsync(file) == 0;
    const std::string reason = std::strerror(errno);
    if (file >= 0) close(file);
    if (!fine) throw std::runtime_error(fmt::format("cannot write '{}' to the disk: {}", path, reason));
}

/// Makes sure that the names in the directory of `path` survive a power cut.
void flush_directory(const std::string& path) {
    const auto directory = std::filesystem::path(path).parent_path().string();
    flush(directory.empty() ? "." : directory, O_RDONLY | O_DIRECTORY);
}

}  // namespace

void write_file(const std::string& path, std::string_view text) {
    std::filesystem::path file = path;
    std::error_code ignored;
    constexpr int max_links = 40;  // as the system follows them
    for (int i = 0; i < max_links && std::filesystem::is_symlink(file, ignored); ++i)
        file = file.parent_path() / std::filesystem::read_symlink(file, ignored);
    write_result(file.string(), text);
}

void write_result(const std::string& path, std::string_view text) {
    write_partial(path, text);
    finish(path);
}

void write_durably(const std::string& path, std::string_view text, const std::string& keep) {
    write_partial(path, text);
    flush(partial(path), O_RDONLY);
    if (!keep.empty() && std::filesystem::exists(path)) std::filesystem::rename(path, keep);
    finish(path);
    flush_directory(path);
}

void flush_to_disk(const std::string& path) {
    flush(path, O_RDONLY);
    flush_directory(path);
}

void make_directory(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error)
        throw std::runtime_error(fmt::format("cannot make the directory '{}': {}", path, error.message()));
    if (access(path.c_str(), W_OK) != 0)
        throw std::runtime_error(fmt::format("cannot write into '{}': {}", path, std::strerror(errno)));
}

DirectoryHold::DirectoryHold(const std::string& directory)
    : file_(open(directory.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (file_ < 0 || flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
    close(file_);
    throw std::runtime_error(fmt::format("another forage is writing into '{}'", directory));
}

DirectoryHold::~DirectoryHold() {
    if (file_ >= 0) close(file_);
}

std::string file_name(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '_';
    return out;
}

}  // namespace forage
