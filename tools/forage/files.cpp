#include "tools/forage/files.h"

#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <unistd.h>

namespace forage::tool {

std::string partial(const std::string& path) { return path + ".part"; }

void finish(const std::string& path) {
    std::error_code error;
    std::filesystem::rename(partial(path), path, error);
    if (error) throw std::runtime_error(fmt::format("cannot write '{}': {}", path, error.message()));
}

void write_file(const std::string& path, std::string_view text) {
    std::ofstream out(partial(path), std::ios::binary);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();
    if (!out) {
        const std::string reason = std::strerror(errno);
        std::error_code ignored;
        std::filesystem::remove(partial(path), ignored);
        throw std::runtime_error(fmt::format("cannot write '{}': {}", path, reason));
    }
    finish(path);
}

void make_directory(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error)
        throw std::runtime_error(fmt::format("cannot make the directory '{}': {}", path, error.message()));
    if (access(path.c_str(), W_OK) != 0)
        throw std::runtime_error(fmt::format("cannot write into '{}': {}", path, std::strerror(errno)));
}

std::string file_name(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '_';
    return out;
}

}  // namespace forage::tool
