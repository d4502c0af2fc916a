// The part of Physics that calls Bullet, which computes the velocities after the contacts.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <BulletCollision/CollisionDispatch/btSphereBoxCollisionAlgorithm.h>
#include <btBulletDynamicsCommon.h>

#include "bug_interface/motion/physics.h"

namespace forage::bug {

/// Bullet detects the contacts and solves the velocities. Poses stay outside, in double precision, and are
/// integrated there. Which pairs are near is known there, too, so no Bullet world is needed. No contact and
/// no impulse persists after its stride.
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

    /// Two objects that may touch: the obstacles have the first numbers, the bodies those after them. The
    /// second one is a body.
    using Pair = std::pair<std::size_t, std::size_t>;

    /// Updates the velocities of `bodies` so that they meet neither each other nor obstacles within `steps`
    /// time steps of `step` s, and counts the contacts of movable objects with robots. `pairs` are the
    /// objects to look at, in ascending order. Sets `touched` of driven bodies that touch another shape,
    /// unless it is empty.
    void solve(double step, std::uint64_t steps, std::span<const std::size_t> bodies,
               std::span<const Pair> pairs, std::span<State> states, std::span<Velocity> velocities,
               std::span<char> touched);
    /// Updates the poses of the parts of a body within its frame.
    void update_shapes(std::size_t body, std::span<const Part> parts);

  private:
    /// The properties of a Bullet object and of its shapes.
    struct ObjectInfo {
        bool driven = false, movable = false;
        LayerMask obstacle_layers = 0;  ///< 0 for a body
        std::vector<int> layers;        ///< one per shape
        std::vector<btScalar> friction;
        std::pair<double, double> mass;  ///< of a body in one step: its mass, kg, and its inertia, kg m^2
    };

    btRigidBody& rigid(std::size_t body) { return *objects_[obstacles_ + body]; }
    void prepare(std::size_t body, std::uint64_t steps, State& state, const Velocity& velocity);
    void find_contacts(std::span<const Pair> pairs);
    void filter_contacts(std::span<State> states, std::span<char> touched);
    bool can_collide(const ObjectInfo& a, int shape_a, const ObjectInfo& b, int shape_b) const;
    void add(const Obstacle& obstacle);
    void add(const Body& body);
    btCollisionShape* shape_of(const Outline& outline);

    /// Finds the contacts of a pair. It keeps memory, but nothing that changes a result.
    using Algorithm = std::unique_ptr<btCollisionAlgorithm, std::function<void(btCollisionAlgorithm*)>>;

    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btSphereBoxCollisionAlgorithm::CreateFunc sphere_box_, box_sphere_;
    btDispatcherInfo dispatch_info_;
    btSequentialImpulseConstraintSolver solver_;
    btContactSolverInfo info_;
    std::vector<LayerMask> collision_masks_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> objects_;  ///< the obstacles, then the bodies
    std::vector<ObjectInfo> object_info_;                ///< one per object; Bullet's user index refers to it
    std::vector<std::uint64_t> steps_;                   ///< per body: for how many steps its mass is set
    std::map<Pair, Algorithm> algorithms_;
    double heaviest_ = 0;        ///< mass of the heaviest driven body, kg
    std::size_t obstacles_ = 0;  ///< number of obstacles

    // ---- the current stride ----
    std::vector<btCollisionObject*> moving_;
    std::vector<btPersistentManifold*> contacts_;
    btManifoldArray of_pair_;
};

}  // namespace forage::bug
