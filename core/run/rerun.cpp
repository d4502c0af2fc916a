#include "core/run/rerun.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/file_bytes.h"
#include "core/base/separated.h"
#include "core/observe/zip_file.h"
#include "core/run/bundle.h"
#include "core/run/run_json.h"

namespace forage {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Reports the plugins of a bundle, which does not hold them, that are not built.
void check_plugins(const BundleRecord& bundle, const std::string& inputs, Rerun& out,
                   Diagnostics& diagnostics) {
    for (const auto& [name, sum] : bundle.plugins) {
        const fs::path plugin = fs::path(inputs) / name;
        const std::string source = plugin.stem().string() + ".cpp";
        const auto beside = std::ranges::find_if(
            bundle.inputs, [&](const auto& input) { return fs::path(input.first).filename() == source; });
        if (std::error_code none; fs::exists(plugin, none)) {
            if (file_digest(plugin.string()) != sum)
                out.notes.push_back(
                    fmt::format("the plugin '{}' is another build than that of before", name));
        } else if (beside == bundle.inputs.end()) {
            diagnostics.error(
                {}, fmt::format("the plugin '{}' is needed, of which there is no source", name),
                fmt::format("copy it to '{}' when you trust those who made it", plugin.string()));
        } else {
            diagnostics.error(
                {}, fmt::format("the plugin '{}' is needed, of which the bundle has the source", name),
                fmt::format("read '{0}/{1}', then build it with 'forage build-plugin {0}/{1} -o "
                            "{2}' and repeat this command",
                            inputs, beside->first, plugin.string()));
        }
    }
}

std::optional<Rerun> from_bundle(const std::string& path, const std::string& directory,
                                 Diagnostics& diagnostics) {
    BundleRecord bundle;
    try {
        bundle = unpack_bundle(path, directory);
    } catch (const std::exception& e) {
        diagnostics.error({}, fmt::format("'{}' is not a bundle of results: {}", path, e.what()),
                          "'forage run --bundle' and 'forage experiment --bundle' write bundles");
        return std::nullopt;
    }
    const std::string inputs = directory + "/inputs";
    Rerun out{.command = bundle.command,
              .start = (fs::path(inputs) / bundle.start).string(),
              .results = directory + "/results",
              .expected = directory + "/expected"};
    for (const auto& [name, sum] : bundle.results) out.files.push_back(name);
    if (bundle.forage != FORAGE_VERSION)
        out.notes.push_back(fmt::format("made by Forage {}; this is {}", bundle.forage, FORAGE_VERSION));
    check_plugins(bundle, inputs, out, diagnostics);
    std::string folders;
    for (const auto& folder : bundle.model_folders)
        folders += fs::absolute(fs::path(inputs) / folder).string() + ":";
    if (const char* before = std::getenv("FORAGE_MODEL_PATH")) folders += before;
    setenv("FORAGE_MODEL_PATH", folders.c_str(), 1);
    fs::create_directories(out.start);
    return out;
}

std::optional<Rerun> from_run(const std::string& results, const std::string& directory,
                              Diagnostics& diagnostics) {
    const auto run = read_run_json(results);
    if (!run || run->command.empty()) {
        diagnostics.error({}, fmt::format("'{}' has no run.json of a run that 'forage run' began", results),
                          "name a directory of results, its run.json, or a bundle");
        return std::nullopt;
    }
    for (const auto& [path, sum] : run->inputs)
        if (file_digest(path) != sum) {
            std::error_code none;
            diagnostics.error({},
                              fmt::format("'{}' {}", path,
                                          fs::exists(path, none) ? "has changed since the run"
                                                                 : "is not there, which the run has read"),
                              "start in the folder where the run was started, and restore its files; a "
                              "bundle keeps them: 'forage run --bundle'");
        }
    Rerun out{
        .command = run->command, .results = directory + "/results", .expected = results, .files = run->files};
    if (std::ranges::find(out.files, "run.json") == out.files.end()) out.files.emplace_back("run.json");
    return out;
}

/// Whether two files of results have the same content. Archives of arrays have other headers with another
/// version of libzip.
bool same_content(const std::string& before, const std::string& now) {
    if (file_digest(before) == file_digest(now)) return true;
    if (fs::path(before).extension() != ".npz") return false;
    try {
        return observe::ZipFile(before).entries() == observe::ZipFile(now).entries();
    } catch (const std::exception&) {
        return false;
    }
}

/// Where two texts begin to differ.
std::string first_difference(const std::string& before, const std::string& now) {
    const auto at = std::ranges::mismatch(before, now).in1 - before.begin();
    const auto line = std::count(before.begin(), before.begin() + at, '\n') + 1;
    const auto shown = [at](const std::string& text) {
        const auto begin = at == 0 ? 0 : text.rfind('\n', static_cast<std::size_t>(at) - 1) + 1;
        constexpr std::size_t most = 100;
        return text.substr(begin, std::min(text.find('\n', begin) - begin, most));
    };
    if (before.find('\0') != before.npos) return fmt::format("differs from byte {} on", at + 1);
    return fmt::format("differs from line {} on: '{}' was '{}'", line, shown(now), shown(before));
}

/// What a run.json says of results, where it differs.
std::string result_difference(const std::string& before, const std::string& now) {
    try {
        const auto then = Json::parse(before).at("result"), here = Json::parse(now).at("result");
        std::vector<std::string> places;
        for (const auto& change : Json::diff(then, here)) places.push_back(change.at("path"));
        return places.empty() ? "" : "differs in " + separated(places, ", ");
    } catch (const Json::exception&) {
        return "is no run.json";
    }
}

}  // namespace

std::optional<Rerun> open_rerun(const std::string& path, const std::string& directory,
                                Diagnostics& diagnostics) {
    std::error_code none;
    const fs::path given = path;
    std::optional<Rerun> out;
    if (fs::is_directory(given, none))
        out = from_run(path, directory, diagnostics);
    else if (given.filename() == "run.json")
        out = from_run(given.parent_path().empty() ? "." : given.parent_path().string(), directory,
                       diagnostics);
    else if (!fs::is_regular_file(given, none))
        diagnostics.error({}, fmt::format("there is no file '{}'", path),
                          "name a bundle, a run.json or a directory of results");
    else
        out = from_bundle(path, directory, diagnostics);
    return diagnostics.failed() ? std::nullopt : out;
}

std::vector<Difference> differences(const Rerun& rerun) {
    std::vector<Difference> out;
    for (const auto& name : rerun.files) {
        const std::string then = rerun.expected + "/" + name, now = rerun.results + "/" + name;
        std::error_code none;
        std::string what;
        if (!fs::exists(now, none)) {
            what = "is missing";
        } else if (fs::path(name).filename() == "run.json") {
            what = result_difference(file_bytes(then), file_bytes(now));
        } else if (!same_content(then, now)) {
            what = first_difference(file_bytes(then), file_bytes(now));
        }
        if (!what.empty()) out.push_back({name, what});
    }
    return out;
}

std::string version_difference(const Rerun& rerun) {
    try {
        const auto then = Json::parse(file_bytes(rerun.expected + "/run.json")),
                   here = Json::parse(file_bytes(rerun.results + "/run.json"));
        std::vector<std::string> out;
        const auto compare = [&](const std::string& what, const Json& a, const Json& b) {
            if (a != b) out.push_back(fmt::format("{} {} then, {} now", what, a.dump(), b.dump()));
        };
        compare("Forage", then.at("forage"), here.at("forage"));
        compare("compiler", then.at("compiler"), here.at("compiler"));
        for (const auto& [name, version] : then.at("libraries").items())
            compare(name, version, here.at("libraries").value(name, Json()));
        return separated(out, "; ");
    } catch (const Json::exception&) {
        return {};
    }
}

}  // namespace forage
