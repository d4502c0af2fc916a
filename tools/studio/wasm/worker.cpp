// The studio in a browser's worker: a session without a server. web/src/browser/worker.ts calls these
// functions, and one page talks to it.
#include <array>
#include <cstdlib>
#include <memory>
#include <string>

#include <emscripten.h>

#include "core/run/run_spec.h"
#include "tools/studio/server/session.h"

// JavaScript.
// clang-format off
EM_JS(void, post_text, (const char* text, int size), { postMessage(UTF8ToString(text, size)); });
EM_JS(void, post_bytes, (const char* bytes, int size), {
    const frame = HEAPU8.slice(bytes, bytes + size).buffer;
    postMessage(frame, [frame]);
});
/// Keeps a PNG picture in the browser, and writes its address to `address`.
EM_JS(void, keep_picture, (const char* bytes, int size, char* address, int most), {
    const picture = new Blob([HEAPU8.slice(bytes, bytes + size)], {type: 'image/png'});
    // The page may still load the last one.
    const pictures = Module.pictures || (Module.pictures = []);
    if (pictures.push(URL.createObjectURL(picture)) > 4) URL.revokeObjectURL(pictures.shift());
    stringToUTF8(pictures.at(-1), address, most);
});
// clang-format on

namespace {

using namespace forage;

constexpr int page = 0;
std::unique_ptr<studio::Session> session;

void send(int, bool binary, const std::string& data) {
    (binary ? post_bytes : post_text)(data.data(), static_cast<int>(data.size()));
}

std::string picture_address(const std::string& what, const std::string&) {
    const std::string png = session->picture(what, "png");
    std::array<char, 256> address{};
    keep_picture(png.data(), static_cast<int>(png.size()), address.data(), address.size());
    return address.data();
}

}  // namespace

extern "C" {

/// Opens a system with a world, which may be empty. Returns what is wrong, until the next call; empty when
/// the session has begun.
EMSCRIPTEN_KEEPALIVE const char* forage_open(const char* system, const char* world) {
    static std::string wrong;
    setenv("FONTCONFIG_FILE", "/forage/fonts/fonts.conf", 1);
    // Worlds of the user find the models that come with Forage: there is no program beside which they are.
    setenv("FORAGE_MODEL_PATH", "/forage/systems/worlds/models", 1);
    try {
        RunInput input;
        input.system = system, input.world = world;
        session = std::make_unique<studio::Session>(input, send, "", "/forage/systems");
        session->picture_address = picture_address;
        session->keep();
        session->connect(page);
        wrong.clear();
    } catch (const std::exception& e) {
        wrong = e.what();
    }
    return wrong.c_str();
}

/// Executes a message of the page.
EMSCRIPTEN_KEEPALIVE void forage_receive(const char* message) { session->message(page, message); }

/// Runs the cycles that are due. Returns the seconds until it should be called again.
EMSCRIPTEN_KEEPALIVE double forage_work() { return session->work(studio::clock_now()); }

/// Keeps what has changed at once, as the page may be gone soon.
EMSCRIPTEN_KEEPALIVE void forage_keep() { session->save_changes(); }
}
