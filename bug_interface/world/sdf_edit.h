// Changes to the text of a world file, in which everything else stays as its author wrote it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bug_interface/world/model_texts.h"
#include "core/base/diagnostic.h"

namespace forage::bug {

/// A value of an item, for a form.
struct ItemProperty {
    std::string name, label;
    std::string kind = "number";  ///< number, integer, boolean (1 or 0), color (#rrggbb), choice or text
    std::string value;
    std::optional<double> low, high;  ///< limits of a number
    std::vector<std::string> choices;
};

/// A shape of an item as it is seen from above, in the item's frame: m and rad.
struct ItemPart {
    double x = 0, y = 0, yaw = 0;
    std::vector<double> size;  ///< width and depth of a box, or the radius of a cylinder or sphere
    std::string color;         ///< #rrggbb; empty when it has none
};

/// Something in a world that can be edited: a model, an included model, a light, the rules of a game or of
/// trials, a site of a game, or the world itself.
struct WorldItem {
    std::string id;  ///< its name; with a number when several have the same one
    std::string name;
    /// What it seems to be: robot, light, start, home, resource, object, patch, wall, floor, sun, site, game,
    /// trials, world, or other.
    std::string kind;
    bool placed = true;                   ///< whether it stands at a place
    bool unpacks = false;                 ///< whether unpacked_in_world() can do something to it
    double x = 0, y = 0, z = 0, yaw = 0;  ///< m and rad
    std::vector<ItemPart> parts;
    std::vector<ItemProperty> properties;
};

/// What can be edited in a well-formed text: the world, and what is in it, in file order.
std::vector<WorldItem> items_of_world(std::string_view text, ModelTexts& models);

/// A kind that add_to_world() makes, a sentence about it, and the heading of the kinds like it.
struct ItemKind {
    std::string_view kind, title, group;
};
/// The kinds by their headings.
std::vector<ItemKind> kinds_of_items();

struct NewItem {
    std::string kind, name;                                     ///< an empty name is made from the kind
    double x = 0, y = 0, yaw = 0;                               ///< m and rad
    std::optional<double> width = {}, depth = {}, radius = {};  ///< m; else as usual for the kind
    std::string color = {};                                     ///< #rrggbb; else as usual for the kind
    std::string uri = {};  ///< of a robot or model; else the first that is found
};
/// The text with an item more. `id` becomes its id. The first start pose brings a floor whose bounds end
/// trials, when the world has none. Throws std::invalid_argument for an unknown kind, for a
/// name that is taken, for a second one of what a world has once, and for a start pose outside of the bounds.
std::string add_to_world(const std::string& text, NewItem item, ModelTexts& models, std::string& id);

// Each of these throws std::invalid_argument when nothing in the world has the id.
std::string removed_from_world(const std::string& text, std::string_view id, ModelTexts& models);
/// Moves an item. Without a yaw it keeps its direction; its height always stays.
std::string moved_in_world(const std::string& text, std::string_view id, double x, double y,
                           std::optional<double> yaw, ModelTexts& models);
/// Gives a property of an item another value. An included model whose shape or colour changes becomes a model
/// of this file first. Throws std::invalid_argument for a property that the item does not have, and for a
/// value that it cannot have. `id` becomes the id that the item has then.
std::string set_in_world(const std::string& text, std::string& id, std::string_view property,
                         const std::string& value, ModelTexts& models);
/// Replaces an included model by its text, and fixed models of several links by a model per link, so that
/// each can be edited. The world stays the same. `ids` become those of the models.
std::string unpacked_in_world(const std::string& text, std::string_view id, ModelTexts& models,
                              std::vector<std::string>& ids);

/// Reports what is wrong with the form of a text of the file `path`.
void check_world_text(const std::string& path, const std::string& text, Diagnostics& diagnostics);

}  // namespace forage::bug
