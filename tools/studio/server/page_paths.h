// Which files pages may read and write: docs/design/studio-protocol.md, "Files". Every path that a page names
// goes through here.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "core/base/diagnostic.h"
#include "core/model/system.h"

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

/// Reports modules of a system that name a file or device of another kind than theirs. Returns whether there
/// are none.
bool check_module_files(const model::System& system, Diagnostics& diagnostics);
/// Throws InputError when a parameter of a type of modules names such a file or device.
void check_module_file(const std::string& type, const std::string& parameter, const std::string& path);

/// Whether a message about a file may name what is in it: not when the file is on the disk, and of no kind
/// that Forage reads.
bool may_quote(const SourceFile& file);

}  // namespace forage::studio
