// Bullet's side of Physics: which velocities contacts leave.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <btBulletDynamicsCommon.h>

#include "bug_interface/motion/physics.h"

namespace forage::bug {

/// All is flat, and the middles of all shapes lie in one plane. There a sphere does what an upright cylinder
/// does, and Bullet finds its contacts exactly, while those of a cylinder have normals that are off by up to
/// 0.01 rad.
///
/// Bullet finds contacts and solves velocities; poses are kept and moved outside, in double precision.
/// No contact and no impulse outlives its step.
class Physics::Engine {
  public:
    Engine(std::span<const Obstacle> obstacles, std::span<const Body> bodies,
           std::span<const LayerMask> meets);
    ~Engine();
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    /// Changes the velocities of the bodies that are involved, and counts what movable things touch.
    void solve(double step, std::span<State> states, std::span<Velocity> velocities);
    /// Parts of a body have been moved within it.
    void reshape(std::size_t body, std::span<const Part> parts);

  private:
    /// What Bullet's objects are numbered by.
    struct Shapes {
        bool driven = false, movable = false;
        LayerMask obstacle = 0;   ///< its layers; of a body 0
        std::vector<int> layers;  ///< of its shapes
        std::vector<btScalar> friction;
    };

    btRigidBody& rigid(std::size_t body) { return *static_cast<btRigidBody*>(bodies_[body]); }
    void set(std::size_t body, const State& state, const Velocity& velocity);
    void find_contacts(std::span<State> states);
    bool meet(const Shapes& a, int shape_a, const Shapes& b, int shape_b) const;
    void add(const Obstacle& obstacle);
    void add(const Body& body);
    btCollisionShape* shape_of(const Outline& outline);

    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    std::vector<LayerMask> meets_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> objects_;
    std::vector<Shapes> known_;                    ///< of each of `objects_`
    std::vector<btCollisionObject*> bodies_;       ///< those of `objects_` that move
    std::vector<char> parked_;                     ///< of each body, where nothing is
    std::vector<btCollisionObject*> solved_;       ///< those of `bodies_` that are involved
    std::vector<btPersistentManifold*> touching_;  ///< in this step
    double heaviest_ = 0;                          ///< of the driven bodies, kg
    std::size_t obstacles_ = 0;                    ///< the first of `objects_` are these
    btContactSolverInfo info_;
    btCollisionWorld world_;
};

}  // namespace forage::bug
