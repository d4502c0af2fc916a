#include "core/run/checkpoint_writer.h"

#include <fmt/format.h>

#include "core/run/checkpoint_file.h"
#include "core/run/run.h"

namespace forage {

CheckpointWriter::CheckpointWriter(std::string directory, std::uint64_t every, CheckpointOrigin origin,
                                   const std::vector<std::string>& module_files)
    : directory_(std::move(directory)), every_(every), origin_(std::move(origin)) {
    for (const auto& path : module_files) module_files_.push_back({path});
    module_file_changed();
}

bool CheckpointWriter::module_file_changed() {
    bool out = false;
    for (auto& f : module_files_) {
        std::error_code none;  // a missing file has the earliest time
        const auto time = std::filesystem::last_write_time(f.path, none);
        out |= time != f.time;
        f.time = time;
    }
    return out;
}

void CheckpointWriter::after_cycle(RunView& run) {
    if (run.time.cycle % every_ == 0 || module_file_changed()) write(run.run);
}

void CheckpointWriter::write(Run& run) {
    Archive archive;
    origin_.cycle = run.cycle();
    for (const auto& f : module_files_) origin_.module_files[f.path] = file_digest(f.path);
    archive(origin_, run);
    write_checkpoint(directory_, archive.bytes());
}

void check_checkpoints(const engine::Layout& layout, const std::string& option, Diagnostics& diagnostics) {
    for (const auto& m : layout.modules)
        if (!m.type.checkpoints)
            diagnostics.error({},
                              fmt::format("{}: the module type '{}' of process '{}' does not say what it "
                                          "keeps beside its parameters",
                                          option, m.type.name, m.process),
                              "give the type a member 'void checkpoint(forage::Archive& archive)' that lists "
                              "the members that start() does not restore");
}

}  // namespace forage
