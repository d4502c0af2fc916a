// The studio: a session and the server that shows it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/run/run_spec.h"

namespace forage::studio {

struct StudioOptions {
    RunInput input;
    std::uint16_t port = 0;   ///< 0: a free one
    std::string plot_config;  ///< a layout that pages begin with (.layout.json); may be empty
    bool recover = false;     ///< whether to go on with the session that was killed
    std::string token;        ///< empty: a random one
    std::string shipped;      ///< the folder of the systems that come with Forage; may be empty
};

/// Opens the system and serves it until `interrupted` returns true, which is called ten times a second. Calls
/// `ready` with the address, when pages can be opened, and what the user should know: a session that was
/// killed, or why nothing is kept of this one. Throws InputError and std::runtime_error.
void serve(const StudioOptions& options,
           const std::function<void(const std::string& address, const std::string& note)>& ready,
           const std::function<bool()>& interrupted);

}  // namespace forage::studio
