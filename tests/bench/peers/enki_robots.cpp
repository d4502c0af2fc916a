// The scenes in Enki, a simulator in two dimensions. Its robots have two wheels, and walls without friction.
// Its sensors are replaced by rays like those of the others. Enki counts in centimetres, from the lower left
// corner.
#include <array>
#include <memory>

#include <enki/PhysicalEngine.h>
#include <enki/robots/DifferentialWheeled.h>

#include "tests/bench/peers/turns.h"

namespace {

constexpr double cm = 100;

/// 16 rays that are called like Enki's own sensors: once per cycle for each object in reach, and for the
/// walls.
class Rays : public Enki::LocalInteraction {
  public:
    explicit Rays(Enki::Robot* robot) : LocalInteraction(peers::max_range * cm, robot) {}

    void init(double, Enki::World*) override {
        ranges.fill(peers::max_range * cm);
        for (int i = 0; i < peers::rays; ++i) {
            const double angle = owner->angle + peers::ray_angle(i);
            dx_[static_cast<std::size_t>(i)] = std::cos(angle),
            dy_[static_cast<std::size_t>(i)] = std::sin(angle);
        }
    }
    void objectStep(double, Enki::World*, Enki::PhysicalObject* object) override {
        const double x = object->pos.x - owner->pos.x, y = object->pos.y - owner->pos.y;
        const double radius = object->getRadius();
        for (std::size_t i = 0; i < peers::rays; ++i) {
            const double along = x * dx_[i] + y * dy_[i], beside = x * dy_[i] - y * dx_[i];
            const double half = radius * radius - beside * beside;
            if (half > 0 && along > 0) see(i, along - std::sqrt(half));
        }
    }
    void wallsStep(double, Enki::World* world) override {
        const auto& at = owner->pos;
        const double reach = peers::max_range * cm;
        if (at.x > reach && at.y > reach && at.x < world->w - reach && at.y < world->h - reach) return;
        for (std::size_t i = 0; i < peers::rays; ++i) {
            if (dx_[i] != 0) see(i, ((dx_[i] > 0 ? world->w : 0) - at.x) / dx_[i]);
            if (dy_[i] != 0) see(i, ((dy_[i] > 0 ? world->h : 0) - at.y) / dy_[i]);
        }
    }

    std::array<double, peers::rays> ranges{};  ///< cm

  private:
    void see(std::size_t ray, double distance) {
        ranges[ray] = std::min(ranges[ray], std::max(distance, peers::min_range * cm));
    }
    std::array<double, peers::rays> dx_{}, dy_{};
};

struct Robot : Enki::DifferentialWheeled {
    static constexpr double axle = 30;  ///< cm
    Robot() : DifferentialWheeled(axle, 1000, 0) {
        setCylindric(peers::robot_radius * cm, 20, peers::robot_mass);
        collisionElasticity = 0;
        addLocalInteraction(&rays);
    }
    Rays rays{this};
};

class EnkiWorld {
  public:
    explicit EnkiWorld(const peers::Scene& scene)
        : scene_(scene), world_(2 * scene.half_x * cm, 2 * scene.half_y * cm) {
        world_.takeObjectOwnership = false;
        robots_.reserve(scene.robots.size());
        for (const auto& pose : scene.robots) place(*robots_.emplace_back(std::make_unique<Robot>()), pose);
        for (const auto& pose : scene.balls) {
            auto& ball = *balls_.emplace_back(std::make_unique<Enki::PhysicalObject>());
            ball.setCylindric(peers::ball_radius * cm, 2 * peers::ball_radius * cm, peers::ball_mass);
            ball.collisionElasticity = 0;
            ball.dryFrictionCoefficient = peers::ball_deceleration * cm / Enki::PhysicalObject::g;
            place(ball, pose);
        }
    }

    void command(std::size_t robot, const peers::Command& c) {
        const double forward = c.forward * cm, difference = c.turn * Robot::axle / 2;
        robots_[robot]->leftSpeed = forward - difference, robots_[robot]->rightSpeed = forward + difference;
    }
    void advance() { world_.step(peers::cycle, static_cast<unsigned>(scene_.steps)); }
    void scan() {}  // a part of the step
    peers::Pose pose(std::size_t i) const { return in_scene(*robots_[i]); }
    peers::Pose ball(std::size_t i) const { return in_scene(*balls_[i]); }
    double range(std::size_t robot, int ray) const {
        return robots_[robot]->rays.ranges[static_cast<std::size_t>(ray)] / cm;
    }

  private:
    peers::Pose in_scene(const Enki::PhysicalObject& o) const {
        return {o.pos.x / cm - scene_.half_x, o.pos.y / cm - scene_.half_y, o.angle};
    }
    void place(Enki::PhysicalObject& object, const peers::Pose& pose) {
        object.pos = {(pose.x + scene_.half_x) * cm, (pose.y + scene_.half_y) * cm};
        object.angle = pose.yaw;
        world_.addObject(&object);
    }

    peers::Scene scene_;
    std::vector<std::unique_ptr<Robot>> robots_;
    std::vector<std::unique_ptr<Enki::PhysicalObject>> balls_;
    Enki::World world_;
};

}  // namespace

int main(int argc, char** argv) { return peers::serve<EnkiWorld>(argc, argv); }
