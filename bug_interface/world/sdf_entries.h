// What an editor of a world file works on: its models, lights, rules, and the world itself, with their
// places.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bug_interface/world/model_texts.h"
#include "bug_interface/world/sdf_text.h"

namespace forage::bug {

/// The element that says what an item is: it stands in the world's text, or in that of an included model.
struct ItemElement {
    std::string_view text;
    xml::SourceElement root;  ///< of the model's file; unused when the element stands in the world
    const xml::SourceElement* element = nullptr;  ///< a <model> or <light>; null when the model is not found
    ItemElement() = default;
    ItemElement(ItemElement&&) = default;  // a copy would point into the tree of the original
    ItemElement& operator=(ItemElement&&) = default;
};

struct Entry {
    enum class Form { include, model, light, game, trials, site, world } form = Form::model;
    std::string id;  ///< its name; with a number when several have the same one
    std::string name;
    std::string kind;  ///< see WorldItem::kind
    const xml::SourceElement* element = nullptr;
    ItemElement body = {};                      ///< of a model or light
    const xml::SourceElement* state = nullptr;  ///< the <model> in <state> whose <pose> counts, or null

    /// Whether it stands at a place of the floor that its own numbers tell.
    bool placed() const {
        const auto* pose = form == Form::site ? nullptr : child(placed_by(), "pose");
        for (const char* attribute : {"relative_to", "frame"})
            if (pose && !pose->value(attribute).empty() && pose->value(attribute) != "world") return false;
        return form == Form::include ? kind != "sun" : form == Form::model || form == Form::site;
    }
    bool is_model() const { return form == Form::include || form == Form::model; }
    /// The element whose <pose> says where it stands.
    const xml::SourceElement& placed_by() const { return state ? *state : *element; }
    /// The pose in the world: that in <state>, its own, or that of the included model's file.
    PoseText pose(std::string_view text) const;
};

/// The world itself, and what is in it, in file order. The text and the tree must outlive the result.
std::vector<Entry> entries_of(std::string_view text, const WorldTree& tree, ModelTexts& models);

/// A shape of a model in its frame.
struct Form {
    const xml::SourceElement* link;
    const xml::SourceElement* owner;  ///< its <collision> or <visual>
    const xml::SourceElement* shape;  ///< <box>, <cylinder> or <sphere>
    PoseText pose;                    ///< in the model; without the tilt of the link
};
/// The shapes of a model's own links, without planes: of the elements `owner`, "collision" or "visual".
std::vector<Form> forms_of(const ItemElement& body, std::string_view owner);
/// The extents of a shape: three of a box; the radius, and of a cylinder the length.
std::vector<double> extents(std::string_view text, const xml::SourceElement& shape);

/// The colour of a <visual> as #rrggbb; empty when its surface is a picture.
std::string colour_of(std::string_view text, const xml::SourceElement& visual);

}  // namespace forage::bug
