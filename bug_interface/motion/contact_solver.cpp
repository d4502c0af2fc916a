#include "bug_interface/motion/contact_solver.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace forage::bug {
namespace {

constexpr float box_half_height = 1;           ///< m; has no effect, since all contacts are horizontal
constexpr btScalar residual = 1e-10f;          ///< (m/s)^2; stops the solver at errors of about 1e-5 m/s
constexpr std::size_t most_algorithms = 1024;  ///< pairs whose memory is kept

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
      collision_masks_(collision_masks.begin(), collision_masks.end()) {
    // Bullet's algorithm for two spheres detects only overlaps. The one for convex shapes also detects gaps,
    // and so does the one for a sphere and a box, which Bullet has but does not choose by itself.
    dispatcher_.registerCollisionCreateFunc(SPHERE_SHAPE_PROXYTYPE, SPHERE_SHAPE_PROXYTYPE,
                                            configuration_.getCollisionAlgorithmCreateFunc(
                                                CONVEX_HULL_SHAPE_PROXYTYPE, CONVEX_HULL_SHAPE_PROXYTYPE));
    dispatcher_.registerCollisionCreateFunc(SPHERE_SHAPE_PROXYTYPE, BOX_SHAPE_PROXYTYPE, &sphere_box_);
    dispatcher_.registerCollisionCreateFunc(BOX_SHAPE_PROXYTYPE, SPHERE_SHAPE_PROXYTYPE, &box_sphere_);
    box_sphere_.m_swapped = true;
    // All gaps up to 2 cm count, however small the shapes are.
    dispatcher_.setDispatcherFlags(dispatcher_.getDispatcherFlags() &
                                   ~btCollisionDispatcher::CD_USE_RELATIVE_CONTACT_BREAKING_THRESHOLD);
    // The scalar solver gives the same bits on all processors; the vectorised ones do not.
    solver_.setConstraintRowSolverGeneric(solver_.getScalarConstraintRowSolverGeneric());
    solver_.setConstraintRowSolverLowerLimit(solver_.getScalarConstraintRowSolverLowerLimit());
    info_.m_solverMode = 0;  // no warm start: impulses do not persist
    info_.m_leastSquaresResidualThreshold = residual;
    info_.m_erp2 = 0;  // no position correction: obstacles push nothing out in the original
    for (const Obstacle& o : obstacles) add(o);
    obstacles_ = objects_.size();
    for (const Body& b : bodies)
        if (b.driven) heaviest_ = std::max(heaviest_, b.mass);
    for (const Body& b : bodies) add(b);
    steps_.assign(bodies.size(), 1);
}

Physics::ContactSolver::~ContactSolver() = default;

/// Gives Bullet the state of a body. A driven body gets the velocity of its command anew in every time step;
/// for `steps` of them at once it is as many times as heavy.
void Physics::ContactSolver::prepare(std::size_t body, std::uint64_t steps, State& state,
                                     const Velocity& velocity) {
    btRigidBody& object = rigid(body);
    btTransform transform = btTransform::getIdentity();
    transform.setOrigin(vector(state.pose.x, state.pose.y));
    if (object.getCollisionShape()->getShapeType() != SPHERE_SHAPE_PROXYTYPE) {
        state.update_rotation();
        transform.setBasis(turn(state.cos_yaw, state.sin_yaw));
    }
    object.setWorldTransform(transform);
    object.setLinearVelocity(vector(velocity.x, velocity.y));
    object.setAngularVelocity({0, 0, scalar(velocity.turn)});
    if (!object_info_[obstacles_ + body].driven || steps_[body] == steps) return;
    // From the mass of the description: what was set before would leave its rounding errors.
    const auto& [mass, inertia] = object_info_[obstacles_ + body].mass;
    const double n = static_cast<double>(steps);
    object.setMassProps(scalar(n * mass), btVector3(1, 1, 1) * scalar(n * inertia));
    object.updateInertiaTensor();
    steps_[body] = steps;
}

void Physics::ContactSolver::solve(double step, std::uint64_t steps, std::span<const std::size_t> bodies,
                                   std::span<const Pair> pairs, std::span<State> states,
                                   std::span<Velocity> velocities, std::span<char> touched) {
    moving_.clear();
    for (const std::size_t i : bodies) {
        prepare(i, steps, states[i], velocities[i]);
        moving_.push_back(&rigid(i));
    }
    find_contacts(pairs);
    filter_contacts(states, touched);
    if (contacts_.empty()) return;
    info_.m_timeStep = scalar(step * static_cast<double>(steps));
    const auto is_movable = [&](const btCollisionObject* o) {
        return object_info_[static_cast<std::size_t>(o->getUserIndex())].movable;
    };
    const bool movable = std::any_of(contacts_.begin(), contacts_.end(), [&](const auto* contact) {
        return is_movable(contact->getBody0()) || is_movable(contact->getBody1());
    });
    info_.m_numIterations = movable ? 60 : 30;  // rows of movable objects converge slowly
    solver_.solveGroup(moving_.data(), static_cast<int>(moving_.size()), contacts_.data(),
                       static_cast<int>(contacts_.size()), nullptr, 0, info_, nullptr, &dispatcher_);
    for (const std::size_t i : bodies) {
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

/// Lets Bullet find the contacts of all pairs.
void Physics::ContactSolver::find_contacts(std::span<const Pair> pairs) {
    contacts_.clear();
    if (algorithms_.size() > most_algorithms) algorithms_.clear();
    for (const Pair& pair : pairs) {
        const btCollisionObject &a = *objects_[pair.first], &b = *objects_[pair.second];
        const btCollisionObjectWrapper of_a(nullptr, a.getCollisionShape(), &a, a.getWorldTransform(), -1,
                                            -1),
            of_b(nullptr, b.getCollisionShape(), &b, b.getWorldTransform(), -1, -1);
        Algorithm& algorithm = algorithms_[pair];
        if (!algorithm)
            algorithm = {dispatcher_.findAlgorithm(&of_a, &of_b, nullptr, BT_CONTACT_POINT_ALGORITHMS),
                         [this](btCollisionAlgorithm* used) {
                             used->~btCollisionAlgorithm();
                             dispatcher_.freeCollisionAlgorithm(used);
                         }};
        of_pair_.resize(0);
        algorithm->getAllContactManifolds(of_pair_);
        for (int m = 0; m < of_pair_.size(); ++m) of_pair_[m]->clearManifold();
        btManifoldResult result(&of_a, &of_b);
        algorithm->processCollision(&of_a, &of_b, dispatch_info_, &result);
        of_pair_.resize(0);
        algorithm->getAllContactManifolds(of_pair_);
        for (int m = 0; m < of_pair_.size(); ++m) contacts_.push_back(of_pair_[m]);
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

/// Removes the contacts of shapes that share no height. A contact has the smaller friction coefficient of its
/// two surfaces, as in the original. The contacts are sorted by object, as the solution depends on their
/// order, and the order of those of compounds depends on earlier contacts.
void Physics::ContactSolver::filter_contacts(std::span<State> states, std::span<char> touched) {
    for (btPersistentManifold* contact : contacts_) {
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
            if (static_cast<double>(point.getDistance()) < touch_distance) {
                if (a.movable && b.driven) ++states[first - obstacles_].contacts_in_stride;
                if (b.movable && a.driven) ++states[second - obstacles_].contacts_in_stride;
                if (a.driven && !touched.empty()) touched[first - obstacles_] = 1;
                if (b.driven && !touched.empty()) touched[second - obstacles_] = 1;
            }
        }
    }
    std::erase_if(contacts_, [](const auto* contact) { return contact->getNumContacts() == 0; });
    const auto key = [](const btPersistentManifold* c) {  // compounds have several contacts with each other
        const btManifoldPoint& first = c->getContactPoint(0);
        return std::tuple(c->getBody0()->getUserIndex(), c->getBody1()->getUserIndex(), first.m_index0,
                          first.m_index1);
    };
    std::stable_sort(contacts_.begin(), contacts_.end(),
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
    body->setUserIndex(static_cast<int>(objects_.size()));
    object_info_.push_back({false, false, o.layers, {0}, {scalar(o.friction)}, {}});
    objects_.push_back(std::move(body));
}

void Physics::ContactSolver::add(const Body& b) {
    ObjectInfo info{b.driven, !b.driven, 0, {}, {}, {}};
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
    const double mass = contact_mass(b, heaviest_);
    const double inertia = b.inertia * mass / b.mass;
    info.mass = {mass, inertia};
    auto body = std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(
        scalar(mass), nullptr, shape, btVector3(1, 1, 1) * scalar(inertia)));
    body->setLinearFactor({1, 1, 0});
    body->setAngularFactor({0, 0, 1});
    body->setFlags(0);  // no gyroscopic forces
    body->setUserIndex(static_cast<int>(objects_.size()));
    object_info_.push_back(std::move(info));
    objects_.push_back(std::move(body));
}

}  // namespace forage::bug
