#include "bug_interface/world/model_texts.h"

#include "bug_interface/world/sdf_edit.h"
#include "core/base/sequence.h"

namespace forage::bug {

const std::string& ModelTexts::of(const std::string& uri) {
    const auto [it, added] = texts_.try_emplace(uri);
    if (!added) return it->second;
    std::string file = folders_.find(uri);
    Diagnostics ignored;  // the check of the world reports what is wrong with its models
    if (!file.empty() && std::filesystem::is_directory(file))
        file = file_of_model(file, {}, ignored).value_or("");
    if (file.empty()) return it->second;
    std::string text = read_text(file).value_or("");
    check_world_text(file, text, ignored);
    if (!ignored.failed()) it->second = std::move(text);
    return it->second;
}

std::vector<std::string> ModelTexts::uris() const {
    return collected(folders_.names(), [](const std::string& name) { return "model://" + name; });
}

}  // namespace forage::bug
