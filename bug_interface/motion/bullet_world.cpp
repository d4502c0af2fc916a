#include "bug_interface/motion/bullet_world.h"

#include <algorithm>
#include <cmath>

namespace forage::bug {
namespace {

constexpr btScalar box_half_height = 10;  ///< m; of boxes, so that they never part upwards
constexpr btScalar residual = 1e-6f;      ///< (m/s)^2; the solver stops when velocities change by less
constexpr int max_iterations = 20;
/// The share of a penetration that is corrected at once. Bullet's split impulses correct positions without
/// changing velocities, so no energy appears.
constexpr btScalar correction_share = 0.5f;
constexpr double max_corrected_depth = 0.002;  ///< m; shapes that the world puts into each other stay there

btScalar scalar(double v) { return static_cast<btScalar>(v); }

btRigidBody::btRigidBodyConstructionInfo body_info(btScalar mass) {
    return {mass, nullptr, nullptr, {mass, mass, mass}};
}

btVector3 vector(double x, double y) { return {scalar(x), scalar(y), 0}; }

btTransform transform_of(const Outline& o, double x, double y) {
    const btScalar c = scalar(o.cos_yaw), s = scalar(o.sin_yaw);
    return btTransform(btMatrix3x3(c, -s, 0, s, c, 0, 0, 0, 1), vector(o.x - x, o.y - y));
}

/// The point of a box in the plane z = 0 that is nearest to `point`.
btVector3 nearest_point(const Outline& o, const btTransform& box, const btVector3& point) {
    btVector3 p = box.invXform(point);
    const btVector3 corner = vector(o.half_x, o.half_y);
    p.setMin(corner), p.setMax(-corner);
    return box(p);
}

/// By how much a box that is made larger by 1 m on all sides extends further along a unit vector, m.
double extension(const Outline& o, const btVector3& n) {
    return std::abs(o.cos_yaw * double{n.x()} + o.sin_yaw * double{n.y()}) +
           std::abs(o.cos_yaw * double{n.y()} - o.sin_yaw * double{n.x()});
}

}  // namespace

BulletWorld::BulletWorld(std::size_t bodies)
    : unused_(nullptr, nullptr, 0, 0, 0),
      discs_(&unused_, {}, nullptr, nullptr),
      disc_and_box_(&unused_, {}, nullptr, nullptr, false),
      boxes_(&unused_, {}, nullptr, nullptr),
      fixed_(body_info(0)) {
    // The scalar solver gives the same bits on all processors; the vectorised ones do not.
    solver_.setConstraintRowSolverGeneric(solver_.getScalarConstraintRowSolverGeneric());
    solver_.setConstraintRowSolverLowerLimit(solver_.getScalarConstraintRowSolverLowerLimit());
    info_.m_solverMode = SOLVER_ENABLE_FRICTION_DIRECTION_CACHING;  // contacts have their tangents
    info_.m_leastSquaresResidualThreshold = residual;
    info_.m_numIterations = max_iterations;
    info_.m_erp2 = correction_share;
    info_.m_splitImpulsePenetrationThreshold = 0;
    info_.m_splitImpulseTurnErp = 0;
    for (std::size_t i = 0; i < bodies; ++i) {
        auto& added = *bodies_.emplace_back(std::make_unique<btRigidBody>(body_info(1)));
        added.setLinearFactor({1, 1, 0});
        added.setAngularFactor({0, 0, 1});
        added.setFlags(0);  // no gyroscopic forces
    }
}

/// The shape of an outline that is made larger (m) on all sides.
const btCollisionShape* BulletWorld::Shape::resize(const Outline& o, double larger) {
    if (o.round) {
        sphere.setUnscaledRadius(scalar(o.radius + larger));
        return &sphere;
    }
    box.setImplicitShapeDimensions({scalar(o.half_x + larger), scalar(o.half_y + larger), box_half_height});
    return &box;
}

/// Takes the points that an algorithm of Bullet finds for two shapes that are larger than they should be.
struct BulletWorld::Result final : btManifoldResult {
    Result(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, std::vector<Point>& to)
        : btManifoldResult(&a, &b), points(to) {}
    void addContactPoint(const btVector3& normal, const btVector3& position, btScalar distance) override {
        // Boxes touch at the same points at both of their ends.
        if (position.z() >= 0) points.push_back({normal, {position.x(), position.y(), 0}, double{distance}});
    }
    std::vector<Point>& points;
};

/// The points at which two shapes are closer than `within`, relative to (x, y). Bullet finds those of boxes
/// that overlap, so the shapes are made larger, and the points moved back to them.
std::span<const BulletWorld::Point> BulletWorld::closest(const Outline& a, const Outline& b, double within,
                                                         double x, double y) {
    if (b.round && !a.round) {  // the order that the algorithm of Bullet has
        closest(b, a, within, x, y);
        for (Point& p : points_) p.normal = -p.normal;
        return points_;
    }
    points_.clear();
    const double larger = a.round ? within : within / 2;
    const btTransform at_a = transform_of(a, x, y), at_b = transform_of(b, x, y);
    const btCollisionObjectWrapper of_a(nullptr, shapes_[0].resize(a, larger), &fixed_, at_a, -1, -1),
        of_b(nullptr, shapes_[1].resize(b, a.round ? 0 : larger), &fixed_, at_b, -1, -1);
    Result result(of_a, of_b, points_);
    btCollisionAlgorithm* algorithm = &boxes_;
    if (a.round) algorithm = &disc_and_box_;
    if (b.round) algorithm = &discs_;
    algorithm->processCollision(&of_a, &of_b, {}, &result);
    for (Point& p : points_) {
        p.distance += a.round ? larger : larger * (extension(a, p.normal) + extension(b, p.normal));
        if (!a.round) p.position = nearest_point(a, at_a, nearest_point(b, at_b, p.position));
    }
    return points_;
}

BulletWorld::Gap BulletWorld::gap(const Outline& a, const Outline& b, double within) {
    Gap least;
    for (const Point& p : closest(a, b, within, a.x, a.y))
        if (p.distance < least.distance)
            least = {p.distance, Eigen::Vector2d(double{p.normal.x()}, double{p.normal.y()}).normalized()};
    return least;
}

void BulletWorld::begin(const Pose2& origin) {
    used_bodies_.clear(), used_manifolds_.clear();
    x_ = origin.x, y_ = origin.y;
}

void BulletWorld::add_body(std::size_t number, const Pose2& pose, double mass, double inertia,
                           const Velocity& velocity) {
    btRigidBody& body = *bodies_[number];
    body.setWorldTransform(btTransform(btMatrix3x3::getIdentity(), vector(pose.x - x_, pose.y - y_)));
    body.setMassProps(scalar(mass), btVector3(1, 1, 1) * scalar(inertia));
    body.updateInertiaTensor();
    body.setLinearVelocity(vector(velocity.x, velocity.y));
    body.setAngularVelocity({0, 0, scalar(velocity.turn)});
    used_bodies_.push_back(&body);
}

double BulletWorld::add_contacts(const Outline& a, std::size_t body_a, const Outline& b, std::size_t body_b,
                                 double friction, double within) {
    const std::span<const Point> points = closest(a, b, within, x_, y_);
    double least = std::numeric_limits<double>::infinity();
    if (points.empty()) return least;
    const std::size_t number = used_manifolds_.size();
    if (number == manifolds_.size())
        manifolds_.push_back(
            std::make_unique<btPersistentManifold>(nullptr, nullptr, 0, BT_LARGE_FLOAT, BT_LARGE_FLOAT));
    btPersistentManifold& manifold = *used_manifolds_.emplace_back(manifolds_[number].get());
    manifold.setBodies(bodies_[body_a].get(), body_b == no_body ? &fixed_ : bodies_[body_b].get());
    manifold.setNumContacts(static_cast<int>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point& p = points[i];
        least = std::min(least, p.distance);
        const btScalar distance = p.distance < -max_corrected_depth ? 0 : scalar(p.distance);
        btManifoldPoint& point = manifold.getContactPoint(static_cast<int>(i)) =
            btManifoldPoint({0, 0, 0}, {0, 0, 0}, p.normal, distance);
        point.m_positionWorldOnA = point.m_positionWorldOnB = p.position;
        point.m_lateralFrictionDir1 = {-p.normal.y(), p.normal.x(), 0};
        point.m_contactPointFlags = BT_CONTACT_FLAG_LATERAL_FRICTION_INITIALIZED;
        point.m_combinedFriction = scalar(friction);
    }
    return least;
}

void BulletWorld::solve(double seconds) {
    info_.m_timeStep = scalar(seconds);
    solver_.solveGroup(used_bodies_.data(), static_cast<int>(used_bodies_.size()), used_manifolds_.data(),
                       static_cast<int>(used_manifolds_.size()), nullptr, 0, info_, nullptr, nullptr);
}

void BulletWorld::update(std::size_t number, Velocity& velocity) const {
    const auto& linear = bodies_[number]->getLinearVelocity();
    const auto update = [](double& value, btScalar solved) {
        if (scalar(value) != solved) value = double{solved};
    };
    update(velocity.x, linear.x()), update(velocity.y, linear.y());
    update(velocity.turn, bodies_[number]->getAngularVelocity().z());
}

Eigen::Vector2d BulletWorld::correction(std::size_t number, const Pose2& pose) const {
    const btVector3& at = bodies_[number]->getWorldTransform().getOrigin();
    return {double{at.x() - scalar(pose.x - x_)}, double{at.y() - scalar(pose.y - y_)}};
}

}  // namespace forage::bug
