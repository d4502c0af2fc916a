#include "tools/studio/server/settings.h"

#include <exception>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/diagnostic.h"
#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "tools/studio/server/recovery.h"

namespace forage::studio {
namespace {

constexpr double shortest = 5, longest = 60;  ///< s; a crash is to lose a minute at most

std::string settings_path() { return state_home() + "/forage/settings.json"; }
bool in_range(double interval) { return interval >= shortest && interval <= longest; }

}  // namespace

Settings read_settings() {
    Settings out;
    try {
        const double interval = nlohmann::json::parse(read_file(settings_path())).at("save_interval");
        if (in_range(interval)) out.save_interval = interval;
    } catch (const std::exception&) {  // no settings were written
    }
    return out;
}

void write_settings(const Settings& settings) {
    if (!in_range(settings.save_interval))
        throw InputError(fmt::format("a session cannot be saved every {} s", settings.save_interval),
                         fmt::format("from {} to {} s", shortest, longest));
    write_file(state_folder() + "/settings.json",
               nlohmann::json{{"save_interval", settings.save_interval}}.dump() + "\n");
}

}  // namespace forage::studio
