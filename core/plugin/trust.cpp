#include "core/plugin/trust.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/output_files.h"
#include "core/base/printable.h"
#include "core/base/shell_word.h"

namespace forage::plugin {
namespace {

namespace fs = std::filesystem;

std::string canonical(const fs::path& path) {
    std::error_code failed;
    auto out = fs::canonical(path, failed);
    if (failed) out = fs::absolute(path, failed).lexically_normal();
    return out.has_filename() || !out.has_relative_path() ? out.string() : out.parent_path().string();
}

/// Makes the folder of the list. Reports why the list cannot be written.
bool prepare_list(Diagnostics& diagnostics) {
    const std::string list = trust_list();
    if (list.empty()) {
        diagnostics.error({}, "there is no place for the list of trusted folders",
                          "set HOME or XDG_CONFIG_HOME");
        return false;
    }
    try {
        make_directory(fs::path(list).parent_path().string());
    } catch (const std::exception& e) {
        diagnostics.error({}, e.what());
        return false;
    }
    auto found = insecure_plugin(list);
    if (found) diagnostics.add(std::move(*found));
    return !found;
}

/// Writes lines to a file that only this user may read and write.
void write_lines(const std::string& path, int flags, const std::vector<std::string>& lines,
                 Diagnostics& diagnostics) {
    std::string text;
    for (const auto& line : lines) text += line + '\n';
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, S_IRUSR | S_IWUSR);
    const bool written =
        file >= 0 && ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    if (!written) diagnostics.error({}, fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
    if (file >= 0) close(file);
}

/// Whether a group is that of this user alone, as Ubuntu and others give each user one, with a umask of 002.
bool is_private(gid_t group) {
    const passwd* user = geteuid() == 0 ? nullptr : getpwuid(geteuid());
    if (!user || user->pw_gid != group) return false;
    const std::string name = user->pw_name;
    const auto* entry = ::getgrgid(group);
    return entry && entry->gr_name == name && !*entry->gr_mem;
}

}  // namespace

std::optional<Diagnostic> insecure(const std::string& path) {
    struct stat file {};
    if (stat(path.c_str(), &file) != 0) return std::nullopt;
    if (file.st_uid != geteuid() && file.st_uid != 0)
        return error_at(
            0, 0,
            fmt::format("'{}' belongs to another user (number {}), who may change it", path, file.st_uid),
            fmt::format("a plugin is a program: if you trust it, copy it, or 'chown {} {}'", geteuid(),
                        shell_word(path)));
    const bool group_writes = (file.st_mode & S_IWGRP) != 0 && !is_private(file.st_gid);
    if (!group_writes && (file.st_mode & S_IWOTH) == 0) return std::nullopt;
    const bool shared = (file.st_mode & S_ISVTX) != 0;
    return error_at(0, 0, fmt::format("other users may write '{}'", path),
                    shared ? "a plugin is a program: move it to a folder that only you may write"
                           : fmt::format("a plugin is a program: 'chmod go-w {}'", shell_word(path)));
}

std::optional<Diagnostic> insecure_folder(const std::string& path) {
    if (auto found = insecure(path)) return found;
    const std::string whole = canonical(path);
    for (fs::path folder = whole; folder.has_relative_path();) {
        folder = folder.parent_path();
        struct stat file {};
        const bool shared = stat(folder.c_str(), &file) == 0 && (file.st_mode & S_ISVTX) != 0;
        const bool others = file.st_uid != geteuid() && file.st_uid != 0;
        if (shared && !others) continue;  // there, others cannot rename what is not theirs
        if (auto found = insecure(folder.string())) {
            found->message += fmt::format(", and so replace '{}'", whole);
            if (others) found->hint = "a plugin is a program: move it to a folder that only you may replace";
            return found;
        }
    }
    return std::nullopt;
}

std::optional<Diagnostic> insecure_plugin(const std::string& path) {
    const auto given = fs::path(path).parent_path();
    auto out = insecure_folder(given.empty() ? "." : given.string());
    if (!out) out = insecure(path);
    if (!out) out = insecure_folder(folder_of(path));  // another one when the file is a link
    return out;
}

std::string folder_of(const std::string& plugin) {
    return fs::path(canonical(plugin)).parent_path().string();
}

std::string trust_list() {
    const auto given = [](const char* name) {
        const char* value = std::getenv(name);
        return std::string(value && *value == '/' ? value : "");
    };
    std::string folder = given("XDG_CONFIG_HOME");
    if (const auto home = given("HOME"); folder.empty() && !home.empty()) folder = home + "/.config";
    return folder.empty() ? "" : folder + "/forage/trusted-plugins";
}

std::vector<std::string> trusted_folders() {
    std::vector<std::string> out;
    const std::string list = trust_list();
    if (list.empty() || insecure_plugin(list)) return out;
    std::ifstream in(list);
    for (std::string line; std::getline(in, line);)
        if (!line.empty()) out.push_back(line);
    return out;
}

bool is_trusted(const std::string& folder) {
    const auto all = trusted_folders();
    return std::ranges::find(all, canonical(folder)) != all.end();
}

void trust(const std::string& folder, Diagnostics& diagnostics) {
    if (std::error_code none; !fs::is_directory(folder, none))
        return diagnostics.error({}, fmt::format("there is no folder '{}'", folder),
                                 "name the folder that holds the plugins (.so)");
    if (auto found = insecure_folder(folder)) return diagnostics.add(std::move(*found));
    const std::string whole = canonical(folder);
    if (has_control(whole))
        return diagnostics.error({}, fmt::format("the name '{}' has a control character", whole),
                                 "rename the folder");
    // One write at the end of the list: several commands may do this at the same time.
    if (prepare_list(diagnostics) && !is_trusted(whole))
        write_lines(trust_list(), O_APPEND, {whole}, diagnostics);
}

void distrust(const std::string& folder, Diagnostics& diagnostics) {
    auto all = trusted_folders();
    if (std::erase(all, canonical(folder)) == 0)
        return diagnostics.error({}, fmt::format("'{}' is not a trusted folder", folder),
                                 "'forage trust' lists them");
    if (!prepare_list(diagnostics)) return;
    write_lines(partial(trust_list()), O_TRUNC, all, diagnostics);
    if (!diagnostics.failed()) finish(trust_list());
}

}  // namespace forage::plugin
