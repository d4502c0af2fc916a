#include "core/run/bundle.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/utsname.h>
#include <unistd.h>

#include "core/base/digest.h"
#include "core/base/file_bytes.h"
#include "core/base/output_files.h"
#include "core/base/shell_word.h"
#include "core/observe/zip_file.h"

namespace forage {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* record_name = "bundle.json";
constexpr int bundle_version = 1;

fs::path absolute(const std::string& path) { return fs::absolute(path).lexically_normal(); }

/// The deepest folder that holds all files and the working directory.
fs::path common_folder(const InputFiles& files) {
    fs::path out = fs::current_path();
    for (const auto& [path, sum] : files) {
        const fs::path folder = absolute(path).parent_path();
        fs::path shared;
        const auto end = std::mismatch(out.begin(), out.end(), folder.begin(), folder.end()).first;
        for (auto part = out.begin(); part != end; ++part) shared /= *part;
        out = shared;
    }
    return out;
}

bool is_plugin(const fs::path& path) { return path.extension() == ".so"; }

/// The source of a plugin, where `forage build-plugin` finds it; empty when there is none.
fs::path source_of(const fs::path& plugin) {
    fs::path name = plugin.stem();
    name += ".cpp";
    for (const auto& folder : {plugin.parent_path(), plugin.parent_path().parent_path()})
        if (std::error_code none; fs::is_regular_file(folder / name, none)) return folder / name;
    return {};
}

/// The folder of the model that a file of a world belongs to; empty when there is none.
fs::path model_folder(const fs::path& file) {
    std::error_code none;
    for (fs::path folder = file.parent_path(); folder != folder.root_path(); folder = folder.parent_path())
        if (fs::exists(folder / "model.config", none)) return folder;
    return {};
}

/// What the files are called in the bundle.
using Entries = std::vector<observe::ZipEntry>;

std::string digest_of(const observe::ZipEntry& e) {
    return e.path.empty() ? sha256(e.text) : file_digest(e.path);
}

std::uintmax_t size_of(const observe::ZipEntry& e) {
    std::error_code none;
    return e.path.empty() ? e.text.size() : fs::file_size(e.path, none);
}

/// The name and the version of the system that the program runs on.
std::string platform() {
    utsname name{};
    uname(&name);
    std::ifstream in("/etc/os-release");
    for (std::string line; std::getline(in, line);)
        if (line.starts_with("PRETTY_NAME=\"") && line.size() > 14)
            return fmt::format("{}, {}", line.substr(13, line.size() - 14), name.machine);
    return fmt::format("{} {}", name.sysname, name.machine);
}

std::string host() {
    std::array<char, 256> name{};
    gethostname(name.data(), name.size() - 1);
    return name.data();
}

std::string date_now() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &parts));
    return text.data();
}

Json json_of(const BundleRecord& r) {
    return {{"bundle", bundle_version},
            {"forage", r.forage},
            {"platform", r.platform},
            {"host", r.host},
            {"date", r.date},
            {"command", r.command},
            {"start", r.start},
            {"inputs", r.inputs},
            {"results", r.results},
            {"plugins", r.plugins},
            {"model_folders", r.model_folders}};
}

BundleRecord record_of(const Json& json) {
    if (json.at("bundle") != bundle_version)
        throw std::runtime_error("a newer version of Forage has written it");
    return {json.at("forage"),        json.at("platform"), json.at("host"),   json.at("date"),
            json.at("command"),       json.at("start"),    json.at("inputs"), json.at("results"),
            json.at("model_folders"), json.at("plugins")};
}

std::string command_line(const std::vector<std::string>& command) {
    std::string out = "forage";
    for (const auto& word : command) out += " " + shell_word(word);
    return out;
}

/// The metadata of an RO-Crate: what each file is, and which command made the results.
std::string crate(const BundleRecord& r, const Entries& files) {
    const auto id = [](const std::string& name) { return Json{{"@id", name}}; };
    Json parts = Json::array(), objects = Json::array(), results = Json::array(), graph = Json::array();
    for (const auto& file : files) {
        parts.push_back(id(file.name));
        (file.name.starts_with("results/") ? results : objects).push_back(id(file.name));
    }
    const std::string line = command_line(r.command);
    graph.push_back({{"@id", "ro-crate-metadata.json"},
                     {"@type", "CreativeWork"},
                     {"conformsTo", id("https://w3id.org/ro/crate/1.1")},
                     {"about", id("./")}});
    graph.push_back({{"@id", "./"},
                     {"@type", "Dataset"},
                     {"name", line},
                     {"description",
                      "A simulation with Forage: what it has read, and its results. "
                      "'forage rerun' repeats it."},
                     {"datePublished", r.date},
                     {"hasPart", parts},
                     {"mentions", id("#run")}});
    graph.push_back({{"@id", "#forage"},
                     {"@type", "SoftwareApplication"},
                     {"name", "Forage"},
                     {"softwareVersion", r.forage},
                     {"operatingSystem", r.platform}});
    graph.push_back({{"@id", "#run"},
                     {"@type", "CreateAction"},
                     {"name", line},
                     {"instrument", id("#forage")},
                     {"endTime", r.date},
                     {"object", objects},
                     {"result", results}});
    for (const auto& file : files)
        graph.push_back({{"@id", file.name},
                         {"@type", "File"},
                         {"name", fs::path(file.name).filename().string()},
                         {"contentSize", fmt::to_string(size_of(file))},
                         {"sha256", digest_of(file)}});
    return Json{{"@context", "https://w3id.org/ro/crate/1.1/context"}, {"@graph", graph}}.dump(2) + "\n";
}

/// Removes a folder when it goes.
class Temporary {
  public:
    explicit Temporary(std::string path) : path_(std::move(path)) { clear(); }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    ~Temporary() { clear(); }
    const std::string& path() const { return path_; }

  private:
    void clear() const {
        std::error_code none;
        fs::remove_all(path_, none);
    }
    std::string path_;
};

/// Whether a name of a bundle stays in the folder into which it is unpacked.
bool stays_inside(const fs::path& name) {
    return !name.empty() && name.is_relative() && std::ranges::find(name, "..") == name.end();
}

}  // namespace

void write_bundle(const std::string& path, const std::vector<std::string>& command, const InputFiles& inputs,
                  const FileTexts& texts, const std::string& directory,
                  const std::vector<std::string>& results) {
    BundleRecord record{.forage = FORAGE_VERSION,
                        .platform = platform(),
                        .host = host(),
                        .date = date_now(),
                        .command = command};
    const fs::path root = common_folder(inputs);
    const auto inside = [&](const fs::path& file) { return file.lexically_relative(root).string(); };
    record.start = inside(fs::current_path());
    Entries files;
    std::set<std::string> folders;
    const auto take = [&](const fs::path& file, const std::string* text = nullptr) {
        if (record.inputs.contains(inside(file))) return;
        files.push_back({"inputs/" + inside(file), text ? "" : file.string(), text ? *text : ""});
        record.inputs[inside(file)] = digest_of(files.back());
    };
    for (const auto& [name, sum] : inputs) {
        const fs::path file = absolute(name);
        const auto kept = texts.find(name);
        if (kept == texts.end() && file_digest(file.string()) != sum)
            throw std::runtime_error(
                fmt::format("cannot write '{}': '{}' has changed since it was read", path, name));
        // What was given as an absolute path is found in the folder into which the bundle is unpacked.
        const std::string from_start = file.lexically_relative(fs::current_path()).string();
        for (auto& word : record.command)
            if (const auto at = word.find(file.string()); at != word.npos)
                word.replace(at, file.string().size(), from_start);
        if (is_plugin(file)) {
            record.plugins[inside(file)] = sum;
            if (const auto source = source_of(file); !source.empty()) take(source);
            continue;
        }
        take(file, kept == texts.end() ? nullptr : &kept->second);
        if (const auto model = model_folder(file); !model.empty())
            folders.insert(inside(model.parent_path()));
    }
    record.model_folders.assign(folders.begin(), folders.end());
    for (const auto& name : results) {
        files.push_back({"results/" + name, directory + "/" + name});
        record.results[name] = digest_of(files.back());
    }
    const std::string metadata = crate(record, files);
    files.push_back({record_name, {}, json_of(record).dump(2) + "\n"});
    files.push_back({"ro-crate-metadata.json", {}, metadata});
    observe::write_zip(path, files, true);
}

BundleRecord unpack_bundle(const std::string& path, const std::string& folder) {
    const observe::ZipFile zip(path);
    const auto target = [](const std::string& name) -> std::string {
        if (name == record_name || name.starts_with("inputs/")) return "/" + name;
        return name.starts_with("results/") ? "/expected" + name.substr(7) : "";
    };
    if (std::ranges::find(zip.entries(), record_name, &observe::ZipFile::Entry::name) == zip.entries().end())
        throw std::runtime_error(fmt::format("it has no {}", record_name));
    for (const auto& entry : zip.entries()) {
        if (!stays_inside(entry.name))
            throw std::runtime_error(fmt::format("its file '{}' leads out of the bundle", entry.name));
        if (is_plugin(entry.name)) throw std::runtime_error("it holds a plugin, which no bundle does");
    }
    const Temporary part(partial(folder));  // nothing is left of a bundle that is refused
    std::vector<std::string> files;
    for (const auto& entry : zip.entries()) {
        const auto name = target(entry.name);
        if (name.empty() || name.ends_with('/')) continue;
        make_directory(fs::path(part.path() + name).parent_path().string());
        zip.extract(entry, part.path() + name);
        files.push_back(name);
    }
    BundleRecord out;
    try {
        out = record_of(Json::parse(file_bytes(part.path() + "/" + record_name)));
    } catch (const Json::exception& e) {
        throw std::runtime_error(fmt::format("its {} is not as Forage writes it: {}", record_name, e.what()));
    }
    if (!stays_inside(out.start)) throw std::runtime_error("its start leads out of the bundle");
    for (const auto& model : out.model_folders)
        if (!stays_inside(model)) throw std::runtime_error("its folders of models lead out of the bundle");
    for (const auto& [name, sum] : out.inputs)
        if (!stays_inside(name) || file_digest(part.path() + "/inputs/" + name) != sum)
            throw std::runtime_error(fmt::format("its file '{}' is not the one that was bundled", name));
    for (const auto& name : files) {
        make_directory(fs::path(folder + name).parent_path().string());
        fs::rename(part.path() + name, folder + name);
    }
    return out;
}

}  // namespace forage
