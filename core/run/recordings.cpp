#include "core/run/recordings.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/base/separated.h"
#include "core/observe/zip_file.h"

namespace forage {
namespace {

using observe::RecordingFormat;

struct FormatName {
    std::string_view name;
    RecordingFormat format;
    bool archive;  ///< several .npy files in one
};
constexpr std::array<FormatName, 5> formats = {{{"csv", RecordingFormat::csv, false},
                                                {"npy", RecordingFormat::npy, false},
                                                {"npz", RecordingFormat::npy, true},
                                                {"h5", RecordingFormat::hdf5, false},
                                                {"dat", RecordingFormat::sampler, false}}};

/// The format that belongs to the ending of a file's name; null when there is none.
const FormatName* format_of(std::string_view file) {
    for (const auto& f : formats)
        if (file.size() > f.name.size() + 1 && file.ends_with(f.name) &&
            file[file.size() - f.name.size() - 1] == '.')
            return &f;
    return nullptr;
}

/// Splits "Process/Group=file.h5" into the source and the file, which is empty when none is named.
std::pair<std::string, std::string> take_apart(const std::string& text) {
    const auto equals = text.rfind('=');
    if (equals == std::string::npos || !format_of(text.substr(equals + 1))) return {text, {}};
    return {text.substr(0, equals), text.substr(equals + 1)};
}

/// The sources for which "*" and "Process/*" stand, with or without a state: those of all groups that have
/// it. Any other text stands for itself.
std::vector<std::string> groups_of(const std::string& text, const engine::Layout& layout) {
    const auto star = text.find('*');
    const std::string process = text.substr(0, star == std::string::npos ? 0 : star);
    if (star == std::string::npos || !(process.empty() || process.ends_with('/'))) return {text};
    const std::string state = text.substr(star + 1);
    if (!(state.empty() || state.starts_with(':'))) return {text};
    std::vector<std::string> out;
    for (const auto& g : layout.groups) {
        const auto& states = g.type.states;
        const bool has =
            state.empty() || state.ends_with("In") ||
            std::ranges::any_of(states, [&](const auto& s) { return s.name == state.substr(1); });
        if (g.path.starts_with(process) && has) out.push_back("#" + g.id + state);
    }
    return out.empty() ? std::vector{text} : out;  // which is then reported as unknown
}

/// Whether "Process/Group=light" names a source, and then a file of no format.
bool names_no_format(const std::string& text, const engine::Layout& layout) {
    const auto equals = text.rfind('=');
    if (equals == std::string::npos) return false;
    Diagnostics unused;
    const auto names_source = [&](const std::string& part) {
        return observe::find_source(layout, groups_of(part, layout).front(), "", unused).has_value();
    };
    return !names_source(text) && names_source(text.substr(0, equals));
}

/// Extracts an array of an .npz file.
void extract(const std::string& archive, const std::string& array, const std::string& to) {
    const observe::ZipFile zip(archive);
    const auto found = std::ranges::find(zip.entries(), array + ".npy", &observe::ZipFile::Entry::name);
    if (found == zip.entries().end())
        throw std::runtime_error(fmt::format("'{}' has no array '{}'", archive, array));
    zip.extract(*found, to);
}

}  // namespace

std::vector<RecordingFile> recorded_files(const std::vector<model::RecordingSpec>& recordings,
                                          const RecordOptions& options, const engine::Layout& layout,
                                          Diagnostics& diagnostics) {
    std::vector<RecordingFile> out;
    const auto find = [&](const std::string& name) {
        return std::ranges::find(out, name, &RecordingFile::name);
    };
    std::set<std::string> seen;
    for (const auto& asked : recordings) {
        const std::string& whole = asked.column.text;
        const std::string option = asked.column.at.file ? "record" : "--record";
        const auto [text, file] = take_apart(whole);
        if (file != file_name(file)) {
            diagnostics.error(asked.column.at,
                              fmt::format("{} \'{}\': '{}' is not a plain file name", option, whole, file),
                              "-o chooses the directory; names have letters, digits, '.', '-' and '_'");
            continue;
        }
        if (file.empty() && names_no_format(whole, layout)) {
            diagnostics.error(
                asked.column.at,
                fmt::format("{} '{}': '{}' is not the name of a recording", option, whole,
                            whole.substr(whole.rfind('=') + 1)),
                "behind '=', write a file that ends in .csv, .npy, .npz, .h5 or .dat; a state is written "
                "'Process/Group:state'");
            continue;
        }
        for (const auto& one : groups_of(text, layout)) {
            auto source = observe::find_source(layout, one, option, diagnostics, asked.column.at);
            if (!source) continue;
            const observe::Recorded& what = source->what();
            if (!seen.insert(file + "\n" + what.name + "\n" + what.group_id).second) continue;  // duplicate
            const FormatName& format = *format_of(
                file.empty() ? "x." + (asked.format.empty() ? options.format : asked.format) : file);
            const bool several = observe::holds_several(format.format);
            std::string stem = file_name(what.name), archive;
            if (format.archive) archive = file.empty() ? "recording.npz" : file;
            std::string name =
                fmt::format("{}.{}", several ? "recording" : stem, format.archive ? "npy" : format.name);
            if (!file.empty() && !format.archive) name = file;
            auto at = find(name);
            if (at != out.end() && !several && file.empty()) {  // two groups have the same name
                name = fmt::format("{}_{}.{}", stem, file_name(what.group_id),
                                   format.archive ? "npy" : format.name);
                at = find(name);
            }
            if (at == out.end()) {
                out.push_back({name, format.format, {}, asked.every, archive});
                at = out.end() - 1;
            } else if (!several) {
                diagnostics.error(
                    asked.column.at,
                    fmt::format("{} \'{}\': a .{} file holds one source", option, whole, format.name),
                    "name another file, or one that ends in .npz, .h5 or .dat");
                continue;
            }
            if (at->every != asked.every) {
                diagnostics.error(asked.column.at,
                                  fmt::format("{} '{}': '{}' has a row every {} cycles, not every {}", option,
                                              whole, name, at->every, asked.every),
                                  "name another file for it");
                continue;
            }
            at->sources.push_back(std::move(*source));
        }
    }
    return out;
}

Recordings::Recordings(std::vector<RecordingFile> files, const RecordOptions& options,
                       const std::string& directory,
                       const std::vector<std::pair<std::string, std::string>>& attributes)
    : options_(options), directory_(directory) {
    for (auto& f : files) {
        observe::RowFileHeader header{{}, f.every, attributes};
        for (const auto& s : f.sources) {
            header.sources.push_back(s.what());
            entries_.push_back(
                {f.archive.empty() ? f.name : f.archive, s.what().name, s.what().label, s.what().names});
        }
        std::string path = directory + "/" + f.name;
        all_.push_back({std::move(f), std::move(path), std::move(header), std::nullopt});
    }
}

void Recordings::open(File& f, const std::optional<observe::RowFilePosition>& go_on) {
    f.recorder.emplace(observe::open_row_file(f.file.format, partial(f.path), f.header, go_on),
                       f.file.sources,
                       observe::Sampling{f.file.every, options_.from, options_.until, options_.mean});
}

void Recordings::begin_files(ResultFiles&) {
    try {
        for (auto& f : all_) open(f, std::nullopt);
    } catch (...) {
        for (const auto& f : all_)
            if (f.recorder) std::remove(partial(f.path).c_str());
        throw;
    }
}

/// Renames a file that was finished, because the run was stopped by a signal, to the name of a growing file
/// again.
void Recordings::reopen(const File& f) const {
    namespace fs = std::filesystem;
    if (fs::exists(partial(f.path))) return;
    const std::string archive = directory_ + "/" + f.file.archive;
    if (!f.file.archive.empty() && fs::exists(archive)) {
        const std::string unpacked =
            partial(f.path + ".unpacked");  // a kill during the unpacking would leave an incomplete file
        extract(archive, f.header.sources.front().name, unpacked);
        fs::rename(unpacked, partial(f.path));
    } else if (fs::exists(f.path)) {
        fs::rename(f.path, partial(f.path));
    } else {
        throw observe::ShortFile(fmt::format("the recording '{}' is not there", f.path));
    }
}

void Recordings::checkpoint(Archive& archive) {
    archive.same(all_.size(), "the number of recordings");
    archive(paused_);
    std::vector<observe::RowFilePosition> positions;
    for (auto& f : all_) {
        archive.same(f.path.substr(directory_.size()), "a recording");
        auto& position = positions.emplace_back();
        if (!archive.loading()) position = f.recorder->flush();
        archive(position);
        if (!archive.loading()) flush_to_disk(partial(f.path));
    }
    if (archive.loading()) {
        for (const auto& f : all_) reopen(f);  // checks that all exist before one is changed
        for (std::size_t i = 0; i < all_.size(); ++i) open(all_[i], positions[i]);
    }
    for (auto& f : all_) archive(*f.recorder);
}

void Recordings::finish(RunView& run, ResultFiles& files) {
    std::vector<std::string> empty;
    const auto complete = [&](const File& f) { forage::finish(f.path), files.add(f.file.name); };
    std::map<std::string, std::vector<std::pair<std::string, std::string>>> archives;
    for (auto& f : all_) {
        const auto first = options_.from + (options_.mean ? f.file.every - 1 : 0);  // when a row is complete
        if (first >= run.time.cycle || (options_.until && first > *options_.until))
            for (const auto& s : f.file.sources) empty.push_back(s.what().name);
        files.attempt([&] { f.recorder->close(); });
        // Its rows are complete in any case.
        if (f.file.archive.empty())
            files.attempt([&] { complete(f); });
        else
            archives[f.file.archive].emplace_back(f.header.sources.front().name, partial(f.path));
    }
    for (const auto& [name, arrays] : archives)
        files.attempt([&, &name = name, &arrays = arrays] {
            std::vector<observe::ZipEntry> entries;
            for (const auto& [array, file] : arrays) entries.push_back({array + ".npy", file});
            try {  // without compression, so that the numbers can be mapped
                observe::write_zip(directory_ + "/" + name, entries, false);
            } catch (const std::exception& e) {  // the disk may be full, and the arrays are complete
                for (const auto& f : all_)
                    if (f.file.archive == name) complete(f);
                throw std::runtime_error(fmt::format("{}; its arrays are in files of their own, such as '{}'",
                                                     e.what(), arrays.front().first));
            }
            for (const auto& [array, file] : arrays) std::remove(file.c_str());
            files.add(name);
        });
    const auto written = files.names();
    for (const auto& e : entries_)
        if (std::ranges::find(written, e.file) != written.end()) files.add_recording(e);
    if (empty.empty()) return;
    files.warn(
        fmt::format("no row was recorded of '{}': the run had {} cycles", separated(empty, "', '"),
                    run.time.cycle),
        options_.until && *options_.until < options_.from
            ? fmt::format("--record-until {} is before --record-from {}", *options_.until, options_.from)
        : options_.from >= run.time.cycle
            ? fmt::format("the recording would begin in cycle {}: choose a smaller --record-from, or a "
                          "longer run",
                          options_.from)
            : "a mean needs all cycles of --record-every");
}

std::vector<std::string> Recordings::file_names() const {
    std::vector<std::string> out;
    for (const auto& e : entries_)
        if (std::ranges::find(out, e.file) == out.end()) out.push_back(e.file);
    return out;
}

}  // namespace forage
