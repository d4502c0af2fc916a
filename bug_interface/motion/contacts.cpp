#include "bug_interface/motion/contacts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace forage::bug {
namespace {

constexpr float box_half_height = 1;    ///< m; any, as long as contacts are horizontal
constexpr btScalar touching = 0.0005f;  ///< m; shapes nearer than this touch
constexpr btScalar residual = 1e-12f;   ///< (N s)^2, below which impulses are solved: some 1e-7 m/s

/// Bullet's default is megabytes for thousands of contacts; it takes more when these are used up.
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

btTransform place_of(const Outline& o) {
    btTransform transform = btTransform::getIdentity();
    transform.setOrigin(vector(o.x, o.y));
    if (!o.round) transform.setBasis(turn(o.cos_yaw, o.sin_yaw));
    return transform;
}

/// The number of a shape in an object's compound.
int shape_number(int index) { return std::max(0, index); }

}  // namespace

Physics::Engine::Engine(std::span<const Obstacle> obstacles, std::span<const Body> bodies,
                        std::span<const LayerMask> meets)
    : configuration_(small_pools()),
      dispatcher_(&configuration_),
      meets_(meets.begin(), meets.end()),
      world_(&dispatcher_, &broadphase_, &configuration_) {
    // Between two spheres Bullet's special algorithm sees only overlaps, the general one also what is
    // just ahead.
    dispatcher_.registerCollisionCreateFunc(SPHERE_SHAPE_PROXYTYPE, SPHERE_SHAPE_PROXYTYPE,
                                            configuration_.getCollisionAlgorithmCreateFunc(
                                                CONVEX_HULL_SHAPE_PROXYTYPE, CONVEX_HULL_SHAPE_PROXYTYPE));
    world_.setForceUpdateAllAabbs(false);
    // The scalar rows: the others differ with what the processor has.
    solver_.setConstraintRowSolverGeneric(solver_.getScalarConstraintRowSolverGeneric());
    solver_.setConstraintRowSolverLowerLimit(solver_.getScalarConstraintRowSolverLowerLimit());
    info_.m_solverMode = 0;  // no warm start: see above
    info_.m_leastSquaresResidualThreshold = residual;
    info_.m_erp2 = 0;  // whatever overlaps may stay so: static things push nothing out in the original
    for (const Obstacle& o : obstacles) add(o);
    obstacles_ = objects_.size();
    for (const Body& b : bodies)
        if (b.driven) heaviest_ = std::max(heaviest_, b.mass);
    for (const Body& b : bodies) add(b);
    parked_.assign(bodies.size(), 0);
}

Physics::Engine::~Engine() {
    for (const auto& object : objects_) world_.removeCollisionObject(object.get());
}

/// Bodies that are not involved wait where nothing is, and cost nothing there.
void Physics::Engine::set(std::size_t body, const State& state, const Velocity& velocity) {
    btRigidBody& object = rigid(body);
    if (!state.involved && parked_[body]) return;
    btTransform transform = btTransform::getIdentity();
    const bool round = object.getCollisionShape()->getShapeType() == SPHERE_SHAPE_PROXYTYPE;
    if (state.involved) {
        transform.setOrigin(vector(state.pose.x, state.pose.y));
        if (!round) transform.setBasis(turn(state.cos_yaw, state.sin_yaw));
    } else {
        transform.setOrigin(vector(1e4, 10.0 * static_cast<double>(body)));
    }
    object.setWorldTransform(transform);
    object.setLinearVelocity(state.involved ? vector(velocity.x, velocity.y) : vector(0, 0));
    object.setAngularVelocity({0, 0, state.involved ? scalar(velocity.turn) : 0});
    if (state.involved == static_cast<bool>(parked_[body])) {
        parked_[body] = !state.involved;
        object.forceActivationState(state.involved ? DISABLE_DEACTIVATION : ISLAND_SLEEPING);
        world_.updateSingleAabb(&object);
    }
}

void Physics::Engine::solve(double step, std::span<State> states, std::span<Velocity> velocities) {
    solved_.clear();
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (states[i].involved) states[i].face();
        set(i, states[i], velocities[i]);
        if (states[i].involved) solved_.push_back(bodies_[i]);
    }
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m)
        dispatcher_.getManifoldByIndexInternal(m)->clearManifold();
    world_.performDiscreteCollisionDetection();
    find_contacts(states);
    if (touching_.empty()) return;
    info_.m_timeStep = scalar(step);
    const auto is_movable = [&](const btCollisionObject* o) {
        return known_[static_cast<std::size_t>(o->getUserIndex())].movable;
    };
    const bool movable = std::any_of(touching_.begin(), touching_.end(), [&](const auto* contact) {
        return is_movable(contact->getBody0()) || is_movable(contact->getBody1());
    });
    info_.m_numIterations = movable ? 60 : 30;  // rows of things need more
    solver_.solveGroup(solved_.data(), static_cast<int>(solved_.size()), touching_.data(),
                       static_cast<int>(touching_.size()), nullptr, 0, info_, nullptr, &dispatcher_);
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (!states[i].involved) continue;
        const auto& linear = rigid(i).getLinearVelocity();
        const auto& angular = rigid(i).getAngularVelocity();
        // What no contact changed keeps its full precision.
        const auto update = [](double& value, btScalar solved) {
            if (scalar(value) != solved) value = static_cast<double>(solved);
        };
        update(velocities[i].x, linear.x());
        update(velocities[i].y, linear.y());
        update(velocities[i].turn, angular.z());
    }
}

void Physics::Engine::reshape(std::size_t body, std::span<const Part> parts) {
    auto* compound = dynamic_cast<btCompoundShape*>(rigid(body).getCollisionShape());
    if (!compound) return;
    const int first = compound->getNumChildShapes() - static_cast<int>(parts.size());
    for (std::size_t p = 0; p < parts.size(); ++p)
        compound->updateChildTransform(first + static_cast<int>(p), place_of(parts[p].outline), false);
    compound->recalculateLocalAabb();
}

bool Physics::Engine::meet(const Shapes& a, int shape_a, const Shapes& b, int shape_b) const {
    if (b.obstacle && !a.obstacle) return meet(b, shape_b, a, shape_a);
    const int layer = b.layers[static_cast<std::size_t>(shape_b)];
    if (a.obstacle) return a.obstacle >> layer & 1u;
    return meets_[static_cast<std::size_t>(a.layers[static_cast<std::size_t>(shape_a)])] >> layer & 1u;
}

/// The pairs that touch, without the contacts of shapes that share no height. Of two surfaces the smaller
/// coefficient counts, as in the original. In order of the objects: Bullet's own order, in which it solves,
/// tells who met whom before.
void Physics::Engine::find_contacts(std::span<State> states) {
    touching_.clear();
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
        btPersistentManifold* contact = dispatcher_.getManifoldByIndexInternal(m);
        const auto number = [](const btCollisionObject* o) {
            return static_cast<std::size_t>(o->getUserIndex());
        };
        const std::size_t first = number(contact->getBody0()), second = number(contact->getBody1());
        const Shapes &a = known_[first], &b = known_[second];
        for (int p = contact->getNumContacts() - 1; p >= 0; --p) {
            btManifoldPoint& point = contact->getContactPoint(p);
            const int shape_a = shape_number(point.m_index0), shape_b = shape_number(point.m_index1);
            if (!meet(a, shape_a, b, shape_b)) {
                contact->removeContactPoint(p);
                continue;
            }
            point.m_combinedFriction = std::min(a.friction[static_cast<std::size_t>(shape_a)],
                                                b.friction[static_cast<std::size_t>(shape_b)]);
            if (point.getDistance() < touching) {
                if (a.movable && b.driven) ++states[first - obstacles_].touches;
                if (b.movable && a.driven) ++states[second - obstacles_].touches;
            }
        }
        if (contact->getNumContacts() > 0) touching_.push_back(contact);
    }
    const auto place = [](const btPersistentManifold* c) {  // bodies of several shapes meet in several
        const btManifoldPoint& first = c->getContactPoint(0);
        return std::tuple(c->getBody0()->getUserIndex(), c->getBody1()->getUserIndex(), first.m_index0,
                          first.m_index1);
    };
    std::stable_sort(touching_.begin(), touching_.end(),
                     [&](const auto* a, const auto* b) { return place(a) < place(b); });
}

btCollisionShape* Physics::Engine::shape_of(const Outline& o) {
    std::unique_ptr<btConvexInternalShape> shape;
    if (o.round) {
        shape = std::make_unique<btSphereShape>(scalar(o.radius));
    } else {
        shape = std::make_unique<btBoxShape>(btVector3(scalar(o.half_x), scalar(o.half_y), box_half_height));
        shape->setMargin(1e-4f);  // it rounds the corners
    }
    return shapes_.emplace_back(std::move(shape)).get();
}

void Physics::Engine::add(const Obstacle& o) {
    auto body = std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(0, nullptr, shape_of(o.outline)));
    body->setWorldTransform(place_of(o.outline));
    body->setActivationState(ISLAND_SLEEPING);  // its bounds are computed once
    body->setUserIndex(static_cast<int>(objects_.size()));
    known_.push_back({false, false, o.layers, {0}, {scalar(o.friction)}});
    world_.addCollisionObject(body.get(), btBroadphaseProxy::StaticFilter, btBroadphaseProxy::DefaultFilter);
    objects_.push_back(std::move(body));
}

void Physics::Engine::add(const Body& b) {
    Shapes known{b.driven, !b.driven, 0, {}, {}};
    btCollisionShape* shape = nullptr;
    if (b.radius > 0) {
        shape = shapes_.emplace_back(std::make_unique<btSphereShape>(scalar(b.radius))).get();
        known.layers.push_back(b.layer);
        known.friction.push_back(scalar(b.friction));
    }
    if (!b.parts.empty()) {
        auto compound = std::make_unique<btCompoundShape>();
        if (shape) compound->addChildShape(btTransform::getIdentity(), shape);
        for (const Part& part : b.parts) {
            compound->addChildShape(place_of(part.outline), shape_of(part.outline));
            known.layers.push_back(part.layer);
            known.friction.push_back(scalar(part.friction));
        }
        shape = shapes_.emplace_back(std::move(compound)).get();
    }
    // A solver of impulses lets something heavy push something light through a wall. A robot is given its
    // velocity anew in every step, so that within one it makes little difference to it how heavy the things
    // are that it pushes.
    const double mass = b.driven ? b.mass : std::max(b.mass, heaviest_);
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
    known_.push_back(std::move(known));
    bodies_.push_back(body.get());
    objects_.push_back(std::move(body));
}

}  // namespace forage::bug
