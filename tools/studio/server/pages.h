// The pages that watch a run.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "tools/studio/server/client.h"

namespace forage::studio {

/// Sends messages and frames to pages.
struct Pages {
    /// Sends a message to a page: JSON, or a frame when `binary`.
    using Send = std::function<void(int client, bool binary, std::string data)>;

    Send send;
    std::map<int, Client> clients = {};
    SourcePool sources = {};
    nlohmann::json layout = {};  ///< that pages begin with; null for none
    nlohmann::json panels = {};  ///< the arrangement that a page had last; null for none
    bool status_due = true;
    double status_at = -1, frames_at = -1;  ///< when they were sent last

    /// The text of a message. A file with mistakes may hold anything, also what is not UTF-8.
    static std::string text(const nlohmann::json& message) {
        return message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    }
    void broadcast(const nlohmann::json& message) const {
        const auto shared = text(message);
        for (const auto& [id, client] : clients) send(id, false, shared);
    }
    /// Subscribes for all pages in a run that replaces the one before.
    void rebind(Run& run) {
        sources.clear();
        for (auto& [id, client] : clients) client.rebind(run, sources);
    }
    /// Forgets rows that pages have not fetched.
    void clear() {
        for (auto& [id, client] : clients) client.clear();
    }
};

}  // namespace forage::studio
