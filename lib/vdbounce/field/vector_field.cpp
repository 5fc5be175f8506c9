// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/vector_lookup.h"

#include <algorithm>

namespace vdbounce {

VectorField::VectorField(const DistanceField& field)
{
    const LinearTransform& transform = field.transform();
    const BlockValues& stored = field.blocks().values();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            worldToIndex[3 * row + column] = transform.worldToIndex()(row, column);
        origin[row] = transform.origin()[row];
        boxMin[row] = field.indexBox().min[row];
        boxMax[row] = field.indexBox().max[row];
    }
    directory = field.blocks().directory();
    lookup = field.options().lookup;
    normal = field.options().normal;
    storage = stored.storage();
    switch (storage) {
    case Storage::Float: values = stored.floats().data(); break;
    case Storage::Half: values = stored.halves().data(); break;
    case Storage::Fixed8: values = stored.bytes().data(); break;
    }
    ranges = stored.ranges().data();
    const double unit = storage == Storage::Half ? double(stored.halfUnit()) : 1.0;
    std::fill_n(&columns[0][0], 16, 0.0f);
    columns[0][0] = float(unit);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            columns[1 + column][1 + row] = float(unit * transform.gradientToWorld()(row, column));
        }
    }
}

} // namespace vdbounce
