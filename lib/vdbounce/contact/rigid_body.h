// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/pose.h"

namespace vdbounce {

/// What a collider that particles can move weighs. World units, in the place in which its file has it.
struct BodyMass {
    double mass = 1.0;                     ///< > 0
    Vec3d centre = Vec3d::Zero();          ///< of mass
    Mat3d inertia = Mat3d::Identity();     ///< about the centre, symmetric and positive definite
    Vec3d velocity = Vec3d::Zero();        ///< of the centre, at the start
    Vec3d angularVelocity = Vec3d::Zero(); ///< radians a second, at the start
};

/// A rigid body in free motion. Its state is its place and its momenta, so that what impulses add is kept to rounding.
class RigidBody {
public:
    explicit RigidBody(const BodyMass& body);

    /// Adds `dt` of gravity to the momentum.
    void accelerate(const Vec3d& gravity, double dt);

    /// Moves and turns by the velocities of now.
    void move(double dt);

    /// `angularImpulse` is about the world's origin, as colliders report it.
    void push(const Vec3d& impulse, const Vec3d& angularImpulse);

    Pose pose() const;
    RigidVelocity velocity() const;
    Mat3d inverseInertia() const; ///< world axes
    double mass() const { return body_.mass; }
    const Vec3d& momentum() const { return momentum_; }
    /// Kinetic energy, and potential in a gravity field.
    double energy(const Vec3d& gravity) const;

private:
    BodyMass body_;
    Mat3d inverseInertia_; // as in the file
    Vec3d centre_;
    Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
    Vec3d momentum_;
    Vec3d angularMomentum_; // about the centre
};

/// How a body's velocity at a point answers an impulse there, one particle's share of it: where `sharers` particles
/// touch it in the same step, each meets 1 / sharers of its mass, so that all of their impulses together do not
/// push it further than any alone would (mass splitting: Tonge, Benevolenski and Voroshilov 2012).
struct BodyShare {
    double inverseMass = 0.0;
    Mat3d inverseInertia = Mat3d::Zero();
    Vec3d centre = Vec3d::Zero();

    BodyShare() = default;
    BodyShare(const RigidBody& body, double sharers);

    /// Change of velocity at `point` for a unit of impulse there.
    Mat3d response(const Vec3d& point) const;
};

/// The impulse on a particle that meets a body: `w` is its velocity relative to the body at the contact, `response`
/// how w changes by an impulse (the particle's 1/m and the body's together). Sticks if Coulomb's cone allows, else
/// slides; never gains energy: where the coupling of turning and friction would, friction is left out.
/// Method: Guendelman, Bridson and Fedkiw 2003, section 5. Equal to respond() for a body of infinite mass.
Vec3d impulseBetween(const Vec3d& w, const Vec3d& normal, double restitution, double friction, const Mat3d& response);

} // namespace vdbounce
