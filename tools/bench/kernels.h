// Registers the benchmarks.
#pragma once

namespace orthodyn::bench {

void register_memory();  // memory bandwidth, a lower bound on the time of a force
// `calls`: of each kernel; 0 for as many as a precise time needs.
void register_kernels(bool large, int calls);
void register_growth();  // scaling with the mesh size, from 3,000 elements to a million

}  // namespace orthodyn::bench
