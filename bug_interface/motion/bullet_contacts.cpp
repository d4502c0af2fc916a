#include "bug_interface/motion/bullet_contacts.h"

#include <algorithm>
#include <cmath>

#include <BulletCollision/CollisionDispatch/btBoxBoxDetector.h>

namespace forage::bug {
namespace {

constexpr float box_half_height = 1;   ///< m; has no effect, since all contacts are horizontal
constexpr btScalar residual = 1e-10f;  ///< (m/s)^2; stops the solver at errors of about 1e-5 m/s
constexpr int max_iterations = 60;
constexpr double same_point = 1e-5;  ///< m; boxes touch at the same point at several heights

btScalar scalar(double v) { return static_cast<btScalar>(v); }
btVector3 vector(double x, double y) { return {scalar(x), scalar(y), 0}; }
btVector3 vector(const Eigen::Vector2d& v) { return vector(v.x(), v.y()); }

/// The pose of a rectangle when (x, y) is the origin, which keeps coordinates small and so precise.
btTransform transform_of(const Outline& o, double x, double y) {
    const btScalar c = scalar(o.cos_yaw), s = scalar(o.sin_yaw);
    return btTransform(btMatrix3x3(c, -s, 0, s, c, 0, 0, 0, 1), vector(o.x - x, o.y - y));
}

btBoxShape box_of(const Outline& o) {
    return btBoxShape(btVector3(scalar(o.half_x), scalar(o.half_y), box_half_height));
}

btRigidBody::btRigidBodyConstructionInfo body_info(btScalar mass) {
    return {mass, nullptr, nullptr, {mass, mass, mass}};
}

}  // namespace

std::span<const BoxContacts::Point> BoxContacts::find(const Outline& a, const Outline& b) {
    points_.clear();
    struct Collector final : btDiscreteCollisionDetectorInterface::Result {
        Collector(std::vector<Point>& to, double x0, double y0) : points(to), x(x0), y(y0) {}
        void setShapeIdentifiersA(int, int) override {}
        void setShapeIdentifiersB(int, int) override {}
        void addContactPoint(const btVector3& normal, const btVector3& at, btScalar distance) override {
            const Eigen::Vector2d point(x + double{at.x()}, y + double{at.y()});
            for (const Point& p : points)
                if ((p.point - point).squaredNorm() < same_point * same_point) return;
            const Eigen::Vector2d n = Eigen::Vector2d(double{normal.x()}, double{normal.y()}).normalized();
            points.push_back({{-double{distance}, n}, point});
        }
        std::vector<Point>& points;
        double x, y;
    } collector(points_, a.x, a.y);
    const btBoxShape box_a = box_of(a), box_b = box_of(b);
    btDiscreteCollisionDetectorInterface::ClosestPointInput input;
    input.m_transformA = transform_of(a, a.x, a.y), input.m_transformB = transform_of(b, a.x, a.y);
    btBoxBoxDetector(&box_a, &box_b).getClosestPoints(input, collector, nullptr);
    return points_;
}

BulletContacts::BulletContacts() : fixed_(body_info(0)) {
    // The scalar solver gives the same bits on all processors; the vectorised ones do not.
    solver_.setConstraintRowSolverGeneric(solver_.getScalarConstraintRowSolverGeneric());
    solver_.setConstraintRowSolverLowerLimit(solver_.getScalarConstraintRowSolverLowerLimit());
    // Each contact says along which tangent it rubs, and with which impulses the solution begins.
    info_.m_solverMode = SOLVER_USE_WARMSTARTING | SOLVER_ENABLE_FRICTION_DIRECTION_CACHING;
    info_.m_warmstartingFactor = 1;
    info_.m_leastSquaresResidualThreshold = residual;
    info_.m_numIterations = max_iterations;
    info_.m_erp2 = 0;  // no position correction: obstacles push nothing out in the original
}

void BulletContacts::set(std::size_t number, const PushedBody& b) {
    if (number == bodies_.size()) {
        auto& added = *bodies_.emplace_back(std::make_unique<btRigidBody>(body_info(1)));
        added.setLinearFactor({1, 1, 0});
        added.setAngularFactor({0, 0, 1});
        added.setFlags(0);  // no gyroscopic forces
    }
    btRigidBody& body = *bodies_[number];
    body.setWorldTransform(btTransform(btMatrix3x3::getIdentity(), vector(b.x, b.y)));
    body.setMassProps(scalar(b.mass), btVector3(1, 1, 1) * scalar(b.inertia));
    body.updateInertiaTensor();
    body.setLinearVelocity(vector(b.velocity->x, b.velocity->y));
    body.setAngularVelocity({0, 0, scalar(b.velocity->turn)});
    used_bodies_.push_back(&body);
}

void BulletContacts::set(std::size_t number, const PointContact& c) {
    if (number == contacts_.size())
        contacts_.push_back(
            std::make_unique<btPersistentManifold>(nullptr, nullptr, 0, BT_LARGE_FLOAT, BT_LARGE_FLOAT));
    btPersistentManifold& contact = *contacts_[number];
    const auto object = [&](std::size_t body) {
        return body == PointContact::fixed ? &fixed_ : bodies_[body].get();
    };
    contact.setBodies(object(c.body), object(c.other));
    contact.setNumContacts(1);
    const Eigen::Vector2d& normal = c.overlap.normal;
    const btVector3 zero(0, 0, 0);
    // The constructor without arguments leaves the restitution unset.
    btManifoldPoint& point = contact.getContactPoint(0) =
        btManifoldPoint(zero, zero, vector(normal), scalar(-c.overlap.depth));
    point.m_positionWorldOnA = point.m_positionWorldOnB = vector(c.point);
    point.m_lateralFrictionDir1 = vector(-normal.y(), normal.x());
    point.m_contactPointFlags = BT_CONTACT_FLAG_LATERAL_FRICTION_INITIALIZED;
    point.m_combinedFriction = scalar(c.friction);
    point.m_appliedImpulse = scalar(c.push), point.m_appliedImpulseLateral1 = scalar(c.rub);
    used_contacts_.push_back(&contact);
}

void BulletContacts::solve(std::span<const PushedBody> bodies, std::span<PointContact> contacts,
                           double seconds) {
    used_bodies_.clear(), used_contacts_.clear();
    for (std::size_t i = 0; i < bodies.size(); ++i) set(i, bodies[i]);
    for (std::size_t i = 0; i < contacts.size(); ++i) set(i, contacts[i]);
    info_.m_timeStep = scalar(seconds);
    solver_.solveGroup(used_bodies_.data(), static_cast<int>(used_bodies_.size()), used_contacts_.data(),
                       static_cast<int>(used_contacts_.size()), nullptr, 0, info_, nullptr, nullptr);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const auto& linear = bodies_[i]->getLinearVelocity();
        const auto& angular = bodies_[i]->getAngularVelocity();
        // A velocity that no contact changed keeps its double precision.
        const auto update = [](double& value, btScalar solved) {
            if (scalar(value) != solved) value = double{solved};
        };
        update(bodies[i].velocity->x, linear.x());
        update(bodies[i].velocity->y, linear.y());
        update(bodies[i].velocity->turn, angular.z());
    }
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const btManifoldPoint& point = used_contacts_[i]->getContactPoint(0);
        contacts[i].push = double{point.m_appliedImpulse};
        contacts[i].rub = double{point.m_appliedImpulseLateral1};
    }
}

}  // namespace forage::bug
