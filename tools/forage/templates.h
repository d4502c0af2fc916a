// The files that `forage new` writes, from tools/forage/templates.
#pragma once

#include <string>

namespace forage::tool {

/// The text of the template `name`.in, in which @NAME@, @CLASS@ and @TYPE@ are not replaced yet.
std::string template_text(const std::string& name);

}  // namespace forage::tool
