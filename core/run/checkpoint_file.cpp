#include "core/run/checkpoint_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "core/base/archive.h"
#include "core/base/digest.h"
#include "core/base/output_files.h"

namespace forage {
namespace {

constexpr std::string_view magic = "forage checkpoint\n";
constexpr std::uint32_t format_version = 8;  ///< version of the content of checkpoints

}  // namespace

std::string checkpoint_path(const std::string& directory) { return directory + "/checkpoint.forage"; }
std::string previous_checkpoint_path(const std::string& directory) {
    return directory + "/checkpoint.previous.forage";
}

std::string sealed(std::string_view content) {
    Archive head;
    std::uint32_t number = format_version;
    std::uint64_t length = content.size();
    std::string sum = digest(content);
    head(number, length, sum);
    std::string out;
    out.reserve(magic.size() + head.bytes().size() + content.size());
    return out.append(magic).append(head.bytes()).append(content);
}

std::string unsealed(std::string_view text, std::string_view name) {
    const auto refuse = [&](const std::string& why) {
        throw CheckpointError(fmt::format("{} {}", name, why));
    };
    if (!text.starts_with(magic))
        refuse(text.size() < magic.size() && magic.starts_with(text) ? "is damaged: it ends too early"
                                                                     : "is not a checkpoint of forage");
    Archive head{text.substr(magic.size())};
    std::uint32_t number = 0;
    std::uint64_t length = 0;
    std::string sum;
    try {
        head(number);
        if (number != format_version)
            refuse(fmt::format("has version {}, and this forage reads version {}", number, format_version));
        head(length, sum);
    } catch (const ArchiveError&) {
        refuse("is damaged: it ends too early");
    }
    const auto content = head.left();
    if (content.size() != length)
        refuse(fmt::format("is damaged: it has {} bytes instead of {}", content.size(), length));
    if (digest(content) != sum) refuse("is damaged: its checksum is wrong");
    return std::string(content);
}

void write_checkpoint(const std::string& directory, std::string_view content) {
    write_durably(checkpoint_path(directory), sealed(content), previous_checkpoint_path(directory));
}

std::string read_checkpoint(const std::string& path) {
    const std::string name = fmt::format("checkpoint '{}'", path);
    std::error_code none;
    if (std::filesystem::exists(path, none) && !std::filesystem::is_regular_file(path, none))
        throw CheckpointError(name + " is not a file");
    std::ifstream in(path, std::ios::binary);
    if (!in) throw CheckpointError(fmt::format("{} cannot be read: {}", name, std::strerror(errno)));
    return unsealed(std::string(std::istreambuf_iterator<char>(in), {}), name);
}

bool has_checkpoint(const std::string& directory) {
    std::error_code none;
    return std::filesystem::exists(checkpoint_path(directory), none) ||
           std::filesystem::exists(previous_checkpoint_path(directory), none);
}

void remove_checkpoints(const std::string& directory) {
    std::error_code ignored;
    std::filesystem::remove(checkpoint_path(directory), ignored);
    std::filesystem::remove(previous_checkpoint_path(directory), ignored);
}

}  // namespace forage
