// What Bullet does for the motion: it finds the contacts of boxes, and solves contacts for comparison.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <btBulletDynamicsCommon.h>

#include "bug_interface/motion/point_contact.h"
#include "bug_interface/sensing/outline.h"

namespace forage::bug {

/// The points at which two overlapping rectangles touch, found by Bullet as those of boxes.
class BoxContacts {
  public:
    struct Point {
        Overlap overlap;  ///< its normal points from `b` to `a`
        Eigen::Vector2d point;
    };
    /// The points are valid until the next call. None when the rectangles do not overlap.
    std::span<const Point> find(const Outline& a, const Outline& b);

  private:
    std::vector<Point> points_;
};

/// Changes the velocities of bodies as ContactSolver does, by Bullet's solver: the reference for tests.
/// Poses stay outside, in double precision, and are integrated there. Which shapes touch is known there, too,
/// so no Bullet world is needed. Every contact is a manifold of one point, in the plane z = 0.
class BulletContacts {
  public:
    BulletContacts();
    void solve(std::span<const PushedBody> bodies, std::span<PointContact> contacts, double seconds);

  private:
    void set(std::size_t number, const PushedBody& body);
    void set(std::size_t number, const PointContact& contact);

    btSequentialImpulseConstraintSolver solver_;
    btContactSolverInfo info_;
    btRigidBody fixed_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;  ///< as many as any stride has needed
    std::vector<std::unique_ptr<btPersistentManifold>> contacts_;
    std::vector<btCollisionObject*> used_bodies_;
    std::vector<btPersistentManifold*> used_contacts_;
};

}  // namespace forage::bug
