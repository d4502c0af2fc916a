#include "bug_interface/world/sdf_new_items.h"

#include <stdexcept>

#include <fmt/format.h>

#include "bug_interface/world/sdf_properties.h"

namespace forage::bug {
namespace {

/// A shape of a model: what it is made of, and the height of its middle, m.
struct Block {
    std::string geometry;
    double z = 0;
};

std::string box(double width, double depth, double height) {
    return fmt::format("<box><size>{} {} {}</size></box>", number_text(width), number_text(depth),
                       number_text(height));
}
std::string cylinder(double radius, double length) {
    return fmt::format("<cylinder><radius>{}</radius><length>{}</length></cylinder>", number_text(radius),
                       number_text(length));
}
std::string sphere(double radius) {
    return fmt::format("<sphere><radius>{}</radius></sphere>", number_text(radius));
}
std::string plane() { return "<plane><normal>0 0 1</normal><size>20 20</size></plane>"; }

/// A geometry at the height `z` in its link.
std::string raised(const std::string& geometry, double z) {
    const auto pose = z == 0 ? std::string() : fmt::format("<pose>0 0 {} 0 0 0</pose>", number_text(z));
    return fmt::format("{}<geometry>{}</geometry>", pose, geometry);
}
std::string collision(const std::string& geometry, double z = 0, const std::string& name = "collision") {
    return fmt::format("<collision name=\"{}\">{}</collision>", name, raised(geometry, z));
}
std::string visual(const std::string& geometry, const std::string& color, double z = 0) {
    return fmt::format(
        "<visual "
        "name=\"visual\">{0}<material><ambient>{1}</ambient><diffuse>{1}</diffuse></material></visual>",
        raised(geometry, z), colour_text(color));
}

std::string model(const NewItem& item, const std::string& more, double z, const std::string& link) {
    return fmt::format(
        "<model name=\"{}\"><pose>{} {} 0 0 0 {}</pose>{}<link name=\"body\"><pose>0 0 {} 0 0 0</pose>{}"
        "</link></model>",
        xml::encoded(item.name), number_text(item.x), number_text(item.y), number_text(item.yaw), more,
        number_text(z), link);
}
std::string fixed(const NewItem& item, double z, const std::string& link) {
    return model(item, "<static>true</static>", z, link);
}
std::string obstacle(const NewItem& item, const Block& s, const std::string& color) {
    return fixed(item, s.z, collision(s.geometry) + visual(s.geometry, color));
}
std::string paint(const NewItem& item, const Block& s, const std::string& color) {
    return fixed(item, s.z, visual(s.geometry, color));
}
std::string movable(const NewItem& item, const Block& s, const std::string& color, const char* mass,
                    const char* more = "") {
    return model(item, more, s.z,
                 fmt::format("<inertial><mass>{}</mass></inertial>", mass) + collision(s.geometry) +
                     visual(s.geometry, color));
}

std::string included(const NewItem& item, const std::string& uri) {
    return fmt::format("<include><name>{}</name><uri>{}</uri><pose>{} {} 0 0 0 {}</pose></include>",
                       xml::encoded(item.name), xml::encoded(uri), number_text(item.x), number_text(item.y),
                       number_text(item.yaw));
}

/// The robot of Forage or of the original when there is one, else the first robot of the models.
std::string robot_uri(ModelTexts& models) {
    for (const char* uri : {"model://forage_bug", "model://DAC_Bug"})
        if (!models.of(uri).empty()) return uri;
    for (const auto& uri : models.uris())
        if (models.of(uri).find("libvel_plugin.so") != std::string::npos) return uri;
    throw std::invalid_argument("no model of a robot is found");
}

std::string model_uri(const ModelTexts& models) {
    const auto uris = models.uris();
    if (uris.empty()) throw std::invalid_argument("no models are found");
    return uris.front();
}

}  // namespace

std::vector<ItemKind> kinds_of_items() {
    constexpr std::string_view robots = "Robots", obstacles = "Obstacles", floors = "Floor",
                               targets = "Targets", rules = "Rules and light";
    return {{"robot", "A robot that a system drives; its model is chosen below", robots},
            {"start",
             "A pose in which trials begin: Reset_0 to Reset_9. The first brings a GroundPlane, whose bounds "
             "end trials",
             robots},
            {"wall", "A box that robots cannot pass", obstacles},
            {"pillar", "A cylinder that robots cannot pass", obstacles},
            {"ball", "A ball that robots push", obstacles},
            {"crate", "A box that robots push", obstacles},
            {"model", "Any model of the folders of models; it is chosen below", obstacles},
            {"patch", "A rectangle of colour on the floor", floors},
            {"disc", "A round patch of colour on the floor", floors},
            {"floor", "A floor whose bounds end trials: GroundPlane", floors},
            {"light", "A target: robots see its light from afar and drive under it; reaching it ends a trial",
             targets},
            {"goal", "A target as a light is, which cameras see, too: a cylinder above the robots", targets},
            {"resource", "A ball that counts when it is brought to a home", targets},
            {"home", "Where a team brings resources: Home_A and Home_B", targets},
            {"site", "Where resources of a game appear", targets},
            {"trials", "Rules of trials: when they end", rules},
            {"game", "Rules of a game of two teams", rules},
            {"sun", "The light that lights everything from one direction", rules}};
}

std::string new_item_text(const NewItem& item, bool has_floor, ModelTexts& models) {
    const auto& kind = item.kind;
    const auto color = [&](const char* usual) { return item.color.empty() ? usual : item.color; };
    const auto width = [&](double usual) { return item.width.value_or(usual); };
    const auto depth = [&](double usual) { return item.depth.value_or(usual); };
    const auto radius = [&](double usual) { return item.radius.value_or(usual); };
    constexpr const char* dark = "#303030";  // stands out from grey floors
    if (kind == "wall") return obstacle(item, {box(width(1), depth(0.2), 0.25), 0.125}, color(dark));
    if (kind == "pillar") return obstacle(item, {cylinder(radius(0.2), 0.25), 0.125}, color(dark));
    // Paint lies just above the floor.
    if (kind == "patch") return paint(item, {box(width(1), depth(1), 0.002), 0.002}, color("#ff0000"));
    if (kind == "disc") return paint(item, {cylinder(radius(0.5), 0.002), 0.002}, color("#00ff00"));
    if (kind == "ball") return movable(item, {sphere(radius(0.1)), radius(0.1)}, color("#0000ff"), "0.05");
    if (kind == "crate")
        return movable(item, {box(width(0.3), depth(0.3), 0.2), 0.1}, color("#ff8000"), "0.5");
    if (kind == "resource")
        return movable(item, {sphere(radius(0.08)), radius(0.08)}, color("#0000ff"), "0.01",
                       "<plugin name=\"resource\" filename=\"libtarget_plugin.so\"/>");
    if (kind == "light")  // above proximity sensors and robots; the camera sees a disc
        return fixed(item, 0,
                     collision(cylinder(radius(0.25), 0.25), 0.35) +
                         visual(cylinder(radius(0.25), 0.01), color("#ffffff")));
    if (kind == "goal")
        return fixed(item, 0,
                     collision(cylinder(radius(0.3), 0.5), 0.5) +
                         visual(cylinder(radius(0.3), 0.6), color("#00ff00"), 0.3));
    if (kind == "home") return paint(item, {cylinder(radius(3), 0.0001), 0.002}, color("#000000"));
    if (kind == "start") return paint(item, {cylinder(radius(0.2), 0.0001), 0.002}, color("#b3b3b3"));
    if (kind == "floor")  // the bounds are the last collision, below everything
        return fixed(item, 0,
                     collision(plane(), 0, "floor") +
                         (has_floor && item.color.empty() ? "" : visual(plane(), color("#b3b3b3"))) +
                         collision(box(width(5), depth(5), 0.02), -1, "bounds"));
    if (kind == "robot") return included(item, item.uri.empty() ? robot_uri(models) : item.uri);
    if (kind == "model") return included(item, item.uri.empty() ? model_uri(models) : item.uri);
    if (kind == "sun")
        return fmt::format(
            "<light name=\"{}\" type=\"directional\"><direction>-0.5 0.1 -0.9</direction></light>",
            xml::encoded(item.name));
    if (kind == "trials")
        return "<plugin name=\"trials\" "
               "filename=\"libforage_trials.so\"><reach>0.45</reach><duration>60</duration></plugin>";
    if (kind == "game")
        return "<plugin name=\"game\" filename=\"libforage_game.so\"><duration>300</duration></plugin>";
    if (kind == "site")
        return fmt::format("<site>{} {} 0.1</site>", number_text(item.x), number_text(item.y));
    throw std::invalid_argument(fmt::format("'{}' is not a kind of item", kind));
}

}  // namespace forage::bug
