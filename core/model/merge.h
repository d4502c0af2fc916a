// Joins two changes of one system.
#pragma once

#include <string>
#include <vector>

#include "core/model/system.h"

namespace forage::model {

struct Merge {
    System system;
    std::vector<std::string> conflicts;  ///< what both have changed, in words; `system` has that of `mine`
};
/// Makes the changes from `base` to `mine` in `theirs`, which is another change of `base`. Items are known by
/// their ids. What only one of them has changed, down to single members of an item, is changed.
Merge merge(const System& base, const System& mine, const System& theirs);

}  // namespace forage::model
