// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/io/particle_file.h"
#include "vdbounce/io/vdb_archive.h"
#include "vdbounce/particles/points_voxel.h"

#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>
#include <openvdb/points/PointCount.h>
#include <openvdb/points/PointDataGrid.h>

#include <algorithm>
#include <tuple>

#include <tbb/parallel_sort.h>

namespace vdbounce {
namespace {

namespace points = openvdb::points;
using openvdb::Coord;
using Grid = points::PointDataGrid;
using Leaf = Grid::TreeType::LeafNodeType;

// The names that DCC tools give these attributes.
constexpr const char* kPosition = "P";
constexpr const char* kVelocity = "v";
constexpr const char* kRadius = "pscale";
constexpr const char* kMass = "mass";
constexpr const char* kId = "id";
constexpr const char* kStuck = "stuck";
constexpr const char* kRejected = "rejected";
constexpr const char* kHitTime = "hittime";
constexpr const char* kHitPosition = "hitpos";
constexpr const char* kHitNormal = "hitnml";
constexpr const char* kHitVelocity = "hitv";
constexpr const char* kHitCollider = "hitcollider";
constexpr const char* kHitCount = "hittotal";

using PositionArray = points::TypedAttributeArray<openvdb::Vec3f, points::NullCodec>;
using VectorArray = points::TypedAttributeArray<openvdb::Vec3f>;
using FloatArray = points::TypedAttributeArray<float>;
using IdArray = points::TypedAttributeArray<std::int64_t>;
using IntArray = points::TypedAttributeArray<std::int32_t>;

// Where a particle goes in the file: its leaf, its voxel within the leaf, its place in the input.
struct Slot {
    Coord leaf;
    std::uint32_t voxel;
    std::size_t particle;

    bool operator<(const Slot& other) const
    {
        return std::tie(leaf, voxel, particle) < std::tie(other.leaf, other.voxel, other.particle);
    }
};

// A position that is not finite has no voxel; it is kept in the one at the origin, where it reads back as it was.
Coord voxelOf(const Vec3d& position, double voxelSize)
{
    if (!position.allFinite()) return Coord(0);
    return Coord(openvdb::math::Round(position.x() / voxelSize), openvdb::math::Round(position.y() / voxelSize),
                 openvdb::math::Round(position.z() / voxelSize));
}

std::vector<Slot> sortedSlots(const Particles& particles, double voxelSize)
{
    std::vector<Slot> slots(particles.size());
    forEachIndex(particles.size(), 65536, [&](std::size_t i) {
        const Coord ijk = voxelOf(particles.position[i], voxelSize);
        slots[i] = {ijk & ~(Leaf::DIM - 1), Leaf::coordToOffset(ijk), i};
    });
    tbb::parallel_sort(slots.begin(), slots.end());
    return slots;
}

points::AttributeSet::Descriptor::Ptr describeAttributes(const Particles& particles)
{
    auto descriptor = points::AttributeSet::Descriptor::create(PositionArray::attributeType());
    if (!particles.velocity.empty()) descriptor = descriptor->duplicateAppend(kVelocity, VectorArray::attributeType());
    if (!particles.radius.empty()) descriptor = descriptor->duplicateAppend(kRadius, FloatArray::attributeType());
    if (!particles.mass.empty()) descriptor = descriptor->duplicateAppend(kMass, FloatArray::attributeType());
    descriptor = descriptor->duplicateAppend(kId, IdArray::attributeType());
    if (!particles.stuckTo.empty()) descriptor = descriptor->duplicateAppend(kStuck, IntArray::attributeType());
    if (!particles.rejected.empty()) descriptor = descriptor->duplicateAppend(kRejected, IntArray::attributeType());
    if (particles.hits.empty()) return descriptor;
    descriptor = descriptor->duplicateAppend(kHitTime, FloatArray::attributeType());
    for (const char* name : {kHitPosition, kHitNormal, kHitVelocity})
        descriptor = descriptor->duplicateAppend(name, VectorArray::attributeType());
    for (const char* name : {kHitCollider, kHitCount})
        descriptor = descriptor->duplicateAppend(name, IntArray::attributeType());
    return descriptor;
}

openvdb::Vec3f toVec3f(const Vec3d& v) { return openvdb::Vec3f(float(v.x()), float(v.y()), float(v.z())); }

// Fills one attribute of a leaf; value(particle) gives what to store.
template <class Array, class Value>
void fill(Leaf& leaf, const char* name, const Slot* slots, std::size_t count, const Value& value)
{
    points::AttributeWriteHandle<typename Array::ValueType> handle(leaf.attributeArray(name));
    for (std::size_t i = 0; i < count; ++i) handle.set(openvdb::Index(i), value(slots[i]));
    handle.compact(); // one value where all are equal
}

void setVoxelOffsets(Leaf& leaf, const Slot* slots, std::size_t count)
{
    std::vector<Leaf::ValueType> offsets(Leaf::SIZE);
    std::size_t next = 0;
    for (openvdb::Index voxel = 0; voxel < Leaf::SIZE; ++voxel) {
        while (next < count && slots[next].voxel == voxel) ++next;
        offsets[voxel] = Leaf::ValueType(static_cast<std::uint32_t>(next));
    }
    leaf.setOffsets(offsets);
}

void fillOutcome(Leaf& leaf, const Slot* slots, std::size_t count, const Particles& particles)
{
    if (!particles.stuckTo.empty()) {
        fill<IntArray>(leaf, kStuck, slots, count, [&](const Slot& s) { return particles.stuckTo[s.particle]; });
    }
    if (!particles.rejected.empty()) {
        fill<IntArray>(leaf, kRejected, slots, count,
                       [&](const Slot& s) { return std::int32_t(particles.rejected[s.particle]); });
    }
    if (particles.hits.empty()) return;
    const auto hit = [&](const Slot& s) -> const HitRecord& { return particles.hits[s.particle]; };
    fill<FloatArray>(leaf, kHitTime, slots, count, [&](const Slot& s) { return float(hit(s).time); });
    fill<VectorArray>(leaf, kHitPosition, slots, count, [&](const Slot& s) { return toVec3f(hit(s).position); });
    fill<VectorArray>(leaf, kHitNormal, slots, count, [&](const Slot& s) { return toVec3f(hit(s).normal); });
    fill<VectorArray>(leaf, kHitVelocity, slots, count, [&](const Slot& s) { return toVec3f(hit(s).velocity); });
    fill<IntArray>(leaf, kHitCollider, slots, count, [&](const Slot& s) { return hit(s).collider; });
    fill<IntArray>(leaf, kHitCount, slots, count, [&](const Slot& s) { return hit(s).count; });
}

void fillLeaf(Leaf& leaf, const points::AttributeSet::Descriptor::Ptr& descriptor, const Slot* slots, std::size_t count,
              const Particles& particles, double voxelSize)
{
    leaf.replaceAttributeSet(new points::AttributeSet(descriptor, openvdb::Index(count)),
                             /*allowMismatchingDescriptors=*/true);
    setVoxelOffsets(leaf, slots, count);
    fill<PositionArray>(leaf, kPosition, slots, count, [&](const Slot& slot) {
        const Vec3d& p = particles.position[slot.particle];
        const Coord ijk = slot.leaf + Leaf::offsetToLocalCoord(slot.voxel);
        return toVec3f(p / voxelSize - Vec3d(ijk.x(), ijk.y(), ijk.z()));
    });
    if (!particles.velocity.empty()) {
        fill<VectorArray>(leaf, kVelocity, slots, count,
                          [&](const Slot& s) { return toVec3f(particles.velocity[s.particle]); });
    }
    if (!particles.radius.empty()) {
        fill<FloatArray>(leaf, kRadius, slots, count,
                         [&](const Slot& s) { return float(particles.radius[s.particle]); });
    }
    if (!particles.mass.empty()) {
        fill<FloatArray>(leaf, kMass, slots, count, [&](const Slot& s) { return float(particles.mass[s.particle]); });
    }
    fill<IdArray>(leaf, kId, slots, count, [&](const Slot& s) { return particles.id[s.particle]; });
    fillOutcome(leaf, slots, count, particles);
}

Grid::Ptr findPoints(openvdb::io::File& file, const std::string& path)
{
    for (const VdbGridHeader& header : readVdbHeaders(file)) {
        if (header.grid->isType<Grid>()) return openvdb::gridPtrCast<Grid>(file.readGrid(header.uniqueName));
    }
    throw InputError(path, "holds no points", "name a .vdb file with an OpenVDB points grid");
}

// Reads one attribute of a leaf through a handle of its stored type; put(i, value) takes it.
template <class T, class Put> bool read(const Leaf& leaf, const char* name, const Put& put)
{
    const std::size_t index = leaf.attributeSet().find(name);
    if (index == points::AttributeSet::INVALID_POS) return false;
    const points::AttributeArray& array = leaf.constAttributeArray(index);
    if (!array.hasValueType<T>()) return false;
    points::AttributeHandle<T> handle(array);
    for (openvdb::Index i = 0; i < array.size(); ++i) put(i, handle.get(i));
    return true;
}

template <class T> Vec3d toVec3d(const openvdb::math::Vec3<T>& v)
{
    return Vec3d(double(v.x()), double(v.y()), double(v.z()));
}

void readPositions(const Leaf& leaf, const Grid& grid, Vec3d* positions)
{
    points::AttributeHandle<openvdb::Vec3f> handle(leaf.constAttributeArray(kPosition));
    for (auto it = leaf.beginIndexOn(); it; ++it) {
        const openvdb::Vec3d index = openvdb::Vec3d(handle.get(*it)) + it.getCoord().asVec3d();
        positions[*it] = toVec3d(grid.indexToWorld(index));
    }
}

void readOutcome(const Leaf& leaf, std::size_t begin, Particles& particles)
{
    if (!particles.stuckTo.empty())
        read<std::int32_t>(leaf, kStuck,
                           [&](std::size_t i, std::int32_t value) { particles.stuckTo[begin + i] = value; });
    if (particles.hits.empty()) return;
    HitRecord* hits = particles.hits.data() + begin;
    read<float>(leaf, kHitTime, [&](std::size_t i, float value) { hits[i].time = double(value); });
    read<openvdb::Vec3f>(leaf, kHitPosition, [&](std::size_t i, const auto& v) { hits[i].position = toVec3d(v); });
    read<openvdb::Vec3f>(leaf, kHitNormal, [&](std::size_t i, const auto& v) { hits[i].normal = toVec3d(v); });
    read<openvdb::Vec3f>(leaf, kHitVelocity, [&](std::size_t i, const auto& v) { hits[i].velocity = toVec3d(v); });
    read<std::int32_t>(leaf, kHitCollider, [&](std::size_t i, std::int32_t value) { hits[i].collider = value; });
    read<std::int32_t>(leaf, kHitCount, [&](std::size_t i, std::int32_t value) { hits[i].count = value; });
}

void readLeaf(const Leaf& leaf, const Grid& grid, std::size_t begin, Particles& particles)
{
    readPositions(leaf, grid, particles.position.data() + begin);
    if (!particles.velocity.empty()) {
        const auto put = [&](std::size_t i, const auto& v) { particles.velocity[begin + i] = toVec3d(v); };
        if (!read<openvdb::Vec3f>(leaf, kVelocity, put)) read<openvdb::Vec3d>(leaf, kVelocity, put);
    }
    const auto readScalar = [&](const char* name, std::vector<double>& values) {
        if (values.empty()) return;
        const auto put = [&](std::size_t i, auto value) { values[begin + i] = double(value); };
        if (!read<float>(leaf, name, put)) read<double>(leaf, name, put);
    };
    readScalar(kRadius, particles.radius);
    readScalar(kMass, particles.mass);
    const auto putId = [&](std::size_t i, auto value) { particles.id[begin + i] = std::int64_t(value); };
    if (!read<std::int64_t>(leaf, kId, putId)) read<std::int32_t>(leaf, kId, putId);
    readOutcome(leaf, begin, particles);
}

} // namespace

Particles readVdbParticles(const std::string& path)
{
    Grid::Ptr grid;
    withVdbFile(path, [&](openvdb::io::File& file) { grid = findPoints(file, path); });

    std::vector<const Leaf*> leaves;
    std::vector<std::size_t> begins;
    std::size_t count = 0;
    for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf) {
        leaves.push_back(leaf.getLeaf());
        begins.push_back(count);
        count += leaf->pointCount();
    }
    Particles particles;
    particles.resize(count);
    if (leaves.empty()) return particles;
    const auto has = [&](const char* name) { return leaves[0]->hasAttribute(name); };
    if (has(kVelocity)) particles.velocity.resize(count, Vec3d::Zero());
    if (has(kRadius)) particles.radius.resize(count);
    if (has(kMass)) particles.mass.resize(count);
    if (has(kStuck)) particles.stuckTo.resize(count, -1);
    if (has(kHitCount)) particles.hits.resize(count);
    forEachIndex(leaves.size(), 16, [&](std::size_t i) { readLeaf(*leaves[i], *grid, begins[i], particles); });
    return particles;
}

void writeVdbParticles(const Particles& particles, const std::string& path)
{
    initializeOpenVdb();
    const double voxelSize = pointsVoxelSize(particles);
    const std::vector<Slot> slots = sortedSlots(particles, voxelSize);
    const auto descriptor = describeAttributes(particles);

    auto grid = Grid::create();
    grid->setName("points");
    grid->setTransform(openvdb::math::Transform::createLinearTransform(voxelSize));
    std::vector<Leaf*> leaves;
    std::vector<std::size_t> begins;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        if (i > 0 && slots[i].leaf == slots[i - 1].leaf) continue;
        leaves.push_back(grid->tree().touchLeaf(slots[i].leaf));
        begins.push_back(i);
    }
    begins.push_back(slots.size());
    forEachIndex(leaves.size(), 16, [&](std::size_t i) {
        fillLeaf(*leaves[i], descriptor, slots.data() + begins[i], begins[i + 1] - begins[i], particles, voxelSize);
    });
    writeVdbFile({grid}, path);
}

} // namespace vdbounce
