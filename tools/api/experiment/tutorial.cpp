#include "tools/api/experiment/tutorial.h"

#include <algorithm>

#include "core/model/lookup.h"
#include "core/xml/experiment.h"

namespace forage {
namespace {

namespace fs = std::filesystem;

void read_note(std::string_view note, TutorialExercise& out) {
    while (!note.empty()) {
        const auto end = std::min(note.find('\n'), note.size());
        const std::string line(model::trim(note.substr(0, end)));
        note.remove_prefix(std::min(end + 1, note.size()));
        if (out.title.empty())
            out.title = line;
        else if (!line.empty() || !out.look_at.empty())
            out.look_at += "  " + line + "\n";
    }
    while (out.look_at.ends_with("  \n")) out.look_at.erase(out.look_at.size() - 3);
}

}  // namespace

std::vector<TutorialExercise> read_tutorial(const fs::path& folder, Diagnostics& diagnostics) {
    std::vector<TutorialExercise> out;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        const std::string name = entry.path().filename().string();
        const auto dash = name.find('-');
        if (entry.path().extension() != ".xml" || dash == std::string::npos) continue;
        const auto experiment = xml::read_experiment(entry.path().string(), diagnostics);
        if (!experiment) continue;
        auto& exercise = out.emplace_back();
        exercise.number = name.substr(0, dash);
        exercise.file = entry.path();
        if (experiment->exercise) exercise.start = fs::path(experiment->exercise->start).lexically_normal();
        if (!experiment->systems.empty())
            exercise.solution = fs::path(experiment->systems.front().text).lexically_normal();
        read_note(experiment->note, exercise);
    }
    std::ranges::sort(out, [](const auto& a, const auto& b) { return a.number < b.number; });
    return out;
}

}  // namespace forage
