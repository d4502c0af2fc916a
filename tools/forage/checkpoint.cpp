#include "tools/forage/checkpoint.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "tools/forage/checkpoint_file.h"
#include "tools/forage/files.h"

namespace forage::tool {

Checkpoints::Checkpoints(const RunOptions& o, const Sources& sources, const Running& running)
    : directory_(o.directory) {
    const auto& wanted = o.checkpoint_every;
    if (!wanted) return;
    const double cycles = wanted->in_seconds ? wanted->amount / running.seconds_per_cycle : wanted->amount;
    every_ = static_cast<std::uint64_t>(std::max(1.0, std::round(std::min(cycles, 1e15))));
    origin_ = {FORAGE_VERSION,          o.arguments, std::filesystem::current_path().string(),
               input_files(o, sources), {},          0};
    for (const auto& path : module_files(running.loaded, running.schedule)) module_files_.push_back({path});
    written();
}

bool Checkpoints::written() {
    bool out = false;
    for (auto& f : module_files_) {
        std::error_code none;  // one that is not there has the earliest time
        const auto time = std::filesystem::last_write_time(f.path, none);
        out |= time != f.time;
        f.time = time;
    }
    return out;
}

void Checkpoints::write(Running& running) {
    Archive archive;
    origin_.cycle = running.simulation.cycle();
    for (const auto& f : module_files_) origin_.module_files[f.path] = file_digest(f.path);
    archive(origin_, running);
    write_checkpoint(directory_, archive.bytes());
}

void check_checkpoints(const RunOptions& o, const engine::Layout& layout, Diagnostics& diagnostics) {
    if (!o.checkpoint_every && !o.hash) return;
    if (o.checkpoint_every && o.directory.empty())
        diagnostics.error({}, "--checkpoint-every needs a directory to write to",
                          "leave out -o '' or name one");
    for (const auto& m : layout.modules)
        if (!m.type.checkpoints)
            diagnostics.error(
                {},
                fmt::format("{}: the module type '{}' of process '{}' does not say what it "
                            "keeps beside its parameters",
                            o.checkpoint_every ? "--checkpoint-every" : "--hash", m.type.name, m.process),
                "give the type a member 'void checkpoint(forage::Archive& archive)' that lists its members");
}

std::string state_digest(Running& running) {
    Archive archive(Archive::Nan::all_the_same);
    archive(running.simulation);
    if (running.loaded.world) archive(*running.loaded.world);
    return digest(archive.bytes());
}

}  // namespace forage::tool
