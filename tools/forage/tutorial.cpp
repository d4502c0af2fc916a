// The exercises of the tutorial: experiment files whose note explains them.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "core/model/lookup.h"
#include "core/xml/experiment.h"
#include "tools/forage/commands.h"

namespace forage::tool {
namespace {

namespace fs = std::filesystem;

struct Exercise {
    std::string number;  ///< such as "3.1": the beginning of the file's name, up to '-'
    fs::path file;
    fs::path start;       ///< the system that users complete; empty when there is none
    fs::path solution;    ///< the system that the exercise runs
    std::string title;    ///< the first line of the note
    std::string look_at;  ///< the other lines, without leading blanks
};

/// The folder of exercises, in the installation or the build tree that the running program is in.
fs::path folder() {
    std::error_code none;
    return fs::read_symlink("/proc/self/exe", none).parent_path().parent_path() /
           "share/forage/systems/tutorial";
}

void read_note(std::string_view note, Exercise& out) {
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

std::vector<Exercise> exercises(Diagnostics& diagnostics) {
    std::vector<Exercise> out;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder(), none)) {
        const std::string name = entry.path().filename().string();
        const auto dash = name.find('-');
        if (entry.path().extension() != ".xml" || dash == std::string::npos) continue;
        const auto experiment = xml::read_experiment(entry.path().string(), diagnostics);
        if (!experiment) continue;
        const auto path = [](const std::string& p) { return fs::path(p).lexically_normal(); };
        Exercise exercise{name.substr(0, dash),
                          entry.path(),
                          experiment->exercise ? path(experiment->exercise->start) : fs::path(),
                          experiment->systems.empty() ? fs::path() : path(experiment->systems.front().text),
                          {},
                          {}};
        read_note(experiment->note, exercise);
        out.push_back(std::move(exercise));
    }
    std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
    return out;
}

/// The path relative to the working directory when it is below it.
std::string shown(const fs::path& path) {
    std::error_code none;
    const fs::path relative = fs::relative(path, none);
    return relative.empty() || *relative.begin() == ".." ? path.string() : relative.string();
}

}  // namespace

int tutorial(const TutorialOptions& o) {
    Diagnostics diagnostics;
    const auto all = exercises(diagnostics);
    if (diagnostics.failed()) {
        fmt::print(stderr, "{}", format(diagnostics));
        return bad_input;
    }
    if (all.empty()) {
        fmt::print(stderr, "error: there are no exercises in '{}'\n", folder().string());
        return bad_input;
    }
    const auto in_part = [&](const auto& e) {
        return o.exercise.empty() || e.number.starts_with(o.exercise + ".");
    };
    const auto first = std::find_if(all.begin(), all.end(), in_part);
    if (first != all.end() && !o.system.empty()) {
        fmt::print(stderr,
                   "error: which exercise?\n  hint: 'forage tutorial {} --system FILE' checks a file for the "
                   "first one; "
                   "without --system, the exercises are listed\n",
                   first->number);
        return bad_input;
    }
    if (first != all.end()) {
        for (const auto& e : all) {
            if (!in_part(e)) continue;
            fmt::print("{:<5} {}\n", e.number, e.title);
            if (!e.start.empty())
                fmt::print("      start {}, solution {}\n", shown(e.start), shown(e.solution));
        }
        fmt::print(
            "\nforage tutorial {} runs the first one; with --system FILE, on a file of your own. "
            "docs/tutorial "
            "has the text.\n",
            first->number);
        return fine;
    }
    if (fs::path(o.exercise).extension() == ".xml")
        return experiment({.file = o.exercise, .directory = o.directory, .system = o.system});
    const auto wanted =
        std::find_if(all.begin(), all.end(), [&](const auto& e) { return e.number == o.exercise; });
    if (wanted == all.end()) {
        std::vector<std::string> numbers;
        for (const auto& e : all) numbers.push_back(e.number);
        fmt::print(stderr, "error: there is no exercise '{}'\n  hint: {}\n", o.exercise,
                   suggest(o.exercise, numbers));
        return bad_input;
    }
    const std::string own = o.system.empty() ? "" : "-own";
    const std::string directory =
        o.directory.empty() ? "forage-out/tutorial/" + wanted->number + own : o.directory;
    fmt::print("{} {}\n", wanted->number, wanted->title);
    std::fflush(stdout);
    const int status =
        experiment({.file = wanted->file.string(), .directory = directory, .system = o.system});
    if (status != fine || !o.system.empty()) return status;
    fmt::print("look at\n{}", wanted->look_at);
    std::vector<std::string> pictures;
    for (const auto& file : fs::recursive_directory_iterator(fs::path(directory) / "runs"))
        if (file.path().extension() == ".png") pictures.push_back(file.path().string());
    std::sort(pictures.begin(), pictures.end());
    if (pictures.size() > 10)
        fmt::print("  the {} pictures: forage view {}\n", pictures.size(), directory);
    else
        for (const auto& picture : pictures) fmt::print("  {}\n", picture);
    return fine;
}

}  // namespace forage::tool
