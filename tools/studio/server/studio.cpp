#include "tools/studio/server/studio.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include <fmt/format.h>

#include "tools/studio/server/assets.h"
#include "tools/studio/server/engine_thread.h"
#include "tools/studio/server/http_server.h"
#include "tools/studio/server/requests.h"

namespace forage::studio {

namespace {

/// Begins to keep the session, or continues the one that was killed. Returns what the user should know.
std::string keep(Session& session, bool recover) {
    try {
        session.keep();
    } catch (const std::exception& e) {
        if (recover) throw InputError(fmt::format("nothing is kept of sessions: {}", e.what()));
        return fmt::format("if this program is killed, the run is lost: {}", e.what());
    }
    if (recover) return session.recover(), "";
    if (session.killed().is_null()) return "";
    return fmt::format(
        "a session of this system was killed in cycle {}; continue it with --recover, or in the page",
        session.killed().at("cycle").get<std::uint64_t>());
}

}  // namespace

void serve(const StudioOptions& options, const std::function<void(const Ready&)>& ready,
           const std::function<bool()>& interrupted) {
    std::unique_ptr<HttpServer> server;
    Session session(
        options.input,
        [&server](int client, bool binary, std::string data) {
            server->send(client, binary, std::move(data));
        },
        options.plot_config, options.shipped);
    std::atomic<bool> quits = false;
    session.quit = [&quits] { quits = true; };
    const std::string note = keep(session, options.recover);
    const Diagnostics mistakes = session.mistakes();
    if (options.running && !mistakes.failed()) session.execute(-1, {{"command", "run"}});
    std::unique_ptr<EngineThread> engine;
    HttpServer::Options wanted;
    wanted.port = options.port;
    wanted.token = make_token(), wanted.picture_key = make_token();
    if (options.ticket) wanted.ticket = make_token();
    session.picture_address = [key = wanted.picture_key](const std::string& what,
                                                         const std::string& version) {
        return fmt::format("/picture?what={}&format=png&version={}&key={}", what, version, key);
    };
    wanted.file = find_asset;
    wanted.opened = [&](int client) { engine->post([client](Session& s) { s.connect(client); }); };
    wanted.closed = [&](int client) { engine->post([client](Session& s) { s.disconnect(client); }); };
    wanted.received = [&](int client, std::string text) {
        if (const auto refused = refusal_of(text)) {
            server->send(client, false, *refused);
            return server->handled(text.size());
        }
        engine->post([&server, client, text = std::move(text)](Session& s) {
            s.message(client, text);
            server->handled(text.size());
        });
    };
    wanted.picture = [&](std::string what, std::string format, const std::function<void(Content)>& done) {
        engine->post([what, format, done](Session& s) {
            try {
                const std::string type = format == "png"   ? "image/png"
                                         : format == "svg" ? "image/svg+xml"
                                                           : "application/pdf";
                done({type, s.picture(what, format)});
            } catch (const std::exception& e) {
                done({"text/plain; charset=utf-8", e.what(), false, 404});
            }
        });
    };
    const std::string token = wanted.token, ticket = wanted.ticket;
    server = std::make_unique<HttpServer>(std::move(wanted));
    engine = std::make_unique<EngineThread>(session);
    std::thread network([&] { server->run(); });
    const auto address = [&](const std::string& secret) {
        return fmt::format("http://127.0.0.1:{}/?token={}", server->port(), secret);
    };
    ready({address(token), ticket.empty() ? "" : address(ticket), note, mistakes});
    while (!interrupted() && !quits) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    server->stop();
    network.join();
    engine.reset();
    session.end();
}

}  // namespace forage::studio
