#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "tools/studio/server/command_functions.h"

namespace forage::studio {
namespace {

constexpr std::uint64_t most_steps = 1'000'000;

}  // namespace

json Commands::start() {
    if (!s.failed_.empty()) throw InputError("the run has failed: " + s.failed_, "stop it, or go back");
    begin_waiting_sampler();
    s.running_ = s.status_due_ = true;
    s.pace_from_ = s.rate_from_ = -1, s.measured_rate_ = 0;
    return json::object();
}

json Commands::pause() {
    s.running_ = false, s.status_due_ = true;
    return json::object();
}

json Commands::step() {
    const auto cycles = whole(c, "cycles", 1, 1, most_steps);
    pause();
    if (!s.failed_.empty()) throw InputError("the run has failed: " + s.failed_, "stop it, or go back");
    begin_waiting_sampler();
    try {
        for (std::uint64_t i = 0; i < cycles; ++i) s.cycle();
    } catch (const engine::RunError& e) {
        s.failed_ = e.what();
        throw;
    }
    return {{"cycle", run().cycle()}};
}

json Commands::stop() {
    s.reset();
    return json::object();
}

json Commands::restart() {
    const auto before = s.input_.seed;
    const auto ended = s.lost_by_rebuild();
    s.input_.seed = whole(c, "seed", before, 0, std::numeric_limits<std::uint64_t>::max());
    try {
        s.reset();
    } catch (...) {
        s.input_.seed = before;
        throw;
    }
    const auto seed = s.input_.seed;
    s.tell_action("restart", fmt::format("begin anew with seed {}", seed),
                  begun_anew(of_restart, s.input_.world), ended);
    return {{"seed", seed}};
}

Equivalent Commands::begun_anew(Equivalent (*form)(const Opened&), const std::string& world) {
    // What the file does not have yet, such as parameters that were set in the run, gets into it before.
    const auto edit =
        s.scripted_.edit(s.edited_file(document().path()), {}, json::array(), document(), run().registry());
    const bool edited = document().dirty();
    Equivalent out = form({s.input_.system, world, s.input_.seed, edited});
    if (!s.current_ || (edited && !s.scripted_.follows())) out.python.clear();
    const auto joined = [](const std::string& a, const std::string& b) {
        return a.empty() || b.empty() ? a + b : a + '\n' + b;
    };
    return {joined(edit.shell, out.shell), joined(edit.python, out.python)};
}

json Commands::speed() {
    const auto mode = c.at("mode").get<std::string>();
    const double value = mode == "times" || mode == "cycles" ? finite(c, "value") : 1;
    if (mode != "real" && mode != "times" && mode != "cycles" && mode != "free")
        throw InputError(fmt::format("'{}' is not a speed", mode), "real, times, cycles or free");
    if (!(value > 0 && value <= 1e9)) throw InputError("a speed is above 0, at most 1e9");
    s.set_speed(mode, value);
    return json::object();
}

json Commands::world_open() {
    RunInput input = s.input_;
    input.world = c.at("world").get<std::string>(), input.world_text.clear();
    const auto ended = s.lost_by_rebuild();
    const auto before = std::exchange(s.input_, input);
    try {
        s.reset();
    } catch (...) {
        s.input_ = before;
        throw;
    }
    s.world_text_.reset();
    // The steps on the text of the world before say nothing about this one.
    for (auto* steps : {&s.undo_, &s.redo_})
        std::erase_if(*steps, [](const auto& step) {
            const auto command = step.redo.is_object() ? step.redo.value("command", "") : "";
            return command == "world_text" || command == "move";
        });
    ++s.generation_;
    const auto name = std::filesystem::path(input.world).filename().string();
    s.tell_action("world_open", name.empty() ? "begin anew without a world" : "begin anew in " + name,
                  begun_anew(of_world, input.world), ended);
    s.tell(s.world_message()), s.tell(s.system_message()), s.tell_document();
    return {{"world", input.world}};
}

json Commands::shipped() {
    namespace fs = std::filesystem;
    json worlds = json::array();
    std::error_code failed;
    if (!s.shipped_.empty())
        for (const auto& entry : fs::directory_iterator(fs::path(s.shipped_) / "worlds", failed))
            if (entry.path().extension() == ".world") worlds.push_back(entry.path().string());
    std::sort(worlds.begin(), worlds.end());
    return {{"worlds", std::move(worlds)}};
}

json Commands::quit() {
    if (!s.quit) throw InputError("this session cannot be ended by a page");
    s.quit();
    return json::object();
}

json Commands::open() {
    RunInput input = s.input_;
    input.more.clear(), input.settings.clear(), input.text.clear(), input.world_text.clear();
    const std::filesystem::path folder = c.value("shipped", false) ? s.shipped_ : "";
    const std::string world = c.value("world", "");
    input.system = folder / c.at("system").get<std::string>();
    input.world = world.empty() ? world : (folder / world).string();
    s.open_document(input);
    return json::object();
}

}  // namespace forage::studio
