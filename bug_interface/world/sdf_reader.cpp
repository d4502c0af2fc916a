#include "bug_interface/world/sdf_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "bug_interface/world/sdf_elements.h"
#include "core/base/separated.h"
#include "core/base/sequence.h"

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
        for (const xml::Element& outside : root.children())
            if (outside.name() == "model" || outside.name() == "light")
                diagnostics_.warning(
                    outside.where(),
                    fmt::format("this <{}> is not in <world>: it has no effect", outside.name()));
        WorldDescription world = read_world_element(world_element);
        if (diagnostics_.errors() > errors_before) return {};
        world.files = std::move(in_.included);
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
        const std::string path = model_file(include);
        if (path.empty()) return {};
        std::error_code ignored;
        const std::string file = fs::weakly_canonical(path, ignored).string();  // the same for all ways to it
        if (const auto known = contents_.find(file); known != contents_.end()) {
            if (open_.contains(file))
                diagnostics_.error(include.where(),
                                   fmt::format("'{}' includes itself", include.value("uri").view),
                                   "take this <include> away, or the one that leads here");
            return known->second;
        }
        contents_[file];
        open_.insert(file);
        const Content content = read_model_file(path, include);
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
        in_.included.insert(file);
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
        const std::string found = in_.found(element);
        if (found.empty()) {
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
        for (const char* config : {"model.config", "manifest.xml"})
            if (const fs::path path = fs::path(found) / config; fs::exists(path))
                in_.included.insert(path.string());
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
        each_model(e, model.models, &model, [&](const xml::Element&, const xml::Element& include) {
            diagnostics_.warning(include.where(), "a light in a model has no effect",
                                 "include it directly in <world>");
        });
        if (!model.is_static) warn_of_twins(model.links, "link");
        for (const xml::Element& j : e.children("joint")) read_joint(in_, j, model);
        warn_of_twins(model.hinges, "joint");
        check_joints(in_, model);
        read_plugins(e, model);
        return model;
    }

    void read_plugins(const xml::Element& e, Model& model) {
        for (const xml::Element& p : e.children("plugin"))
            model.plugins.push_back({p.where(), p["name"].text(), p["filename"].text()});
    }

    void warn_of_twin(const Location& where, std::string_view what, std::string_view name) {
        diagnostics_.warning(where, fmt::format("two {}s are called '{}'", what, name),
                             "give each a name of its own: the name stands for the first one");
    }
    template <class Things>
    void warn_of_twins(const Things& things, std::string_view what) {
        std::set<std::string_view> names;
        for (const auto& thing : things)
            if (!names.insert(thing.name).second) warn_of_twin(thing.where, what, thing.name);
    }

    /// Adds a model to others. `named` is whether its name was written for it. Others share that of their
    /// file, which misleads only in what moves. Two robots of one name are an error in a world.
    void add(Model model, bool named, std::vector<Model>& models) {
        const auto is_robot = [](const Model& m) {
            return contains(m.plugins, "libvel_plugin.so", &Plugin::filename);
        };
        const auto same = std::ranges::find(models, model.name, &Model::name);
        if (same != models.end() && (named || !model.is_static) && !(is_robot(model) && is_robot(*same)))
            warn_of_twin(model.where, "model", model.name);
        models.push_back(std::move(model));
    }

    /// Adds what an included model holds to `model`, as <include merge="true"> wants it.
    void merge(Model included, Model& model, const xml::Element& include) {
        if (included.is_static && !model.is_static)
            diagnostics_.warning(
                include.where(),
                fmt::format("the merged model is static, but '{}' is not: it can be pushed", model.name),
                fmt::format("write <static>true</static> in '{}'", model.name));
        for (Link& link : included.links) {
            link.pose = included.pose * link.pose;
            model.links.push_back(std::move(link));
        }
        for (Model& inner : included.models) {
            inner.pose = included.pose * inner.pose;
            add(std::move(inner), true, model.models);
        }
        std::ranges::move(included.hinges, std::back_inserter(model.hinges));
        std::ranges::move(included.plugins, std::back_inserter(model.plugins));
    }

    /// Whether an <include> merges its model into `model`, which is null directly in a world.
    bool merges(const xml::Element& include, const Model* model) {
        if (!include["merge"].flag(false)) return false;
        if (!model)
            diagnostics_.warning(include.where(), "merge=\"true\" has no effect directly in <world>",
                                 "it adds the links of a model to the <model> in which the <include> stands");
        else if (const xml::Element name = include.child("name"))
            diagnostics_.warning(name.where(), "the <name> of a merged model has no effect",
                                 fmt::format("its links become those of '{}'", model->name));
        return model != nullptr;
    }

    /// Reads the models and includes in `parent`, in file order. Calls visit_light(element, include) for an
    /// included light. `outer` is the model that `parent` describes, if it is one.
    template <class F>
    void each_model(const xml::Element& parent, std::vector<Model>& models, Model* outer, F visit_light) {
        for (const xml::Element& e : parent.children()) {
            if (e.name() == "model") add(read_model(e), true, models);
            if (e.name() != "include") continue;
            const Content content = included(e);
            if (content.model && fits(content.links, e)) {
                if (merges(e, outer))
                    merge(placed(*content.model, e), *outer, e);
                else
                    add(placed(*content.model, e), bool(e.child("name")), models);
            }
            if (content.light) visit_light(content.light, e);
        }
    }

    /// Warns of static models in a movable one, with which they move.
    void warn_of_static(const Model& outer, const Model& movable) {
        for (const Model& inner : outer.models) {
            if (inner.is_static)
                diagnostics_.warning(inner.where,
                                     fmt::format("'{}' is static, but a part of '{}', with which it moves",
                                                 inner.name, movable.name),
                                     "put it beside that model, or make that model static");
            warn_of_static(inner, movable);
        }
    }

    /// Puts models where <state> says that they are: a saved world has the poses of its last moment there.
    void apply_state(const xml::Element& state, WorldDescription& world) {
        for (const xml::Element& e : state.children("model")) {
            const auto found = std::ranges::find(world.models, e["name"].view, &Model::name);
            if (found == world.models.end()) {
                diagnostics_.warning(
                    e.where(),
                    fmt::format("<state> names a model '{}' that the world does not have", e["name"].view),
                    suggest(e["name"].view, names_of(world.models)));
                continue;
            }
            if (e.child("pose")) found->pose = in_.pose_of(e);
            if (const xml::Element part = moved_part(e, *found, found->pose))
                diagnostics_.warning(
                    part.where(),
                    fmt::format("<state> moves '{}', a part of '{}': it stays where its model puts it",
                                part["name"].view, found->name),
                    "only whole models are moved");
        }
    }

    /// The first part of a model in <state> that is elsewhere than in `model`, whose pose in the world is
    /// `at`.
    xml::Element moved_part(const xml::Element& state, const Model& model, const Pose& at) {
        const auto moved = [&](const xml::Element& part, const Pose& pose) {
            return part.child("pose") && !is_near(pose, in_.pose_of(part));
        };
        for (const xml::Element& e : state.children("link"))
            for (const Link& link : model.links)
                if (link.name == e["name"].view && moved(e, at * link.pose)) return e;
        for (const xml::Element& e : state.children("model"))
            for (const Model& inner : model.models) {
                if (inner.name != e["name"].view) continue;
                if (moved(e, at * inner.pose)) return e;
                if (const xml::Element part = moved_part(e, inner, at * inner.pose)) return part;
            }
        return {};
    }

    /// Whether two poses are the same on the floor, but for what models sink into it.
    static bool is_near(const Pose& a, const Pose& b) {
        const Pose2 p = in_plane(a), q = in_plane(b);
        return std::hypot(p.x - q.x, p.y - q.y) < 0.01 && std::cos(p.yaw - q.yaw) > 0.9999;
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
        std::map<std::string_view, xml::Element> lights_in_state;  // a saved world has poses there
        if (const xml::Element state = e.child("state"))
            for (const xml::Element& light : state.children("light"))
                if (light.child("pose")) lights_in_state.emplace(light["name"].view, light);
        const auto read_light = [&](const xml::Element& light, const xml::Element& include) {
            const auto name = include.value("name").view;
            const auto state = lights_in_state.find(name.empty() ? light["name"].view : name);
            const xml::Element placed = state != lights_in_state.end() ? state->second
                                        : include.child("pose")        ? include
                                                                       : light;
            if (light["type"].view != "directional") {
                diagnostics_.warning(light.where(),
                                     "only directional lights are simulated; this one is ignored");
            } else if (world.sun) {
                diagnostics_.warning(light.where(),
                                     "there are several directional lights; the first one is used");
            } else {
                const Eigen::Vector3d d = in_.pose_of(placed).linear() *
                                          read_vector(light.value("direction"), Eigen::Vector3d(0, 0, -1));
                if (!(d.norm() > 0))
                    diagnostics_.error(light.where(), "a light needs a <direction> that is not 0",
                                       "straight down is 0 0 -1");
                world.sun = -d.normalized();
            }
        };
        for (const xml::Element& light : e.children("light")) read_light(light, light);
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
        each_model(e, world.models, nullptr, read_light);
        for (const Model& model : world.models)
            if (!model.is_static) warn_of_static(model, model);
        if (const xml::Element state = e.child("state")) apply_state(state, world);
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
