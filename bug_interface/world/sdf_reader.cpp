#include "bug_interface/world/sdf_reader.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <mutex>
#include <regex>
#include <sdf/sdf.hh>
#include <sstream>

#include "bug_interface/world/material.h"

namespace forage::bug {
namespace {

namespace fs = std::filesystem;

/// Collects what is written to std::cerr: the library reports its reasons only there, and we print them ourselves.
class CapturedErrors {
  public:
    CapturedErrors() : before_(std::cerr.rdbuf(text_.rdbuf())) {}
    ~CapturedErrors() { std::cerr.rdbuf(before_); }
    CapturedErrors(const CapturedErrors&) = delete;
    CapturedErrors& operator=(const CapturedErrors&) = delete;
    std::string text() const { return std::regex_replace(text_.str(), std::regex("\x1b\\[[0-9;]*m"), ""); }

  private:
    std::ostringstream text_;
    std::streambuf* before_;
};

/// The library opens a log file below $HOME when its console is first used, and has no switch against that. It goes
/// without one when the directory cannot be made, so HOME points elsewhere during this one call.
void make_console_without_log_file() {
    static std::once_flag done;
    std::call_once(done, [] {
        const char* home = std::getenv("HOME");
        const std::optional<std::string> before = home ? std::optional<std::string>(home) : std::nullopt;
        setenv("HOME", "/dev/null", 1);
        sdf::Console::Instance();
        if (before) setenv("HOME", before->c_str(), 1);
        else unsetenv("HOME");
    });
}

/// The library's schema takes 30 ms to set up; a copy of it does not.
sdf::SDFPtr empty_document() {
    auto document = std::make_shared<sdf::SDF>();
    sdf::init(document);
    return document;
}

std::vector<std::string> split_path(const char* list) {
    std::vector<std::string> out;
    std::istringstream in(list ? list : "");
    for (std::string entry; std::getline(in, entry, ':');)
        if (!entry.empty()) out.push_back(entry);
    return out;
}

std::optional<std::string> read_text(const fs::path& path) {
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) return {};
    std::ifstream in(path, std::ios::binary);
    if (!in) return {};
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

class Reader {
  public:
    Reader(const std::string& path, Diagnostics& diagnostics, const std::vector<std::string>& extra)
        : path_(path), diagnostics_(diagnostics), directories_(extra) {
        const fs::path beside = fs::path(path).parent_path();
        directories_.push_back((beside / "models").string());
        directories_.push_back((beside / ".." / "models").string());
        for (const char* variable : {"FORAGE_MODEL_PATH", "GAZEBO_MODEL_PATH"})
            for (auto& entry : split_path(std::getenv(variable))) directories_.push_back(std::move(entry));
    }

    std::optional<WorldDescription> read() {
        const int errors_before = diagnostics_.errors();
        if (!read_text(path_)) {
            diagnostics_.error({}, fmt::format("cannot read the world file '{}'", path_), "is the path right?");
            return {};
        }
        const sdf::SDFPtr document = parse();
        if (diagnostics_.errors() > errors_before) return {};
        const sdf::ElementPtr root = document->Root();
        if (!root || !root->HasElement("world")) {
            diagnostics_.error(at(path_, 1), "the file has no <world>", "a world file is <sdf><world name=\"..\">..</world></sdf>");
            return {};
        }
        WorldDescription world = read_world_element(root->GetElement("world"));
        if (diagnostics_.errors() > errors_before) return {};
        return world;
    }

  private:
    // ---- the library ----

    sdf::SDFPtr parse() {
        make_console_without_log_file();
        const auto find = [this](const std::string& uri) { return find_model(uri); };
        CapturedErrors captured;
        // An include inside an included model is looked up through the global callback only.
        sdf::setFindCallback(find);
        const sdf::ParserConfig config = sdf::ParserConfig::GlobalConfig();
        const sdf::SDFPtr document = empty_document();
        sdf::Errors errors;
        const bool good = sdf::readFile(path_, config, document, errors);
        sdf::setFindCallback([](const std::string&) { return std::string(); });
        report(errors, captured.text(), good);
        return document;
    }

    std::string find_model(const std::string& uri) const {
        constexpr std::string_view scheme = "model://";
        if (!uri.starts_with(scheme)) return fs::exists(uri) ? uri : std::string();
        for (const auto& directory : directories_) {
            const fs::path candidate = fs::path(directory) / uri.substr(scheme.size());
            std::error_code ignored;
            if (fs::exists(candidate, ignored)) return candidate.string();
        }
        return {};
    }

    std::vector<std::string> known_models() const {
        std::vector<std::string> names;
        for (const auto& directory : directories_) {
            std::error_code ignored;
            for (fs::directory_iterator entry(directory, ignored), end; !ignored && entry != end; entry.increment(ignored))
                if (fs::exists(entry->path() / "model.config", ignored))
                    names.push_back("model://" + entry->path().filename().string());
        }
        std::sort(names.begin(), names.end());
        names.erase(std::unique(names.begin(), names.end()), names.end());
        return names;
    }

    void report(const sdf::Errors& errors, const std::string& console, bool good) {
        static const std::regex syntax(R"(Error parsing XML in file \[([^\]]*)\]: Error=(\w+) .*Line number=(\d+))");
        static const std::regex reason(R"(Error \[\w+\.cc:\d+\] (.*))");
        const int errors_before = diagnostics_.errors();
        std::smatch match;
        if (std::regex_search(console, match, syntax))
            diagnostics_.error(at(match[1], std::stoi(match[3])), "this is not well-formed XML (" + xml_reason(match[2]) + ")",
                               "every element needs its closing tag, every attribute its quotes");
        bool inside_chain = false;  // "Error reading element" is repeated for every parent
        for (const auto& e : errors) {
            const Location where = at(e.FilePath().value_or(path_), e.LineNumber().value_or(0));
            const std::string& message = e.Message();
            const bool chain = message.starts_with("Error reading element");
            if (chain && inside_chain) continue;
            inside_chain = chain;
            if (message.find("Unable to find uri") != std::string::npos) {
                const auto open = message.find('['), close = message.find(']', open);
                const std::string uri = message.substr(open + 1, close - open - 1);
                const auto names = known_models();
                diagnostics_.error(where, fmt::format("there is no model '{}'", uri),
                                   names.empty() ? "no models found; searched " + fmt::format("{}", fmt::join(directories_, ", "))
                                                 : suggest(uri, names));
                inside_chain = true;
            } else if (message.find("more than one model for <include>") != std::string::npos) {
                diagnostics_.warning(where, "the included file holds several models; the first one is used");
            } else if (chain && std::regex_search(console, match, reason)) {
                diagnostics_.error(where, message + ": " + std::string(match[1]));
            } else {
                diagnostics_.error(where, message);
            }
        }
        if (!good && diagnostics_.errors() == errors_before)
            diagnostics_.error(at(path_, 0), "the world file could not be read",
                               std::regex_search(console, match, reason) ? std::string(match[1]) : std::string());
    }

    static std::string xml_reason(std::string text) {
        if (text.starts_with("XML_ERROR_")) text.erase(0, 10);
        for (char& c : text) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return text;
    }

    // ---- places ----

    Location at(const std::string& file, int line) {
        auto& known = files_[file];
        if (!known) known = std::make_shared<SourceFile>(SourceFile{file, read_text(file).value_or("")});
        return {known, line, 0};
    }
    Location at(const sdf::ElementPtr& e) { return at(e->FilePath().empty() ? path_ : e->FilePath(), e->LineNumber().value_or(0)); }

    // ---- values ----

    template <class T>
    static T value(const sdf::ElementPtr& parent, const std::string& name, T otherwise) {
        return parent->HasElement(name) ? parent->GetElement(name)->Get<T>() : otherwise;
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

    Pose pose_of(const sdf::ElementPtr& parent) {
        if (!parent->HasElement("pose")) return Pose::Identity();
        const auto e = parent->GetElement("pose");
        if (e->HasAttribute("relative_to") && !e->Get<std::string>("relative_to").empty())
            diagnostics_.error(at(e), "poses relative to a named frame are not supported",
                               "give the pose relative to the enclosing element");
        const auto p = e->Get<ignition::math::Pose3d>();
        Pose pose = Pose::Identity();
        pose.translation() = Eigen::Vector3d(p.Pos().X(), p.Pos().Y(), p.Pos().Z());
        pose.linear() = Eigen::Quaterniond(p.Rot().W(), p.Rot().X(), p.Rot().Y(), p.Rot().Z()).toRotationMatrix();
        return pose;
    }

    Shape shape_of(const sdf::ElementPtr& parent) {
        Shape shape;
        const auto geometry = child(parent, {"geometry"});
        const auto kind = geometry ? geometry->GetFirstElement() : nullptr;
        if (!kind || kind->GetName() == "empty") {
            diagnostics_.error(at(parent), fmt::format("<{}> has no shape that is known here", parent->GetName()),
                               "the shapes are <plane>, <box>, <cylinder> and <sphere>");
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
        }
        if ((shape.size.array() < 0).any()) diagnostics_.error(at(kind), "a size is negative");
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
                diagnostics_.error(at(script), fmt::format("there is no material '{}'", name), suggest(name, material_names()));
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
        const std::string folder = find_model(uri);
        if (folder.empty()) {
            diagnostics_.error(at(script), fmt::format("there is no folder '{}'", uri), "it holds the .material script and its texture");
            return {};
        }
        std::vector<fs::path> places = {folder, fs::path(folder) / "scripts", fs::path(folder) / "textures",
                                        fs::path(folder).parent_path() / "textures"};
        std::string image;
        for (const auto& place : places) {
            std::error_code ignored;
            for (fs::directory_iterator entry(place, ignored), end; !ignored && entry != end; entry.increment(ignored))
                if (entry->path().extension() == ".material" && image.empty())
                    image = texture_in_script(read_text(entry->path()).value_or(""), name);
        }
        if (image.empty()) {
            diagnostics_.error(at(script), fmt::format("no script in '{}' gives material '{}' a texture", folder, name));
            return {};
        }
        for (const auto& place : places)
            if (fs::exists(place / image)) return (place / image).string();
        diagnostics_.error(at(script), fmt::format("the texture '{}' of material '{}' is missing in '{}'", image, name, folder));
        return {};
    }

    static double noise_of(const sdf::ElementPtr& e) {
        const auto stddev = child(e, {"noise", "stddev"});
        return stddev ? stddev->Get<double>() : 0.0;
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
                diagnostics_.error(s.where, fmt::format("ray sensor '{}' needs <ray> with <scan><horizontal> and <range>", s.name));
                return;
            }
            s.rays = value(scan, "samples", 1);
            s.first_angle = value(scan, "min_angle", 0.0), s.last_angle = value(scan, "max_angle", 0.0);
            s.min_range = value(range, "min", 0.0), s.max_range = value(range, "max", 1.0);
            s.noise = noise_of(ray);
            if (s.rays < 1 || !(s.max_range > s.min_range))
                diagnostics_.error(s.where, fmt::format("ray sensor '{}' needs at least one sample and min < max", s.name));
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
            if (const auto image = child(camera, {"image"})) s.width = value(image, "width", 32), s.height = value(image, "height", 28);
            if (const auto clip = child(camera, {"clip"})) s.far = value(clip, "far", 20.0);
            s.noise = noise_of(camera);
            if (s.width < 1 || s.height < 1 || s.width > 4096 || s.height > 4096)
                diagnostics_.error(s.where, fmt::format("camera '{}' has an impossible image size", s.name));
            if (!(s.horizontal_fov > 0 && s.horizontal_fov < 3.1))
                diagnostics_.error(s.where, fmt::format("camera '{}' needs a horizontal_fov between 0 and 3.1 rad", s.name));
            link.cameras.push_back(std::move(s));
        }
    }

    Link read_link(const sdf::ElementPtr& e) {
        Link link;
        link.where = at(e), link.name = name_of(e), link.pose = pose_of(e);
        if (const auto inertial = child(e, {"inertial"})) {
            link.mass = value(inertial, "mass", 1.0);
            if (const auto izz = child(inertial, {"inertia", "izz"})) link.inertia_z = izz->Get<double>();
            if (!(link.mass > 0 && link.inertia_z > 0)) diagnostics_.error(at(inertial), "mass and inertia must be positive");
        }
        each(e, "collision", [&](const sdf::ElementPtr& c) {
            const auto mu = child(c, {"surface", "friction", "ode", "mu"});
            link.collisions.push_back({at(c), name_of(c), pose_of(c), shape_of(c), mu ? mu->Get<double>() : 1.0});
        });
        each(e, "visual", [&](const sdf::ElementPtr& v) {
            link.visuals.push_back({at(v), name_of(v), pose_of(v), shape_of(v), material_of(v)});
        });
        each(e, "sensor", [&](const sdf::ElementPtr& s) { read_sensor(s, link); });
        return link;
    }

    Model read_model(const sdf::ElementPtr& e) {
        Model model;
        model.where = at(e), model.name = name_of(e), model.pose = pose_of(e);
        model.is_static = value(e, "static", false);
        each(e, "link", [&](const sdf::ElementPtr& l) { model.links.push_back(read_link(l)); });
        each(e, "model", [&](const sdf::ElementPtr& m) { model.models.push_back(read_model(m)); });
        each(e, "plugin", [&](const sdf::ElementPtr& p) {
            model.plugins.push_back({at(p), name_of(p), p->Get<std::string>("filename")});
        });
        return model;
    }

    WorldDescription read_world_element(const sdf::ElementPtr& e) {
        WorldDescription world;
        world.path = path_;
        if (const auto physics = child(e, {"physics"})) {
            world.step = value(physics, "max_step_size", 0.001);
            world.update_rate = value(physics, "real_time_update_rate", 1000.0);
            if (!(world.step > 0 && world.update_rate > 0))
                diagnostics_.error(at(physics), "max_step_size and real_time_update_rate must be positive");
        }
        if (const auto ambient = child(e, {"scene", "ambient"})) world.ambient = ambient->Get<ignition::math::Color>().R();
        each(e, "light", [&](const sdf::ElementPtr& light) {
            if (light->Get<std::string>("type") != "directional") {
                diagnostics_.warning(at(light), "only directional lights are simulated; this one is left out");
            } else if (world.sun) {
                diagnostics_.warning(at(light), "there are several directional lights; the first one is used");
            } else {
                const auto d = value(light, "direction", ignition::math::Vector3d(0, 0, -1));
                world.sun = -Eigen::Vector3d(d.X(), d.Y(), d.Z()).normalized();
            }
        });
        each(e, "model", [&](const sdf::ElementPtr& m) { world.models.push_back(read_model(m)); });
        return world;
    }

    std::string path_;
    Diagnostics& diagnostics_;
    std::vector<std::string> directories_;
    std::map<std::string, std::shared_ptr<const SourceFile>> files_;
};

}  // namespace

std::optional<WorldDescription> read_world(const std::string& path, Diagnostics& diagnostics,
                                           const std::vector<std::string>& extra_model_dirs) {
    return Reader(path, diagnostics, extra_model_dirs).read();
}

}  // namespace forage::bug
