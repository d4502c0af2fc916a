#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "bug_interface/simulation/data_sheet.h"
#include "bug_interface/world/sdf_reader.h"
#include "core/base/output_files.h"
#include "core/base/print.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"
#include "tools/plot/robot_plot.h"
#include "tools/plot/world_map.h"

namespace forage::tool {
namespace {

struct WorldCommand {
    std::string file;     ///< .world
    std::string picture;  ///< .png, .svg or .pdf; empty: the name of the world or robot with .png
    bool game = false;
    std::string robot;  ///< prints and draws the data sheet of this robot instead of the world
};

int world(const WorldCommand& o) {
    Diagnostics diagnostics;
    const std::string picture =
        !o.picture.empty()
            ? o.picture
            : (o.robot.empty() ? std::filesystem::path(o.file).stem().string() : file_name(o.robot)) + ".png";
    const auto format_of_picture = plot::format_of(picture);
    if (!format_of_picture)
        diagnostics.error({}, fmt::format("-o: '{}' is not the name of a picture", picture),
                          "it ends with .png, .svg or .pdf");
    check_output(picture, "map.png", diagnostics);
    const auto description = bug::read_world(o.file, diagnostics);
    bug::WorldOptions options;
    options.game = o.game;
    std::unique_ptr<bug::World> made;
    if (description) made = bug::World::make(*description, options, diagnostics);
    if (made) try {
            made->scene();  // floors whose pictures cannot be read
            for (std::size_t i = 0; i < made->bugs(); ++i) made->image(i);
        } catch (const std::exception& e) {
            diagnostics.error({}, e.what());
        }
    const bool sheet = !o.robot.empty();
    std::size_t robot = 0;
    if (made && sheet) {
        if (const auto found = made->find(o.robot))
            robot = *found;
        else
            diagnostics.error({}, fmt::format("--robot: there is no robot '{}' in '{}'", o.robot, o.file),
                              suggest(o.robot, made->robot_names()));
    }
    print(stderr, "{}", format(diagnostics));
    if (diagnostics.failed() || !made) return bad_input;
    print("{}", sheet ? bug::data_sheet(*made, robot) : bug::describe(*made));
    write_file(picture, plot::render(sheet ? plot::robot_plot(*made, robot)
                                           : plot::world_plot(
                                                 *made, std::filesystem::path(o.file).filename().string()),
                                     *format_of_picture));
    if (sheet) {
        print("\n![The robot {}]({})\n", o.robot, picture);
        return fine;
    }
    print("  {:<11} {}\n", "picture", picture);
    return fine;
}

}  // namespace

void add_world(Program& program) {
    const auto [command, o] = program.add(
        "world", "Check a world, list its contents and draw it from above; or the data sheet of a robot",
        world,
        "Example:\n"
        "  forage world systems/worlds/basic_arena.world -o forage-out/basic_arena.png\n"
        "  forage world systems/worlds/basic_arena.world --robot Bug -o forage-out/bug.png");
    add_value(command, "FILE", o.file, " ", "World file (.world)")->required();
    add_value(command, "-o,--output", o.picture, "PICTURE",
              "Picture (.png, .svg or .pdf) [FILE's or ROBOT's name with .png]")
        ->check(named("file"));
    add_value(command, "--robot", o.robot, "ROBOT",
              "Print and draw the data sheet of this robot: what every cell of its motors and sensors means");
    command.add_flag("--game", o.game, "With the robotics challenge's resources");
}

}  // namespace forage::tool
