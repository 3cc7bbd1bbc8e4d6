// Measures the kernels that a run spends its time in, and compares with what was measured before.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "lib/core/errors.h"
#include "lib/core/write_file.h"
#include "lib/linear/blas.h"
#include "tools/bench/register.h"
#include "tools/bench/results.h"

namespace {

struct Request {
  std::string filter = ".*";
  std::filesystem::path json, compare;
  int repetitions = 5;
  bool large = false, growth = false;
};

std::vector<orthodyn::bench::Result> measure(const Request& request) {
  if (request.growth) {
    orthodyn::bench::register_growth();
  } else {
    orthodyn::bench::register_memory();
    orthodyn::bench::register_kernels(request.large);
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
      "Times of forces, tangents, factorisations and solves, in nanoseconds an element: the least of several "
      "repetitions. Trust ratios of one machine, not seconds.");
  Request request;
  app.add_option("--filter", request.filter, "Regular expression of what is measured, such as '^tangent'");
  app.add_option("--json", request.json, "Writes the figures to a file");
  app.add_option("--compare", request.compare,
                 "Ratios to a file of --json; the exit code is 1 where more than 10 % "
                 "were lost")
      ->check(CLI::ExistingFile);
  app.add_option("--repetitions", request.repetitions, "Of each measurement")->check(CLI::Range(1, 1000));
  app.add_flag("--large", request.large, "With 57,600 unknowns, too");
  app.add_flag("--growth", request.growth,
               "From 3,000 elements to a million instead, for tools/bench/growth.py: 16 GB of memory; an hour, or 5 "
               "minutes with --repetitions 1");
  CLI11_PARSE(app, argc, argv);
  try {
    std::optional<orthodyn::bench::Before> before;
    if (!request.compare.empty()) before = orthodyn::bench::read_before(request.compare);
    const auto results = measure(request);
    if (results.empty()) throw orthodyn::ConfigError(fmt::format("--filter: nothing matches '{}'", request.filter));
    const int lost = orthodyn::bench::print(results, before);
    if (!request.json.empty()) orthodyn::write_file(request.json, {orthodyn::bench::to_json(results).dump(1), "\n"});
    return lost > 0 ? 1 : 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 2;
  }
}
