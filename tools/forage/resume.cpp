// Resumes a run from its checkpoint.
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "core/base/print.h"
#include "core/observe/row_file.h"
#include "core/run/checkpoint_file.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

struct ResumeOptions {
    std::string path;  ///< a directory of results, or a checkpoint in it
    int threads = 0;   ///< 0 for as many as before the stop
    bool quiet = false;
};

namespace fs = std::filesystem;

/// The content of a checkpoint, before the run is created.
struct Found {
    std::string path, content;
    CheckpointOrigin origin;
    std::string_view state;  ///< the part of `content` with the state
};

std::unique_ptr<Found> open_checkpoint(const std::string& path) {
    auto out = std::make_unique<Found>();
    out->path = path;
    out->content = read_checkpoint(path);
    Archive archive{std::string_view(out->content)};
    archive(out->origin);
    if (out->origin.version != FORAGE_VERSION)
        throw CheckpointError(fmt::format("checkpoint '{}' was written by forage {}, and this is {}", path,
                                          out->origin.version, FORAGE_VERSION));
    out->state = archive.left();
    return out;
}

bool is_gone(const std::string& path) {
    std::error_code unknown;
    return !fs::exists(path, unknown) && !unknown;
}

/// Reports files that have changed since the run was started.
void check_files(const CheckpointOrigin& origin, const InputFiles& now, Diagnostics& diagnostics) {
    for (const auto& [path, digest] : origin.files) {
        const auto same = now.find(path);
        if (same != now.end() && same->second == digest) continue;
        diagnostics.error({},
                          is_gone(path) ? fmt::format("'{}', which the run has read, is gone", path)
                                        : fmt::format("'{}' has changed since the run began{}", path,
                                                      same == now.end() ? ": it is not read now" : ""),
                          "a run can only be resumed with the same files; restore it, or start a new run "
                          "with 'forage run'");
    }
    for (const auto& [path, digest] : origin.module_files)
        if (file_digest(path) != digest)
            diagnostics.error(
                {},
                is_gone(path)
                    ? fmt::format("'{}', a file of a module, is gone", path)
                    : fmt::format("'{}', a file of a module, has changed since cycle {}", path, origin.cycle),
                "restore it, or start a new run with 'forage run'");
}

/// The run in the state of the checkpoint. Throws CheckpointError when the checkpoint is unusable; empty when
/// `diagnostics` got an error.
std::optional<PreparedRun> restore(const Found& found, const RunSpec& spec, const Sources& sources,
                                   Diagnostics& diagnostics) {
    if (diagnostics.failed()) return std::nullopt;
    auto prepared = prepare(sources, spec, diagnostics);
    if (!prepared) return std::nullopt;
    check_files(found.origin, input_files(spec, sources), diagnostics);
    if (diagnostics.failed()) return std::nullopt;
    Archive archive(found.state);
    archive(prepared->run);
    if (!archive.left().empty()) throw ArchiveError("the checkpoint contains more than the run");
    return prepared;
}

int resume(const ResumeOptions& o) {
    const fs::path given = fs::absolute(o.path);
    const bool whole_directory = fs::is_directory(given);
    const std::string directory = (whole_directory ? given : given.parent_path()).string();
    std::vector<std::string> paths = {given.string()};
    if (whole_directory) paths = {checkpoint_path(directory), previous_checkpoint_path(directory)};
    if (whole_directory && !fs::exists(paths[0]) && !fs::exists(paths[1]))
        return refused(fmt::format("there is no checkpoint in '{}'", o.path),
                       fs::exists(given / "run.json")
                           ? "the run is finished, or was made without --checkpoint-every"
                           : "a run writes checkpoints with --checkpoint-every, into its directory (-o)");
    std::string unusable;
    for (const auto& path : paths) try {
            if (whole_directory && !fs::exists(path)) continue;  // killed between two renames
            const auto found = open_checkpoint(path);
            std::error_code moved;
            fs::current_path(found->origin.working_directory,
                             moved);  // unchanged when it does not exist any more
            RunOptions options = parse_run(found->origin.arguments);
            options.spec.arguments = found->origin.arguments;
            options.spec.directory = directory;
            options.quiet |= o.quiet;
            if (o.threads > 0) options.spec.threads = o.threads;
            options.spec.input.resumed_files = found->origin.files;
            ask_for_trust(options.spec.input);
            Diagnostics diagnostics;
            const Sources sources = read_sources(options.spec.input, diagnostics);
            auto prepared = restore(*found, options.spec, sources, diagnostics);
            if (diagnostics.failed() || !options.quiet) print(stderr, "{}", format(diagnostics));
            if (!prepared) return bad_input;
            if (!unusable.empty()) print(stderr, "warning: {}\n", unusable);
            if (!unusable.empty() || !options.quiet)
                print(stderr, "continuing from cycle {}\n", prepared->run.cycle());
            // A newer checkpoint that is damaged or not wanted must not be kept instead of this one.
            if (path != checkpoint_path(directory)) fs::remove(checkpoint_path(directory));
            return run_to_end(options, *prepared);
        } catch (const CheckpointError& e) {
            unusable += (unusable.empty() ? "" : "\n") + std::string(e.what());
        } catch (const ArchiveError& e) {
            unusable += fmt::format("{}checkpoint '{}': {}", unusable.empty() ? "" : "\n", path, e.what());
        } catch (const observe::ShortFile& e) {
            unusable += fmt::format("{}checkpoint '{}': {}", unusable.empty() ? "" : "\n", path, e.what());
        }
    return refused(unusable,
                   "start the run again; name the directory of results of a run with --checkpoint-every");
}

}  // namespace

void add_resume(Program& program) {
    const auto [command, o] =
        program.add("resume", "Continue a stopped run from its checkpoint", resume,
                    "The files are then the same, byte for byte, as those of a run that was never stopped.\n"
                    "Example:\n"
                    "  forage resume forage-out");
    add_value(command, "FROM", o.path, "DIR|FILE", "Directory of results, or one of the checkpoints in it")
        ->required();
    add_value(command, "--threads", o.threads, "N",
              "Largest number of threads that share a cycle [as before]")
        ->transform(threads());
    command.add_flag("-q,--quiet", o.quiet, "Print errors only");
}

}  // namespace forage::tool
