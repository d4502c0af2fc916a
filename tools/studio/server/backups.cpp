#include "tools/studio/server/backups.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include <fmt/chrono.h>
#include <fmt/format.h>

namespace forage::studio {
namespace {

constexpr std::string_view date_and_time = ",0000-00-00_00-00-00";  ///< with a digit for each 0

bool is_date_and_time(std::string_view text) {
    return std::ranges::equal(text, date_and_time, [](char c, char form) {
        return form == '0' ? std::isdigit(static_cast<unsigned char>(c)) != 0 : c == form;
    });
}

}  // namespace

std::string backup_path(const std::string& system, const std::tm& local) {
    return fmt::format("{},{:%Y-%m-%d_%H-%M-%S}", system, local);
}

std::optional<Backup> backup_of(const std::string& path) {
    if (path.size() <= date_and_time.size()) return std::nullopt;
    const auto end = path.size() - date_and_time.size();
    if (!is_date_and_time(std::string_view(path).substr(end))) return std::nullopt;
    Backup out{path.substr(0, end), path.substr(end + 1)};
    if (!out.system.ends_with(".iqr") && !out.system.ends_with(".xml")) return std::nullopt;
    out.time[10] = 'T';
    std::replace(out.time.begin() + 10, out.time.end(), '-', ':');
    return out;
}

}  // namespace forage::studio
