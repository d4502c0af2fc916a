// The functions of commands. Each topic has a file: commands_run.cpp, commands_looking.cpp,
// commands_parameters.cpp, commands_touching.cpp, commands_sampler.cpp, commands_files.cpp,
// commands_document.cpp, commands_editing.cpp, commands_world.cpp, commands_past.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bug_interface/simulation/world.h"
#include "core/model/edit.h"
#include "core/observe/manipulation.h"
#include "core/xml/panel.h"
#include "tools/studio/server/equivalents.h"
#include "tools/studio/server/session.h"

namespace forage::studio {

/// A whole number of a command. Throws InputError.
std::uint64_t whole(const json& command, const char* member, std::uint64_t otherwise, std::uint64_t least,
                    std::uint64_t most);
/// A finite number of a command. Throws InputError.
double finite(const json& command, const char* member);

/// A command of a page. Its functions are those of the table in commands.cpp, and what several of them need.
struct Commands {
    Session& s;
    int client;
    const json& c;
    Run& run() { return *s.run_; }
    bug::World& world();
    int group(const std::string& name);
    const engine::Layout::Group& laid(int i) { return run().layout().groups[static_cast<std::size_t>(i)]; }

    // ---- the run ----
    json start();
    json pause();
    json step();
    json stop();
    json restart();
    /// The forms of a run of the document that begins anew in a world.
    Equivalent begun_anew(Equivalent (*form)(const Opened&), const std::string& world);
    json speed();
    json open();
    json world_open();
    json shipped();
    json quit();

    // ---- looking ----
    json subscribe();
    json unsubscribe();
    json read();
    Run* beside();  ///< the run to compare with; null without one
    json synapses();
    json trials();
    std::size_t find_robot();

    // ---- parameters ----
    json parameters();
    static std::string value_in(const std::string& assignment);
    /// Checks assignments and returns those that would undo them. Throws InputError for all mistakes at once.
    std::vector<std::string> inverse(const std::vector<std::string>& assignments);
    static bool at_start(const model::Assignment& a) { return !a.parameter || a.parameter->at_start; }
    json set(const std::vector<std::string>& assignments, const std::string& title, bool undoable);
    json set();
    json undo();
    json redo();
    json back_or_forth(std::vector<Session::Undo>& from, std::vector<Session::Undo>& to, bool back);

    // ---- manipulations ----
    json describe(int number);
    /// What does the same as a command that has not been applied yet.
    Equivalent same(const json& command);
    /// What is told of a command: its title, and what does the same.
    json told(const json& command, const std::string& title, const std::string& item = {});
    json manipulate();
    json revoke();
    json manipulations();
    json patterns_read();
    json patterns_write();
    observe::Manipulation::Settings settings_of(const json& command);

    // ---- the world ----
    json move();
    std::optional<Pose2> pose_of(const std::string& name);
    json begin_trial();
    /// Changes the run as a noted action says.
    void apply();

    // ---- the sampler ----
    json sample();
    json sample_stop();
    void begin_sampling(const json& how);
    /// Begins what was asked to begin with the run.
    void begin_waiting_sampler();

    // ---- layouts ----
    std::filesystem::path folder();
    std::string layout_path(const std::string& name);
    json layouts();
    json layout_read();
    json layout_convert();
    json layout_write();
    json panels_keep();

    // ---- panels and sets of parameters ----
    std::string panel_path(const char* ending);
    /// Throws InputError when a file of this name exists and the command does not say to overwrite it.
    void check_new(const std::string& path) const;
    /// The same, and of a file that comes with Forage.
    void check_free(const std::string& path) const;
    std::vector<xml::PanelRow> panel_rows(const char* ending);
    /// The parameter of an item, as `parameters` describes it. Throws InputError.
    json one_parameter(const std::string& item, const std::string& name);
    static xml::PanelRow row_of(const json& p);
    std::vector<xml::PanelRow> wanted_rows();  ///< those of the command; throws InputError
    json panel_read();
    json panel_write();
    json parameters_read();
    json parameters_write();

    // ---- editing ----
    Document& document();
    json edit();
    json item();
    /// The number of synapses of a connection of the document; 0 when it cannot be built.
    std::size_t synapses_of(const std::string& connection);
    json item_text();
    json item_check();
    json text_edit();
    /// Whether the last step is one of the document alone, so that the next one may join it.
    bool joins_document() const;
    json copy();
    json types();
    json vocabulary();
    json preview();

    // ---- the document ----
    json document_read();
    json difference();
    json new_system();
    void refuse_shipped(const std::string& file) const;
    json save();
    json backup();
    json reload();
    json import_process();
    json export_process();
    json recent();
    json settings();
    json files();
    /// After a step of the document.
    json edited(const std::string& title, const std::string& text_before = {},
                const json& operations = json::array());

    // ---- the text of the world ----
    Session::WorldText& world_text();
    void set_world_text(const std::string& text);
    std::string running_world();  ///< the text of the world that runs
    /// Builds the run anew in a world of this text: robots and what they carry stay where they are. Throws
    /// InputError, and leaves the run as it is then.
    void run_in_world(const std::string& text);
    /// Tells the pages of an edit of the world, with which the run goes on in another world or not.
    void tell_world_edit(const std::string& title, const Equivalent& forms, bool runs,
                         const std::vector<std::string>& ended);
    json world_document();
    json world_types();
    json world_edit();
    json world_save();

    // ---- the past ----
    json history();
    json digest();
    json seek();
    json branch();
    json compare();
    json compare_end();
    json recover();
    json forget();
};

}  // namespace forage::studio
