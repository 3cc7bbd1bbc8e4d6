// What is measured: each file adds its benchmarks.
#pragma once

namespace orthodyn::bench {

void register_memory();  // bandwidth, which bounds a force from below
void register_kernels(bool large);

}  // namespace orthodyn::bench
