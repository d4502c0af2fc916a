// What types say of a use that makes no sense.
#pragma once

#include <string>
#include <vector>

namespace forage {

/// What a module finds wrong with its parameters or groups before the run; reported to the author of the
/// file.
struct Problems {
    struct Problem {
        std::string message;
        std::string hint;
        std::string parameter;  ///< the parameter to point at, if any
        std::string port;       ///< the cross reference to point at, if any; of modules
    };
    std::vector<Problem> all;
};

}  // namespace forage
