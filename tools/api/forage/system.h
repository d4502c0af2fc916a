// Systems as values inside another program: read, built, edited, checked, drawn, saved and opened.
//
//     forage::SystemFile file = forage::read_system("dac_foraging.iqr");
//     forage::model::find_group(file.model, "light")->name = "Lamp";
//     forage::save(file, "lamp.iqr");
//
// "core/model/build.h" and "core/model/edit.h" build and edit its model.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <forage/forage.h>

#include "core/model/build.h"
#include "core/model/constants.h"
#include "core/model/edit.h"
#include "core/model/lookup.h"

namespace forage {

/// A system, the types that it may use, and its file, which need not exist.
struct SystemFile {
    model::System model;
    std::string path;                  ///< relative paths in the system start at the folder of this file
    std::vector<std::string> plugins;  ///< shared objects with types, and folders of them, as in OpenOptions
    std::shared_ptr<const Registry> types;
};

/// A new system without content. Throws InputError for mistakes in the plugins.
SystemFile new_system(const std::string& name, std::vector<std::string> plugins = {});
/// Reads a system file (.iqr), with the content of linked processes. Throws InputError. With `lenient`,
/// mistakes that the original accepts are warnings, which are added to `warnings`, if it is not null.
SystemFile read_system(const std::string& path, std::vector<std::string> plugins = {}, bool lenient = false,
                       Diagnostics* warnings = nullptr);
/// Reads a text as read_system() reads the file `path`.
SystemFile parse_system(const std::string& text, const std::string& path,
                        std::vector<std::string> plugins = {}, Diagnostics* warnings = nullptr);

/// Declares a neuron or synapse type in the system (docs/reference/system-file.md#types). Throws InputError
/// for what is wrong with it, and then changes nothing.
void declare_neuron_type(SystemFile& file, model::TypeDeclaration type);
void declare_synapse_type(SystemFile& file, model::TypeDeclaration type);
/// The C++ source of a plugin that computes what a type declared in the system does, to the bit. Throws
/// InputError when there is no such type, or for what plugins cannot do.
std::string plugin_source(const SystemFile& file, const std::string& type);

/// Carries out an operation of an editor or a list of them, JSON as in the command `edit` of the studio
/// (docs/design/studio-protocol.md): all of them, or none when one is refused. Returns a JSON list of what
/// each has made: an id, a list of ids, or null. What else it has changed gets into `warnings`, if it is not
/// null. Throws InputError.
std::string edit(SystemFile& file, const std::string& operations, Diagnostics* warnings = nullptr);
/// Does the same in a file, a system (.iqr) or a world (.world; the command `world_edit`), and writes it:
/// into `save_as` unless that is empty. Everything else in the file stays as its author wrote it. What is
/// wrong with a system only since the edit gets into `warnings`, if it is not null. Throws InputError and
/// then writes nothing, and std::runtime_error when the file cannot be written.
std::string edit_file(const std::string& path, const std::string& operations, const std::string& save_as = {},
                      const std::vector<std::string>& plugins = {}, Diagnostics* warnings = nullptr);

/// The text of the system's file.
std::string text_of(const SystemFile& file);
/// Writes the file `path`, which is the system's file afterwards: links and names of files in it are changed
/// so that they stay valid. With `original`, everything is written that the original requires. Throws
/// std::runtime_error when the file cannot be written.
void save(SystemFile& file, const std::string& path, bool original = false);
/// Writes a process with the connections among its groups as a process file (.iqrProcess). Throws
/// std::invalid_argument when there is no process with this id, and std::runtime_error.
void save_process(const SystemFile& file, const std::string& id, const std::string& path);
/// Adds the process in a process file under new ids, and returns its id. Throws InputError.
std::string import_process(SystemFile& file, const std::string& path);

/// Compiles the whole system as it would be read from its file, in a world if `world` is not empty: all
/// checks of `forage check`. Empty when `diagnostics` got an error.
std::optional<engine::Simulation> compile(const SystemFile& file, const std::string& world,
                                          std::uint64_t seed, Diagnostics& diagnostics);
/// Opens the system as if it were read from its file: messages have the places in text_of(). Throws
/// InputError.
Run open(const SystemFile& file, const OpenOptions& options = {}, Diagnostics* warnings = nullptr);

/// The diagram that `forage plot` draws, of the system or of one process, as the content of a file in a
/// format that is png, svg or pdf. Throws InputError.
std::string diagram(const SystemFile& file, const std::string& process = {},
                    const std::string& format = "png");

/// The description that `forage describe` prints: "text"; for papers "markdown" or "latex" (tables) and "dot"
/// (a graph for Graphviz); for programs "json". Throws InputError for mistakes in the system, and
/// std::invalid_argument for another format.
std::string describe(const SystemFile& file, const std::string& format = "text", std::uint64_t seed = 1);

/// The synapses of a connection, in the order in which the inputs of a target are summed.
struct SynapseTable {
    std::vector<int> source, target;  ///< numbers of cells, from 0, row by row
    std::vector<double> distance;     ///< in cells
    std::vector<int> delay;           ///< in cycles
    std::vector<double> strength;     ///< the input that is delivered for an activity of 1, before learning
};
/// The synapses of the connection with this id, in runs with this seed. Throws InputError.
SynapseTable synapses(const SystemFile& file, const std::string& id, std::uint64_t seed);

}  // namespace forage
