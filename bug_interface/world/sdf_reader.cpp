#include "bug_interface/world/sdf_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sdf/sdf.hh>

#include "bug_interface/world/material.h"
#include "bug_interface/world/model_folders.h"
#include "bug_interface/world/png.h"
#include "bug_interface/world/sdf_parser.h"
#include "bug_interface/world/sdf_text.h"

namespace forage::bug {
namespace {

namespace fs = std::filesystem;

class Reader {
  public:
    Reader(const std::string& path, Diagnostics& diagnostics, const std::vector<std::string>& extra)
        : path_(path), diagnostics_(diagnostics), folders_(path, extra), parser_(diagnostics) {}

    std::optional<WorldDescription> read() {
        const int errors_before = diagnostics_.errors();
        sdf::ElementPtr world_element;
        for (const auto& e : parser_.parse(path_))
            if (e->GetName() == "world" && !world_element) world_element = e;
        if (!world_element && diagnostics_.errors() == errors_before)
            diagnostics_.error(at(path_, 1), "the file has no <world>",
                               "a world file is <sdf><world name=\"..\">..</world></sdf>");
        if (diagnostics_.errors() > errors_before) return {};
        WorldDescription world = read_world_element(world_element);
        if (diagnostics_.errors() > errors_before) return {};
        return world;
    }

  private:
    Location at(const std::string& file, int line) { return parser_.at(file, line); }
    Location at(const sdf::ElementPtr& e) { return parser_.at(e); }

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
                diagnostics_.error(at(include),
                                   fmt::format("'{}' includes itself", value(include, "uri", std::string())));
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
        const auto elements = parser_.parse(file);
        if (diagnostics_.errors() > errors_before) return {};
        const auto first = [&](const char* name) {
            return std::find_if(elements.begin(), elements.end(),
                                [&](const auto& e) { return e->GetName() == name; });
        };
        const auto model = first("model"), light = first("light");
        if (elements.size() > 1)
            diagnostics_.warning(at(elements[1]),
                                 "the included file holds several models; the first one is used");
        Content content;
        if (model != elements.end())
            content.model = read_model(*model);
        else if (light != elements.end())
            content.light = *light;
        else
            diagnostics_.error(at(include), fmt::format("'{}' holds neither a model nor a light", file));
        return content;
    }

    /// The file that an <include> names; empty when there is none.
    std::string model_file(const sdf::ElementPtr& include) {
        const std::string uri = value(include, "uri", std::string());
        const Location where = at(include->HasElement("uri") ? include->GetElement("uri") : include);
        const std::string found = folders_.find(uri);
        // A bare name that happens to be a folder here would not be one elsewhere.
        const bool bare = uri.find('/') == std::string::npos;
        if (found.empty() || (bare && fs::is_directory(found))) {
            const auto names = folders_.names();
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
        model.where = at(include);
        if (const auto name = value(include, "name", std::string()); !name.empty()) model.name = name;
        if (include->HasElement("pose")) model.pose = pose_of(include);
        model.is_static = value(include, "static", model.is_static);
        if (include->HasElement("placement_frame"))
            diagnostics_.error(at(include->GetElement("placement_frame")),
                               "<placement_frame> is not supported", "give the <pose> of the model's origin");
        read_plugins(include, model);
        return model;
    }

    // ---- values ----

    template <class T>
    T value(const sdf::ElementPtr& parent, const std::string& name, T otherwise) {
        if (!parent->HasElement(name)) return otherwise;
        const auto e = parent->GetElement(name);
        T out = e->Get<T>();
        if constexpr (requires { out.IsFinite(); }) {
            if (!out.IsFinite()) return not_finite(e), otherwise;
        } else if constexpr (std::is_same_v<T, double>) {
            if (!std::isfinite(out)) return not_finite(e), otherwise;
        }
        return out;
    }

    void not_finite(const sdf::ElementPtr& e) {
        diagnostics_.error(at(e), fmt::format("<{}> holds a number that is not finite", e->GetName()));
    }

    static std::string name_of(const sdf::ElementPtr& e) {
        return e->HasAttribute("name") ? e->Get<std::string>("name") : std::string();
    }

    static sdf::ElementPtr child(const sdf::ElementPtr& e, std::initializer_list<const char*> path) {
        sdf::ElementPtr at = e;
        for (const char* name : path) {
            if (!at->HasElement(name)) return nullptr;
            at = at->GetElement(name);
        }
        return at;
    }

    template <class F>
    static void each(const sdf::ElementPtr& parent, const std::string& name, F visit) {
        for (auto e = parent->GetFirstElement(); e; e = e->GetNextElement())
            if (e->GetName() == name) visit(e);
    }

    /// Angles of more than a turn are likely degrees.
    void check_angles(const sdf::ElementPtr& pose) {
        for (const char* attribute : {"degrees", "rotation_format"})
            if (pose->GetAttributeSet(attribute)) return;
        std::istringstream in(pose->GetValue()->GetAsString());
        std::array<double, 6> v{};
        for (double& each : v) in >> each;
        for (std::size_t i = 3; i < v.size(); ++i)
            if (std::abs(v[i]) > 2 * std::numbers::pi + 1e-3) {
                diagnostics_.warning(
                    at(pose), fmt::format("an angle of {} in a <pose>: radians, not degrees?", v[i]),
                    fmt::format("{} degrees are {:.5g} rad", v[i], v[i] * std::numbers::pi / 180));
                return;
            }
    }

    Pose pose_of(const sdf::ElementPtr& parent) {
        if (!parent->HasElement("pose")) return Pose::Identity();
        const auto e = parent->GetElement("pose");
        if (e->HasAttribute("relative_to") && !e->Get<std::string>("relative_to").empty())
            diagnostics_.error(at(e), "poses relative to a named frame are not supported",
                               "give the pose relative to the enclosing element");
        const auto p = e->Get<ignition::math::Pose3d>();
        if (!p.IsFinite()) return not_finite(e), Pose::Identity();
        check_angles(e);
        Pose pose = Pose::Identity();
        pose.translation() = Eigen::Vector3d(p.Pos().X(), p.Pos().Y(), p.Pos().Z());
        pose.linear() =
            Eigen::Quaterniond(p.Rot().W(), p.Rot().X(), p.Rot().Y(), p.Rot().Z()).toRotationMatrix();
        return pose;
    }

    Shape shape_of(const sdf::ElementPtr& parent) {
        Shape shape;
        const auto geometry = child(parent, {"geometry"});
        const auto kind = geometry ? geometry->GetFirstElement() : nullptr;
        if (!kind || kind->GetName() == "empty") {
            diagnostics_.error(at(parent),
                               fmt::format("<{}> has no shape that is known here", parent->GetName()),
                               "the shapes are <plane>, <box>, <cylinder> and <sphere>");
            return shape;
        } else if (kind->GetName() == "box") {
            const auto s = value(kind, "size", ignition::math::Vector3d(1, 1, 1));
            shape = {ShapeKind::box, {s.X(), s.Y(), s.Z()}};
        } else if (kind->GetName() == "cylinder") {
            const double d = 2 * value(kind, "radius", 1.0);
            shape = {ShapeKind::cylinder, {d, d, value(kind, "length", 1.0)}};
        } else if (kind->GetName() == "sphere") {
            shape = {ShapeKind::sphere, Eigen::Vector3d::Constant(2 * value(kind, "radius", 1.0))};
        } else if (kind->GetName() == "plane") {
            const auto s = value(kind, "size", ignition::math::Vector2d(1, 1));
            shape = {ShapeKind::plane, {s.X(), s.Y(), 0}};
        } else {
            diagnostics_.error(at(kind), fmt::format("shape <{}> is not supported", kind->GetName()),
                               "the shapes are <plane>, <box>, <cylinder> and <sphere>");
            return shape;
        }
        if ((shape.size.array() < 0).any()) diagnostics_.error(at(kind), "a size is negative");
        const auto zeros = (shape.size.array() == 0).count();  // a box may be flat, and is then no obstacle
        if (shape.kind != ShapeKind::plane && zeros > (shape.kind == ShapeKind::box ? 1 : 0))
            diagnostics_.error(at(kind), "a size is 0");
        return shape;
    }

    Material material_of(const sdf::ElementPtr& visual) {
        Material material;
        const auto e = child(visual, {"material"});
        if (!e) return material;
        if (const auto script = child(e, {"script"})) {
            const std::string name = value(script, "name", std::string());
            std::string uri;
            each(script, "uri", [&](const sdf::ElementPtr& u) {
                if (u->Get<std::string>().starts_with("model://")) uri = u->Get<std::string>();
            });
            if (!uri.empty()) {
                material.ambient = material.diffuse = Colour::Ones();
                material.texture = texture_of(script, uri, name);
            } else if (const auto known = named_material(name)) {
                material = *known;
            } else {
                diagnostics_.error(at(script), fmt::format("there is no material '{}'", name),
                                   suggest(name, material_names()));
            }
        }
        const auto set = [&](const char* which, Colour& colour) {
            if (!e->HasElement(which)) return;
            const auto c = e->GetElement(which)->Get<ignition::math::Color>();
            colour = {c.R(), c.G(), c.B()};
        };
        set("ambient", material.ambient);
        set("diffuse", material.diffuse);
        return material;
    }

    std::string texture_of(const sdf::ElementPtr& script, const std::string& uri, const std::string& name) {
        const std::string folder = folders_.find(uri);
        if (folder.empty()) {
            diagnostics_.error(at(script), fmt::format("there is no folder '{}'", uri),
                               "it holds the .material script and its texture");
            return {};
        }
        std::vector<fs::path> places = {folder, fs::path(folder) / "scripts", fs::path(folder) / "textures",
                                        fs::path(folder).parent_path() / "textures"};
        std::string image;
        for (const auto& place : places) {
            std::error_code ignored;
            for (fs::directory_iterator entry(place, ignored), end; !ignored && entry != end;
                 entry.increment(ignored))
                if (entry->path().extension() == ".material" && image.empty())
                    image = texture_in_script(read_text(entry->path()).value_or(""), name);
        }
        if (image.empty()) {
            diagnostics_.error(at(script),
                               fmt::format("no script in '{}' gives material '{}' a texture", folder, name));
            return {};
        }
        for (const auto& place : places) {
            const std::string file = (place / image).string();
            if (!fs::exists(file)) continue;
            if (const std::string problem = png_problem(file); !problem.empty())
                diagnostics_.error(at(script),
                                   fmt::format("the texture '{}' is no PNG picture: {}", file, problem));
            return file;
        }
        diagnostics_.error(at(script), fmt::format("the texture '{}' of material '{}' is missing in '{}'",
                                                   image, name, folder));
        return {};
    }

    double noise_of(const sdf::ElementPtr& e) {
        const auto stddev = child(e, {"noise", "stddev"});
        if (!stddev) return 0;
        const double noise = stddev->Get<double>();
        if (!(noise >= 0 && std::isfinite(noise)))
            diagnostics_.error(at(stddev), "a standard deviation is a finite number, at least 0");
        return noise;
    }

    double rate_of(const sdf::ElementPtr& sensor) {
        const double rate = value(sensor, "update_rate", 0.0);
        if (rate < 0) diagnostics_.error(at(sensor), "an <update_rate> cannot be negative");
        return rate;
    }

    // ---- elements ----

    void read_sensor(const sdf::ElementPtr& e, Link& link) {
        const std::string type = e->Get<std::string>("type");
        if (type == "ray") {
            RangeSensor s;
            s.where = at(e), s.name = name_of(e), s.pose = pose_of(e);
            const auto ray = child(e, {"ray"});
            const auto scan = ray ? child(ray, {"scan", "horizontal"}) : nullptr;
            const auto range = ray ? child(ray, {"range"}) : nullptr;
            if (!scan || !range) {
                diagnostics_.error(
                    s.where,
                    fmt::format("ray sensor '{}' needs <ray> with <scan><horizontal> and <range>", s.name));
                return;
            }
            s.rays = value(scan, "samples", 1);
            s.first_angle = value(scan, "min_angle", 0.0), s.last_angle = value(scan, "max_angle", 0.0);
            s.min_range = value(range, "min", 0.0), s.max_range = value(range, "max", 1.0);
            s.noise = noise_of(ray), s.rate = rate_of(e);
            if (!(std::isfinite(s.first_angle) && std::isfinite(s.last_angle)))
                diagnostics_.error(s.where,
                                   fmt::format("ray sensor '{}' has an angle that is not finite", s.name));
            if (s.rays < 1 || s.rays > most_rays || !(s.max_range > s.min_range))
                diagnostics_.error(s.where, fmt::format("ray sensor '{}' needs 1 to {} samples and min < max",
                                                        s.name, most_rays));
            link.range_sensors.push_back(std::move(s));
        } else if (type == "camera") {
            CameraSensor s;
            s.where = at(e), s.name = name_of(e), s.pose = pose_of(e);
            const auto camera = child(e, {"camera"});
            if (!camera) {
                diagnostics_.error(s.where, fmt::format("camera sensor '{}' needs <camera>", s.name));
                return;
            }
            s.horizontal_fov = value(camera, "horizontal_fov", 1.047);
            if (const auto image = child(camera, {"image"}))
                s.width = value(image, "width", 32), s.height = value(image, "height", 28);
            if (const auto clip = child(camera, {"clip"})) s.far = value(clip, "far", 20.0);
            s.noise = noise_of(camera), s.rate = rate_of(e);
            if (s.width < 1 || s.height < 1 || s.width > 4096 || s.height > 4096)
                diagnostics_.error(s.where, fmt::format("camera '{}' has an impossible image size", s.name));
            if (!(s.horizontal_fov > 0 && s.horizontal_fov < 3.1))
                diagnostics_.error(
                    s.where, fmt::format("camera '{}' needs a horizontal_fov between 0 and 3.1 rad", s.name));
            link.cameras.push_back(std::move(s));
        }
    }

    Link read_link(const sdf::ElementPtr& e) {
        Link link;
        link.where = at(e), link.name = name_of(e), link.pose = pose_of(e);
        if (const auto inertial = child(e, {"inertial"})) {
            link.mass = value(inertial, "mass", 1.0);
            if (const auto izz = child(inertial, {"inertia", "izz"})) link.inertia_z = izz->Get<double>();
            if (!(link.mass > 0 && link.inertia_z > 0))
                diagnostics_.error(at(inertial), "mass and inertia must be positive");
        }
        each(e, "collision", [&](const sdf::ElementPtr& c) {
            const auto mu = child(c, {"surface", "friction", "ode", "mu"});
            link.collisions.push_back(
                {at(c), name_of(c), pose_of(c), shape_of(c), mu ? mu->Get<double>() : 1.0});
        });
        each(e, "visual", [&](const sdf::ElementPtr& v) {
            link.visuals.push_back({at(v), name_of(v), pose_of(v), shape_of(v), material_of(v)});
        });
        each(e, "sensor", [&](const sdf::ElementPtr& s) { read_sensor(s, link); });
        return link;
    }

    /// Joints that do not turn fix their links, as everything in a model is fixed here.
    void read_joint(const sdf::ElementPtr& e, Model& model) {
        const auto axis = child(e, {"axis"});
        if (e->Get<std::string>("type") != "revolute" || !axis) return;
        Hinge hinge;
        hinge.where = at(e), hinge.name = name_of(e), hinge.pose = pose_of(e);
        hinge.parent = value(e, "parent", std::string()), hinge.child = value(e, "child", std::string());
        const auto xyz = value(axis, "xyz", ignition::math::Vector3d(0, 0, 1));
        if (const auto limit = child(axis, {"limit"}))
            hinge.lower = value(limit, "lower", -1e16), hinge.upper = value(limit, "upper", 1e16);
        if (hinge.lower == hinge.upper) return;
        if (std::abs(xyz.X()) > 1e-6 || std::abs(xyz.Y()) > 1e-6 || xyz.Z() == 0) {
            diagnostics_.warning(
                at(axis),
                fmt::format("the axis of joint '{}' is not vertical: it does not turn here", hinge.name));
            return;
        }
        hinge.sense = xyz.Z() > 0 ? 1 : -1;
        if (!(hinge.lower < hinge.upper))
            diagnostics_.error(at(axis),
                               fmt::format("joint '{}' has its lower limit above the upper one", hinge.name));
        model.hinges.push_back(std::move(hinge));
    }

    Model read_model(const sdf::ElementPtr& e) {
        Model model;
        model.where = at(e), model.name = name_of(e), model.pose = pose_of(e);
        model.is_static = value(e, "static", false);
        each(e, "link", [&](const sdf::ElementPtr& l) { model.links.push_back(read_link(l)); });
        each_model(e, model.models, [](const sdf::ElementPtr&) {});
        each(e, "joint", [&](const sdf::ElementPtr& j) { read_joint(j, model); });
        read_plugins(e, model);
        return model;
    }

    void read_plugins(const sdf::ElementPtr& e, Model& model) {
        each(e, "plugin", [&](const sdf::ElementPtr& p) {
            model.plugins.push_back({at(p), name_of(p), p->Get<std::string>("filename")});
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

    /// A plugin's children are not in the format: they come as text.
    GameRules read_game(const sdf::ElementPtr& e) {
        GameRules rules;
        rules.where = at(e);
        // The library does not say where they stand.
        const std::string& file = rules.where.file->text;
        std::size_t cursor = 0;
        for (int line = 1; line < rules.where.line; ++line) cursor = file.find('\n', cursor) + 1;
        Location place = rules.where;
        const auto next = [&](const std::string& name) {
            const auto found = file.find("<" + name, cursor);
            if (found == std::string::npos) return;
            cursor = found + 1;
            place.line =
                1 + static_cast<int>(std::count(file.begin(), file.begin() + static_cast<long>(found), '\n'));
            place.column = static_cast<int>(found - (file.rfind('\n', found) + 1)) + 1;
        };
        const std::vector<std::string> known = {
            "duration", "stale_after", "dissolves_after", "points", "penalty", "most", "site"};
        for (auto c = e->GetFirstElement(); c; c = c->GetNextElement()) {
            const std::string name = c->GetName(), text = c->Get<std::string>();
            next(name);
            std::istringstream in(text);
            std::vector<double> v;
            for (double number; in >> number;) v.push_back(number);
            const std::size_t wanted = name == "site" ? 3 : 1;
            if (std::find(known.begin(), known.end(), name) == known.end()) {
                diagnostics_.error(place, fmt::format("<{}> is no rule of a game", name),
                                   suggest(name, known));
            } else if (v.size() != wanted || !in.eof()) {
                diagnostics_.error(
                    place, fmt::format("<{}> cannot be '{}'", name, text),
                    wanted == 3 ? "a site is x y chance: m, m, and how likely a resource appears in a second"
                                : "a number is expected here");
            } else if (name == "site") {
                if (!(v[2] >= 0 && v[2] <= 1))
                    diagnostics_.error(place, fmt::format("a chance of {} is not from 0 to 1", v[2]));
                rules.sites.push_back({v[0], v[1], v[2]});
            } else if (name == "points" || name == "penalty") {
                (name == "points" ? rules.points : rules.penalty) = static_cast<int>(v[0]);
            } else if (!(v[0] > 0 && v[0] <= 1e6)) {
                diagnostics_.error(place, fmt::format("<{}> must be above 0", name));
            } else if (name == "most") {
                rules.most = static_cast<int>(std::min(v[0], 200.0));
            } else {
                (name == "duration"      ? rules.duration
                 : name == "stale_after" ? rules.stale_after
                                         : rules.dissolves_after) = v[0];
            }
        }
        return rules;
    }

    WorldDescription read_world_element(const sdf::ElementPtr& e) {
        WorldDescription world;
        world.path = path_;
        if (const auto physics = child(e, {"physics"})) {
            world.step = value(physics, "max_step_size", 0.001);
            world.update_rate = value(physics, "real_time_update_rate", 1000.0);
            if (!(world.step > 0 && world.update_rate > 0))
                diagnostics_.error(at(physics), "max_step_size and real_time_update_rate must be positive");
            else if (!(world.step >= 1e-6 && world.step <= 1 && world.update_rate <= 1e6))
                diagnostics_.error(
                    at(physics), "max_step_size lies between 1e-6 and 1 s, real_time_update_rate below 1e6");
        }
        if (const auto ambient = child(e, {"scene", "ambient"}))
            world.ambient = ambient->Get<ignition::math::Color>().R();
        const auto read_light = [&](const sdf::ElementPtr& light) {
            if (light->Get<std::string>("type") != "directional") {
                diagnostics_.warning(at(light),
                                     "only directional lights are simulated; this one is left out");
            } else if (world.sun) {
                diagnostics_.warning(at(light),
                                     "there are several directional lights; the first one is used");
            } else {
                const auto d = value(light, "direction", ignition::math::Vector3d(0, 0, -1));
                if (!(d.Length() > 0))
                    diagnostics_.error(at(light), "a light needs a <direction> that is not 0");
                world.sun = -Eigen::Vector3d(d.X(), d.Y(), d.Z()).normalized();
            }
        };
        each(e, "light", read_light);
        each(e, "plugin", [&](const sdf::ElementPtr& p) {
            if (p->Get<std::string>("filename") == "libforage_game.so")
                world.game = read_game(p);
            else
                diagnostics_.warning(
                    at(p),
                    fmt::format("plugin '{}' of the world is not known here and does nothing",
                                p->Get<std::string>("filename")),
                    "known is libforage_game.so");
        });
        each_model(e, world.models, read_light);
        return world;
    }

    static constexpr int most_rays = 10'000;

    std::string path_;
    Diagnostics& diagnostics_;
    ModelFolders folders_;
    SdfParser parser_;
    std::map<std::string, Content> contents_;  ///< of the model files that were read
    std::set<std::string> open_;               ///< those that are being read
    bool no_models_ = false;
};

/// Whether a file can be a world; says what it is when it is something else.
bool looks_like_a_world(const std::string& path, Diagnostics& diagnostics) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
        std::set<std::string> worlds;
        for (fs::directory_iterator entry(path, ignored), end; !ignored && entry != end;
             entry.increment(ignored))
            if (entry->path().extension() == ".world") worlds.insert(entry->path().string());
        diagnostics.error({}, fmt::format("'{}' is a folder, not a world file", path),
                          worlds.empty() ? "give the path of a .world file"
                                         : fmt::format("in it are {}", fmt::join(worlds, ", ")));
        return false;
    }
    const auto text = read_text(path);
    if (!text) {
        diagnostics.error({}, fmt::format("cannot read the world file '{}'", path), "is the path right?");
        return false;
    }
    const bool png = text->starts_with("\x89PNG");
    if (png || text->substr(0, 1000).find('\0') != std::string::npos) {
        diagnostics.error(
            {}, fmt::format("'{}' is {}, not a world file", path, png ? "a PNG picture" : "a binary file"),
            "a world is a text file: SDF, an XML format");
        return false;
    }
    if (text->find_first_not_of(" \t\r\n") == std::string::npos) {
        diagnostics.error({}, fmt::format("the world file '{}' is empty", path));
        return false;
    }
    const std::string root = root_name(*text);
    const Location file{std::make_shared<SourceFile>(SourceFile{path, {}}), 0, 0};
    if (root == "System")
        diagnostics.error(
            file, "this is a system file; a world is wanted here",
            "a world is an SDF file, with the ending .world: the robot, its arena and the lights");
    else if (root.empty())
        diagnostics.error(file, "there is no XML in this file",
                          "a world is an SDF file, with the ending .world");
    else if (root != "sdf" && root != "gazebo")
        diagnostics.error(file, fmt::format("the root element is <{}>; that of a world is <sdf>", root));
    else
        return true;
    return false;
}

}  // namespace

std::optional<WorldDescription> read_world(const std::string& path, Diagnostics& diagnostics,
                                           const std::vector<std::string>& extra_model_dirs) {
    if (!looks_like_a_world(path, diagnostics)) return {};
    return Reader(path, diagnostics, extra_model_dirs).read();
}

}  // namespace forage::bug
