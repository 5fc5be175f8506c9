// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/walls.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

// The cosine below which two normals are those of two walls.
constexpr double kSameWall = 0.95;

// Two normals closer to parallel than this, by the sine, have no crease that numbers could find.
constexpr double kParallel = 1e-6;

// Speeds of approach below this share of all speeds are rounding.
constexpr double kRounding = 1e-12;

} // namespace

int Walls::add(const Vec3d& normal, std::size_t collider, double friction, bool& known)
{
    int place = 0;
    while (place < count_ && !((*this)[place].collider == collider && (*this)[place].normal.dot(normal) > kSameWall))
        ++place;
    known = place < count_;
    if (place == kMost) {
        place = oldest_;
        oldest_ = (oldest_ + 1) % kMost;
    }
    count_ = std::max(count_, place + 1);
    (*this)[place] = {normal, collider, friction, Vec3d::Zero(), 0.0};
    return place;
}

// How much faster it would have to leave.
double Walls::missing(int i, const Vec3d& velocity) const
{
    const Wall& wall = (*this)[i];
    return wall.leave - (velocity - wall.velocity).dot(wall.normal);
}

// To the rounding of what the velocity was before: a velocity next to 0 may be the rest of larger ones.
bool Walls::holds(const Vec3d& velocity, const Vec3d& before) const
{
    for (int i = 0; i < count_; ++i) {
        const double scale = before.norm() + (*this)[i].velocity.norm() + (*this)[i].leave;
        if (missing(i, velocity) > kRounding * scale) return false;
    }
    return true;
}

bool Walls::answerOne(int i, const Vec3d& velocity, std::array<Vec3d, kMost>& changes) const
{
    const double impulse = missing(i, velocity);
    if (!(impulse > 0.0)) return false;
    const Wall& wall = (*this)[i];
    const Vec3d w = velocity - wall.velocity;
    const Vec3d tangential = w - w.dot(wall.normal) * wall.normal;
    const double slip = tangential.norm();
    const double lost = slip > 0.0 ? std::min(1.0, wall.friction * impulse / slip) : 0.0;
    changes[std::size_t(i)] = impulse * wall.normal - lost * tangential;
    return holds(velocity + changes[std::size_t(i)], velocity);
}

bool Walls::answerTwo(int i, int j, const Vec3d& velocity, std::array<Vec3d, kMost>& changes) const
{
    const Wall& a = (*this)[i];
    const Wall& b = (*this)[j];
    Vec3d crease = a.normal.cross(b.normal);
    const double sine = crease.norm();
    if (!(sine > kParallel)) return false;
    crease /= sine;
    const double cosine = a.normal.dot(b.normal);
    const double missingA = missing(i, velocity);
    const double missingB = missing(j, velocity);
    const double impulseA = (missingA - cosine * missingB) / (sine * sine);
    const double impulseB = (missingB - cosine * missingA) / (sine * sine);
    if (impulseA < 0.0 || impulseB < 0.0) return false;
    // What slides along the crease rubs on both, each in proportion to how hard it presses.
    const double along = (velocity - 0.5 * (a.velocity + b.velocity)).dot(crease);
    const double grip = a.friction * impulseA + b.friction * impulseB;
    const double lost = std::abs(along) > grip ? std::copysign(grip, along) : along;
    const double shareA = grip > 0.0 ? a.friction * impulseA / grip : 0.0;
    changes[std::size_t(i)] = impulseA * a.normal - shareA * lost * crease;
    changes[std::size_t(j)] = impulseB * b.normal - (grip > 0.0 ? (1.0 - shareA) * lost : 0.0) * crease;
    return holds(velocity + changes[std::size_t(i)] + changes[std::size_t(j)], velocity);
}

bool Walls::answerThree(const Vec3d& velocity, std::array<Vec3d, kMost>& changes) const
{
    Mat3d normals;
    Vec3d asked;
    for (int i = 0; i < 3; ++i) {
        normals.row(i) = (*this)[i].normal;
        asked[i] = missing(i, velocity);
    }
    const Mat3d products = normals * normals.transpose();
    if (!(products.determinant() > kParallel)) return false;
    const Vec3d impulses = products.inverse() * asked;
    if ((impulses.array() < 0.0).any()) return false;
    for (int i = 0; i < 3; ++i) changes[std::size_t(i)] = impulses[i] * (*this)[i].normal;
    return true;
}

bool Walls::answer(Vec3d& velocity, std::array<Vec3d, kMost>& changes) const
{
    const auto accept = [&](bool good) {
        if (good) {
            for (const Vec3d& change : changes) velocity += change;
        } else {
            changes.fill(Vec3d::Zero());
        }
        return good;
    };
    changes.fill(Vec3d::Zero());
    if (holds(velocity, velocity)) return true;
    for (int i = 0; i < count_; ++i) {
        if (accept(answerOne(i, velocity, changes))) return true;
    }
    for (int i = 0; i < count_; ++i) {
        for (int j = i + 1; j < count_; ++j) {
            if (accept(answerTwo(i, j, velocity, changes))) return true;
        }
    }
    return count_ == 3 && accept(answerThree(velocity, changes));
}

} // namespace vdbounce
