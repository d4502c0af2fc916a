// The files of `forage new`, as tools/forage/templates has them.
#pragma once

#include <string>

namespace forage::tool {

/// The text of templates/`name`.in, with @NAME@, @CLASS@ and @TYPE@ to be filled in.
std::string template_text(const std::string& name);

}  // namespace forage::tool
