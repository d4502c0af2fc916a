#include "tools/studio/server/stream_source.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bug_interface/simulation/world.h"
#include "core/observe/source.h"
#include "tools/studio/server/sampled_synapses.h"

namespace forage::studio {
namespace {

constexpr std::size_t max_cells = 1'000'000;    ///< of a stream
constexpr std::size_t max_append_cells = 4096;  ///< of a stream of every cycle

class Cells final : public StreamSource {
  public:
    explicit Cells(observe::Source source) : source_(std::move(source)) {}
    std::uint32_t rows() const override {
        return source_.what().one_number() ? 1 : static_cast<std::uint32_t>(source_.what().cells.height);
    }
    std::uint32_t columns() const override {
        return source_.what().one_number() ? 1 : static_cast<std::uint32_t>(source_.what().cells.width);
    }
    std::string label() const override { return source_.what().label; }
    void read(Run& run, std::span<double> out) const override { source_.read(run.simulation(), out); }
    void declare(engine::Demand& demand) const override { source_.declare(demand); }

  private:
    observe::Source source_;
};

class Poses final : public StreamSource {
  public:
    explicit Poses(const bug::World& world) : bodies_(world.bugs() + world.movable_objects()) {}
    std::uint32_t rows() const override { return static_cast<std::uint32_t>(bodies_); }
    std::uint32_t columns() const override { return 5; }
    std::string label() const override { return "x, y, z, yaw, presence"; }
    void read(Run& run, std::span<double> out) const override {
        const auto& world = static_cast<const bug::World&>(*run.environment());
        for (std::size_t i = 0; i < bodies_; ++i) {
            const auto object = i < world.bugs() ? std::nullopt : world.movable_object_pose(i - world.bugs());
            const Pose2 pose = i < world.bugs() ? world.pose(i) : object.value_or(Pose2{});
            const double state = i < world.bugs() ? (world.resetting(i) ? 2 : 1) : object ? 1 : 0;
            const double row[] = {pose.x, pose.y, 0, pose.yaw, state};
            std::copy(std::begin(row), std::end(row), out.begin() + static_cast<std::ptrdiff_t>(5 * i));
        }
    }

  private:
    std::size_t bodies_;
};

class Rays final : public StreamSource {
  public:
    Rays(const bug::World& world, std::size_t robot) : robot_(robot) {
        for (const auto& s : world.robot(robot).sensors.range_sensors())
            if (shown(s)) rows_ += static_cast<std::uint32_t>(s.rays);
    }
    std::uint32_t rows() const override { return rows_; }
    std::uint32_t columns() const override { return 6; }
    std::string label() const override { return "x, y, to x, to y, kind, activity"; }
    void read(Run& run, std::span<double> out) const override {
        const auto& world = static_cast<const bug::World&>(*run.environment());
        const auto& sensors = world.robot(robot_).sensors;
        const Pose2 pose = world.pose(robot_);
        std::size_t at = 0;
        for (const auto& s : sensors.range_sensors()) {
            if (!shown(s)) continue;
            const bool light = s.name == "laser_target";
            const auto& cells = light ? sensors.snapshot().target : sensors.snapshot().proximity;
            for (int k = 0; k < s.rays; ++k, at += 6) {
                const double activity =
                    static_cast<std::size_t>(k) < cells.size() ? cells[static_cast<std::size_t>(k)] : 0;
                const double angle = pose.yaw + s.cell_angle(k), c = std::cos(angle), d = std::sin(angle);
                const double range = s.max_range * (1 - activity);
                const double row[] = {pose.x + s.min_range * c, pose.y + s.min_range * d, pose.x + range * c,
                                      pose.y + range * d,       light ? 1. : 0.,          activity};
                std::copy(std::begin(row), std::end(row), out.begin() + static_cast<std::ptrdiff_t>(at));
            }
        }
    }

  private:
    static bool shown(const bug::RangeSensor& s) { return s.name == "laser" || s.name == "laser_target"; }
    std::size_t robot_;
    std::uint32_t rows_ = 0;
};

/// What a robot consists of, with the gripper as it is now.
class Parts final : public StreamSource {
  public:
    Parts(const bug::World& world, std::size_t robot) : robot_(robot) {
        for (const auto& v : world.moving_visuals()) rows_ += v.body == robot_;
    }
    std::uint32_t rows() const override { return rows_; }
    std::uint32_t columns() const override { return 11; }
    std::string label() const override { return "kind, x, y, z, yaw, size, red, green, blue"; }
    void read(Run& run, std::span<double> out) const override {
        const auto& world = static_cast<const bug::World&>(*run.environment());
        std::size_t at = 0;
        for (const auto& v : world.moving_visuals()) {
            if (v.body != robot_) continue;
            const auto pose = v.at(world.body_poses());
            const Eigen::Vector3d p = pose.translation(), size = v.visual.solid.size;
            const auto& colour = v.visual.material.diffuse;
            const auto kind = static_cast<double>(v.visual.solid.kind), yaw = bug::yaw_of(pose);
            const double row[] = {kind,     p.x(),    p.y(),     p.z(),     yaw,      size.x(),
                                  size.y(), size.z(), colour[0], colour[1], colour[2]};
            std::copy(std::begin(row), std::end(row), out.begin() + static_cast<std::ptrdiff_t>(at));
            at += columns();
        }
    }

  private:
    std::size_t robot_;
    std::uint32_t rows_ = 0;
};

class Picture final : public StreamSource {
  public:
    Picture(const bug::CameraSensor& camera, std::size_t robot)
        : robot_(robot), width_(camera.width), height_(camera.height) {}
    std::uint32_t rows() const override { return static_cast<std::uint32_t>(height_); }
    std::uint32_t columns() const override { return static_cast<std::uint32_t>(3 * width_); }
    std::string label() const override { return "red, green, blue"; }
    Type type() const override { return Type::uint8; }
    void read(Run& run, std::span<double> out) const override {
        const auto image = static_cast<bug::World&>(*run.environment()).image(robot_);
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = i < image.size() ? image[i] : 0;
    }

  private:
    std::size_t robot_;
    int width_, height_;
};

class Trail final : public StreamSource {
  public:
    explicit Trail(std::size_t robot) : robot_(robot) {}
    std::uint32_t rows() const override { return 1; }
    std::uint32_t columns() const override { return 3; }
    std::string label() const override { return "x, y, trial"; }
    void read(Run& run, std::span<double> out) const override {
        const auto& world = *run.environment();
        const Pose2 pose = world.pose(robot_);
        out[0] = pose.x, out[1] = pose.y;
        out[2] = world.has_trials(robot_) ? world.current_trial(robot_).number : 0;
    }

  private:
    std::size_t robot_;
};

std::unique_ptr<StreamSource> world_source(Run& run, std::string_view text) {
    const auto* world = dynamic_cast<const bug::World*>(run.environment());
    if (!world) throw InputError(fmt::format("'{}' needs a world", text), "open the system with --world");
    if (text == "world:poses") return std::make_unique<Poses>(*world);
    const auto colon = text.find(':', 6);
    const std::string_view kind = text.substr(0, colon);
    std::optional<std::size_t> robot =
        world->bugs() > 0 && colon == text.npos ? std::optional<std::size_t>(0) : std::nullopt;
    if (colon != text.npos) robot = world->find(text.substr(colon + 1));
    if (!robot)
        throw InputError(fmt::format("'{}' names no robot of this world", text),
                         suggest(colon == text.npos ? "" : text.substr(colon + 1), world->robot_names()));
    if (kind == "world:rays") return std::make_unique<Rays>(*world, *robot);
    if (kind == "world:parts") return std::make_unique<Parts>(*world, *robot);
    if (kind == "world:trail") return std::make_unique<Trail>(*robot);
    if (kind == "world:camera") {
        if (const auto& camera = world->robot(*robot).sensors.camera_sensor())
            return std::make_unique<Picture>(*camera, *robot);
        throw InputError(fmt::format("the robot of '{}' has no camera", text));
    }
    throw InputError(
        fmt::format("'{}' is not a stream of a world", text),
        "world:poses, world:rays:ROBOT, world:parts:ROBOT, world:camera:ROBOT or world:trail:ROBOT");
}

}  // namespace

std::unique_ptr<StreamSource> find_stream_source(Run& run, std::string_view text, Delivery delivery) {
    std::unique_ptr<StreamSource> out;
    if (text.starts_with("world:")) {
        out = world_source(run, text);
    } else if (text.starts_with("sampled(") && text.ends_with(')')) {
        out = sampled_synapses(run, text.substr(8, text.size() - 9));
    } else {
        Diagnostics diagnostics;
        auto source = observe::find_source(run.layout(), text, "subscribe", diagnostics);
        throw_errors(diagnostics);
        out = std::make_unique<Cells>(std::move(*source));
    }
    engine::Demand wanted;
    out->declare(wanted);
    run.require(wanted, fmt::format("'{}'", text));
    const std::size_t cells = static_cast<std::size_t>(out->rows()) * out->columns();
    const std::size_t max = delivery == Delivery::append ? max_append_cells : max_cells;
    if (cells > max)
        throw InputError(fmt::format("'{}' has {} numbers; a stream has at most {}", text, cells, max),
                         "name a part of the cells, such as (1..30,1..30), or the mean");
    return out;
}

}  // namespace forage::studio
