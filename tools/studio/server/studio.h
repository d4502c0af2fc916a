// The studio: a session and the server that shows it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/base/diagnostic.h"
#include "core/run/run_spec.h"

namespace forage::studio {

struct StudioOptions {
    RunInput input;
    std::uint16_t port = 0;   ///< 0: a free one
    std::string plot_config;  ///< a layout that pages begin with (.layout.json); may be empty
    bool recover = false;     ///< whether to continue the session that was killed
    bool running = false;     ///< whether the run begins at once
    bool ticket = false;      ///< whether the studio also has an address that opens one page once
    std::string shipped;      ///< the folder of the systems that come with Forage; may be empty
};

/// A studio whose pages can be opened.
struct Ready {
    std::string address;
    std::string once;      ///< an address that opens one page; may be empty
    std::string note;      ///< a session that was killed, or why nothing is kept of this one; may be empty
    Diagnostics mistakes;  ///< those of a system that must be corrected before it runs; else empty
};

/// Opens the system and serves it until `interrupted` returns true, which is called ten times a second. Calls
/// `ready` when pages can be opened. A system file with mistakes is opened, too. Throws InputError and
/// std::runtime_error.
void serve(const StudioOptions& options, const std::function<void(const Ready&)>& ready,
           const std::function<bool()>& interrupted);

}  // namespace forage::studio
