// Datagrams of remote control, and the endpoints of command lines.
#include <cstdint>

#include "core/run/remote_command.h"
#include "core/run/udp_socket.h"
#include "tests/fuzz/holds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using forage::test::holds;
    const std::string text(reinterpret_cast<const char*>(data), size);
    std::string problem;
    const auto command = forage::parse_remote_command(text, problem);
    holds(command.has_value() == problem.empty(), "a command, or a reason");
    holds(std::none_of(problem.begin(), problem.end(), [](char c) { return c >= 0 && c < ' '; }),
          "no control characters reach the terminal");
    if (command) {
        holds(size <= forage::longest_remote_command + 3 || text.back() < ' ', "a command is short");
        const bool about_item = command->kind == forage::RemoteCommand::Kind::set_parameter ||
                                command->kind == forage::RemoteCommand::Kind::plot;
        holds(about_item != command->name.empty(), "a command about an item names it");
    }
    if (const auto endpoint = forage::parse_endpoint(text)) {
        const auto again = forage::parse_endpoint(endpoint->text());
        holds(again && again->port == endpoint->port && again->host == endpoint->host,
              "an endpoint is stable");
    }
    return 0;
}
