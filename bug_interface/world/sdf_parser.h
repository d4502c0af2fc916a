// SDF files become element trees, and what the library says about them becomes plain words.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <sdf/sdf.hh>

#include "core/model/diagnostic.h"

namespace forage::bug {

/// Parses SDF files, converted to the library's version of the format. Elements that are not there have their
/// defaults only where the format requires them.
///
/// An <include> stays an element of its own. The library could resolve it, but copies its whole schema for
/// every one (about 10 ms), and would hide where the include stands.
class SdfParser {
  public:
    explicit SdfParser(Diagnostics& diagnostics);

    /// What stands in the root element of file `path`, in file order. When it cannot be read `diagnostics`
    /// have more errors than before. An unknown element is a warning.
    std::vector<sdf::ElementPtr> parse(const std::string& path);

    /// The file that the model.config in `folder` names for this version of the format; may be empty.
    static std::string model_file(const std::string& folder);

    /// `element`: what stands at that line, for the column.
    Location at(const std::string& file, int line, const std::string& element = {});
    Location at(const sdf::ElementPtr& element);

  private:
    bool safe(const std::string& path);
    bool known_version(const std::shared_ptr<const SourceFile>& file, const std::string& root);
    void settle(const sdf::ElementPtr& element, const std::string& path);
    void check_numbers(const std::string& path, const std::vector<sdf::ElementPtr>& elements);
    void report(const std::string& path, const sdf::Errors& errors, const std::string& console, bool good);
    void report_unknown(const Location& where, const std::string& message);
    void report_reason(const Location& where, const std::string& element, std::string_view reason);
    std::vector<std::string> children_of(const std::string& element) const;

    Diagnostics& diagnostics_;
    sdf::SDFPtr document_;  ///< holds the schema, and one file at a time
    std::map<std::string, std::shared_ptr<const SourceFile>> files_;
};

}  // namespace forage::bug
