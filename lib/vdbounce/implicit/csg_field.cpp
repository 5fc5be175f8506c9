// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/csg_field.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/number_text.h"

#include <cmath>

namespace vdbounce {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Box kEverywhere{Vec3d::Constant(-kInfinity), Vec3d::Constant(kInfinity)};

// Of a rounded edge: where operands all but cancel, there is no direction in which the surface moves.
constexpr double kSmallestGradient = 1e-3;

} // namespace

CsgField::CsgField(CsgOperation operation, std::vector<std::shared_ptr<const ImplicitField>> operands, double blend)
    : operation_(operation), operands_(std::move(operands)), blend_(blend)
{
    if (!(blend_ >= 0.0) || !std::isfinite(blend_))
        throw UsageError("blend", numberText(blend_) + " is out of range", "give 0 or more");
    const bool one = operation_ == CsgOperation::Complement;
    if (one ? operands_.size() != 1 : operands_.size() < 2) {
        throw UsageError("csg", std::to_string(operands_.size()) + " operands do not suit the operation",
                         one ? "complement takes one" : "give two or more");
    }
}

double CsgField::phi(const Vec3d& world, double time) const
{
    double result = operands_[0]->phi(world, time);
    if (operation_ == CsgOperation::Complement) return -result;
    for (std::size_t i = 1; i < operands_.size(); ++i)
        result = combine(operation_, result, operands_[i]->phi(world, time), blend_);
    return result;
}

FieldSample CsgField::sample(const Vec3d& world, double time) const
{
    FieldSample result = operands_[0]->sample(world, time);
    if (operation_ == CsgOperation::Complement) return {-result.phi, -result.gradient};
    for (std::size_t i = 1; i < operands_.size(); ++i) {
        const FieldSample other = operands_[i]->sample(world, time);
        const CsgWeights weights = combinationWeights(operation_, result.phi, other.phi, blend_);
        result.gradient = weights.a * result.gradient + weights.b * other.gradient;
        result.phi = combine(operation_, result.phi, other.phi, blend_);
    }
    return result;
}

// How fast phi falls at a place that rests is a weighted sum as the gradient is; how fast the surface goes along itself
// is one's choice where it is rounded, and here a mean of what the operands do.
Vec3d CsgField::velocity(const Vec3d& world, double time) const
{
    FieldSample here = operands_[0]->sample(world, time);
    Vec3d result = operands_[0]->velocity(world, time);
    if (operation_ == CsgOperation::Complement) return result;
    double falling = result.dot(here.gradient);
    for (std::size_t i = 1; i < operands_.size(); ++i) {
        const FieldSample other = operands_[i]->sample(world, time);
        const Vec3d otherVelocity = operands_[i]->velocity(world, time);
        const CsgWeights weights = combinationWeights(operation_, here.phi, other.phi, blend_);
        result = std::abs(weights.a) * result + std::abs(weights.b) * otherVelocity;
        falling = weights.a * falling + weights.b * otherVelocity.dot(other.gradient);
        here.gradient = weights.a * here.gradient + weights.b * other.gradient;
        here.phi = combine(operation_, here.phi, other.phi, blend_);
    }
    const double squared = here.gradient.squaredNorm();
    if (!(squared > kSmallestGradient * kSmallestGradient)) return result;
    return result + (falling - result.dot(here.gradient)) / squared * here.gradient;
}

void CsgField::phiInRow(const Vec3d& from, const Vec3d& step, int count, double time, double* out) const
{
    operands_[0]->phiInRow(from, step, count, time, out);
    if (operation_ == CsgOperation::Complement) {
        for (int k = 0; k < count; ++k) out[k] = -out[k];
    }
    double others[kLongestRow];
    for (std::size_t i = 1; i < operands_.size(); ++i) {
        operands_[i]->phiInRow(from, step, count, time, others);
        for (int k = 0; k < count; ++k) out[k] = combine(operation_, out[k], others[k], blend_);
    }
}

Box CsgField::box() const
{
    if (operation_ == CsgOperation::Complement) return kEverywhere;
    Box box = operands_[0]->box();
    if (operation_ == CsgOperation::Subtraction) return box;
    for (std::size_t i = 1; i < operands_.size(); ++i) {
        const Box other = operands_[i]->box();
        if (operation_ == CsgOperation::Union) {
            box.add(other);
        } else {
            box = {box.min.cwiseMax(other.min), box.max.cwiseMin(other.max)};
        }
    }
    if (operation_ == CsgOperation::Intersection) return box;
    // Each rounding of an edge adds up to a quarter of the blend.
    const Vec3d rounded = Vec3d::Constant(0.25 * blend_ * double(operands_.size() - 1));
    return {box.min - rounded, box.max + rounded};
}

double CsgField::thinnestWall() const
{
    // What is cut can be left as thin as one likes.
    if (operation_ != CsgOperation::Union) return 0.0;
    double thinnest = kInfinity;
    for (const auto& operand : operands_) thinnest = std::min(thinnest, operand->thinnestWall());
    return thinnest;
}

double CsgField::resolution() const
{
    double finest = kInfinity;
    for (const auto& operand : operands_) finest = std::min(finest, operand->resolution());
    return finest;
}

double CsgField::clearance(const Vec3d& world, double radius, double time) const
{
    if (operation_ == CsgOperation::Complement) return operands_[0]->clearanceInside(world, radius, time);
    if (blend_ > 0.0) return ImplicitField::clearance(world, radius, time);
    double result = operands_[0]->clearance(world, radius, time);
    for (std::size_t i = 1; i < operands_.size(); ++i) {
        switch (operation_) {
        case CsgOperation::Union: result = std::min(result, operands_[i]->clearance(world, radius, time)); break;
        case CsgOperation::Intersection: result = std::max(result, operands_[i]->clearance(world, radius, time)); break;
        default: result = std::max(result, operands_[i]->clearanceInside(world, radius, time)); break;
        }
    }
    return result;
}

double CsgField::clearanceInside(const Vec3d& world, double radius, double time) const
{
    if (operation_ == CsgOperation::Complement) return operands_[0]->clearance(world, radius, time);
    if (blend_ > 0.0) return ImplicitField::clearanceInside(world, radius, time);
    double result = operands_[0]->clearanceInside(world, radius, time);
    for (std::size_t i = 1; i < operands_.size(); ++i) {
        switch (operation_) {
        case CsgOperation::Union: result = std::max(result, operands_[i]->clearanceInside(world, radius, time)); break;
        case CsgOperation::Intersection:
            result = std::min(result, operands_[i]->clearanceInside(world, radius, time));
            break;
        default: result = std::min(result, operands_[i]->clearance(world, radius, time)); break;
        }
    }
    return result;
}

double CsgField::lipschitz() const
{
    double steepest = 1.0;
    for (const auto& operand : operands_) steepest = std::max(steepest, operand->lipschitz());
    return steepest;
}

double CsgField::voxelSize() const
{
    double smallest = kInfinity;
    for (const auto& operand : operands_) smallest = std::min(smallest, operand->voxelSize());
    return smallest;
}

bool CsgField::convex() const
{
    // The larger of convex functions is convex, and rounding it leaves it so.
    if (operation_ != CsgOperation::Intersection) return false;
    return std::all_of(operands_.begin(), operands_.end(), [](const auto& operand) { return operand->convex(); });
}

bool CsgField::wayOutside(const Vec3d& world, double time, Vec3d& way) const
{
    if (operation_ == CsgOperation::Complement) return false;
    if (operation_ == CsgOperation::Subtraction) return operands_[0]->wayOutside(world, time, way);
    // Out of the operand that decides; of a union possibly into the next one, whose turn it then is.
    const bool smallest = operation_ == CsgOperation::Union;
    std::size_t deciding = 0;
    double decided = operands_[0]->phi(world, time);
    for (std::size_t i = 1; i < operands_.size(); ++i) {
        const double other = operands_[i]->phi(world, time);
        if (smallest ? other < decided : other > decided) {
            deciding = i;
            decided = other;
        }
    }
    return operands_[deciding]->wayOutside(world, time, way);
}

bool CsgField::still() const
{
    return std::all_of(operands_.begin(), operands_.end(), [](const auto& operand) { return operand->still(); });
}

double CsgField::reach(double begin, double end) const
{
    double farthest = 0.0;
    for (const auto& operand : operands_) farthest = std::max(farthest, operand->reach(begin, end));
    return farthest;
}

} // namespace vdbounce
