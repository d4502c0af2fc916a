// What the diagram needs and the format of the original has no place for: comments on a page, places of
// phantoms of groups of other processes, and vertices on the pages of two processes. It stands in XML
// comments, which every reader of XML skips, in the form of an element:
//
//     <!-- forage:comment id="comment" x="20" y="30" width="120" height="40" text="Why" -->
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/model/system.h"

namespace forage::xml {

/// Vertices of a connection between processes, on the page of its source or of its target.
struct PageVertices {
    bool of_target = false;
    std::vector<model::Point> points;
};
using CanvasPart = std::variant<model::CanvasComment, model::Phantom, PageVertices>;

/// Whether an XML comment, without `<!--` and `-->`, begins as a part of the diagram.
bool begins_canvas_part(std::string_view comment);
/// The part of the diagram that an XML comment holds. Empty when it holds none, or one with a mistake.
std::optional<CanvasPart> read_canvas_part(std::string_view comment);
/// The XML comment of a part of the diagram, without `<!--` and `-->`.
std::string write_canvas_part(const CanvasPart& part);
/// The forms of the parts, for hints.
std::string canvas_forms();

}  // namespace forage::xml
