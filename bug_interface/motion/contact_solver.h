// The part of Physics that calls Bullet, which computes the velocities after the contacts.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <btBulletDynamicsCommon.h>

#include "bug_interface/motion/physics.h"

namespace forage::bug {

/// Bullet detects the contacts and solves the velocities. Poses stay outside, in double precision, and are
/// integrated there. No contact and no impulse persists after its step.
///
/// The world is flat: the centres of all shapes lie in one plane. A disc is represented by a sphere, which
/// behaves like an upright cylinder in the plane: Bullet's contacts of spheres are exact, while the contact
/// normals of its cylinders are off by up to 0.01 rad.
class Physics::ContactSolver {
  public:
    ContactSolver(std::span<const Obstacle> obstacles, std::span<const Body> bodies,
                  std::span<const LayerMask> collision_masks);
    ~ContactSolver();
    ContactSolver(const ContactSolver&) = delete;
    ContactSolver& operator=(const ContactSolver&) = delete;

    /// Updates the velocities of the active bodies, and counts the contacts of movable objects with robots.
    /// `step` is the duration of the time step, s. Sets `touched` of driven bodies that touch another shape,
    /// unless it is empty.
    void solve(double step, std::span<State> states, std::span<Velocity> velocities, std::span<char> touched);
    /// Updates the poses of the parts of a body within its frame.
    void update_shapes(std::size_t body, std::span<const Part> parts);

  private:
    /// The properties of a Bullet object and of its shapes.
    struct ObjectInfo {
        bool driven = false, movable = false;
        LayerMask obstacle_layers = 0;  ///< 0 for a body
        std::vector<int> layers;        ///< one per shape
        std::vector<btScalar> friction;
    };

    btRigidBody& rigid(std::size_t body) { return *static_cast<btRigidBody*>(bodies_[body]); }
    void set_state(std::size_t body, const State& state, const Velocity& velocity);
    void find_contacts(std::span<State> states, std::span<char> touched);
    bool can_collide(const ObjectInfo& a, int shape_a, const ObjectInfo& b, int shape_b) const;
    void add(const Obstacle& obstacle);
    void add(const Body& body);
    btCollisionShape* shape_of(const Outline& outline);

    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    std::vector<LayerMask> collision_masks_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> objects_;  ///< the obstacles, then the bodies
    std::vector<ObjectInfo> object_info_;                ///< one per object; Bullet's user index refers to it
    std::vector<btCollisionObject*> bodies_;             ///< the objects that move
    std::vector<char> parked_;                           ///< whether a body is parked outside the world
    std::vector<btCollisionObject*> active_bodies_;
    std::vector<btPersistentManifold*> manifolds_;  ///< the contacts of the current step
    double max_driven_mass_ = 0;                    ///< kg
    std::size_t obstacles_ = 0;                     ///< number of obstacles
    btContactSolverInfo info_;
    btCollisionWorld world_;
};

}  // namespace forage::bug
