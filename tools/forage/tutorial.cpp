// Lists and runs the exercises of the tutorial.
#include <algorithm>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "core/base/installation.h"
#include "core/base/print.h"
#include "core/base/sequence.h"
#include "core/model/lookup.h"
#include "core/xml/experiment.h"
#include "tools/api/experiment/results.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

struct TutorialOptions {
    std::string exercise;   ///< number of the exercise, or an experiment file; empty: list all exercises
    std::string directory;  ///< empty: forage-out/tutorial/ and the number
    std::string system;     ///< a system of the user's own; empty: run the exercise's system
};

namespace fs = std::filesystem;

/// An experiment file whose note explains it.
struct TutorialExercise {
    std::string number;  ///< such as "3.1": the beginning of the file's name, up to '-'
    fs::path file;
    fs::path start;       ///< the system that users complete; empty when there is none
    fs::path solution;    ///< the system that the exercise runs
    std::string title;    ///< the first line of the note
    std::string look_at;  ///< the other lines, each with two leading blanks and a line end
};

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

/// The exercises in a folder, sorted by their numbers. Reports files that cannot be read.
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

/// The path relative to the working directory when it is below it.
std::string shown(const fs::path& path) {
    std::error_code none;
    const fs::path relative = fs::relative(path, none);
    return relative.empty() || *relative.begin() == ".." ? path.string() : relative.string();
}

int tutorial(const TutorialOptions& o) {
    Diagnostics diagnostics;
    const fs::path folder = installation() / "share/forage/systems/tutorial";
    const auto all = read_tutorial(folder, diagnostics);
    if (diagnostics.failed()) {
        print(stderr, "{}", format(diagnostics));
        return bad_input;
    }
    if (all.empty()) {
        print(stderr, "error: there are no exercises in '{}'\n", folder.string());
        return bad_input;
    }
    const auto in_part = [&](const auto& e) {
        return o.exercise.empty() || e.number.starts_with(o.exercise + ".");
    };
    const auto first = std::ranges::find_if(all, in_part);
    if (first != all.end() && !o.system.empty())
        return refused("which exercise?",
                       fmt::format("'forage tutorial {} --system FILE' checks a file for the first one; "
                                   "without --system, the exercises are listed",
                                   first->number));
    if (first != all.end()) {
        for (const auto& e : all) {
            if (!in_part(e)) continue;
            print("{:<5} {}\n", e.number, e.title);
            if (!e.start.empty()) print("      start {}, solution {}\n", shown(e.start), shown(e.solution));
        }
        print(
            "\nforage tutorial {} runs the first one; with --system FILE, on a file of your own. "
            "docs/tutorial has the text.\n",
            first->number);
        return fine;
    }
    if (fs::path(o.exercise).extension() == ".xml")
        return experiment({.file = o.exercise, .directory = o.directory, .system = o.system});
    const auto wanted = std::ranges::find_if(all, [&](const auto& e) { return e.number == o.exercise; });
    if (wanted == all.end())
        return refused(fmt::format("there is no exercise '{}'", o.exercise),
                       suggest(o.exercise, collected(all, &TutorialExercise::number)));
    const std::string own = o.system.empty() ? "" : "-own";
    const std::string directory =
        o.directory.empty() ? "forage-out/tutorial/" + wanted->number + own : o.directory;
    print("{} {}\n", wanted->number, wanted->title);
    std::fflush(stdout);
    const int status =
        experiment({.file = wanted->file.string(), .directory = directory, .system = o.system});
    if (status != fine || !o.system.empty()) return status;
    print("look at\n{}", wanted->look_at);
    const auto pictures =
        collected(pictures_below(directory), [&](const auto& p) { return directory + "/" + p; });
    if (pictures.size() > 10)
        print("  the {} pictures: forage view {}\n", pictures.size(), directory);
    else
        for (const auto& picture : pictures) print("  {}\n", picture);
    return fine;
}

}  // namespace

void add_tutorial(Program& program) {
    const auto [command, o] =
        program.add("tutorial", "List the exercises of the tutorial, or run one", tutorial,
                    "docs/tutorial has the text, the questions and their solutions.\n"
                    "Example:\n"
                    "  forage tutorial 3.1\n"
                    "  forage tutorial 2.2 --system mine.iqr");
    add_value(command, "EXERCISE", o.exercise, " ",
              "Number of an exercise or of a part, or an experiment file");
    add_value(command, "--system", o.system, "FILE",
              "Run the exercise on this system, and say what it still lacks; the exit status is 1 if "
              "it lacks something");
    add_value(command, "-o,--output", o.directory, "DIR",
              "Directory for results [forage-out/tutorial/EXERCISE]")
        ->check(named("directory"));
}

}  // namespace forage::tool
