#include "bug_interface/world/sdf_reader.h"

#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "bug_interface/world/sdf_elements.h"
#include "core/base/separated.h"

namespace forage::bug {
namespace {

namespace fs = std::filesystem;

class Reader {
  public:
    Reader(const std::string& path, Diagnostics& diagnostics, const std::vector<std::string>& extra)
        : path_(path), diagnostics_(diagnostics), in_(path, diagnostics, extra) {}

    std::optional<WorldDescription> read(const std::string& text) {
        const int errors_before = diagnostics_.errors();
        const xml::Element root = text.empty() ? in_.open(path_) : in_.parse(path_, text);
        if (!root) return {};
        const xml::Element world_element = root.child("world");
        if (!world_element) {
            diagnostics_.error(root.where(), "the file has no <world>",
                               "a world file is <sdf><world name=\"..\">..</world></sdf>");
            return {};
        }
        WorldDescription world = read_world_element(world_element);
        if (diagnostics_.errors() > errors_before) return {};
        return world;
    }

  private:
    // ---- includes ----

    /// The content of a model's file: a model or a light.
    struct Content {
        std::optional<Model> model;
        std::size_t links = 0;  ///< number of links in the model and in the models within it
        xml::Element light;
    };

    /// The content that an <include> stands for. A file that is included many times is read once, and its
    /// mistakes are reported once.
    Content included(const xml::Element& include) {
        const std::string file = model_file(include);
        if (file.empty()) return {};
        if (const auto known = contents_.find(file); known != contents_.end()) {
            if (open_.contains(file))
                diagnostics_.error(include.where(),
                                   fmt::format("'{}' includes itself", include.value("uri").view),
                                   "take this <include> away, or the one that leads here");
            return known->second;
        }
        contents_[file];
        open_.insert(file);
        const Content content = read_model_file(file, include);
        open_.erase(file);
        return contents_[file] = content;
    }

    Content read_model_file(const std::string& file, const xml::Element& include) {
        if (std::error_code ignored; fs::exists(file, ignored) && !fs::is_regular_file(file, ignored)) {
            diagnostics_.error(include.where(), fmt::format("'{}' is a pipe or a device, not a file", file));
            return {};
        }
        const xml::Element root = in_.open(file);
        if (!root) return {};
        if (const auto inside = root.children(); inside.size() > 1)
            diagnostics_.warning(inside[1].where(),
                                 "the included file holds several models; the first one is used");
        Content content;
        if (const xml::Element model = root.child("model"))
            content.model = read_model(model), content.links = count_links(*content.model);
        else if (const xml::Element light = root.child("light"))
            content.light = light;
        else
            diagnostics_.error(include.where(), fmt::format("'{}' holds neither a model nor a light", file),
                               "an <include> stands for <sdf><model name=\"..\">..</model></sdf>");
        return content;
    }

    /// The file that an <include> names; empty when there is none.
    std::string model_file(const xml::Element& include) {
        const xml::Element element = include.child("uri");
        const std::string uri = element.value().text();
        const Location where = element.where();
        if (uri.empty()) {
            diagnostics_.error(where, "<uri> is empty", "write <uri>model://NAME</uri>");
            return {};
        }
        const std::string found = in_.folders.find(uri);
        // A bare name that is a folder in this working directory may not be one elsewhere.
        const bool bare = uri.find('/') == std::string::npos;
        if (found.empty() || (bare && fs::is_directory(found))) {
            const auto known = in_.folders.names();
            if (!known.empty()) {
                diagnostics_.error(where, fmt::format("there is no model '{}'", uri),
                                   ModelFolders::hint(uri, known));
            } else if (!no_models_) {
                no_models_ = true;  // once is enough
                diagnostics_.error(where,
                                   fmt::format("model '{}' not found: there is no folder of models", uri),
                                   "put models into a folder 'models' beside the world file or up to two "
                                   "above, or name their folder in FORAGE_MODEL_PATH");
            }
            return {};
        }
        if (!fs::is_directory(found)) return found;
        return file_of_model(found, where, diagnostics_).value_or("");
    }

    /// Returns `model` with the name and the pose that an <include> gives it.
    Model placed(Model model, const xml::Element& include) {
        model.where = include.where();
        if (const auto name = include.value("name"); !name.view.empty()) model.name = name.view;
        if (include.child("pose")) model.pose = in_.pose_of(include);
        model.is_static = include.value("static").flag(model.is_static);
        if (const xml::Element frame = include.child("placement_frame"))
            diagnostics_.error(frame.where(), "<placement_frame> is not supported",
                               "give the <pose> of the model's origin");
        read_plugins(include, model);
        return model;
    }

    static std::size_t count_links(const Model& model) {
        std::size_t out = 1 + model.links.size();
        for (const Model& inner : model.models) out += count_links(inner);
        return out;
    }

    /// Whether a copy of so many links is allowed. A few files that include each other many times could make
    /// any number. Reports an error when there are too many.
    bool fits(std::size_t links, const xml::Element& include) {
        links_ += links;
        if (links_ > max_links && !too_many_) {
            too_many_ = true;  // once is enough
            diagnostics_.error(
                include.where(),
                fmt::format("with this <include> there are more than {} included models and links",
                            max_links),
                "does a model include others many times?");
        }
        return links_ <= max_links;
    }

    // ---- elements ----

    Model read_model(const xml::Element& e) {
        Model model;
        model.where = e.where(), model.name = e["name"].text(), model.pose = in_.pose_of(e);
        model.is_static = e.value("static").flag(false);
        for (const xml::Element& l : e.children("link")) model.links.push_back(read_link(in_, l));
        each_model(e, model.models, [](const xml::Element&) {});
        for (const xml::Element& j : e.children("joint")) read_joint(in_, j, model);
        check_joints(in_, model);
        read_plugins(e, model);
        return model;
    }

    void read_plugins(const xml::Element& e, Model& model) {
        for (const xml::Element& p : e.children("plugin"))
            model.plugins.push_back({p.where(), p["name"].text(), p["filename"].text()});
    }

    /// Reads the models and includes in `parent`, in file order. Calls visit_light(element) for an included
    /// light.
    template <class F>
    void each_model(const xml::Element& parent, std::vector<Model>& models, F visit_light) {
        for (const xml::Element& e : parent.children()) {
            if (e.name() == "model") models.push_back(read_model(e));
            if (e.name() != "include") continue;
            const Content content = included(e);
            if (content.model && fits(content.links, e)) models.push_back(placed(*content.model, e));
            if (content.light) visit_light(content.light);
        }
    }

    WorldDescription read_world_element(const xml::Element& e) {
        WorldDescription world;
        world.path = path_;
        if (const xml::Element physics = e.child("physics")) {
            // They had other names until version 1.3.
            world.step =
                physics.value("max_step_size").number(physics.value("ode/solver/dt").number(world.step));
            world.update_rate = physics.value("real_time_update_rate")
                                    .number(physics.value("update_rate").number(world.update_rate));
        }
        world.ambient = read_colour(e.value("scene/ambient"), Colour(Colour::Constant(world.ambient)))(0);
        const auto read_light = [&](const xml::Element& light) {
            if (light["type"].view != "directional") {
                diagnostics_.warning(light.where(),
                                     "only directional lights are simulated; this one is ignored");
            } else if (world.sun) {
                diagnostics_.warning(light.where(),
                                     "there are several directional lights; the first one is used");
            } else {
                const Eigen::Vector3d d = read_vector(light.value("direction"), Eigen::Vector3d(0, 0, -1));
                if (!(d.norm() > 0))
                    diagnostics_.error(light.where(), "a light needs a <direction> that is not 0",
                                       "straight down is 0 0 -1");
                world.sun = -d.normalized();
            }
        };
        for (const xml::Element& light : e.children("light")) read_light(light);
        for (const xml::Element& p : e.children("plugin")) {
            const std::string_view file = p["filename"].view;
            const bool game = file == "libforage_game.so";
            if (!game && file != "libforage_trials.so")
                diagnostics_.warning(
                    p.where(),
                    fmt::format("plugin '{}' of the world is not known here and does nothing", file),
                    "known are libforage_game.so and libforage_trials.so");
            else if (game ? world.game.has_value() : world.trials.has_value())
                diagnostics_.error(p.where(),
                                   game ? "there are two games in this world"
                                        : "there are two rules of trials in this world",
                                   "take one away");
            else if (game)
                world.game = read_game(in_, p);
            else
                world.trials = read_trials(in_, p);
        }
        each_model(e, world.models, read_light);
        return world;
    }

    std::string path_;
    Diagnostics& diagnostics_;
    SdfSource in_;
    std::map<std::string, Content> contents_;  ///< contents of the model files that were read
    std::set<std::string> open_;               ///< model files that are being read
    static constexpr std::size_t max_links = 10'000;
    std::size_t links_ = 0;  ///< number of links in all models that were included so far
    bool no_models_ = false, too_many_ = false;
};

/// Whether a path names a folder. Reports it as an error, with the worlds in the folder.
bool is_a_folder(const std::string& path, Diagnostics& diagnostics) {
    std::error_code ignored;
    if (!fs::is_directory(path, ignored)) return false;
    std::set<std::string> worlds;
    for (fs::directory_iterator entry(path, ignored), end; !ignored && entry != end; entry.increment(ignored))
        if (entry->path().extension() == ".world") worlds.insert(entry->path().string());
    diagnostics.error({std::make_shared<SourceFile>(SourceFile{path, {}}), 0, 0},
                      "this is a folder, not a world file",
                      worlds.empty() ? "give the path of a .world file"
                                     : fmt::format("in it are {}", separated(worlds, ", ")));
    return true;
}

}  // namespace

std::optional<WorldDescription> read_world(const std::string& path, Diagnostics& diagnostics,
                                           const std::vector<std::string>& extra_model_dirs,
                                           const std::string& text) {
    if (is_a_folder(path, diagnostics)) return {};
    return Reader(path, diagnostics, extra_model_dirs).read(text);
}

}  // namespace forage::bug
