#include "bug_interface/world/model_folders.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <span>
#include <sstream>

#include <fmt/format.h>

#include "bug_interface/world/sdf_format.h"
#include "core/base/installation.h"
#include "core/base/number.h"
#include "core/base/separated.h"
#include "core/base/sequence.h"
#include "core/base/text_file.h"
#include "core/xml/check.h"

namespace forage::bug {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view scheme = "model://";

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

constexpr const char* what_to_write = "<sdf version=\"1.4\">model.sdf</sdf>";

/// Whether a path from a folder can lead out of it.
bool leads_out(const fs::path& path) { return path.is_absolute() || contains(path, ".."); }

/// Whether a path, with all links followed, is in a folder.
bool is_inside(const fs::path& folder, const fs::path& path) {
    std::error_code ignored;
    const auto root = fs::weakly_canonical(folder, ignored), file = fs::weakly_canonical(path, ignored);
    return !root.empty() &&
           std::mismatch(root.begin(), root.end(), file.begin(), file.end()).first == root.end();
}

/// A text with "%20" and the like replaced by the characters that they stand for.
std::string without_escapes(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned byte = 0;
        const auto* digits = text.data() + i + 1;
        if (text[i] == '%' && i + 2 < text.size() &&
            std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2 && byte > 0)
            out += static_cast<char>(byte), i += 2;
        else
            out += text[i];
    }
    return out;
}

/// The <sdf> element with the newest version; false when there is none. Elements without a version count as
/// the oldest.
xml::Element newest(const xml::Element& model) {
    xml::Element out;
    int newest = -1;
    for (const xml::Element& e : model.children("sdf")) {
        const std::string_view version = e["version"].view;
        const int minor = version.starts_with("1.") ? parse_number<int>(version.substr(2)).value_or(0) : 0;
        if (minor > newest) newest = minor, out = e;
    }
    return out;
}

}  // namespace

ModelFolders::ModelFolders(const std::string& world_file, const std::vector<std::string>& extra)
    : world_(world_file), folders_(extra) {
    const fs::path beside = fs::path(world_file).parent_path();
    for (const char* folder : {"models", "../models", "../../models"})
        folders_.push_back((beside / folder).string());
    for (const char* variable : {"FORAGE_MODEL_PATH", "GAZEBO_MODEL_PATH"}) {
        const char* list = std::getenv(variable);
        std::istringstream in(list ? list : "");
        for (std::string entry; std::getline(in, entry, ':');)
            if (!entry.empty()) folders_.push_back(entry);
    }
    try {
        folders_.push_back((installation() / "share/forage/systems/worlds/models").string());
    } catch (const fs::filesystem_error&) {  // not known where /proc is not mounted
    }
}

std::string ModelFolders::find(const std::string& uri, const std::string& from) const {
    const bool is_model = uri.starts_with(scheme);
    std::string path = uri;
    for (const std::string_view prefix : {scheme, std::string_view("file://"), std::string_view("file:")})
        if (uri.starts_with(prefix)) {
            path.erase(0, prefix.size());
            break;
        }
    std::vector<std::string> folders = folders_;
    if (!is_model) folders.insert(folders.begin(), fs::path(from.empty() ? world_ : from).parent_path());
    for (const auto& name : {path, without_escapes(path)}) {
        if (name.empty() || (is_model && leads_out(name))) continue;
        for (const auto& folder : folders)
            if (std::error_code ignored; fs::exists(fs::path(folder) / name, ignored))
                return (fs::path(folder) / name).lexically_normal().string();
    }
    return {};
}

std::vector<std::string> ModelFolders::names() const {
    std::vector<std::string> names;
    for (const auto& folder : folders_) {
        std::error_code ignored;
        for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
             entry.increment(ignored))
            if (fs::exists(entry->path() / "model.config", ignored))
                names.push_back(entry->path().filename().string());
    }
    std::ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

std::string ModelFolders::hint(std::string_view uri, const std::vector<std::string>& names) {
    if (!uri.starts_with(scheme) && contains(names, uri)) return fmt::format("write {}{}", scheme, uri);
    const std::string name(uri.starts_with(scheme) ? uri.substr(scheme.size()) : uri);
    std::vector<std::string> near;
    const auto take = [&](auto&& matches) {
        if (near.empty() && name.size() >= 3)
            for (const auto& candidate : names)
                if (matches(lower(candidate), lower(name)))
                    near.push_back(fmt::format("'{}{}'", scheme, candidate));
    };
    take([](const std::string& known, const std::string& asked) { return known.starts_with(asked); });
    take([](const std::string& known, const std::string& asked) {
        return known.find(asked) != std::string::npos || asked.find(known) != std::string::npos;
    });
    if (near.empty())
        if (const auto nearest = forage::nearest(name, names); !nearest.empty())
            near.push_back(fmt::format("'{}{}'", scheme, nearest));
    constexpr std::size_t few = 4, shown = 12;
    if (!near.empty() && near.size() <= few) return fmt::format("did you mean {}?", separated(near, " or "));
    const std::size_t n = std::min(names.size(), shown);
    return fmt::format("the models are {}{}", separated(std::span(names).first(n), ", "),
                       n < names.size() ? fmt::format(" and {} more", names.size() - n) : "");
}

std::optional<std::string> file_of_model(const fs::path& folder, const Location& where,
                                         Diagnostics& diagnostics) {
    fs::path config = folder / "model.config";
    if (!fs::exists(config)) config = folder / "manifest.xml";
    if (!fs::exists(config)) {
        diagnostics.error(where,
                          fmt::format("the folder '{}' of this model has no model.config", folder.string()),
                          "it says which file holds the model; copy it from another model");
        return {};
    }
    const auto document = xml::open(config.string(), model_config_format(), diagnostics);
    if (!document) return {};
    const xml::Element sdf = newest(document->root());
    if (!sdf || sdf.value().view.empty()) {
        diagnostics.error(sdf ? sdf.where() : document->root().where(),
                          "this does not say which file holds the model", what_to_write);
        return {};
    }
    const fs::path file = folder / sdf.value().text();
    const bool outside = !is_inside(folder, file);
    if (std::error_code ignored; !outside && fs::is_regular_file(file, ignored)) return file.string();
    diagnostics.error(sdf.value().where(),
                      outside
                          ? fmt::format("the file '{}' is not in the folder of its model", sdf.value().text())
                          : fmt::format("there is no file '{}'", file.string()),
                      what_to_write);
    return {};
}

std::optional<std::string> read_text(const std::string& path) {
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) return {};
    try {
        return read_file(path, std::size_t{32} << 20);
    } catch (const FileError&) {
        return {};
    }
}

}  // namespace forage::bug
