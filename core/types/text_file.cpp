#include "core/types/text_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

namespace forage {
namespace {

constexpr std::size_t excerpted = std::size_t{1} << 20;

std::string summary(const std::string& path, const std::vector<FileError::Fault>& faults) {
    const FileError::Fault& first = faults.front();
    std::string place = path;
    for (const int number : {first.line, first.column})
        if (number > 0) place += fmt::format(":{}", number);
    return fmt::format("{}: {}{}", place, first.message,
                       faults.size() > 1 ? fmt::format(", and {} more errors", faults.size() - 1) : "");
}

[[noreturn]] void unreadable(const std::string& path, std::string why) {
    throw FileError(path, {}, {{0, 0, std::move(why)}});
}

struct FileHandle {
    explicit FileHandle(int n) : number(n) {}
    FileHandle(const FileHandle&) = delete;
    FileHandle& operator=(const FileHandle&) = delete;
    ~FileHandle() {
        if (number >= 0) close(number);
    }
    int number;
};

}  // namespace

FileError::FileError(std::string path, std::string text, std::vector<Fault> faults)
    : std::runtime_error(summary(path, faults)),
      path_(std::move(path)),
      text_(text.size() > excerpted ? text.substr(0, excerpted) : std::move(text)),
      faults_(std::move(faults)) {}

std::string read_file(const std::string& path, std::size_t most) {
    std::error_code ignored;
    const FileHandle in(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (in.number < 0) unreadable(path, fmt::format("cannot read the file: {}", std::strerror(errno)));
    if (std::filesystem::is_directory(path, ignored)) unreadable(path, "this is a directory, not a file");
    const bool pipe = std::filesystem::is_fifo(path, ignored);
    std::string text;
    if (const auto size = std::filesystem::file_size(path, ignored); !ignored)
        text.reserve(std::min<std::uintmax_t>(size, most) + 1);
    std::array<char, std::size_t{1} << 16> block;
    for (bool waited = false;;) {
        const ssize_t count = read(in.number, block.data(), block.size());
        pollfd ready{in.number, POLLIN, 0};
        if (count < 0 && errno == EINTR) continue;
        if (count < 0 && errno == EAGAIN) {  // a pipe or a terminal, and somebody is about to write
            poll(&ready, 1, -1);
            continue;
        }
        if (count < 0) unreadable(path, fmt::format("cannot read the file: {}", std::strerror(errno)));
        if (count == 0 && pipe && text.empty()) {
            if (waited) unreadable(path, "this is a pipe, and nobody writes into it");
            poll(&ready, 1, 300), waited = true;
            continue;
        }
        if (count == 0) return text;
        const std::string_view got(block.data(), static_cast<std::size_t>(count));
        // What follows a NUL in its own block tells UTF-16 and pictures from damaged texts.
        text.append(got);
        if (text.size() > most) unreadable(path, fmt::format("the file is larger than {} MiB", most >> 20));
        if (got.find('\0') != got.npos) return text;
    }
}

std::string shown(std::string_view piece) {
    std::string out(piece.substr(0, 20));
    std::replace_if(
        out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return piece.size() > out.size() ? out + "..." : out;
}

std::string_view what_begins_with(std::string_view text) {
    using namespace std::string_view_literals;
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 9> known = {
        {{"\x1f\x8b"sv, "a gzip archive"},
         {"\x89PNG"sv, "a PNG picture"},
         {"\x7f"
          "ELF"sv,
          "a program"},
         {"PK\x03\x04"sv, "a zip archive"},
         {"\x89HDF"sv, "an HDF5 file"},
         {"\x93NUMPY"sv, "a NumPy file"},
         {"%PDF"sv, "a PDF document"},
         {"\xff\xfe"sv, "encoded as UTF-16: save it as UTF-8"},
         {"\xfe\xff"sv, "encoded as UTF-16: save it as UTF-8"}}};
    for (const auto& [bytes, what] : known)
        if (text.starts_with(bytes)) return what;
    return {};
}

}  // namespace forage
