// Which files pages may read and write: docs/design/studio-protocol.md, "Files". Every path that a page names
// is checked here: in commands, in operations, and in the system that runs after them.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "core/base/diagnostic.h"
#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::studio {

class Session;

/// What a file is by its content.
enum class FileKind {
    system,
    process,
    world,
    plots,
    panel,
    parameters,
    layout,
    patterns,  ///< nothing but numbers
    table,     ///< of moduleReplay
    numbers,   ///< weights and initial values
    recording,
    camera,  ///< no file has its content
    gamepad  ///< its recorded events
};

/// Whether a text, of which the end may be missing, has the content of a kind. An empty one has that of every
/// kind.
bool is_of_kind(std::string_view text, FileKind kind);

/// Throws InputError unless the file is a regular one whose content is of one of these kinds. The message has
/// nothing of the content. A file that cannot be opened is left to its reader.
void check_readable(const std::string& path, std::initializer_list<FileKind> kinds);

/// Throws InputError when there is something else at a path than a regular file of this kind, or a file that
/// comes with Forage.
void check_replaceable(const Session& session, const std::string& path, FileKind kind);

/// Throws InputError unless a file of this kind may be written: the name has an ending of the kind, the
/// folder exists, and what is there is replaceable. Throws FileExists when there is a file that is not to be
/// overwritten.
void check_writable(const Session& session, const std::string& path, FileKind kind, bool overwrite);

/// The path of a system or a world that comes with Forage. Throws InputError for a name that leads elsewhere.
std::string shipped_path(const Session& session, const std::string& name);

/// Reports the files and devices that a system names and that a page may not name: its modules, weights and
/// initial values have files of their kinds. Returns whether there are none.
bool check_system_files(const model::System& system, const Registry& registry, Diagnostics& diagnostics);
/// Throws InputError when the value of a parameter of a type names such a file or device.
void check_parameter_file(const std::string& type, const Parameter& parameter, const std::string& path);
/// Throws InputError for a path in operations on a system that pages may not read, or write for operations
/// that may overwrite a file. All these files are processes.
void check_operation_files(const Session& session, const nlohmann::json& operations);

/// Whether a message about a file may name what is in it: not when the file is on the disk, and of no kind
/// that Forage reads.
bool may_quote(const SourceFile& file);

}  // namespace forage::studio
