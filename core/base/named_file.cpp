#include "core/base/named_file.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

namespace forage {
namespace {

namespace fs = std::filesystem;

/// "did you mean 'x'?" for a missing file. Empty when no file with the same ending has a similar name.
std::string near_file(const fs::path& path) {
    std::error_code error;
    if (path.empty() || fs::exists(fs::symlink_status(path, error))) return {};
    std::vector<std::string> siblings;
    const fs::path folder = path.parent_path();
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
         entry.increment(error))
        if (entry->path().extension() == path.extension())
            siblings.push_back(entry->path().filename().string());
    std::ranges::sort(siblings);
    const auto near = nearest(path.filename().string(), siblings);
    return near.empty() ? "" : fmt::format("did you mean '{}'?", (folder / near).string());
}

}  // namespace

void report(const FileError& error, Diagnostics& diagnostics) {
    for (Diagnostic e : error.errors()) {
        if (e.hint.empty() && e.where.line == 0) e.hint = near_file(error.file()->path);
        diagnostics.add(std::move(e));
    }
}

std::optional<std::string> read_file(const std::string& path, std::size_t most, Diagnostics& diagnostics) {
    try {
        return read_file(path, most);
    } catch (const FileError& e) {
        report(e, diagnostics);
        return std::nullopt;
    }
}

bool find_file(const std::string& path, const Location& where, Diagnostics& diagnostics) {
    const auto error = why_unreadable(path);
    if (error)
        diagnostics.error(where, fmt::format("'{}': {}", path, error->message),
                          error->hint.empty() ? near_file(path) : error->hint);
    return !error;
}

}  // namespace forage
