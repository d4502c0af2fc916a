// Which comment of a document belongs to what.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace tinyxml2 {
class XMLElement;
class XMLNode;
}  // namespace tinyxml2

namespace forage::xml {

/// A comment belongs to the process, group or connection that it stands before; elsewhere, to the one that it
/// stands in, or to the file's root.
class Comments {
  public:
    explicit Comments(const tinyxml2::XMLElement& root);
    /// The comments that belong to a process, group, connection or the root, in file order.
    std::vector<std::string> of(const tinyxml2::XMLElement& element) const;

  private:
    void collect(const tinyxml2::XMLNode& parent, const tinyxml2::XMLElement& owner);

    std::map<const tinyxml2::XMLElement*, std::vector<std::string>> by_owner_;
};

}  // namespace forage::xml
