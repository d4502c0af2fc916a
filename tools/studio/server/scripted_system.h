// The system of a document as the commands and the Python have made it that do the same as the studio.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "core/model/system.h"
#include "core/types/registry.h"
#include "tools/api/document.h"
#include "tools/studio/server/equivalents.h"

namespace forage::studio {

/// `forage edit` works on the text of a file, and `System.edit()` on what a System holds of it. Both begin
/// with the file as it is saved, and follow the document; parameters that were set in the run get into them
/// with the next edit, or when it is saved. What has no form, as it is too long, is part of the next form;
/// after the document was saved, forms begin with that file.
class ScriptedSystem {
  public:
    /// Without a system in the file, there are no forms before the document is saved.
    void begin(const Document& document);
    /// The forms of what has happened to the document since the last forms: `operations`, with the ids that
    /// they made, were carried out on the text `before`; none for another kind of edit. Empty when the
    /// document has no system.
    Equivalent edit(const EditedFile& file, const std::string& before, const nlohmann::json& operations,
                    const Document& now, const Registry& registry);
    /// Whether the document differs by parameters at most.
    bool has_all_but_parameters(const Document& now, const Registry& registry) const;
    /// The forms of saving the document in the file `to`.
    Equivalent save(const EditedFile& file, const Document& now, const std::string& to,
                    const Registry& registry);
    /// The document was saved, which may have changed names of files in it.
    void note_saved(const Document& saved);
    /// Whether what the forms have made is the document.
    bool follows() const { return follows_; }

  private:
    struct Operations {
        nlohmann::json in_shell = nlohmann::json::array(), in_python = nlohmann::json::array();
    };
    Operations follow(const std::string& before, const nlohmann::json& operations, const Document& now,
                      const Registry& registry);

    std::string text_;      ///< of the file; empty when it has no system
    model::System system_;  ///< of Python
    bool follows_ = false;
};

}  // namespace forage::studio
