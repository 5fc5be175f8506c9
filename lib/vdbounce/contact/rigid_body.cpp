// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/rigid_body.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>

namespace vdbounce {
namespace {

Mat3d crossMatrix(const Vec3d& v)
{
    Mat3d m;
    m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
    return m;
}

} // namespace

RigidBody::RigidBody(const BodyMass& body)
    : body_(body), inverseInertia_(body.inertia.inverse()), centre_(body.centre), momentum_(body.mass * body.velocity),
      angularMomentum_(body.inertia * body.angularVelocity)
{
}

void RigidBody::accelerate(const Vec3d& gravity, double dt) { momentum_ += dt * body_.mass * gravity; }

void RigidBody::move(double dt)
{
    const RigidVelocity now = velocity();
    centre_ += dt * now.linear;
    const double angle = dt * now.angular.norm();
    if (angle > 0.0) {
        orientation_ = Eigen::Quaterniond(Eigen::AngleAxisd(angle, now.angular.normalized())) * orientation_;
        orientation_.normalize();
    }
}

void RigidBody::push(const Vec3d& impulse, const Vec3d& angularImpulse)
{
    momentum_ += impulse;
    angularMomentum_ += angularImpulse - centre_.cross(impulse);
}

Pose RigidBody::pose() const
{
    const Mat3d rotation = orientation_.toRotationMatrix();
    return {rotation, centre_ - rotation * body_.centre};
}

Mat3d RigidBody::inverseInertia() const
{
    const Mat3d rotation = orientation_.toRotationMatrix();
    return rotation * inverseInertia_ * rotation.transpose();
}

RigidVelocity RigidBody::velocity() const
{
    return {momentum_ / body_.mass, inverseInertia() * angularMomentum_, centre_};
}

double RigidBody::energy(const Vec3d& gravity) const
{
    const RigidVelocity now = velocity();
    return 0.5 * momentum_.dot(now.linear) + 0.5 * angularMomentum_.dot(now.angular) -
           body_.mass * gravity.dot(centre_);
}

BodyShare::BodyShare(const RigidBody& body, double sharers)
    : inverseMass(sharers / body.mass()), inverseInertia(sharers * body.inverseInertia()),
      centre(body.velocity().centre)
{
}

Mat3d BodyShare::response(const Vec3d& point) const
{
    const Mat3d arm = crossMatrix(point - centre);
    return inverseMass * Mat3d::Identity() - arm * inverseInertia * arm;
}

Vec3d impulseBetween(const Vec3d& w, const Vec3d& normal, double restitution, double friction, const Mat3d& response)
{
    const double approach = w.dot(normal);
    if (!(approach < 0.0)) return Vec3d::Zero();
    const double normalResponse = normal.dot(response * normal);
    const Vec3d frictionless = -(1.0 + restitution) * approach / normalResponse * normal;

    // w'/2 + w/2 dotted with the impulse is the energy that it adds.
    const auto gained = [&](const Vec3d& impulse) { return impulse.dot(w) + 0.5 * impulse.dot(response * impulse); };
    const auto kept = [&](const Vec3d& impulse) { return gained(impulse) <= 0.0 ? impulse : frictionless; };

    const Vec3d sticking = response.ldlt().solve(Vec3d(-restitution * approach * normal - w));
    const double pressing = sticking.dot(normal);
    if ((sticking - pressing * normal).norm() <= friction * pressing) return kept(sticking);
    const Vec3d tangential = w - approach * normal;
    const double slip = tangential.norm();
    if (!(slip > 0.0)) return frictionless;
    const Vec3d push = normal - friction / slip * tangential;
    const double along = normal.dot(response * push);
    if (!(along > 0.0)) return frictionless;
    return kept(-(1.0 + restitution) * approach / along * push);
}

} // namespace vdbounce
