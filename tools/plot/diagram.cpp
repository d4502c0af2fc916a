#include "tools/plot/diagram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "core/model/lookup.h"
#include "tools/plot/axes.h"
#include "tools/plot/layers.h"

namespace forage::plot {
namespace {

constexpr double diagram_scale = 1.7;  ///< pixels per unit of the file; leaves room for names
constexpr double sheet_margin = 26, heading = 34, name_size = 11, small_size = 10;

struct Point2 {
    double x, y;
};

/// The colours of the original.
Colour colour_of(InputKind kind) {
    switch (kind) {
        case InputKind::excitatory:
            return {0.78, 0.10, 0.10};
        case InputKind::inhibitory:
            return {0.10, 0.25, 0.75};
        case InputKind::modulatory:
            break;
    }
    return {0.05, 0.50, 0.20};
}

struct Node {
    Box box;
    std::string name, size, below;  ///< `size` is shown inside the box, `below` underneath
    bool process = false, outside = false, disabled = false;

    Point2 centre() const { return {box.x + box.width / 2, box.y + box.height / 2}; }
    /// One of the 16 points around the icon, four per side: above, right, below, left; numbered to the right
    /// and downwards.
    Point2 anchor(int n) const {
        const double part = (n % 4 + 0.5) / 4;
        switch ((n / 4) % 4) {
            case 0:
                return {box.x + part * box.width, box.y};
            case 1:
                return {box.right(), box.y + part * box.height};
            case 2:
                return {box.x + part * box.width, box.bottom()};
            default:
                return {box.x, box.y + part * box.height};
        }
    }
    /// The point where the line from the centre to `p` leaves the box.
    Point2 border(Point2 p) const {
        const Point2 c = centre();
        const double dx = p.x - c.x, dy = p.y - c.y;
        const double f = std::min(dx == 0 ? 1e9 : box.width / 2 / std::abs(dx),
                                  dy == 0 ? 1e9 : box.height / 2 / std::abs(dy));
        return {c.x + f * dx, c.y + f * dy};
    }
};

struct Edge {
    std::vector<Point2> points;
    InputKind kind;
    std::string label;
};

/// A comment on the page.
struct Remark {
    Box box;
    std::string text;
    Colour colour;
};

struct DiagramSheet {
    std::string title;
    std::vector<Remark> remarks;
    std::vector<Node> nodes;
    std::vector<Edge> edges;
    Box extent{};

    /// Moves everything so that it begins at (sheet_margin, heading).
    void fit(Canvas& measure) {
        double x0 = std::numeric_limits<double>::max(), y0 = x0, x1 = -x0, y1 = -x0;
        const auto take = [&](double x, double y) {
            x0 = std::min(x0, x), y0 = std::min(y0, y), x1 = std::max(x1, x), y1 = std::max(y1, y);
        };
        for (const auto& n : nodes) {
            const double half = std::max(n.box.width, measure.width_of(n.below, small_size)) / 2;
            take(n.centre().x - half, n.box.y), take(n.centre().x + half, n.box.bottom() + 14);
        }
        for (const auto& e : edges)
            for (const auto& p : e.points) take(p.x, p.y);
        for (const auto& r : remarks) take(r.box.x, r.box.y), take(r.box.right(), r.box.bottom());
        if (nodes.empty()) take(0, 0), take(120, 20);
        const double dx = sheet_margin - x0, dy = heading + sheet_margin - y0;
        for (auto& n : nodes) n.box.x += dx, n.box.y += dy;
        for (auto& r : remarks) r.box.x += dx, r.box.y += dy;
        for (auto& e : edges)
            for (auto& p : e.points) p.x += dx, p.y += dy;
        extent.width =
            std::max(x1 - x0 + 2 * sheet_margin, 2 * sheet_margin + measure.width_of(title, 14, true));
        extent.height = y1 - y0 + 2 * sheet_margin + heading;
    }
};

/// Breaks `text` into lines that are at most `width` wide.
std::vector<std::string> lines_of(Canvas& canvas, const std::string& text, double width) {
    std::vector<std::string> out;
    std::string line;
    for (std::size_t at = 0; at <= text.size();) {
        const auto end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        const std::string longer = line.empty() ? word : line + " " + word;
        if (!line.empty() && canvas.width_of(longer, name_size) > width)
            out.push_back(line), line = word;
        else
            line = longer;
        at = end + 1;
    }
    out.push_back(line);
    for (auto& l : out) l = canvas.fitted(l, name_size, width);
    return out;
}

void draw(Canvas& canvas, const Node& n) {
    if (n.outside || n.disabled) canvas.dashes(4, 3);
    canvas.fill(n.box.x, n.box.y, n.box.width, n.box.height, n.outside ? Colour{0.96, 0.96, 0.96} : white);
    cairo_rectangle(canvas.cairo(), n.box.x, n.box.y, n.box.width, n.box.height);
    canvas.stroke(n.outside ? grey : black, n.process ? 2.5 : 1);
    canvas.dashes(0, 0);
    auto lines = lines_of(canvas, n.name, n.box.width - 6);
    lines.resize(std::min(lines.size(), static_cast<std::size_t>(std::max(1.0, n.box.height / 14 - 1))));
    double y = n.centre().y - static_cast<double>(lines.size()) * 7 + 4;
    for (const auto& line : lines) {
        canvas.text(n.centre().x, y, line, name_size, 0.5, n.outside ? grey : black);
        y += 14;
    }
    canvas.text(n.centre().x, y + 1, n.size, small_size, 0.5, grey);
    if (n.below.empty()) return;
    const double half = canvas.width_of(n.below, small_size) / 2 + 2;
    canvas.fill(n.centre().x - half, n.box.bottom() + 3, 2 * half, 13, white);
    canvas.text(n.centre().x, n.box.bottom() + 13, n.below, small_size, 0.5, grey);
}

void draw(Canvas& canvas, const Edge& e) {
    cairo_t* c = canvas.cairo();
    cairo_set_line_join(c, CAIRO_LINE_JOIN_ROUND);
    for (const auto& p : e.points) cairo_line_to(c, p.x, p.y);
    canvas.stroke(colour_of(e.kind), 1.3);
    const Point2 tip = e.points.back(), before = e.points[e.points.size() - 2];
    const double angle = std::atan2(tip.y - before.y, tip.x - before.x);
    cairo_move_to(c, tip.x, tip.y);
    for (const double turn : {2.75, -2.75})
        cairo_line_to(c, tip.x + 10 * std::cos(angle + turn), tip.y + 10 * std::sin(angle + turn));
    cairo_close_path(c);
    cairo_fill(c);
    if (e.label.empty()) return;
    const Point2 from = e.points.front();
    const double x = (from.x + tip.x) / 2, y = (from.y + tip.y) / 2,
                 half = canvas.width_of(e.label, small_size) / 2;
    canvas.fill(x - half - 2, y - 7, 2 * half + 4, 13, white);
    canvas.text(x, y + 3.5, e.label, small_size, 0.5, colour_of(e.kind));
}

void draw(Canvas& canvas, const Remark& r) {
    canvas.fill(r.box.x, r.box.y, r.box.width, r.box.height, r.colour);
    const Colour ink = 0.3 * r.colour.r + 0.6 * r.colour.g + 0.1 * r.colour.b > 0.5 ? black : white;
    double y = r.box.y + 14;
    for (std::size_t at = 0; at <= r.text.size();) {
        const auto end = std::min(r.text.find('\n', at), r.text.size());
        for (const auto& line : lines_of(canvas, r.text.substr(at, end - at), r.box.width - 10)) {
            if (y > r.box.bottom() - 2) return;
            canvas.text(r.box.x + 5, y, line, name_size, 0, ink);
            y += 14;
        }
        at = end + 1;
    }
}

void draw(Canvas& canvas, const DiagramSheet& sheet) {
    canvas.text(sheet_margin, 22, sheet.title, 14, 0, black, true);
    for (const auto& r : sheet.remarks) draw(canvas, r);
    for (const auto& e : sheet.edges) draw(canvas, e);
    for (const auto& n : sheet.nodes) draw(canvas, n);
}

constexpr double box_side = 50 * diagram_scale;

Box box_of(const std::optional<model::Icon>& icon) {
    if (!icon) return {0, 0, box_side, box_side};  // place_in_layers() moves it
    return {icon->x * diagram_scale, icon->y * diagram_scale, std::max(icon->width, 20) * diagram_scale,
            std::max(icon->height, 20) * diagram_scale};
}

/// Moves `points` to the left of their direction.
void shift(std::vector<Point2>& points, double by) {
    const Point2 a = points.front(), b = points.back();
    const double length = std::max(std::hypot(b.x - a.x, b.y - a.y), 1.0);
    for (auto& p : points) p.x += (b.y - a.y) / length * by, p.y -= (b.x - a.x) / length * by;
}

/// Moves a point along the side of the box on which it lies.
void slide(Point2& p, const Box& box, double by) {
    if (p.x > box.x + 0.5 && p.x < box.right() - 0.5)
        p.x = std::min(p.x + by, box.right() - 4);
    else
        p.y = std::min(p.y + by, box.bottom() - 4);
}

/// The point of a box that is the nearest to `p`: straight below, above or beside, if the box reaches there.
Point2 nearest_on_border(const Box& box, Point2 p) {
    const double x = std::clamp(p.x, box.x + 12, box.right() - 12),
                 y = std::clamp(p.y, box.y + 12, box.bottom() - 12);
    if (p.y >= box.bottom()) return {x, box.bottom()};
    if (p.y <= box.y) return {x, box.y};
    return {p.x < box.x + box.width / 2 ? box.x : box.right(), y};
}

/// Loops above the upper right corner; further ones of a box are larger.
std::vector<Point2> loop(const Node& n, int number) {
    const double r = n.box.right(), t = n.box.y, by = 10.0 * number;
    return {{r - 10 - by, t},
            {r - 10 - by, t - 18 - by},
            {r + 18 + by, t - 18 - by},
            {r + 18 + by, t + 12 + by},
            {r, t + 12 + by}};
}

/// Adds the ends of an edge with these bends.
void end_at_borders(std::vector<Point2>& points, const Node& from, const Node& to) {
    const bool straight = points.empty();
    const Point2 start = from.border(straight ? to.centre() : points.front()),
                 end = to.border(straight ? from.centre() : points.back());
    points.insert(points.begin(), start);
    points.push_back(end);
}

/// Places the boxes of a sheet, and draws its edges between the pairs of boxes in `arrows`, which has one
/// pair per edge. Edges between the same boxes are side by side.
void place_in_layers(DiagramSheet& sheet, const std::vector<std::pair<std::size_t, std::size_t>>& arrows) {
    const Layers layers = layered(sheet.nodes.size(), arrows);
    const auto centre = [](const Layers::Place& p) {
        return Point2{p.column * 95 * diagram_scale, p.row * 95 * diagram_scale};
    };
    for (std::size_t i = 0; i < sheet.nodes.size(); ++i) {
        Box& box = sheet.nodes[i].box;
        const Point2 c = centre(layers.boxes[i]);
        box.x = c.x - box.width / 2, box.y = c.y - box.height / 2;
    }
    std::map<std::pair<std::size_t, std::size_t>, int> drawn;
    for (std::size_t i = 0; i < arrows.size(); ++i) {
        const auto& [from, to] = arrows[i];
        auto& points = sheet.edges[i].points;
        const int number = drawn[std::minmax(from, to)]++;
        if (from == to) {
            points = loop(sheet.nodes[from], number);
            continue;
        }
        const Node &a = sheet.nodes[from], &b = sheet.nodes[to];
        for (const auto& bend : layers.bends[i]) points.push_back(centre(bend));
        const bool straight = points.empty();
        end_at_borders(points, a, b);
        if (straight && number > 0)
            slide(points.front(), a.box, 12 * number), slide(points.back(), b.box, 12 * number);
    }
}

/// The colour "#RRGGBB"; a light yellow for another text.
Colour colour_of(const std::string& text) {
    const bool right = text.size() == 7 && text[0] == '#' &&
                       text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
    const auto part = [&](std::size_t at) { return std::stoi(text.substr(at, 2), nullptr, 16) / 255.0; };
    return right ? Colour{part(1), part(3), part(5)} : Colour{0.99, 0.95, 0.78};
}

/// Adds the comments of a page where the file places them; below boxes that the file does not place.
void add_remarks(DiagramSheet& sheet, const std::vector<model::CanvasComment>& comments, bool placed) {
    if (comments.empty()) return;
    double shift = 0;
    if (!placed) {
        double bottom = 0, top = std::numeric_limits<double>::max();
        for (const auto& n : sheet.nodes) bottom = std::max(bottom, n.box.bottom());
        for (const auto& c : comments) top = std::min(top, c.box.y * diagram_scale);
        shift = bottom + 40 - top;
    }
    for (const auto& c : comments)
        sheet.remarks.push_back({{c.box.x * diagram_scale, c.box.y * diagram_scale + shift,
                                  c.box.width * diagram_scale, c.box.height * diagram_scale},
                                 c.text,
                                 colour_of(c.color)});
}

std::string size_of(const model::Group& group) {
    const GroupShape s = model::shape(group.topology);
    return s.cells == s.width * s.height ? fmt::format("{} × {}", s.width, s.height)
                                         : fmt::format("{} cells", s.cells);
}

std::string trimmed(const std::string& name) { return std::string(model::trim(name)); }

DiagramSheet system_sheet(const model::System& system) {
    DiagramSheet out;
    out.title = "The system's processes";
    std::map<const model::Process*, std::size_t> node_of;
    for (const auto& p : system.processes) {
        node_of[&p] = out.nodes.size();
        const std::string size = fmt::format("{} group{}", p.groups.size(), p.groups.size() == 1 ? "" : "s");
        const std::string below = p.module ? p.module->type + (p.module_enabled ? "" : " (off)") : "";
        out.nodes.push_back(
            {box_of(p.icon), trimmed(p.name), size, below, true, false, p.module && !p.module_enabled});
    }
    const bool placed =
        std::ranges::all_of(system.processes, [](const auto& p) { return p.icon.has_value(); });
    add_remarks(out, system.canvas_comments, placed);
    // One arrow stands for all connections of a kind between two processes that are bent in the same way.
    using Bends = std::vector<std::pair<int, int>>;
    std::map<std::tuple<std::size_t, std::size_t, InputKind, Bends>, int> counts;
    const model::GroupIndex groups(system);
    for (const auto& c : system.connections) {
        const auto source = groups.find(c.source), target = groups.find(c.target);
        if (!source.group || !target.group || source.process == target.process) continue;
        Bends bends;
        if (c.line && placed)
            for (const auto& v : c.line->vertices) bends.emplace_back(v.x, v.y);
        ++counts[{node_of[source.process], node_of[target.process], c.kind, std::move(bends)}];
    }
    std::vector<std::pair<std::size_t, std::size_t>> arrows;
    for (const auto& [key, count] : counts) {
        const auto& [from, to, kind, bends] = key;
        out.edges.push_back({{}, kind, count > 1 ? fmt::format("{}", count) : ""});
        arrows.emplace_back(from, to);
        if (!placed) continue;
        auto& points = out.edges.back().points;
        for (const auto& [x, y] : bends) points.push_back({x * diagram_scale, y * diagram_scale});
        end_at_borders(points, out.nodes[from], out.nodes[to]);
        // beside the arrows of the opposite direction and of other kinds
        if (bends.empty()) shift(points, -9 - 12 * static_cast<double>(kind));
    }
    if (!placed) place_in_layers(out, arrows);
    return out;
}

/// Places the groups of other processes where the file puts their phantoms, or in a row above the process's
/// own groups, near those they connect to.
void add_outside(DiagramSheet& sheet, const model::System& system, const model::Process& process,
                 std::map<std::string_view, std::size_t>& node_of) {
    const model::GroupIndex groups(system);
    std::map<std::string_view, std::vector<double>> partners;
    for (const auto& c : system.connections) {
        const bool from_here = node_of.count(c.source) != 0, to_here = node_of.count(c.target) != 0;
        if (from_here != to_here)
            partners[from_here ? c.target : c.source].push_back(
                sheet.nodes[node_of[from_here ? c.source : c.target]].centre().x);
    }
    std::vector<std::pair<double, std::string_view>> order;
    double top = std::numeric_limits<double>::max();
    for (const auto& n : sheet.nodes) top = std::min(top, n.box.y);
    for (const auto& [id, xs] : partners) {
        double sum = 0;
        for (const double x : xs) sum += x;
        if (groups.find(id).group) order.emplace_back(sum / static_cast<double>(xs.size()), id);
    }
    std::ranges::sort(order);
    double free_from = std::numeric_limits<double>::lowest();
    for (const auto& [x, id] : order) {
        const auto entry = groups.find(id);
        const auto phantom = std::ranges::find(process.phantoms, id, &model::Phantom::group);
        const bool placed = phantom != process.phantoms.end();
        const double width = 62 * diagram_scale,
                     left = placed ? phantom->x * diagram_scale : std::max(x - width / 2, free_from),
                     y = placed ? phantom->y * diagram_scale : top - 105 * diagram_scale;
        if (!placed) free_from = left + width + 14;
        node_of[entry.group->id] = sheet.nodes.size();
        sheet.nodes.push_back({{left, y, width, 36 * diagram_scale},
                               trimmed(entry.process->name) + " / " + trimmed(entry.group->name),
                               size_of(*entry.group),
                               "",
                               false,
                               true});
    }
}

/// The sheet of a process whose file places all groups.
void draw_connections(DiagramSheet& sheet, const model::System& system, const model::Process& process,
                      std::map<std::string_view, std::size_t>& node_of) {
    const std::size_t own = sheet.nodes.size();
    add_outside(sheet, system, process, node_of);
    std::map<std::size_t, int> loops;
    for (const auto& c : system.connections) {
        const auto from = node_of.find(c.source), to = node_of.find(c.target);
        if (from == node_of.end() || to == node_of.end() || (from->second >= own && to->second >= own))
            continue;
        const Node &a = sheet.nodes[from->second], &b = sheet.nodes[to->second];
        Edge e{{}, c.kind, {}};
        const model::Line line = c.line.value_or(model::Line{});
        if (a.outside || b.outside) {
            const Point2 inner = a.outside ? b.anchor(line.target_anchor) : a.anchor(line.source_anchor);
            const auto& vertices = a.outside ? line.target_vertices : line.source_vertices;
            for (const auto& v : vertices) e.points.push_back({v.x * diagram_scale, v.y * diagram_scale});
            const Point2 next = e.points.empty() ? inner : a.outside ? e.points.front() : e.points.back();
            const Point2 end = nearest_on_border((a.outside ? a : b).box, next);
            e.points.insert(e.points.begin(), a.outside ? end : inner);
            e.points.push_back(a.outside ? inner : end);
        } else if (from->second == to->second && line.vertices.empty()) {
            e.points = loop(b, loops[to->second]++);
        } else {
            e.points.push_back(c.line ? a.anchor(line.source_anchor) : a.border(b.centre()));
            for (const auto& v : line.vertices)
                e.points.push_back({v.x * diagram_scale, v.y * diagram_scale});
            e.points.push_back(c.line ? b.anchor(line.target_anchor) : b.border(a.centre()));
        }
        sheet.edges.push_back(std::move(e));
    }
}

/// The same in layers. `process` is that of the sheet.
void draw_in_layers(DiagramSheet& sheet, const model::System& system, const model::Process& process,
                    std::map<std::string_view, std::size_t>& node_of) {
    const model::GroupIndex groups(system);
    std::vector<std::pair<std::size_t, std::size_t>> arrows;
    const auto node = [&](const model::GroupIndex::Entry& entry) {
        const auto [at, added] = node_of.emplace(entry.group->id, sheet.nodes.size());
        if (added)
            sheet.nodes.push_back({{0, 0, 62 * diagram_scale, 36 * diagram_scale},
                                   trimmed(entry.process->name) + " / " + trimmed(entry.group->name),
                                   size_of(*entry.group),
                                   "",
                                   false,
                                   true});
        return at->second;
    };
    for (const auto& c : system.connections) {
        const auto source = groups.find(c.source), target = groups.find(c.target);
        if (!source.group || !target.group || (source.process != &process && target.process != &process))
            continue;
        const auto from = node(source);
        arrows.emplace_back(from, node(target));
        sheet.edges.push_back({{}, c.kind, {}});
    }
    place_in_layers(sheet, arrows);
}

DiagramSheet process_sheet(const model::System& system, const model::Process& process) {
    DiagramSheet out;
    out.title = trimmed(process.name) + (process.module ? "  –  " + process.module->type : "");
    std::map<std::string_view, std::size_t> node_of;
    for (const auto& g : process.groups) {
        node_of[g.id] = out.nodes.size();
        out.nodes.push_back({box_of(g.icon), trimmed(g.name), size_of(g), ""});
    }
    const bool placed = std::ranges::all_of(process.groups, [](const auto& g) { return g.icon.has_value(); });
    if (placed)
        draw_connections(out, system, process, node_of);
    else
        draw_in_layers(out, system, process, node_of);
    add_remarks(out, process.canvas_comments, placed);
    return out;
}

Picture picture_of(DiagramSheet sheet) {
    Measure measure;
    sheet.fit(measure.canvas());
    return {sheet.extent.width, sheet.extent.height, [sheet](Canvas& canvas) { draw(canvas, sheet); }};
}

void draw_legend(Canvas& canvas, double x, double y) {
    for (const auto& [kind, name] : {std::pair{InputKind::excitatory, "excitatory"},
                                     {InputKind::inhibitory, "inhibitory"},
                                     {InputKind::modulatory, "modulatory"}}) {
        draw(canvas, Edge{{{x, y - 4}, {x + 34, y - 4}}, kind, {}});
        canvas.text(x + 41, y, name, 12);
        x += 130;
    }
}

}  // namespace

Picture system_diagram(const model::System& system) { return picture_of(system_sheet(system)); }

Picture process_diagram(const model::System& system, const model::Process& process) {
    return picture_of(process_sheet(system, process));
}

Picture diagram(const model::System& system, const std::string& title) {
    std::vector<Picture> all = {system_diagram(system)};
    for (const auto& p : system.processes) all.push_back(process_diagram(system, p));
    // The sheets are in rows that are not much wider than the widest sheet.
    constexpr double top = 62, gap = 12;
    double area = 0, widest = 0;
    for (const auto& p : all) {
        area += (p.width + gap) * (p.height + gap);
        widest = std::max(widest, p.width + 2 * gap);
    }
    widest = std::max(widest, 1.25 * std::sqrt(area));
    std::vector<Point2> places;
    double x = gap, y = top, row = 0, right = 0;
    for (const auto& p : all) {
        if (x > gap && x + p.width > widest) x = gap, y += row + gap, row = 0;
        places.push_back({x, y});
        x += p.width + gap, row = std::max(row, p.height), right = std::max(right, x);
    }
    return {std::max(right, 460.0), y + row + gap, [=](Canvas& canvas) {
                canvas.text(gap, 24, title, 16, 0, black, true);
                draw_legend(canvas, gap, 48);
                for (std::size_t i = 0; i < all.size(); ++i) {
                    cairo_save(canvas.cairo());
                    cairo_translate(canvas.cairo(), places[i].x, places[i].y);
                    cairo_rectangle(canvas.cairo(), 0.5, 0.5, all[i].width - 1, all[i].height - 1);
                    canvas.stroke(pale);
                    all[i].draw(canvas);
                    cairo_restore(canvas.cairo());
                }
            }};
}

}  // namespace forage::plot
