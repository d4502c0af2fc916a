#include "bug_interface/world/sdf_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

#include "bug_interface/world/sdf_elements.h"
#include "bug_interface/world/world_file.h"

namespace forage::bug {
namespace {

namespace fs = std::filesystem;

class Reader {
  public:
    Reader(const std::string& path, Diagnostics& diagnostics, const std::vector<std::string>& extra)
        : path_(path), diagnostics_(diagnostics), in_(path, diagnostics, extra) {}

    std::optional<WorldDescription> read() {
        const int errors_before = diagnostics_.errors();
        sdf::ElementPtr world_element;
        for (const auto& e : in_.parser.parse(path_))
            if (e->GetName() == "world" && !world_element) world_element = e;
        if (!world_element && diagnostics_.errors() == errors_before)
            diagnostics_.error(in_.at(path_, 1), "the file has no <world>",
                               "a world file is <sdf><world name=\"..\">..</world></sdf>");
        if (diagnostics_.errors() > errors_before) return {};
        WorldDescription world = read_world_element(world_element);
        if (diagnostics_.errors() > errors_before) return {};
        return world;
    }

  private:
    // ---- includes ----

    /// What a model's file holds: a model or a light.
    struct Content {
        std::optional<Model> model;
        sdf::ElementPtr light;
    };

    /// What an <include> stands for. A file that is included many times is read once; what is wrong in it is
    /// said once.
    Content included(const sdf::ElementPtr& include) {
        const std::string file = model_file(include);
        if (file.empty()) return {};
        if (const auto known = contents_.find(file); known != contents_.end()) {
            if (open_.contains(file))
                diagnostics_.error(in_.at(include), fmt::format("'{}' includes itself",
                                                                in_.value(include, "uri", std::string())));
            return known->second;
        }
        contents_[file];
        open_.insert(file);
        const Content content = read_model_file(file, include);
        open_.erase(file);
        return contents_[file] = content;
    }

    Content read_model_file(const std::string& file, const sdf::ElementPtr& include) {
        const int errors_before = diagnostics_.errors();
        const auto elements = in_.parser.parse(file);
        if (diagnostics_.errors() > errors_before) return {};
        const auto first = [&](const char* name) {
            return std::find_if(elements.begin(), elements.end(),
                                [&](const auto& e) { return e->GetName() == name; });
        };
        const auto model = first("model"), light = first("light");
        if (elements.size() > 1)
            diagnostics_.warning(in_.at(elements[1]),
                                 "the included file holds several models; the first one is used");
        Content content;
        if (model != elements.end())
            content.model = read_model(*model);
        else if (light != elements.end())
            content.light = *light;
        else
            diagnostics_.error(in_.at(include), fmt::format("'{}' holds neither a model nor a light", file));
        return content;
    }

    /// The file that an <include> names; empty when there is none.
    std::string model_file(const sdf::ElementPtr& include) {
        const std::string uri = in_.value(include, "uri", std::string());
        const Location where = in_.at(include->HasElement("uri") ? include->GetElement("uri") : include);
        const std::string found = in_.folders.find(uri);
        // A bare name that happens to be a folder here would not be one elsewhere.
        const bool bare = uri.find('/') == std::string::npos;
        if (found.empty() || (bare && fs::is_directory(found))) {
            const auto names = in_.folders.names();
            if (!names.empty()) {
                diagnostics_.error(where, fmt::format("there is no model '{}'", uri),
                                   ModelFolders::hint(uri, names));
            } else if (!no_models_) {
                no_models_ = true;  // once is enough
                diagnostics_.error(
                    where, fmt::format("there is no model '{}', nor any other: no models are found", uri),
                    "put them into a folder 'models' beside the world file or one above, or name their "
                    "folder in FORAGE_MODEL_PATH");
            }
            return {};
        }
        if (!fs::is_directory(found)) return found;
        const fs::path folder = found;
        if (!fs::exists(folder / "model.config") && !fs::exists(folder / "manifest.xml")) {
            diagnostics_.error(where, fmt::format("the folder '{}' of this model has no model.config", found),
                               "it says which file holds the model; copy it from another model");
            return {};
        }
        const std::string file = SdfParser::model_file(found);
        if (file.empty() || !fs::exists(file)) {
            diagnostics_.error(where, fmt::format("'{}/model.config' names no file that there is", found),
                               "<sdf version=\"1.4\">model.sdf</sdf>");
            return {};
        }
        return file;
    }

    /// `model`, with the name and the place that an <include> gives it.
    Model placed(Model model, const sdf::ElementPtr& include) {
        model.where = in_.at(include);
        if (const auto name = in_.value(include, "name", std::string()); !name.empty()) model.name = name;
        if (include->HasElement("pose")) model.pose = in_.pose_of(include);
        model.is_static = in_.value(include, "static", model.is_static);
        if (include->HasElement("placement_frame"))
            diagnostics_.error(in_.at(include->GetElement("placement_frame")),
                               "<placement_frame> is not supported", "give the <pose> of the model's origin");
        read_plugins(include, model);
        return model;
    }

    // ---- elements ----

    Model read_model(const sdf::ElementPtr& e) {
        Model model;
        model.where = in_.at(e), model.name = name_of(e), model.pose = in_.pose_of(e);
        model.is_static = in_.value(e, "static", false);
        each(e, "link", [&](const sdf::ElementPtr& l) { model.links.push_back(read_link(in_, l)); });
        each_model(e, model.models, [](const sdf::ElementPtr&) {});
        each(e, "joint", [&](const sdf::ElementPtr& j) { read_joint(in_, j, model); });
        check_joints(model);
        read_plugins(e, model);
        return model;
    }

    void check_joints(const Model& model) {
        std::vector<std::string> links;
        const auto collect = [&](const Model& m, const auto& again) -> void {
            for (const Link& link : m.links) links.push_back(link.name);
            for (const Model& inner : m.models) again(inner, again);
        };
        collect(model, collect);
        for (const Hinge& hinge : model.hinges)
            for (const std::string& name : {hinge.parent, hinge.child})
                if (std::find(links.begin(), links.end(), name.substr(name.rfind(':') + 1)) == links.end())
                    diagnostics_.error(
                        hinge.where,
                        fmt::format("joint '{}' names no link of its model: '{}'", hinge.name, name),
                        suggest(name, links));
    }

    void read_plugins(const sdf::ElementPtr& e, Model& model) {
        each(e, "plugin", [&](const sdf::ElementPtr& p) {
            model.plugins.push_back({in_.at(p), name_of(p), p->Get<std::string>("filename")});
        });
    }

    /// The models and includes in `parent`, in file order; visit_light(element) for an included light.
    template <class F>
    void each_model(const sdf::ElementPtr& parent, std::vector<Model>& models, F visit_light) {
        for (auto e = parent->GetFirstElement(); e; e = e->GetNextElement()) {
            if (e->GetName() == "model") models.push_back(read_model(e));
            if (e->GetName() != "include") continue;
            const Content content = included(e);
            if (content.model) models.push_back(placed(*content.model, e));
            if (content.light) visit_light(content.light);
        }
    }

    WorldDescription read_world_element(const sdf::ElementPtr& e) {
        WorldDescription world;
        world.path = path_;
        if (const auto physics = child(e, {"physics"})) {
            world.step = in_.value(physics, "max_step_size", 0.001);
            world.update_rate = in_.value(physics, "real_time_update_rate", 1000.0);
            if (!(world.step > 0 && world.update_rate > 0))
                diagnostics_.error(in_.at(physics),
                                   "max_step_size and real_time_update_rate must be positive");
            else if (!(world.step >= 1e-6 && world.step <= 1 && world.update_rate <= 1e6))
                diagnostics_.error(
                    in_.at(physics),
                    "max_step_size lies between 1e-6 and 1 s, real_time_update_rate below 1e6");
        }
        if (const auto ambient = child(e, {"scene", "ambient"}))
            world.ambient = ambient->Get<ignition::math::Color>().R();
        const auto read_light = [&](const sdf::ElementPtr& light) {
            if (light->Get<std::string>("type") != "directional") {
                diagnostics_.warning(in_.at(light),
                                     "only directional lights are simulated; this one is left out");
            } else if (world.sun) {
                diagnostics_.warning(in_.at(light),
                                     "there are several directional lights; the first one is used");
            } else {
                const auto d = in_.value(light, "direction", ignition::math::Vector3d(0, 0, -1));
                if (!(d.Length() > 0))
                    diagnostics_.error(in_.at(light), "a light needs a <direction> that is not 0");
                world.sun = -Eigen::Vector3d(d.X(), d.Y(), d.Z()).normalized();
            }
        };
        each(e, "light", read_light);
        each(e, "plugin", [&](const sdf::ElementPtr& p) {
            if (p->Get<std::string>("filename") == "libforage_game.so" && world.game)
                diagnostics_.error(in_.at(p), "there are two games in this world", "take one away");
            else if (p->Get<std::string>("filename") == "libforage_game.so")
                world.game = read_game(in_, p);
            else
                diagnostics_.warning(
                    in_.at(p),
                    fmt::format("plugin '{}' of the world is not known here and does nothing",
                                p->Get<std::string>("filename")),
                    "known is libforage_game.so");
        });
        each_model(e, world.models, read_light);
        return world;
    }

    std::string path_;
    Diagnostics& diagnostics_;
    SdfSource in_;
    std::map<std::string, Content> contents_;  ///< of the model files that were read
    std::set<std::string> open_;               ///< those that are being read
    bool no_models_ = false;
};

}  // namespace

std::optional<WorldDescription> read_world(const std::string& path, Diagnostics& diagnostics,
                                           const std::vector<std::string>& extra_model_dirs) {
    if (!looks_like_a_world(path, diagnostics)) return {};
    return Reader(path, diagnostics, extra_model_dirs).read();
}

}  // namespace forage::bug
