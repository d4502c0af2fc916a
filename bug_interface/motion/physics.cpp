#include "bug_interface/motion/physics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <btBulletDynamicsCommon.h>

namespace forage::bug {
namespace {

constexpr double near_enough = 0.001;  ///< m; well above the errors of Bullet's single precision
constexpr float box_half_height = 1;   ///< m; any, as long as contacts are horizontal

/// Distance from point (x, y) to an outline, 0 inside.
double distance_to(const Outline& o, double x, double y) {
    const double dx = x - o.x, dy = y - o.y;
    if (o.round) return std::max(0.0, std::sqrt(dx * dx + dy * dy) - o.radius);
    const double out_x = std::max(0.0, std::abs(o.cos_yaw * dx + o.sin_yaw * dy) - o.half_x);
    const double out_y = std::max(0.0, std::abs(o.cos_yaw * dy - o.sin_yaw * dx) - o.half_y);
    return std::sqrt(out_x * out_x + out_y * out_y);
}

double wrapped(double yaw) {
    if (yaw > -std::numbers::pi && yaw <= std::numbers::pi) return yaw;
    const double rest = std::remainder(yaw, 2 * std::numbers::pi);
    return rest <= -std::numbers::pi ? std::numbers::pi : rest;
}

/// Bullet's default is megabytes for thousands of contacts; it takes more when these are used up.
btDefaultCollisionConstructionInfo small_pools() {
    btDefaultCollisionConstructionInfo info;
    info.m_defaultMaxPersistentManifoldPoolSize = info.m_defaultMaxCollisionAlgorithmPoolSize = 64;
    return info;
}

btVector3 vector(double x, double y) { return {static_cast<btScalar>(x), static_cast<btScalar>(y), 0}; }

}  // namespace

/// All is flat, and the middles of all shapes lie in one plane. There a sphere does what an upright cylinder
/// does, and Bullet finds its contacts exactly, while those of a cylinder have normals that are off by up to
/// 0.01 rad.
///
/// Bullet finds contacts and solves velocities; poses are kept and moved outside, in double precision.
/// No contact and no impulse outlives its step.
class Physics::Engine {
  public:
    Engine(std::span<const Obstacle> obstacles, std::span<const Body> bodies)
        : configuration_(small_pools()),
          dispatcher_(&configuration_),
          world_(&dispatcher_, &broadphase_, &configuration_) {
        // Between two spheres Bullet's special algorithm sees only overlaps, the general one also what is
        // just ahead.
        dispatcher_.registerCollisionCreateFunc(
            SPHERE_SHAPE_PROXYTYPE, SPHERE_SHAPE_PROXYTYPE,
            configuration_.getCollisionAlgorithmCreateFunc(CONVEX_HULL_SHAPE_PROXYTYPE,
                                                           CONVEX_HULL_SHAPE_PROXYTYPE));
        world_.setForceUpdateAllAabbs(false);
        // The scalar rows: the others differ with what the processor has.
        solver_.setConstraintRowSolverGeneric(solver_.getScalarConstraintRowSolverGeneric());
        solver_.setConstraintRowSolverLowerLimit(solver_.getScalarConstraintRowSolverLowerLimit());
        info_.m_solverMode = 0;  // no warm start: see above
        info_.m_numIterations = 30;
        info_.m_erp2 = 0;  // whatever overlaps may stay so: static things push nothing out in the original
        for (const Obstacle& o : obstacles) add(o);
        for (const Body& b : bodies) add(b);
    }
    ~Engine() {
        for (const auto& object : objects_) world_.removeCollisionObject(object.get());
    }
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    void solve(double step, std::span<const State> states, std::span<Velocity> velocities) {
        for (std::size_t i = 0; i < states.size(); ++i) {
            btTransform transform = btTransform::getIdentity();  // a round body needs no yaw
            const Velocity v = states[i].present ? velocities[i] : Velocity{0, 0, 0};
            // Bodies that are not there wait where nothing is.
            transform.setOrigin(states[i].present ? vector(states[i].pose.x, states[i].pose.y)
                                                  : vector(1e4, 10.0 * static_cast<double>(i)));
            rigid(i).setWorldTransform(transform);
            rigid(i).setLinearVelocity(vector(v.x, v.y));
            rigid(i).setAngularVelocity({0, 0, static_cast<btScalar>(v.turn)});
        }
        for (int m = 0; m < dispatcher_.getNumManifolds(); ++m)
            dispatcher_.getManifoldByIndexInternal(m)->clearManifold();
        world_.performDiscreteCollisionDetection();
        find_touching();
        if (touching_.empty()) return;
        info_.m_timeStep = static_cast<btScalar>(step);
        solver_.solveGroup(bodies_.data(), static_cast<int>(bodies_.size()), touching_.data(),
                           static_cast<int>(touching_.size()), nullptr, 0, info_, nullptr, &dispatcher_);
        for (std::size_t i = 0; i < states.size(); ++i) {
            const auto& linear = rigid(i).getLinearVelocity();
            const auto& angular = rigid(i).getAngularVelocity();
            // What no contact changed keeps its full precision.
            const auto update = [](double& value, btScalar solved) {
                if (static_cast<btScalar>(value) != solved) value = static_cast<double>(solved);
            };
            update(velocities[i].x, linear.x());
            update(velocities[i].y, linear.y());
            update(velocities[i].turn, angular.z());
        }
    }

  private:
    btRigidBody& rigid(std::size_t body) { return *static_cast<btRigidBody*>(bodies_[body]); }

    /// The pairs that touch, with their friction: the smaller coefficient of two surfaces counts, as in the
    /// original. In order of the objects: Bullet's own order, in which it solves, tells who met whom before.
    void find_touching() {
        touching_.clear();
        for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
            btPersistentManifold* contact = dispatcher_.getManifoldByIndexInternal(m);
            if (contact->getNumContacts() == 0) continue;
            touching_.push_back(contact);
            const btScalar friction =
                std::min(contact->getBody0()->getFriction(), contact->getBody1()->getFriction());
            for (int p = 0; p < contact->getNumContacts(); ++p)
                contact->getContactPoint(p).m_combinedFriction = friction;
        }
        const auto place = [](const btPersistentManifold* c) {
            return std::pair(c->getBody0()->getWorldArrayIndex(), c->getBody1()->getWorldArrayIndex());
        };
        std::sort(touching_.begin(), touching_.end(),
                  [&](const auto* a, const auto* b) { return place(a) < place(b); });
    }

    void add(const Obstacle& o) {
        const auto scalar = [](double v) { return static_cast<btScalar>(v); };
        btTransform transform = btTransform::getIdentity();
        transform.setOrigin(vector(o.outline.x, o.outline.y));
        std::unique_ptr<btConvexInternalShape> shape;
        if (o.outline.round) {
            shape = std::make_unique<btSphereShape>(scalar(o.outline.radius));
        } else {
            transform.setRotation({{0, 0, 1}, scalar(std::atan2(o.outline.sin_yaw, o.outline.cos_yaw))});
            shape = std::make_unique<btBoxShape>(
                btVector3(scalar(o.outline.half_x), scalar(o.outline.half_y), box_half_height));
            shape->setMargin(1e-4f);  // it rounds the corners
        }
        auto body =
            std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, shape.get()));
        body->setWorldTransform(transform);
        body->setFriction(scalar(o.friction));
        body->setActivationState(ISLAND_SLEEPING);  // its bounds are computed once
        world_.addCollisionObject(body.get(), btBroadphaseProxy::StaticFilter,
                                  btBroadphaseProxy::DefaultFilter);
        objects_.push_back(std::move(body));
        shapes_.push_back(std::move(shape));
    }

    void add(const Body& b) {
        const auto radius = static_cast<btScalar>(b.radius);
        auto shape = std::make_unique<btSphereShape>(radius);
        const auto inertia = static_cast<btScalar>(b.inertia);
        btRigidBody::btRigidBodyConstructionInfo info(static_cast<btScalar>(b.mass), nullptr, shape.get(),
                                                      {inertia, inertia, inertia});
        auto body = std::make_unique<btRigidBody>(info);
        body->setLinearFactor({1, 1, 0});
        body->setAngularFactor({0, 0, 1});
        body->setFlags(0);  // no gyroscopic forces
        body->setFriction(static_cast<btScalar>(b.friction));
        body->setActivationState(DISABLE_DEACTIVATION);
        world_.addCollisionObject(body.get(), btBroadphaseProxy::DefaultFilter,
                                  btBroadphaseProxy::DefaultFilter | btBroadphaseProxy::StaticFilter);
        bodies_.push_back(body.get());
        objects_.push_back(std::move(body));
        shapes_.push_back(std::move(shape));
    }

    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> objects_;
    std::vector<btCollisionObject*> bodies_;  ///< those of `objects_` that move
    std::vector<btPersistentManifold*> touching_;
    btContactSolverInfo info_;
    btCollisionWorld world_;
};

Physics::Physics(std::span<const Obstacle> obstacles, std::span<const Body> bodies, double step,
                 Contacts contacts)
    : obstacles_(obstacles.begin(), obstacles.end()),
      bodies_(bodies.begin(), bodies.end()),
      states_(bodies.size()),
      velocities_(bodies.size()),
      step_(step),
      contacts_(contacts) {}

Physics::~Physics() = default;

void Physics::place(std::size_t body, const Pose2& pose) {
    states_[body].pose = {pose.x, pose.y, wrapped(pose.yaw)};
    states_[body].present = true;
    for (State& s : states_) s.clearance = 0;  // the others may be near it now
}

void Physics::lift(std::size_t body) { states_[body].present = false; }

/// Of a gap between two bodies each may use one half.
void Physics::measure_clearance(std::size_t body) {
    State& state = states_[body];
    double gap = std::numeric_limits<double>::infinity();
    for (const Obstacle& o : obstacles_)
        gap = std::min(gap, distance_to(o.outline, state.pose.x, state.pose.y) - bodies_[body].radius);
    for (std::size_t other = 0; other < states_.size(); ++other) {
        if (other == body || !states_[other].present) continue;
        const Pose2& there = states_[other].pose;
        const double apart = std::hypot(there.x - state.pose.x, there.y - state.pose.y) -
                             bodies_[body].radius - bodies_[other].radius;
        gap = std::min(gap, apart / 2);
        states_[other].clearance = std::min(states_[other].clearance, apart / 2);
    }
    state.clearance = gap;
}

bool Physics::near_something(std::size_t body, double travel) {
    if (states_[body].clearance < travel + near_enough) measure_clearance(body);
    return states_[body].clearance < travel + near_enough;
}

void Physics::step(std::span<const MotorCommand> drives) {
    bool contacts = contacts_ == Contacts::always;
    for (std::size_t i = 0; i < states_.size(); ++i) {
        const State& s = states_[i];
        if (!s.present) continue;
        velocities_[i] = {drives[i].forward * std::cos(s.pose.yaw), drives[i].forward * std::sin(s.pose.yaw),
                          drives[i].turn};
        contacts |= near_something(i, std::abs(drives[i].forward) * step_);
    }
    if (contacts) {
        if (!engine_) engine_ = std::make_unique<Engine>(obstacles_, bodies_);
        ++contact_steps_;
        engine_->solve(step_, states_, velocities_);
    }
    for (std::size_t i = 0; i < states_.size(); ++i) {
        State& s = states_[i];
        if (!s.present) continue;
        const Velocity& v = velocities_[i];
        s.pose.x += v.x * step_;
        s.pose.y += v.y * step_;
        s.pose.yaw = wrapped(s.pose.yaw + v.turn * step_);
        // A body may be pushed faster than it is driven.
        s.clearance -= contacts ? std::hypot(v.x, v.y) * step_ : std::abs(drives[i].forward) * step_;
    }
}

}  // namespace forage::bug
