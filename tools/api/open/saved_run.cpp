// Runs that are saved and resumed as a whole: how they were opened, their observers, and their state.
#include "tools/api/open/saved_run.h"

#include <filesystem>

#include <fmt/format.h>

#include "core/base/member_count.h"
#include "core/observe/manipulation.h"
#include "core/run/checkpoint_file.h"
#include "core/run/module_files.h"
#include "core/run/path_recorder.h"
#include "tools/api/open/program_types.h"
#include "tools/plot/plots.h"

namespace forage {
namespace {

using observe::Manipulation;

std::string absolute(const std::string& path) {
    return path.empty() ? path : std::filesystem::absolute(path).string();
}

/// An observer that open() does not add, because it is created when the run resumes; or Run::overrun().
enum class Saved : std::uint8_t { recording, manipulation, measures, overrun };

void keep(Archive& archive, std::string& source, std::uint64_t& every) { archive(source, every); }

void keep(Archive& archive, model::Measure& m) {
    static_assert(member_count<model::Measure>() == 6);  // another process cannot use the location
    archive(m.name, m.kind, m.what.text, m.of.text, m.last);
}

/// Writes one observer. Returns false for those that open() adds itself, and for films.
bool save(Archive& archive, const Observer& observer) {
    if (dynamic_cast<const ModuleFiles*>(&observer) || dynamic_cast<const TrialRecorder*>(&observer) ||
        dynamic_cast<const PathRecorder*>(&observer) || dynamic_cast<const plot::FilmRecorder*>(&observer))
        return false;  // a film stays with the run
    const auto begin = [&](Saved kind) { archive(kind); };
    if (const auto* recorder = dynamic_cast<const MemoryRecorder*>(&observer)) {
        begin(Saved::recording);
        std::string source = recorder->what().name;
        std::uint64_t every = recorder->every();
        keep(archive, source, every);
    } else if (const auto* manipulation = dynamic_cast<const Manipulation*>(&observer);
               manipulation && !manipulation->settings().from && !manipulation->settings().until) {
        begin(Saved::manipulation);
        auto settings = manipulation->settings();
        archive(settings);
    } else if (const auto* measures = dynamic_cast<const RunMeasures*>(&observer)) {
        begin(Saved::measures);
        auto specs = measures->specs();
        std::uint64_t count = specs.size();
        archive(count);
        for (auto& m : specs) keep(archive, m);
    } else {
        throw InputError("this run cannot be saved as a whole, because of one of its observers",
                         "recordings in memory, manipulations without conditions and measures can be saved; "
                         "of other runs, save the state with Run::checkpoint()");
    }
    return true;
}

/// Reads one observer, and adds it to the run; or reads the overrun.
void restore(Archive& archive, Run& run, double& overrun) {
    Saved kind{};
    archive(kind);
    if (kind == Saved::overrun) {
        archive(overrun);
    } else if (kind == Saved::recording) {
        std::string source;
        std::uint64_t every = 1;
        keep(archive, source, every);
        run.record(source, every);
    } else if (kind == Saved::manipulation) {
        Manipulation::Settings settings;
        archive(settings);
        run.add(std::make_unique<Manipulation>(std::move(settings)));
    } else {
        std::uint64_t count = 0;
        archive(count);
        std::vector<model::Measure> specs;
        for (; count > 0; --count) keep(archive, specs.emplace_back());
        Diagnostics diagnostics;
        auto measures = checked(
            diagnostics, std::make_unique<RunMeasures>(specs, run.layout(), run.environment(), diagnostics));
        run.add(std::move(measures));
    }
}

/// How a run was opened.
struct Origin {
    std::string version = FORAGE_VERSION, system, text;
    OpenOptions options;
    InputFiles files;                          ///< digests when it was opened
    std::map<std::string, std::string> types;  ///< of the program, with their versions
    void checkpoint(Archive& archive) { archive(version, system, text, options, files, types); }
};

void check_files(const InputFiles& files) {
    Diagnostics diagnostics;
    std::error_code unknown;
    for (const auto& [path, digest] : files)
        if (file_digest(path) != digest)
            diagnostics.error({},
                              fmt::format("'{}' {}", path,
                                          std::filesystem::exists(path, unknown) || unknown
                                              ? "has changed since the run was opened"
                                              : "is gone, which the run has read"),
                              "a run can only be resumed with the same files: restore it");
    throw_errors(diagnostics);
}

void check_types(const std::map<std::string, std::string>& used) {
    Diagnostics diagnostics;
    const auto there = program_types();
    for (const auto& [name, version] : used) {
        const auto it = there.find(name);
        if (it == there.end())
            diagnostics.error(
                {},
                fmt::format("the state of the run needs the type '{}', which this program does not define",
                            name),
                "define it before the run is resumed, as it was when the run was opened");
        else if (it->second != version)
            diagnostics.error({}, fmt::format("the type '{}' has changed since the run was opened", name),
                              "a run can only be resumed with the same types: restore it");
    }
    throw_errors(diagnostics);
}

}  // namespace

std::string origin_of(const std::string& system, const std::string& text, OpenOptions options,
                      const InputFiles& files, std::map<std::string, std::string> types) {
    options.world = absolute(options.world);
    for (auto& p : options.plugins) p = absolute(p);
    InputFiles there;
    for (const auto& [path, digest] : files) there[absolute(path)] = digest;
    Origin origin{.system = absolute(system),
                  .text = text,
                  .options = std::move(options),
                  .files = std::move(there),
                  .types = std::move(types)};
    Archive archive;
    archive(origin);
    return archive.bytes();
}

void set_origin(Run& run, const Run& restarted) {
    if (restarted.opened_as.empty()) return;
    Origin origin;
    Archive{std::string_view(restarted.opened_as)}(origin);
    origin.options.seed = run.seed();
    RunInput input;
    input.system = origin.system, input.world = origin.options.world, input.seed = run.seed();
    run.title = run_title(input);
    Archive archive;
    archive(origin);
    run.opened_as = archive.bytes();
}

std::string save_state(Run& run) {
    if (run.opened_as.empty())
        throw InputError("a run of a system that was built in code cannot be saved as a whole",
                         "save its state with Run::checkpoint(), and resume it in a run of the same system");
    run.start();
    Archive observers;
    std::uint64_t count = 0;
    for (const auto& o : run.observers()) count += save(observers, *o);
    if (double ahead = run.overrun(); ahead > 0) {
        Saved kind = Saved::overrun;
        observers(kind, ahead);
        ++count;
    }
    std::string list = observers.bytes();
    Archive out;
    out(run.opened_as, count, list, run);
    return sealed(out.bytes());
}

Run resume(std::string_view state, bool trusted) {
    const std::string content = unsealed(state, "the state of the run");
    Archive archive{std::string_view(content)};
    std::string how, list;
    std::uint64_t count = 0;
    archive(how, count, list);
    Origin origin;
    Archive{std::string_view(how)}(origin);
    if (origin.version != FORAGE_VERSION)
        throw CheckpointError(fmt::format("the state of the run was written by forage {}, and this is {}",
                                          origin.version, FORAGE_VERSION));
    check_files(origin.files);
    check_types(origin.types);
    Run run = open(origin.system, origin.text, origin.options, nullptr, trusted ? nullptr : &origin.files);
    Archive observers{std::string_view(list)};
    double overrun = 0;
    for (; count > 0; --count) restore(observers, run, overrun);
    run.start();
    archive(run);
    run.set_overrun(overrun);
    if (!archive.left().empty()) throw ArchiveError("the state contains more than the run");
    return run;
}

}  // namespace forage
