// Changes to the text of a world file, in which everything else stays as its author wrote it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage::bug {

/// Something that stands in a world: a model, an included model or a light, known by its name.
struct WorldItem {
    std::string name;
    std::string kind;  ///< robot, light, start, floor, wall, patch, object, sun or other: what it seems to be
    std::string uri;   ///< of an included model; else empty
    double x = 0, y = 0, z = 0, yaw = 0;  ///< m and rad
    /// Width and depth of a model of one box, or the radius of one cylinder or sphere, m. Empty when it is of
    /// another form, or included.
    std::vector<double> size;
};

/// What stands directly in the world of a well-formed text, in file order.
std::vector<WorldItem> items_of_world(std::string_view text);

/// The kinds that add_to_world() makes.
std::vector<std::string> kinds_of_items();

struct NewItem {
    std::string kind, name;                  ///< an empty name is made from the kind
    double x = 0, y = 0, yaw = 0;            ///< m and rad
    double width = 1, depth = 0.2;           ///< of a wall or patch, m
    double radius = 0.2;                     ///< of a pillar or ball, m
    std::string color = "#808080";           ///< of a wall, pillar, patch or ball
    std::string uri = "model://forage_bug";  ///< of a robot
};
/// The text with an item more. `name` becomes its name. Throws std::invalid_argument for an unknown kind and
/// for a name that is taken.
std::string add_to_world(const std::string& text, NewItem item, std::string& name);

// Each of these throws std::invalid_argument when nothing in the world has the name.
std::string removed_from_world(const std::string& text, std::string_view name);
/// Moves an item. Without a yaw it keeps its direction; its height always stays.
std::string moved_in_world(const std::string& text, std::string_view name, double x, double y,
                           std::optional<double> yaw);
/// Changes the width and depth of all boxes of a model, or the radius of its cylinders and spheres. Throws
/// std::invalid_argument for an item that is included, too.
std::string resized_in_world(const std::string& text, std::string_view name, const std::vector<double>& size);
std::string renamed_in_world(const std::string& text, std::string_view name, const std::string& new_name);

/// Reports what is wrong with the form of a text of the file `path`.
void check_world_text(const std::string& path, const std::string& text, Diagnostics& diagnostics);

}  // namespace forage::bug
