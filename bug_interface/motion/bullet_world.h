// Bullet: the collision algorithms of two shapes, rigid bodies, contact manifolds and the solver.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <BulletCollision/CollisionDispatch/btBoxBoxCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btSphereBoxCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btSphereSphereCollisionAlgorithm.h>
#include <BulletDynamics/ConstraintSolver/btNNCGConstraintSolver.h>
#include <Eigen/Core>
#include <btBulletDynamicsCommon.h>

#include "bug_interface/motion/body.h"

namespace forage::bug {

/// Finds and solves contacts with Bullet. A disc is a btSphereShape and a rectangle a btBoxShape, both with
/// their centres in the plane z = 0, in which all bodies stay. Bullet computes in single precision, so its
/// coordinates are relative to a place near the shapes, and poses are kept outside in double precision.
///
/// A solution depends on its bodies and contacts only: nothing is kept from one solution to the next.
class BulletWorld {
  public:
    static constexpr std::size_t no_body = ~std::size_t{0};  ///< the body of an obstacle

    explicit BulletWorld(std::size_t bodies);

    /// Where two shapes are closest to each other. The distance is negative when they penetrate each other.
    struct Gap {
        double distance = std::numeric_limits<double>::infinity();  ///< m; a lower bound for boxes apart
        Eigen::Vector2d normal = Eigen::Vector2d::UnitX();          ///< from b to a
    };
    /// The gap between two shapes. Infinite when it is larger than `within` (m).
    Gap gap(const Outline& a, const Outline& b, double within = 0);

    // ---- one solution: begin(), all bodies, all contacts, solve(), then the results ----
    /// Forgets all bodies and contacts. `origin` is a place near the bodies that are added next.
    void begin(const Pose2& origin);
    /// Adds the body with this number, which contacts can push.
    void add_body(std::size_t number, const Pose2& pose, double mass, double inertia,
                  const Velocity& velocity);
    /// Adds the contacts of a shape of body `body_a` with one of `body_b`, or of an obstacle, at which they
    /// are closer than `within` (m). Returns the smallest distance (m), infinite when there are none.
    double add_contacts(const Outline& a, std::size_t body_a, const Outline& b, std::size_t body_b,
                        double friction, double within);
    bool has_contacts() const { return !used_manifolds_.empty(); }
    /// Changes the velocities of the bodies so that no contact closes by more than its distance within
    /// `seconds`, and finds how to correct the positions of shapes that penetrate each other.
    void solve(double seconds);
    /// The velocity of a body after solve(). What no contact changed in `velocity` keeps its precision.
    void update(std::size_t number, Velocity& velocity) const;
    /// How far solve() moves a body at `pose` out of what it penetrates, m.
    Eigen::Vector2d correction(std::size_t number, const Pose2& pose) const;

  private:
    /// A point at which two shapes are close to each other.
    struct Point {
        btVector3 normal, position;  ///< the normal points from b to a
        double distance;             ///< m
    };
    struct Result;
    /// The collision shapes of outlines, which get the sizes of one after the other.
    struct Shape {
        Shape() { box.setMargin(0); }
        const btCollisionShape* resize(const Outline& outline, double larger);
        btSphereShape sphere{1};
        btBoxShape box{{1, 1, 1}};
    };
    std::span<const Point> closest(const Outline& a, const Outline& b, double within, double x, double y);

    btPersistentManifold unused_;  ///< the algorithms need one, but their points are taken by Result
    btSphereSphereCollisionAlgorithm discs_;
    btSphereBoxCollisionAlgorithm disc_and_box_;
    btBoxBoxCollisionAlgorithm boxes_;
    Shape shapes_[2];
    btNNCGConstraintSolver solver_;
    btContactSolverInfo info_;
    btRigidBody fixed_;  ///< all obstacles
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
    std::vector<std::unique_ptr<btPersistentManifold>> manifolds_;  ///< as many as any solution has needed
    std::vector<btCollisionObject*> used_bodies_;
    std::vector<btPersistentManifold*> used_manifolds_;
    std::vector<Point> points_;
    double x_ = 0, y_ = 0;  ///< the origin of Bullet's coordinates, m
};

}  // namespace forage::bug
