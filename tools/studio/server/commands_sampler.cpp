#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/observe/row_file.h"
#include "core/run/recordings.h"
#include "tools/studio/server/command_functions.h"

namespace forage::studio {

json Commands::sample() {
    if (s.sampler_) throw InputError("the sampler runs already", "stop it first");
    const auto file = c.at("file").get<std::string>();
    const auto sources = c.at("sources").get<std::vector<std::string>>();
    if (sources.empty()) throw InputError("the sampler needs a source");
    if (!c.value("overwrite", false) && std::filesystem::exists(file))
        throw InputError(fmt::format("'{}' exists", file), "overwrite it, or choose another name");
    const auto every = whole(c, "every", 1, 1, 1'000'000);
    std::vector<model::RecordingSpec> specs;
    for (const auto& source : sources)
        specs.push_back({{source + "=" + std::filesystem::path(file).filename().string()}, every});
    Diagnostics diagnostics;
    auto files = recorded_files(specs, {}, run().layout(), diagnostics);
    check_output(file, "samples.csv", diagnostics);
    throw_errors(diagnostics);
    if (files.size() != 1 || !files.front().archive.empty())
        throw InputError("a sampler writes one file", "its name ends with .csv, .npy, .h5 or .dat");
    observe::RowFileHeader header;
    for (const auto& source : files.front().sources) header.sources.push_back(source.what());
    header.every = every;
    Session::Sampler sampler;
    sampler.file = file, sampler.every = every;
    if (const auto cycles = whole(c, "cycles", 0, 1, 1'000'000'000'000)) sampler.left = cycles;
    sampler.recorder.emplace(observe::open_row_file(files.front().format, partial(file), header),
                             std::move(files.front().sources),
                             observe::Sampling{every, 0, std::nullopt, false});
    s.sampler_ = std::move(sampler);
    s.status_due_ = true;
    return {{"file", file}};
}

json Commands::sample_stop() {
    if (!s.sampler_) throw InputError("the sampler does not run");
    const json out = {{"file", s.sampler_->file}, {"rows", s.sampler_->rows}};
    s.close_sampler();
    return out;
}

}  // namespace forage::studio
