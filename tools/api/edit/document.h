// A system file that is edited: its text, and the system that it says.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/archive.h"
#include "core/model/system.h"
#include "core/run/input_error.h"
#include "core/types/registry.h"
#include "core/xml/source_tree.h"

namespace forage {

/// The text of a system file in the hands of an editor. The text stays its author's: an edit replaces what
/// differs and leaves comments, order, blanks and spellings of everything else (core/xml/patch.h).
class Document {
  public:
    /// What is wrong, with the process, group or connection in which it is; empty for none of them.
    struct Problem {
        Diagnostic diagnostic;
        std::string item;
    };
    using Edit = std::function<void(model::System&)>;

    Document() = default;  ///< only to read a checkpoint into it
    /// Reads the file `path`. Throws InputError when its text has no system; other mistakes are problems.
    static Document open(const std::string& path, bool lenient = false);
    /// Reads the file `path`, whatever its text is: a text without a system is a problem that can be
    /// corrected. Throws InputError when the file cannot be read.
    static Document open_text(const std::string& path, bool lenient = false);
    /// A text that has not been saved, of a file that `path` names, or of none when it is empty. Throws
    /// InputError.
    static Document unsaved(std::string path, std::string text, bool lenient = false);
    /// A system without content, or with that of a text under another name; it has no file yet. Throws
    /// InputError.
    static Document create(const std::string& name, const std::string& content = {});

    const std::string& path() const { return path_; }  ///< empty before the first save
    const std::string& text() const { return text_; }
    /// Whether the text has a system. When it has none, system() is the last one that it had, or one without
    /// content.
    bool readable() const { return readable_; }
    const model::System& system() const { return system_; }
    /// What the reader said of the text.
    const Diagnostics& reading() const { return diagnostics_; }
    const model::System& saved_system() const {
        return saved_system_;
    }                                               ///< that of the file, as last read or saved
    bool dirty() const { return text_ != saved_; }  ///< whether the text differs from the file's

    /// Everything that is wrong with the system, as `forage check` finds it before it compiles connections.
    /// Modules check themselves against `environment`, which may be null.
    std::vector<Problem> problems(const Registry& registry, Environment* environment = nullptr) const;
    /// Names the items of diagnostics about this text.
    std::vector<Problem> located(const Diagnostics& diagnostics) const;

    /// Changes the system. This and the next three functions return whether the text has changed. Throws what
    /// `edit` throws, and InputError when the text or the result cannot be read; the document then stays.
    bool edit(const Edit& edit);
    /// Replaces the whole text. Throws InputError when the text has no system.
    bool replace_text(std::string text);
    /// Replaces the whole text by one that may have no system.
    bool write_text(std::string text);
    /// The text of the element of an item; of the whole system for its id. Throws InputError.
    std::string item_text(std::string_view id) const;
    /// Replaces the text of the element of an item.
    bool replace_item_text(std::string_view id, const std::string& text);
    /// What would be wrong if the element of an item had this text, apart from what is wrong elsewhere
    /// already. Lines and columns are those of `text`; a mistake elsewhere has no place. Throws InputError.
    Diagnostics check_item_text(std::string_view id, const std::string& text, const Registry& registry,
                                Environment* environment = nullptr) const;

    /// Writes the file, and makes `path` its name unless it is empty: links and names of files in the system
    /// then stay valid, also in `earlier` texts of the document. Throws InputError when the file has changed
    /// outside, or exists under a new name, unless `overwrite` is set, and std::runtime_error when it cannot
    /// be written.
    void save(const std::string& path, const Registry& registry, bool overwrite = false,
              const std::vector<std::string*>& earlier = {});
    /// Whether the file is not what it was when it was read or saved.
    bool changed_outside() const;

    enum class Keep { mine, theirs, merge };
    /// Continues after a change outside: with this text, with that of the file, or with the file's text and
    /// the changes of this document in it. Returns whether the text has changed. Throws InputError when texts
    /// without a system should be merged, or when both have changed the same thing.
    bool reload(Keep keep);

    /// The changes since the last save, as `diff -u` prints them.
    std::string difference() const;

    /// Writes or reads everything, for the case that the program is killed. The file is not read again:
    /// whether it has changed since is found later.
    void checkpoint(Archive& archive);

  private:
    enum class Accept { system, any };
    /// Makes `text` the text. Throws InputError when it has no system, unless any text is accepted.
    void read(std::string text, Accept accept = Accept::system);
    /// Makes another text the text. Returns whether it was another one.
    bool replace(std::string text, Accept accept);
    xml::Span place_of(std::string_view id) const;  ///< of an item's element; throws InputError

    std::string path_, text_, saved_;
    bool lenient_ = false, readable_ = true;
    struct Stamp {
        std::filesystem::file_time_type time = {};
        std::uintmax_t size = 0;
        friend bool operator==(const Stamp&, const Stamp&) = default;
    };
    static Stamp stamp_of(const std::string& path);
    mutable Stamp stamp_;  ///< of the file, when it was what `saved_` is
    model::System system_, saved_system_;
    Diagnostics diagnostics_;  ///< of the reader
};

}  // namespace forage
