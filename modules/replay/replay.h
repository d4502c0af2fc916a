// moduleReplay: plays a table into groups, so that a system can be driven by recorded data.
#pragma once

#include <string>

#include "core/base/drive_table.h"
#include "core/types/module.h"

namespace forage::replay {

/// Whether a row is played into an output of the module of process `process`.
bool plays(const DriveTable::Row& row, std::string_view process, const ModulePorts::Group& output);

/// The module accepts any cross references. In cycle t it writes the row of cycle t into the output that the
/// row names (by cross reference or group), so the group receives it in cycle t + 1; a row of cycle -1 is
/// received in cycle 0. Outputs keep the values of their last row.
struct Replay {
    std::string file;

    static void describe(ModuleSpec<Replay>& s) {
        s.name("moduleReplay", "Replay").doc("Plays the rows of a table into its output groups.").any_ports();
        s.param("file", &Replay::file)
            .label("File")
            .path()
            .at_start()
            .doc("Table of rows cycle,process,target,v0,v1,...");
    }
    void check(const ModulePorts& ports, Diagnostics& diagnostics);
    void start(const ModulePorts& ports, ModuleFrame& frame);
    void update(ModuleFrame& frame);
    void checkpoint(Archive& archive) {
        for (auto& c : cursors_) archive(c.next);
    }

  private:
    struct Cursor {
        std::vector<const DriveTable::Row*> rows;  ///< the rows of one output, in order
        std::size_t next = 0;
    };
    void play(std::int64_t until, ModuleFrame& frame);

    DriveTable table_;
    std::vector<Cursor> cursors_;  ///< one per output
};

}  // namespace forage::replay
