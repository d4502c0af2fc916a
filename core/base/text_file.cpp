#include "core/base/text_file.h"

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

#include "core/base/utf8.h"

namespace forage {
namespace {

constexpr std::size_t excerpted = std::size_t{1} << 20;

std::string summary(const std::string& path, const std::vector<Diagnostic>& errors) {
    const Diagnostic& first = errors.front();
    std::string place = path;
    for (const int number : {first.where.line, first.where.column})
        if (number > 0) place += fmt::format(":{}", number);
    return fmt::format("{}: {}{}", place, first.message,
                       errors.size() > 1 ? fmt::format(", and {} more errors", errors.size() - 1) : "");
}

[[noreturn]] void unreadable(const std::string& path, std::string why) {
    throw FileError(path, {}, {error_at(0, 0, std::move(why))});
}

Diagnostic refusal(const std::string& path, int error) {
    if (path.empty()) return error_at(0, 0, "no file is named");
    switch (error) {
        case ENOENT:
        case ENOTDIR:
            return error_at(0, 0, "there is no such file");
        case ENAMETOOLONG:
            return error_at(0, 0, "there is no such file: its name is longer than names can be");
        case ELOOP:
            return error_at(0, 0, "this link refers to itself", "name the file that it should refer to");
        case EACCES:
            return error_at(0, 0, "cannot read the file: Permission denied",
                            "'chmod +r' makes a file readable, 'chmod +x' makes a folder accessible");
        default:
            return error_at(0, 0, fmt::format("cannot read the file: {}", std::strerror(error)));
    }
}

/// The error at the byte `at`.
Diagnostic error_in(std::string_view text, std::size_t at, std::string message, std::string hint) {
    const std::string_view before = text.substr(0, at);
    return error_at(1 + static_cast<int>(std::ranges::count(before, '\n')),
                    static_cast<int>(at - (before.rfind('\n') + 1)) + 1,  // npos + 1 is 0
                    std::move(message), std::move(hint));
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const auto length = utf8_length(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
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

FileError::FileError(std::string path, std::string text, std::vector<Diagnostic> errors)
    : FileError(std::make_shared<SourceFile>(SourceFile{
                    std::move(path), text.size() > excerpted ? text.substr(0, excerpted) : std::move(text)}),
                std::move(errors)) {}

FileError::FileError(std::shared_ptr<const SourceFile> file, std::vector<Diagnostic> errors)
    : std::runtime_error(summary(file->path, errors)), file_(std::move(file)), errors_(std::move(errors)) {
    for (auto& e : errors_) e.where.file = file_;
}

std::string read_file(const std::string& path, std::size_t most) {
    std::error_code ignored;
    const FileHandle in(path.empty() ? -1 : open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (in.number < 0) throw FileError(path, {}, {refusal(path, errno)});
    if (std::filesystem::is_directory(path, ignored)) unreadable(path, "this is a directory, not a file");
    if (!is_utf8(path))
        throw FileError(path, {},
                        {error_at(0, 0, "the name of this file is not UTF-8",
                                  "rename it: results name the files of their run")});
    const bool pipe = std::filesystem::is_fifo(path, ignored);
    std::string text;
    if (const auto size = std::filesystem::file_size(path, ignored); !ignored)
        text.reserve(std::min<std::uintmax_t>(size, most) + 1);
    std::array<char, std::size_t{1} << 16> block;
    for (bool waited = false;;) {
        const ssize_t count = read(in.number, block.data(), block.size());
        pollfd ready{in.number, POLLIN, 0};
        if (count < 0 && errno == EINTR) continue;
        if (count < 0 && errno == EAGAIN) {  // a pipe or a terminal that a program will write into
            poll(&ready, 1, -1);
            continue;
        }
        if (count < 0) unreadable(path, fmt::format("cannot read the file: {}", std::strerror(errno)));
        if (count == 0 && pipe && text.empty()) {
            if (waited)
                throw FileError(
                    path, {}, {error_at(0, 0, "this is a pipe that no program writes into", "name a file")});
            poll(&ready, 1, 300), waited = true;
            continue;
        }
        if (count == 0) return text;
        const std::string_view got(block.data(), static_cast<std::size_t>(count));
        // The rest of the block after a NUL distinguishes UTF-16 and pictures from damaged texts.
        text.append(got);
        if (text.size() > most) unreadable(path, fmt::format("the file is larger than {} MiB", most >> 20));
        if (got.find('\0') != got.npos) return text;
    }
}

std::string escaped(std::string_view piece) {
    std::string out(piece.substr(0, 20));
    std::replace_if(
        out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return piece.size() > out.size() ? out + "..." : out;
}

std::optional<Diagnostic> why_unreadable(const std::string& path) {
    const FileHandle in(path.empty() ? -1 : open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (in.number < 0) return refusal(path, errno);
    if (std::error_code ignored; std::filesystem::is_directory(path, ignored))
        return error_at(0, 0, "this is a directory, not a file");
    return std::nullopt;
}

std::ifstream open_file(const std::string& path) {
    auto error = why_unreadable(path);
    if (std::error_code ignored; !error && !std::filesystem::is_regular_file(path, ignored))
        error = error_at(0, 0, "this is a pipe or a device, not a file");
    if (error) throw FileError(path, {}, {std::move(*error)});
    return std::ifstream(path, std::ios::binary);
}

std::optional<Diagnostic> not_lines(std::string_view text, std::string_view wanted) {
    using namespace std::string_view_literals;
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 7> known = {
        {{"\x1f\x8b"sv, "a gzip archive"},
         {"\x89PNG"sv, "a PNG picture"},
         {"\x7f"
          "ELF"sv,
          "a program"},
         {"PK\x03\x04"sv, "a zip archive"},
         {"\x89HDF"sv, "an HDF5 file"},
         {"\x93NUMPY"sv, "a NumPy file"},
         {"%PDF"sv, "a PDF document"}}};
    for (const auto& [bytes, what] : known)
        if (text.starts_with(bytes)) return error_at(0, 0, fmt::format("{}, but {}", wanted, what));
    const std::size_t nul = text.find('\0'), cr = text.find('\r');
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff") ||
        (nul <= 1 && text.find_first_not_of('\0') < 2))
        return error_at(0, 0, "the file is encoded as UTF-16", "save it as UTF-8");
    if (nul != text.npos)
        return error_in(text, nul, "the byte 0x00 does not occur in a text",
                        "is the file damaged? Remove the byte");
    if (cr != text.npos && cr + 1 < text.size() && text[cr + 1] != '\n')
        return error_in(text, cr, "a carriage return that ends no line",
                        "save the file with the line ends of Unix or Windows");
    return std::nullopt;
}

}  // namespace forage
