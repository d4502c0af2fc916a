// The scenes in Bullet alone. Robots and balls are spheres, the shape with the fastest contacts, that move in
// a plane. There is no floor. As in Forage a robot gets the velocity of its command in every step.
#include <memory>

#include <btBulletDynamicsCommon.h>

#include "tests/bench/peers/turns.h"

namespace {

btScalar scalar(double v) { return static_cast<btScalar>(v); }

/// The nearest surface of another object.
struct NearestOther : btCollisionWorld::ClosestRayResultCallback {
    NearestOther(const btVector3& from, const btVector3& to, const btRigidBody& own)
        : ClosestRayResultCallback(from, to), own_proxy(own.getBroadphaseProxy()) {}
    bool needsCollision(btBroadphaseProxy* proxy) const override { return proxy != own_proxy; }
    const btBroadphaseProxy* own_proxy;
};

class BulletWorld {
  public:
    explicit BulletWorld(const peers::Scene& scene)
        : robots_(scene.robots.size()), steps_(scene.steps), step_(scalar(scene.step())) {
        world_.setGravity({0, 0, 0});
        const double t = peers::wall_thickness;
        for (const double sign : {-1.0, 1.0}) {
            add_wall(sign * (scene.half_x + t / 2), 0, t / 2, scene.half_y + t);
            add_wall(0, sign * (scene.half_y + t / 2), scene.half_x + t, t / 2);
        }
        for (const auto& pose : scene.robots)
            add(pose, peers::robot_radius, peers::robot_mass, peers::robot_inertia);
        for (const auto& pose : scene.balls)
            add(pose, peers::ball_radius, peers::ball_mass,
                0.4 * peers::ball_mass * peers::ball_radius * peers::ball_radius);
        commands_.resize(robots_), ranges_.resize(robots_ * peers::rays);
    }
    ~BulletWorld() {
        for (const auto& o : objects_) world_.removeRigidBody(o.get());
    }

    void command(std::size_t robot, const peers::Command& c) { commands_[robot] = c; }
    void advance() {
        for (int s = 0; s < steps_; ++s) {
            for (std::size_t i = 0; i < bodies_.size(); ++i) i < robots_ ? drive(i) : brake(*bodies_[i]);
            world_.stepSimulation(step_, 0);
        }
    }
    void scan() {
        for (std::size_t i = 0; i < robots_; ++i) {
            const peers::Pose at = pose(i);
            for (int ray = 0; ray < peers::rays; ++ray) {
                const double angle = at.yaw + peers::ray_angle(ray);
                const btVector3 from(scalar(at.x), scalar(at.y), 0);
                const btVector3 to(scalar(at.x + peers::max_range * std::cos(angle)),
                                   scalar(at.y + peers::max_range * std::sin(angle)), 0);
                NearestOther hit(from, to, *bodies_[i]);
                world_.rayTest(from, to, hit);
                ranges_[i * peers::rays + static_cast<std::size_t>(ray)] =
                    std::max(peers::min_range, peers::max_range * double{hit.m_closestHitFraction});
            }
        }
    }
    peers::Pose pose(std::size_t i) const {
        const btTransform& t = bodies_[i]->getWorldTransform();
        return {t.getOrigin().x(), t.getOrigin().y(), std::atan2(t.getBasis()[1][0], t.getBasis()[0][0])};
    }
    peers::Pose ball(std::size_t i) const { return pose(robots_ + i); }
    double range(std::size_t robot, int ray) const {
        return ranges_[robot * peers::rays + static_cast<std::size_t>(ray)];
    }

  private:
    void drive(std::size_t i) {
        const auto& forward = bodies_[i]->getWorldTransform().getBasis().getColumn(0);
        bodies_[i]->setLinearVelocity(scalar(commands_[i].forward) * forward);
        bodies_[i]->setAngularVelocity({0, 0, scalar(commands_[i].turn)});
    }
    void brake(btRigidBody& ball) const {
        const btVector3 v = ball.getLinearVelocity();
        const btScalar speed = v.length(), lost = scalar(peers::ball_deceleration) * step_;
        ball.setLinearVelocity(speed > lost ? v * (1 - lost / speed) : btVector3(0, 0, 0));
    }
    btRigidBody& add(btCollisionShape* shape, double x, double y, double yaw, double mass, double inertia) {
        shapes_.emplace_back(shape);
        const btVector3 inertias(scalar(inertia), scalar(inertia), scalar(inertia));
        btRigidBody::btRigidBodyConstructionInfo info(scalar(mass), nullptr, shape, inertias);
        info.m_startWorldTransform =
            btTransform(btQuaternion({0, 0, 1}, scalar(yaw)), {scalar(x), scalar(y), 0});
        info.m_friction = scalar(std::sqrt(peers::friction));  // Bullet multiplies the two coefficients
        objects_.push_back(std::make_unique<btRigidBody>(info));
        world_.addRigidBody(objects_.back().get());
        return *objects_.back();
    }
    void add(const peers::Pose& pose, double radius, double mass, double inertia) {
        btRigidBody& body = add(new btSphereShape(scalar(radius)), pose.x, pose.y, pose.yaw, mass, inertia);
        body.setLinearFactor({1, 1, 0});
        body.setAngularFactor({0, 0, 1});
        if (bodies_.size() < robots_) body.setActivationState(DISABLE_DEACTIVATION);
        bodies_.push_back(&body);
    }
    void add_wall(double x, double y, double half_x, double half_y) {
        add(new btBoxShape({scalar(half_x), scalar(half_y), 1}), x, y, 0, 0, 0);
    }

    std::size_t robots_;
    int steps_;
    btScalar step_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> objects_;
    std::vector<btRigidBody*> bodies_;  ///< robots, then balls
    std::vector<peers::Command> commands_;
    std::vector<double> ranges_;
};

}  // namespace

int main(int argc, char** argv) { return peers::serve<BulletWorld>(argc, argv); }
