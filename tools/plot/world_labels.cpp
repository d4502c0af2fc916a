#include "tools/plot/world_labels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace forage::plot {
namespace {

constexpr double label_size = 11, label_height = 14;

/// A label: the centre of its base line, and half its width.
struct Label {
    double x, y, half;
    std::string text;
};

Label label_of(Canvas& canvas, double x, double y, std::string text) {
    const double half = canvas.width_of(text, label_size) / 2 + 2;
    return {x, y, half, std::move(text)};
}

void draw(Canvas& canvas, const Label& l) {
    canvas.fill(l.x - l.half, l.y - label_size, 2 * l.half, label_height, white);
    canvas.text(l.x, l.y, l.text, label_size, 0.5);
}

/// Moves a label so that all of it is within the map.
Label within(const WorldMap& map, Label l) {
    const double left = map.px(map.view().min().x()), right = map.px(map.view().max().x()),
                 top = map.py(map.view().max().y()), bottom = map.py(map.view().min().y());
    l.x = std::clamp(l.x, std::min(left + l.half + 3, right), std::max(right - l.half - 3, left));
    l.y = std::clamp(l.y, std::min(top + label_height, bottom), std::max(bottom - 6, top));
    return l;
}

std::vector<Label> robot_labels(Canvas& canvas, const bug::World& world, const WorldMap& map) {
    constexpr std::pair<double, double> sides[] = {{0, -1}, {0, 1},   {1, 0}, {-1, 0},
                                                   {1, -1}, {-1, -1}, {1, 1}, {-1, 1}};
    std::vector<Label> out;
    const auto names = world.robot_names();
    for (std::size_t i = 0; i < world.bugs(); ++i) {
        const double r = world.robot(i).body.radius * map.scale(), x = map.px(world.pose(i).x),
                     y = map.py(world.pose(i).y);
        const auto is_free = [&](const Label& l) {
            for (const Label& other : out)
                if (std::abs(l.x - other.x) < l.half + other.half + 1 &&
                    std::abs(l.y - other.y) < label_height + 1)
                    return false;
            for (std::size_t j = 0; j < world.bugs(); ++j)
                if (std::abs(map.px(world.pose(j).x) - l.x) < r + l.half &&
                    std::abs(map.py(world.pose(j).y) - (l.y - label_height / 2 + 3)) < r + label_height / 2)
                    return false;
            return true;
        };
        Label best = within(map, label_of(canvas, x, y - r - 5, names[i]));
        bool found = false;
        for (double ring = 0; ring < 6 && !found; ++ring)
            for (const auto& [dx, dy] : sides) {
                const double away = r + 5 + ring * (label_height + 2);
                Label tried = best;
                tried.x = x + dx * (away + best.half);
                tried.y = y + dy * (away + (dy > 0 ? label_size : 0)) + (dy == 0 ? 4 : 0);
                tried = within(map, tried);
                if (!is_free(tried)) continue;
                best = tried, found = true;
                break;
            }
        out.push_back(best);
    }
    return out;
}

/// An entry of the legend. `draw` draws a sample of the line within 18 x 12 pixels, given the lower left
/// corner.
struct Entry {
    const char* name;
    std::function<void(Canvas&, double x, double y)> draw;
};

std::vector<Entry> entries_of(const bug::World& world) {
    const auto ray = [](const Colour& colour) {
        return
            [colour](Canvas& canvas, double x, double y) { canvas.line(x, y - 4, x + 18, y - 4, colour, 2); };
    };
    const auto ring = [](const Colour& colour, double on, double off) {
        return [=](Canvas& canvas, double x, double y) {
            canvas.fill(x, y - 11, 18, 14, {0.5, 0.5, 0.5});  // the colour of the ground
            canvas.dashes(on, off);
            canvas.circle(x + 9, y - 4, 5);
            canvas.stroke(colour, 1.5);
            canvas.dashes(0, 0);
        };
    };
    std::vector<Entry> out;
    if (world.bugs() > 0) out = {{"proximity", ray(near_ray)}, {"light", ray(light_ray)}};
    if (!world.targets().empty()) out.push_back({"target reached", ring(white, 3, 3)});
    if (has_homes(world)) out.push_back({"home", ring(white, 2, 4)});
    if (const auto& game = world.description().game; game && !game->sites.empty())
        out.push_back({"resources appear", ring(site_colour, 2, 3)});
    if (world.reset_plan())
        out.push_back({"bounds", [](Canvas& canvas, double x, double y) {
                           canvas.fill(x, y - 11, 18, 14, black);
                           canvas.dashes(4, 3);
                           canvas.line(x, y - 4, x + 18, y - 4, bounds_colour);
                           canvas.dashes(0, 0);
                       }});
    return out;
}

}  // namespace

void draw_home_names(Canvas& canvas, const bug::World& world, const WorldMap& map) {
    if (!has_homes(world)) return;
    for (int team = 0; team < 2; ++team) {
        const Pose2& at = world.game().homes()[static_cast<std::size_t>(team)];
        const Eigen::Vector2d home(at.x, at.y);
        const Eigen::Vector2d outwards =
            home + (home - map.view().center()).normalized() * 0.75 * bug::Game::home_radius;
        draw(canvas, within(map, label_of(canvas, map.px(outwards.x()), map.py(outwards.y()),
                                          team ? "home B" : "home A")));
    }
}

void draw_robot_names(Canvas& canvas, const bug::World& world, const WorldMap& map) {
    const auto labels = robot_labels(canvas, world, map);
    for (std::size_t i = 0; i < labels.size(); ++i)
        canvas.line(map.px(world.pose(i).x), map.py(world.pose(i).y), labels[i].x, labels[i].y - 4, white);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        map.draw_robot(canvas, i, false);
        draw(canvas, labels[i]);
    }
}

double draw_legend(Canvas& canvas, const bug::World& world, double left, double right, double y) {
    double x = left;
    for (const Entry& entry : entries_of(world)) {
        const double wide = 24 + canvas.width_of(entry.name, label_size);
        if (x > left && x + wide > right) x = left, y += 20;
        entry.draw(canvas, x, y);
        canvas.text(x + 24, y, entry.name, label_size);
        x += wide + 18;
    }
    return y;
}

}  // namespace forage::plot
