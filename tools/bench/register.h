// What is measured: each file adds its benchmarks.
#pragma once

namespace orthodyn::bench {

void register_memory();  // bandwidth, which bounds a force from below
void register_kernels(bool large);
void register_growth();  // what grows with the size, from 3,000 elements to a million

}  // namespace orthodyn::bench
