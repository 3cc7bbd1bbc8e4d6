// Measures the most expensive kernels of a run and compares the times with those of an earlier measurement.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "lib/core/errors.h"
#include "lib/core/write_file.h"
#include "lib/linear/blas.h"
#include "tools/bench/kernels.h"
#include "tools/bench/results.h"

namespace {

struct Request {
  std::string filter = ".*";
  std::filesystem::path json, compare;
  int repetitions = 5, calls = 0;
  bool large = false, growth = false;
};

std::vector<orthodyn::bench::Result> measure(const Request& request) {
  if (request.growth) {
    orthodyn::bench::register_growth();
  } else {
    orthodyn::bench::register_memory();
    orthodyn::bench::register_kernels(request.large, request.calls);
  }
  std::vector<std::string> arguments{"orthodyn_bench", "--benchmark_filter=" + request.filter,
                                     fmt::format("--benchmark_repetitions={}", request.repetitions),
                                     "--benchmark_min_time=0.1", "--benchmark_enable_random_interleaving=false"};
  std::vector<char*> pointers;
  for (auto& argument : arguments) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  const orthodyn::BlasThreadLimit one(1);
  orthodyn::bench::Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  return collector.results();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Times of forces, tangents, factorisations and solves in nanoseconds per element: the minimum of several "
      "repetitions. Compare results of the same machine only.");
  Request request;
  app.add_option("--filter", request.filter, "Regular expression of the benchmarks to run, such as '^tangent'");
  app.add_option("--json", request.json, "Write the results to a file");
  app.add_option(
         "--compare", request.compare,
         "Print ratios to an earlier file of --json; the exit code is 1 if a benchmark became more than 10 % slower")
      ->check(CLI::ExistingFile);
  app.add_option("--repetitions", request.repetitions, "Repetitions of each benchmark")->check(CLI::Range(1, 1000));
  app.add_option("--calls", request.calls, "Calls of each kernel, for tools/bench/instructions.py; default: by time")
      ->check(CLI::PositiveNumber);
  app.add_flag("--large", request.large, "Also measure 57,600 unknowns");
  app.add_flag("--growth", request.growth,
               "Measure 3,000 to a million elements instead, for tools/bench/growth.py; needs 16 GB of memory and an "
               "hour, or 5 minutes with --repetitions 1");
  CLI11_PARSE(app, argc, argv);
  try {
    std::optional<orthodyn::bench::Baseline> baseline;
    if (!request.compare.empty()) baseline = orthodyn::bench::read_baseline(request.compare);
    const auto results = measure(request);
    if (results.empty()) throw orthodyn::ConfigError(fmt::format("--filter: nothing matches '{}'", request.filter));
    const int slower = orthodyn::bench::print(results, baseline);
    if (!request.json.empty()) orthodyn::write_file(request.json, {orthodyn::bench::to_json(results).dump(1), "\n"});
    return slower > 0 ? 1 : 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 2;
  }
}
