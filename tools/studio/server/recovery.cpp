#include "tools/studio/server/recovery.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "core/base/digest.h"
#include "core/base/sequence.h"
#include "core/base/text_file.h"
#include "core/run/checkpoint_file.h"

namespace forage::studio {
namespace {

namespace fs = std::filesystem;

constexpr int max_studios = 8;  ///< of one system at a time

}  // namespace

std::string state_home() {
    const auto given = [](const char* name) {
        const char* value = std::getenv(name);
        return std::string(value && *value == '/' ? value : "");
    };
    if (const auto state = given("XDG_STATE_HOME"); !state.empty()) return state;
    if (const auto home = given("HOME"); !home.empty()) return home + "/.local/state";
    throw std::runtime_error("neither XDG_STATE_HOME nor HOME names a folder");
}

std::string state_folder(const std::string& inside) {
    const fs::path home = state_home();
    make_directory(home.string());
    fs::path out = home;
    for (const auto& part : inside.empty() ? fs::path("forage") : fs::path("forage") / inside) {
        out /= part;
        // A folder that an earlier version has made is closed to others, too.
        if (mkdir(out.c_str(), 0700) != 0 && (errno != EEXIST || chmod(out.c_str(), 0700) != 0))
            throw std::runtime_error(
                fmt::format("cannot make the directory '{}': {}", out.string(), std::strerror(errno)));
    }
    make_directory(out.string());
    return out.string();
}

double read_save_interval() {
    try {
        const double kept =
            nlohmann::json::parse(read_file(state_home() + "/forage/settings.json")).at("save_interval");
        if (kept >= min_save_interval && kept <= max_save_interval) return kept;
    } catch (const std::exception&) {  // it was never written
    }
    return 20;
}

void write_save_interval(double seconds) {
    write_file(state_folder() + "/settings.json", nlohmann::json{{"save_interval", seconds}}.dump() + "\n");
}

RecoveryFiles::RecoveryFiles(const std::string& system) {
    const std::string whole = fs::weakly_canonical(system).string();
    const std::string name =
        fmt::format("studio/{}-{}", file_name(fs::path(whole).stem().string()), digest(whole));
    for (int i = 1;; ++i) {
        folder_ = state_folder(i == 1 ? name : fmt::format("{}-{}", name, i));
        try {
            hold_ = DirectoryHold(folder_);
            break;
        } catch (const std::runtime_error&) {
            if (i == max_studios) throw;
        }
    }
    remove_unfinished(folder_);
    if (fs::exists(running_path())) fs::rename(running_path(), killed_path());
}

void RecoveryFiles::write(std::string_view content) const { write_durably(running_path(), sealed(content)); }

std::optional<std::string> RecoveryFiles::killed() const {
    if (!fs::exists(killed_path())) return std::nullopt;
    return read_checkpoint(killed_path());
}

std::vector<std::string> RecoveryFiles::all_killed() {
    std::vector<std::string> out;
    std::error_code none;
    for (const auto& folder : fs::directory_iterator(state_home() + "/forage/studio", none)) {
        try {
            const DirectoryHold hold(folder.path().string());
            for (const char* name : {"killed.forage", "running.forage"})
                if (const auto file = folder.path() / name; fs::exists(file))
                    out.push_back(read_checkpoint(file.string()));
        } catch (const std::exception&) {  // a studio holds it, or it is damaged
        }
    }
    return out;
}

void RecoveryFiles::forget_killed() const {
    std::error_code ignored;
    fs::remove(killed_path(), ignored);
}

void RecoveryFiles::forget_running() const {
    std::error_code ignored;
    fs::remove(running_path(), ignored);
    if (fs::is_empty(folder_, ignored)) fs::remove(folder_, ignored);
}

std::string digest_of_files(const RunInput& input, const Sources& sources) {
    std::string out = input.text.empty() ? file_digest(input.system) : sha256(input.text);
    for (const auto& [path, content] : system_files(*sources.system))
        if (fs::absolute(path) != fs::absolute(input.system)) out += " " + content;
    for (const auto& other : sources.more)
        for (const auto& [path, content] : system_files(other)) out += " " + content;
    return input.world.empty() ? out : out + " " + file_digest(input.world);
}

void archive_input(Archive& archive, RunInput& input) {
    const auto absolute = [](std::string& path) {
        if (!path.empty()) path = fs::absolute(path).string();
    };
    const auto expressions = [&](std::vector<model::Expression>& all) {
        auto texts = collected(all, &model::Expression::text);
        archive(texts);
        all.clear();
        for (auto& text : texts) all.push_back({std::move(text)});
    };
    if (!archive.loading()) {
        absolute(input.system), absolute(input.world), absolute(input.replay);
        for (auto& path : input.more) absolute(path);
        for (auto& path : input.plugins) absolute(path);
    }
    archive(input.system, input.world, input.more, input.replay, input.plugins, input.lenient, input.seed,
            input.real_time_factor, input.noise, input.sensor_rates, input.latency, input.game, input.text,
            input.world_text);
    expressions(input.settings), expressions(input.robots);
}

}  // namespace forage::studio
