// Tries messages of pages to the studio, one per line, what is read before the token is known,
// and the original's files of plots and panels. A message changes no file: commands that write are left out.
#include <cstdint>
#include <string_view>

#include "core/base/text_file.h"
#include "core/xml/panel.h"
#include "core/xml/plot_config.h"
#include "tests/fuzz/holds.h"
#include "tools/studio/server/requests.h"
#include "tools/studio/server/session.h"

namespace {

using namespace forage;
using namespace forage::studio;

struct SmallStudio {
    int replies = 0;
    std::string text = read_file(input().system);
    Session session;

    SmallStudio()
        : session(input(), [this](int, bool binary, const std::string& data) {
              if (!binary && json::parse(data)["type"] == "reply") ++replies;
          }) {
        session.connect(1);
    }
    static RunInput input() {
        RunInput out;
        out.system = FORAGE_SOURCE_DIR "/tests/diagnostics/sound/system.iqr";
        return out;
    }
};

/// Whether a message would write a file, read another system or take long.
bool left_out(std::string_view message) {
    const auto command = json::parse(message, nullptr, false);
    if (!command.is_object()) return false;
    const auto name = command.value("command", json());
    for (const char* other :
         {"sample", "layout_write", "panel_write", "parameters_write", "patterns_write", "save", "world_save",
          "export", "backup", "open", "world_open", "step", "run", "run_until", "figure", "settings"})
        if (name == other) return true;
    return false;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static SmallStudio small;
    std::string_view text(reinterpret_cast<const char*>(data), size);
    for (const auto& parse :
         {+[](const std::string&t, Diagnostics&d) { xml::parse_plot_config("x.conf", t, d); },
          +[](const std::string&t, Diagnostics&d) { xml::parse_panel("x.hconf", t, d); }}) {
        Diagnostics diagnostics;
        parse(std::string(text), diagnostics);
        test::sensible(diagnostics, std::string(text));
    }
    query_value(text, "token"), token_in(text), is_from_here(text, text, 1);
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        if (const auto message = text.substr(0, end); !left_out(message)) {
            const auto command = json::parse(message, nullptr, false);
            const bool ack = command.is_object() && command.value("command", json()) == "ack";
            small.replies = 0;
            small.session.message(1, message);
            test::holds(small.replies == 1 || (ack && small.replies == 0), "a message has one reply");
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    // Each input begins with the same text.
    small.session.execute(-1, {{"command", "text_edit"}, {"text", small.text}});
    small.session.work(0);
    return 0;
}
