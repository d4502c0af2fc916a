#include "core/types/text_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include <fmt/format.h>

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

}  // namespace

FileError::FileError(std::string path, std::string text, std::vector<Fault> faults)
    : std::runtime_error(summary(path, faults)),
      path_(std::move(path)),
      text_(text.size() > excerpted ? text.substr(0, excerpted) : std::move(text)),
      faults_(std::move(faults)) {}

std::string read_file(const std::string& path, std::size_t most) {
    std::error_code ignored;
    std::ifstream in(path, std::ios::binary);
    if (!in) unreadable(path, fmt::format("cannot read the file: {}", std::strerror(errno)));
    if (std::filesystem::is_directory(path, ignored)) unreadable(path, "this is a directory, not a file");
    std::string text;
    if (const auto size = std::filesystem::file_size(path, ignored); !ignored)
        text.reserve(std::min<std::uintmax_t>(size, most) + 1);
    std::array<char, std::size_t{1} << 16> block;
    while (in.read(block.data(), block.size()), in.gcount() > 0) {
        const std::string_view read(block.data(), static_cast<std::size_t>(in.gcount()));
        const auto nul = read.find('\0');
        // What follows a NUL in its own block tells UTF-16 and pictures from damaged texts.
        text.append(read);
        if (text.size() > most) unreadable(path, fmt::format("the file is larger than {} MiB", most >> 20));
        if (nul != read.npos) break;
    }
    if (in.bad()) unreadable(path, "cannot read the file to its end");
    return text;
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
