#include "modules/allostasis/module.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/types/cell_model.h"
#include "modules/allostasis/bug.h"

namespace forage::allostasis {
namespace {

enum In : std::size_t { gps_in, mate_in, predator_in, proximity_in };
enum Out : std::size_t { needs_out, forces_out, views_out, motor_out, time_out, errors_out, balance_out };

const std::vector<std::string> need_names = {"temperature", "hydration", "energy", "security", "mating"};

constexpr std::uint32_t draw_noise = 0, draw_steering = 16, draw_control = 32;

}  // namespace

void AllostasisModule::describe(ModuleSpec<AllostasisModule>& s) {
    using T = AllostasisModule;
    s.name("moduleAllostasis", "Allostasis")
        .doc(
            "Keeps the needs for temperature, hydration, energy, security and mating in balance by a "
            "competition of drives, which steer a robot in an arena with resources, a mate and a predator.");
    s.param("Scale", &T::scale)
        .range(0.1, 100)
        .doc("Metres of the world per metre of the original arena, which measures 3.5 m x 3.5 m.");
    s.param("Cycle", &T::cycle).unit("s").range(0.001, 1).doc("Time of the world per cycle.");
    s.param("Step", &T::interval)
        .unit("s")
        .range(0.01, 1)
        .doc("Time between steps of needs and network; their rates are per step.");
    s.param("View Interval", &T::view_interval)
        .unit("s")
        .range(0, 100)
        .doc("Time between two views of the fields; 0: a view in every step.");
    s.param("View Delay", &T::view_delay)
        .unit("s")
        .range(0, 100)
        .doc("Age that a view has when it is first used; until the first one, nothing is sensed.");
    s.param("Field Offset", &T::field_offset)
        .doc(
            "Whether the fields of water and food are 5 cm (times 'Scale') off their objects, as in the "
            "original.");
    s.param("Extent X", &T::extent_x).unit("m").range(0, 100).doc("What the GPS groups add to x.");
    s.param("Extent Y", &T::extent_y).unit("m").range(0, 100).doc("What the GPS groups add to y.");
    s.param("Noise", &T::noise)
        .range(0, 200)
        .doc("sigma: noise of the network, without which the first drive that wins stays the winner.");
    const auto priority = [&](const char* name, double T::*member) {
        s.param(name, member).range(0, 10).doc("Factor of this need's error at the input of the network.");
    };
    priority("Temperature Priority", &T::temperature_priority);
    priority("Hydration Priority", &T::hydration_priority);
    priority("Energy Priority", &T::energy_priority);
    priority("Security Priority", &T::security_priority);
    priority("Mating Priority", &T::mating_priority);
    s.param("Dead Sector", &T::dead_sector)
        .doc(
            "Whether the robot keeps the last side of each field while it looks east, as the original does.");
    s.param("Control", &T::control).doc("Ignores needs and drives, and walks at random.");
    const char* gps =
        "Place x, y and heading as moduleGazeboBug writes them: x + extent, y + extent, heading + pi.";
    s.input("gps", "GPS").cells(3).doc(gps);
    s.input("mate", "Mate").cells(3).doc(std::string("The mate. ") + gps);
    s.input("predator", "Predator").cells(3).doc(std::string("The predator. ") + gps);
    s.input("proximity", "Proximity")
        .optional()
        .cells(32)
        .doc("The proximity sensors of the Bug; without them the robot does not avoid obstacles.");
    s.output("needs", "Needs")
        .optional()
        .cells(needs)
        .names(need_names)
        .doc("Internal states, 0 to 1: temperature, hydration, energy, security, mating.");
    s.output("forces", "Forces")
        .optional()
        .cells(needs)
        .names(need_names)
        .doc("Force of each drive, 0 to 1, in the same order.");
    s.output("views", "Views")
        .optional()
        .size(4, needs)
        .names([](const auto&, const ModulePorts&, const GroupShape&) {
            return CellNames{.columns = {"north-west", "north-east", "south-west", "south-east"},
                             .rows = need_names};
        })
        .doc("What is sensed of each field, 0 to 1. Row: need; column: NW, NE, SW, SE of the robot.");
    describe_motor(s);
    s.output("time", "Time")
        .optional()
        .cells(2)
        .names({"step of the day", "mean temperature"})
        .doc("Step of the day, 0 to 1, and mean temperature, 0 to 1.");
    s.output("errors", "Errors")
        .optional()
        .cells(needs)
        .names(need_names)
        .doc("Homeostatic errors, 1 - state, 0 to 1, in the same order.");
    s.output("balance", "Balance")
        .optional()
        .cells(3)
        .names({"efficiency", "fairness", "stability"})
        .doc(
            "Efficiency (mean of the states), fairness (1 - largest + smallest), stability (1 - mean of the "
            "squared errors).");
}

void AllostasisModule::check(const ModulePorts&, Diagnostics& diagnostics) const {
    for (const auto& [name, value] :
         {std::pair{"Scale", scale}, std::pair{"Cycle", cycle}, std::pair{"Step", interval}})
        if (!(value > 0))
            diagnostics.error(at_parameter(name), fmt::format("'{}' is {}", name, value), "use more than 0");
}

void AllostasisModule::start(const ModulePorts& ports) {
    drives_ = {}, steering_ = {}, wheels_ = {}, day_ = {};
    views_.setZero();
    stepped_ = looked_ = false;
    last_step_ = last_look_ = 0;
    coming_.clear();
    random_ = ports.random;
    motor_width_ = ports.outputs[motor_out].shape.width;
    motor_height_ = ports.outputs[motor_out].shape.height;
}

Place AllostasisModule::place(const ConstColumn& gps) const {
    // The fields end 5 cm outside the walls; 4 cells around the robot must lie on the grid.
    const auto within = [](double x) { return std::clamp(x, -1.75, 1.75); };
    return {within((gps[0] - extent_x) / scale), within((gps[1] - extent_y) / scale)};
}

void AllostasisModule::update(ModuleFrame& frame) {
    const double time = static_cast<double>(frame.cycle()) * cycle;
    if (!stepped_ || time >= last_step_ + interval - cycle / 2) {
        const double c = day_.step(time);
        const int step = static_cast<int>(std::clamp(c, 0.0, Day::length));
        NeedSettings settings;
        settings.priority << temperature_priority, hydration_priority, energy_priority, security_priority,
            mating_priority;
        NetworkSettings network;
        network.noise = noise;
        if (look(frame, time, step)) drives_.sense(views_, settings);
        FiveNeeds z;
        for (std::uint32_t i = 0; i < needs; ++i)
            z[i] = normal(random_.uniform(frame.cycle(), draw_noise + 2 * i),
                          random_.uniform(frame.cycle(), draw_noise + 2 * i + 1));
        drives_.step(z, settings, network);
        stepped_ = true;
        last_step_ = time;
        if (frame.is_read(needs_out)) frame.output(needs_out) = drives_.states();
        const FiveNeeds error = drives_.errors(settings);
        if (frame.is_read(errors_out)) frame.output(errors_out) = error;
        if (frame.is_read(balance_out))
            frame.output(balance_out) << drives_.states().mean(), 1 - error.maxCoeff() + error.minCoeff(),
                1 - error.square().mean();
        if (frame.is_read(forces_out)) frame.output(forces_out) = drives_.forces();
        if (frame.is_read(views_out))
            for (int i = 0; i < needs; ++i)
                for (int q = 0; q < 4; ++q) frame.output(views_out)[4 * i + q] = views_(i, q);
        if (frame.is_read(time_out))
            frame.output(time_out) << step / Day::length, TemperatureField(step).mean();
    }
    act(frame, time);
}

/// Takes a view when one is due, and returns whether a view has become old enough to be used.
bool AllostasisModule::look(ModuleFrame& frame, double time, int step) {
    const double tolerance = cycle / 2;
    if (!looked_ || time >= last_look_ + view_interval - tolerance) {
        coming_.push_back({time, local_views(place(frame.input(gps_in)), place(frame.input(predator_in)),
                                             place(frame.input(mate_in)), step, field_offset)});
        looked_ = true;
        last_look_ = time;
    }
    bool found = false;
    while (!coming_.empty() && time >= coming_.front().time + view_delay - tolerance) {
        views_ = coming_.front().views;
        coming_.pop_front();
        found = true;
    }
    return found;
}

void AllostasisModule::act(ModuleFrame& frame, double time) {
    const auto number = [&](std::uint32_t i) { return random_.uniform(frame.cycle(), i); };
    const double turn = 180 / std::numbers::pi;
    double bearing = std::fmod(-(frame.input(gps_in)[2] - std::numbers::pi) * turn, 360);
    if (bearing < 0) bearing += 360;
    const FiveNeeds forces = control ? FiveNeeds::Zero() : drives_.forces();
    const Wheels wanted = steering_.step(bearing, views_, forces, 1, dead_sector, number(draw_steering),
                                         number(draw_steering + 1));
    FrontRanges ranges;
    const auto& near = frame.input(proximity_in);
    if (near.size() == 32)
        ranges = {range(near[ray_of[0]], scale), range(near[ray_of[1]], scale), range(near[ray_of[6]], scale),
                  range(near[ray_of[7]], scale)};
    Wheels z;
    if (control)
        z = {normal(number(draw_control), number(draw_control + 1)),
             normal(number(draw_control + 2), number(draw_control + 3))};
    const Wheels w = wheels_.step(time, ranges, wanted, z);
    auto motor = frame.output(motor_out);
    show_wheels(w, motor_width_, motor_height_, motor);
}

}  // namespace forage::allostasis
