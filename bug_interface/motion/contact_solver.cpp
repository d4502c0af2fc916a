#include "bug_interface/motion/contact_solver.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace forage::bug {
namespace {

constexpr float box_half_height = 1;    ///< m; has no effect, since all contacts are horizontal
constexpr btScalar touching = 0.0005f;  ///< m; shapes closer than this touch
constexpr btScalar residual = 1e-12f;   ///< (N s)^2; stops the solver at errors of about 1e-7 m/s

/// Memory pools for a few contacts; Bullet allocates more when needed. Its default takes megabytes.
btDefaultCollisionConstructionInfo small_pools() {
    btDefaultCollisionConstructionInfo info;
    info.m_defaultMaxPersistentManifoldPoolSize = info.m_defaultMaxCollisionAlgorithmPoolSize = 64;
    return info;
}

btScalar scalar(double v) { return static_cast<btScalar>(v); }
btVector3 vector(double x, double y) { return {scalar(x), scalar(y), 0}; }

btMatrix3x3 turn(double cos_yaw, double sin_yaw) {
    const btScalar c = scalar(cos_yaw), s = scalar(sin_yaw);
    return {c, -s, 0, s, c, 0, 0, 0, 1};
}

btTransform transform_of(const Outline& o) {
    btTransform transform = btTransform::getIdentity();
    transform.setOrigin(vector(o.x, o.y));
    if (!o.round) transform.setBasis(turn(o.cos_yaw, o.sin_yaw));
    return transform;
}

/// The number of a shape within its object; Bullet's index is -1 for an object with one shape.
int shape_number(int index) { return std::max(0, index); }

}  // namespace

Physics::ContactSolver::ContactSolver(std::span<const Obstacle> obstacles, std::span<const Body> bodies,
                                      std::span<const LayerMask> collision_masks)
    : configuration_(small_pools()),
      dispatcher_(&configuration_),
      collision_masks_(collision_masks.begin(), collision_masks.end()),
      world_(&dispatcher_, &broadphase_, &configuration_) {
    // Bullet's algorithm for two spheres detects only overlaps. The one for convex shapes also detects small
    // gaps.
    dispatcher_.registerCollisionCreateFunc(SPHERE_SHAPE_PROXYTYPE, SPHERE_SHAPE_PROXYTYPE,
                                            configuration_.getCollisionAlgorithmCreateFunc(
                                                CONVEX_HULL_SHAPE_PROXYTYPE, CONVEX_HULL_SHAPE_PROXYTYPE));
    world_.setForceUpdateAllAabbs(false);
    // The scalar solver gives the same bits on all processors; the vectorised ones do not.
    solver_.setConstraintRowSolverGeneric(solver_.getScalarConstraintRowSolverGeneric());
    solver_.setConstraintRowSolverLowerLimit(solver_.getScalarConstraintRowSolverLowerLimit());
    info_.m_solverMode = 0;  // no warm start: impulses do not persist
    info_.m_leastSquaresResidualThreshold = residual;
    info_.m_erp2 = 0;  // no position correction: obstacles push nothing out in the original
    for (const Obstacle& o : obstacles) add(o);
    obstacles_ = objects_.size();
    for (const Body& b : bodies)
        if (b.driven) max_driven_mass_ = std::max(max_driven_mass_, b.mass);
    for (const Body& b : bodies) add(b);
    parked_.assign(bodies.size(), 0);
}

Physics::ContactSolver::~ContactSolver() {
    for (const auto& object : objects_) world_.removeCollisionObject(object.get());
}

/// Inactive bodies are parked outside the world, where they cost nothing.
void Physics::ContactSolver::set_state(std::size_t body, const State& state, const Velocity& velocity) {
    btRigidBody& object = rigid(body);
    if (!state.active && parked_[body]) return;
    btTransform transform = btTransform::getIdentity();
    const bool round = object.getCollisionShape()->getShapeType() == SPHERE_SHAPE_PROXYTYPE;
    if (state.active) {
        transform.setOrigin(vector(state.pose.x, state.pose.y));
        if (!round) transform.setBasis(turn(state.cos_yaw, state.sin_yaw));
    } else {
        transform.setOrigin(vector(1e4, 10.0 * static_cast<double>(body)));
    }
    object.setWorldTransform(transform);
    object.setLinearVelocity(state.active ? vector(velocity.x, velocity.y) : vector(0, 0));
    object.setAngularVelocity({0, 0, state.active ? scalar(velocity.turn) : 0});
    if (state.active == static_cast<bool>(parked_[body])) {
        parked_[body] = !state.active;
        object.forceActivationState(state.active ? DISABLE_DEACTIVATION : ISLAND_SLEEPING);
        world_.updateSingleAabb(&object);
    }
}

void Physics::ContactSolver::solve(double step, std::span<State> states, std::span<Velocity> velocities,
                                   std::span<char> touched) {
    active_bodies_.clear();
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (states[i].active) states[i].update_rotation();
        set_state(i, states[i], velocities[i]);
        if (states[i].active) active_bodies_.push_back(bodies_[i]);
    }
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m)
        dispatcher_.getManifoldByIndexInternal(m)->clearManifold();
    world_.performDiscreteCollisionDetection();
    find_contacts(states, touched);
    if (manifolds_.empty()) return;
    info_.m_timeStep = scalar(step);
    const auto is_movable = [&](const btCollisionObject* o) {
        return object_info_[static_cast<std::size_t>(o->getUserIndex())].movable;
    };
    const bool movable = std::any_of(manifolds_.begin(), manifolds_.end(), [&](const auto* contact) {
        return is_movable(contact->getBody0()) || is_movable(contact->getBody1());
    });
    info_.m_numIterations = movable ? 60 : 30;  // rows of movable objects converge slowly
    solver_.solveGroup(active_bodies_.data(), static_cast<int>(active_bodies_.size()), manifolds_.data(),
                       static_cast<int>(manifolds_.size()), nullptr, 0, info_, nullptr, &dispatcher_);
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (!states[i].active) continue;
        const auto& linear = rigid(i).getLinearVelocity();
        const auto& angular = rigid(i).getAngularVelocity();
        // A velocity that no contact changed keeps its double precision.
        const auto update = [](double& value, btScalar solved) {
            if (scalar(value) != solved) value = static_cast<double>(solved);
        };
        update(velocities[i].x, linear.x());
        update(velocities[i].y, linear.y());
        update(velocities[i].turn, angular.z());
    }
}

void Physics::ContactSolver::update_shapes(std::size_t body, std::span<const Part> parts) {
    auto* compound = dynamic_cast<btCompoundShape*>(rigid(body).getCollisionShape());
    if (!compound) return;
    const int first = compound->getNumChildShapes() - static_cast<int>(parts.size());
    for (std::size_t p = 0; p < parts.size(); ++p)
        compound->updateChildTransform(first + static_cast<int>(p), transform_of(parts[p].outline), false);
    compound->recalculateLocalAabb();
}

bool Physics::ContactSolver::can_collide(const ObjectInfo& a, int shape_a, const ObjectInfo& b,
                                         int shape_b) const {
    if (b.obstacle_layers && !a.obstacle_layers) return can_collide(b, shape_b, a, shape_a);
    const int layer = b.layers[static_cast<std::size_t>(shape_b)];
    if (a.obstacle_layers) return a.obstacle_layers >> layer & 1u;
    return collision_masks_[static_cast<std::size_t>(a.layers[static_cast<std::size_t>(shape_a)])] >> layer &
           1u;
}

/// Collects the contacts in `manifolds_`, without those of shapes that share no height. A contact has the
/// smaller friction coefficient of its two surfaces, as in the original. The contacts are sorted by object,
/// as the solution depends on their order, and Bullet's own order depends on earlier contacts.
void Physics::ContactSolver::find_contacts(std::span<State> states, std::span<char> touched) {
    manifolds_.clear();
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
        btPersistentManifold* contact = dispatcher_.getManifoldByIndexInternal(m);
        const auto number = [](const btCollisionObject* o) {
            return static_cast<std::size_t>(o->getUserIndex());
        };
        const std::size_t first = number(contact->getBody0()), second = number(contact->getBody1());
        const ObjectInfo &a = object_info_[first], &b = object_info_[second];
        for (int p = contact->getNumContacts() - 1; p >= 0; --p) {
            btManifoldPoint& point = contact->getContactPoint(p);
            const int shape_a = shape_number(point.m_index0), shape_b = shape_number(point.m_index1);
            if (!can_collide(a, shape_a, b, shape_b)) {
                contact->removeContactPoint(p);
                continue;
            }
            point.m_combinedFriction = std::min(a.friction[static_cast<std::size_t>(shape_a)],
                                                b.friction[static_cast<std::size_t>(shape_b)]);
            if (point.getDistance() < touching) {
                if (a.movable && b.driven) ++states[first - obstacles_].robot_contacts;
                if (b.movable && a.driven) ++states[second - obstacles_].robot_contacts;
                if (a.driven && !touched.empty()) touched[first - obstacles_] = 1;
                if (b.driven && !touched.empty()) touched[second - obstacles_] = 1;
            }
        }
        if (contact->getNumContacts() > 0) manifolds_.push_back(contact);
    }
    const auto key = [](const btPersistentManifold* c) {  // compounds have several contacts with each other
        const btManifoldPoint& first = c->getContactPoint(0);
        return std::tuple(c->getBody0()->getUserIndex(), c->getBody1()->getUserIndex(), first.m_index0,
                          first.m_index1);
    };
    std::stable_sort(manifolds_.begin(), manifolds_.end(),
                     [&](const auto* a, const auto* b) { return key(a) < key(b); });
}

btCollisionShape* Physics::ContactSolver::shape_of(const Outline& o) {
    std::unique_ptr<btConvexInternalShape> shape;
    if (o.round) {
        shape = std::make_unique<btSphereShape>(scalar(o.radius));
    } else {
        shape = std::make_unique<btBoxShape>(btVector3(scalar(o.half_x), scalar(o.half_y), box_half_height));
        shape->setMargin(1e-4f);  // rounds the corners
    }
    return shapes_.emplace_back(std::move(shape)).get();
}

void Physics::ContactSolver::add(const Obstacle& o) {
    auto body = std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(0, nullptr, shape_of(o.outline)));
    body->setWorldTransform(transform_of(o.outline));
    body->setActivationState(ISLAND_SLEEPING);  // keeps Bullet from updating its bounds
    body->setUserIndex(static_cast<int>(objects_.size()));
    object_info_.push_back({false, false, o.layers, {0}, {scalar(o.friction)}});
    world_.addCollisionObject(body.get(), btBroadphaseProxy::StaticFilter, btBroadphaseProxy::DefaultFilter);
    objects_.push_back(std::move(body));
}

void Physics::ContactSolver::add(const Body& b) {
    ObjectInfo info{b.driven, !b.driven, 0, {}, {}};
    btCollisionShape* shape = nullptr;
    if (b.radius > 0) {
        shape = shapes_.emplace_back(std::make_unique<btSphereShape>(scalar(b.radius))).get();
        info.layers.push_back(b.layer);
        info.friction.push_back(scalar(b.friction));
    }
    if (!b.parts.empty()) {
        auto compound = std::make_unique<btCompoundShape>();
        if (shape) compound->addChildShape(btTransform::getIdentity(), shape);
        for (const Part& part : b.parts) {
            compound->addChildShape(transform_of(part.outline), shape_of(part.outline));
            info.layers.push_back(part.layer);
            info.friction.push_back(scalar(part.friction));
        }
        shape = shapes_.emplace_back(std::move(compound)).get();
    }
    // With an impulse solver, a heavy body pushes a light one through a wall. Therefore movable objects are
    // at least as heavy as the heaviest robot here. This changes little, as robots get the velocity of their
    // command in every step, whatever mass they push.
    const double mass = b.driven ? b.mass : std::max(b.mass, max_driven_mass_);
    const btScalar inertia = scalar(b.inertia * mass / b.mass);
    auto body = std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(scalar(mass), nullptr, shape, {inertia, inertia, inertia}));
    body->setLinearFactor({1, 1, 0});
    body->setAngularFactor({0, 0, 1});
    body->setFlags(0);  // no gyroscopic forces
    body->setActivationState(DISABLE_DEACTIVATION);
    body->setUserIndex(static_cast<int>(objects_.size()));
    world_.addCollisionObject(body.get(), btBroadphaseProxy::DefaultFilter,
                              btBroadphaseProxy::DefaultFilter | btBroadphaseProxy::StaticFilter);
    object_info_.push_back(std::move(info));
    bodies_.push_back(body.get());
    objects_.push_back(std::move(body));
}

}  // namespace forage::bug
