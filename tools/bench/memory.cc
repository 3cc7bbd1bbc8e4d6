// What main memory gives: a_i = b_i + s c_i on arrays far larger than the caches (McCalpin's STREAM triad). A force
// reads 160 bytes an element at least: nine gradients, a volume, four node numbers and the offsets' share.
#include <benchmark/benchmark.h>

#include <vector>

#include "tools/bench/register.h"

namespace orthodyn::bench {

namespace {

void triad(benchmark::State& state) {
  constexpr std::size_t kSize = 10'000'000;
  constexpr double kBytesOfElement = 160;
  std::vector<double> a(kSize, 0), b(kSize, 1), c(kSize, 2);
  for (auto _ : state) {
    for (std::size_t i = 0; i < kSize; ++i) a[i] = b[i] + 3 * c[i];
    benchmark::DoNotOptimize(a.data());
    benchmark::ClobberMemory();
  }
  const double bytes = 3 * sizeof(double) * kSize;
  state.SetItemsProcessed(static_cast<std::int64_t>(static_cast<double>(state.iterations()) * bytes / kBytesOfElement));
}

}  // namespace

void register_memory() { benchmark::RegisterBenchmark("160 bytes from memory", triad)->UseRealTime(); }

}  // namespace orthodyn::bench
