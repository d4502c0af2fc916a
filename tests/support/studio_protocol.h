// Compares what the studio's server sends with the types of its page.
#pragma once

#include "core/base/text_file.h"
#include "tests/support/catch.h"
#include "tests/support/typescript.h"
#include "tools/studio/server/commands/command.h"

namespace forage::test {

inline const TypeScript& page_types() {
    static const TypeScript types(read_file(FORAGE_SOURCE_DIR "/tools/studio/web/src/protocol/messages.ts"));
    return types;
}

inline void check_message(const nlohmann::json& message) {
    INFO(message.dump().substr(0, 2000));
    CHECK(page_types().mismatch(message, "ServerMessage") == "");
}

inline void check_reply(const nlohmann::json& command, const nlohmann::json& reply) {
    if (reply["ok"] != true) return;
    INFO(command.dump().substr(0, 200) << " " << reply.dump().substr(0, 2000));
    const auto& type = studio::find_command(command["command"].get<std::string>()).result;
    CHECK(page_types().mismatch(reply["result"], type) == "");
}

}  // namespace forage::test
