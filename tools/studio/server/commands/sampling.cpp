#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "core/observe/row_file.h"
#include "core/run/recordings.h"
#include "tools/studio/server/commands/shared.h"
#include "tools/studio/server/page_paths.h"

namespace forage::studio {
namespace {

namespace fs = std::filesystem;

/// The next name of a sequence of files that is free: "light.csv" gives "light_001.csv", "light_002.csv", ...
std::string next_of_sequence(const fs::path& file) {
    constexpr int max_number = 99'999;
    for (int i = 1; i <= max_number; ++i) {
        const auto name = file.parent_path() /
                          fmt::format("{}_{:03}{}", file.stem().string(), i, file.extension().string());
        if (!fs::exists(name)) return name.string();
    }
    throw InputError(fmt::format("the sequence of '{}' has {} files", file.string(), max_number),
                     "choose another name");
}

observe::RowFileHeader header_of(const RecordingFile& recorded, std::uint64_t every) {
    observe::RowFileHeader out;
    for (const auto& source : recorded.sources) out.sources.push_back(source.what());
    out.every = every;
    return out;
}

/// Checks that rows of the same sources can be appended to `file`; returns its size. Leaves no file. Throws
/// InputError.
std::size_t check_same_sources(observe::RecordingFormat format, const std::string& file,
                               const observe::RowFileHeader& header) {
    observe::open_row_file(format, partial(file), header)->close();
    const std::string head = read_file(partial(file)), old = read_file(file);
    fs::remove(partial(file));
    if (!old.starts_with(head) || !old.ends_with('\n'))
        throw InputError(fmt::format("'{}' does not hold the same sources", file),
                         "record into another file, or a sequence of files");
    return old.size();
}

/// Opens partial(file) with the rows that `file` has, to append rows of the same sources. Throws InputError.
std::unique_ptr<observe::RowFile> continued(observe::RecordingFormat format, const std::string& file,
                                            const observe::RowFileHeader& header) {
    const auto size = check_same_sources(format, file, header);
    fs::copy_file(file, partial(file), fs::copy_options::overwrite_existing);
    return observe::open_row_file(format, partial(file), header, observe::RowFilePosition{0, size});
}

/// The file that a recording would write now, with what gets into it. Leaves no file. Throws InputError.
std::pair<std::string, RecordingFile> planned(const Session& s, const SamplerRequest& how) {
    if (how.sources.empty()) throw InputError("the sampler needs a source");
    const auto file = how.mode == "sequence" ? next_of_sequence(how.file) : how.file;
    if (how.mode == "new" && fs::exists(file))
        throw FileExists(fmt::format("'{}' exists", file),
                         "overwrite it, append to it, or choose another name");
    check_writable(s, file, FileKind::recording, true);
    std::vector<model::RecordingSpec> specs;
    for (const auto& source : how.sources)
        specs.push_back({{source + "=" + fs::path(file).filename().string()}, how.every});
    Diagnostics diagnostics;
    auto files = recorded_files(specs, {}, s.live.run->layout(), diagnostics);
    check_output(file, "samples.csv", diagnostics);
    throw_errors(diagnostics);
    if (files.size() != 1 || !files.front().archive.empty())
        throw InputError("a sampler writes one file", "its name ends with .csv, .npy, .h5 or .dat");
    if (const auto format = files.front().format; how.mode == "append" &&
                                                  format != observe::RecordingFormat::csv &&
                                                  format != observe::RecordingFormat::sampler)
        throw InputError("rows can be appended to a .csv or a .dat file", "record a sequence of files");
    if (how.mode == "append" && fs::exists(file))
        check_same_sources(files.front().format, file, header_of(files.front(), how.every));
    return {file, std::move(files.front())};
}

/// Begins a recording. Throws InputError.
void begin_sampling(Session& s, const SamplerRequest& how) {
    auto [file, recorded] = planned(s, how);
    const auto header = header_of(recorded, how.every);
    Sampler sampler;
    sampler.what = {how.sources, file, how.every, s.run().cycle()};
    sampler.left = how.cycles;
    if (how.cycles) sampler.what.until = s.run().cycle() + *how.cycles - 1;
    auto rows = how.mode == "append" && fs::exists(file)
                    ? continued(recorded.format, file, header)
                    : observe::open_row_file(recorded.format, partial(file), header);
    sampler.recorder.emplace(std::move(rows), std::move(recorded.sources),
                             observe::Sampling{how.every, 0, std::nullopt, false});
    s.live.sampler = std::move(sampler);
    s.pages.status_due = true;
    s.log(
        {.command = "sample", .title = "record into " + file, .scripts = of_sampling(s.live.sampler->what)});
}

json begin_sampler(Session& s, const Request& r) {
    if (s.live.sampler) throw InputError("the sampler runs already", "stop it first");
    const bool automatic = r.flag("automatic");
    // The second run would find the file of the first one.
    const std::string mode = r.has("mode") ? r.text("mode") : automatic ? "sequence" : "new";
    SamplerRequest how{r.text("file"), mode, r.texts("sources"), r.whole("every"), {}};
    if (r.has("cycles")) how.cycles = r.whole("cycles");
    if (automatic && how.mode == "new")
        throw InputError("a file for each run is one of a sequence, or it is overwritten or appended to",
                         "sequence, overwrite or append");
    if (automatic && !s.live.pace.running) {
        planned(s, how);
        s.live.waiting_sampler = std::move(how);
        s.pages.status_due = true;
        return {{"file", nullptr}};
    }
    begin_sampling(s, how);
    if (automatic) s.live.waiting_sampler = std::move(how);
    return {{"file", s.live.sampler->what.file}};
}

json stop_sampler(Session& s, const Request&) {
    if (!s.live.sampler && !s.live.waiting_sampler) throw InputError("the sampler does not run");
    json out = {{"file", nullptr}, {"rows", 0}};
    if (s.live.sampler) out = {{"file", s.live.sampler->what.file}, {"rows", s.live.sampler->rows}};
    s.live.waiting_sampler.reset(), s.pages.status_due = true;
    if (const auto failed = s.close_sampler(); !failed.empty()) throw InputError(failed);
    return out;
}

}  // namespace

void begin_waiting_sampler(Session& s) {
    if (!s.live.waiting_sampler || s.live.sampler || s.live.sampled) return;
    begin_sampling(s, *s.live.waiting_sampler);
    s.live.sampled = true;
}

std::vector<Command> sampling_commands() {
    return {
        {.name = "sample",
         .doc = "Records into a file (`.csv`, `.dat`, `.npy`, `.h5`). `append` needs a `.csv` or `.dat` with "
                "the same sources; `sequence` writes `NAME_001.csv`, ...",
         .arguments = {{"file", path()},
                       {"sources", texts()},
                       optional("every", whole(1, 1'000'000), 1),
                       optional("cycles", whole(1, 1'000'000'000'000), nullptr,
                                "by default until it is stopped"),
                       optional("mode", choice({"new", "overwrite", "append", "sequence"}), nullptr,
                                "by default `new`, with `automatic` `sequence`"),
                       optional(
                           "automatic", boolean(), false,
                           "begins with the next cycle after each `stop` and ends with it; its `mode` is not "
                           "`new`")},
         .result = "{ file: string | null }",
         .apply = begin_sampler},
        {.name = "sample_stop",
         .doc = "Ends the recording, and an automatic one.",
         .result = "{ file: string | null; rows: number }",
         .apply = stop_sampler},
    };
}

}  // namespace forage::studio
