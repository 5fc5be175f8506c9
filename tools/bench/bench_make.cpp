// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_make.h"

#include "bench/bench_blobs.h"
#include "bench/bench_csg.h"
#include "bench/bench_redistance.h"
#include "bench/bench_shapes.h"

namespace vdbounce::bench {

Cases benchMake(const MakeBenchOptions& options, Progress& progress)
{
    Cases cases;
    for (const auto measure : {benchShapes, benchCsg, benchBlobs, benchRedistance}) {
        const Cases some = measure(options, progress);
        cases.insert(cases.end(), some.begin(), some.end());
    }
    return cases;
}

} // namespace vdbounce::bench
