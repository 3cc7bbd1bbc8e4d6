// Benchmarks of forces, tangents, factorisations and memory bandwidth, in nanoseconds per element of real time. The
// processor time of one thread would not include the time that it waits for others.
#include "tools/bench/kernels.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "lib/core/parallel.h"
#include "lib/linear/solver.h"
#include "tools/bench/beam.h"

namespace orthodyn::bench {

namespace {

// Memory bandwidth: a_i = b_i + s c_i on arrays far larger than the caches (McCalpin's STREAM triad). A force reads at
// least 160 bytes per element: nine gradients, a volume, four node numbers and a share of the offsets.
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

void count(benchmark::State& state, const BentBeam& beam) {
  state.SetItemsProcessed(state.iterations() * beam.num_elements());
  state.counters["elements"] = beam.num_elements();
  state.counters["unknowns"] = beam.model().num_dofs();
}

void force(benchmark::State& state, const BentBeam& beam) {
  Vector f(beam.q().size());
  for (auto _ : state) {
    beam.model().force(0, beam.q(), beam.v(), f);
    benchmark::DoNotOptimize(f.data());
  }
  count(state, beam);
}

void tangent(benchmark::State& state, const BentBeam& beam) {
  Linearization at;
  for (auto _ : state) beam.model().linearize(0, beam.q(), beam.v(), TangentKind::exact, at);
  count(state, beam);
}

void combine(benchmark::State& state, const BentBeam& beam) {
  Linearization at;
  beam.model().linearize(0, beam.q(), beam.v(), TangentKind::exact, at);
  std::vector<double> values(beam.model().pattern().row.size());
  for (auto _ : state) beam.model().combine({1, 1e-2, 1e-4}, at, values.data());
  count(state, beam);
}

void energy(benchmark::State& state, const BentBeam& beam) {
  for (auto _ : state) {
    const auto view = beam.model().view({0, beam.q(), beam.v()});
    benchmark::DoNotOptimize(view->evaluate("energy.elastic"));
  }
  count(state, beam);
}

enum class Use { in_double, in_single, cholmod };

struct Factored {
  Factored(const BentBeam& beam, Use use)
      : solver(make_linear_solver(use == Use::cholmod ? "cholmod" : "cholesky")),
        values(beam.model().pattern().row.size()) {
    Linearization at;
    beam.model().linearize(0, beam.q(), beam.v(), TangentKind::exact, at);
    beam.model().combine({1, 1e-2, 1e-4}, at, values.data());
    solver->analyze(beam.model().pattern());
    if (use == Use::in_single) solver->set_tolerance({1e-2, 0});
    solver->factor(values.data());
  }
  std::unique_ptr<LinearSolver> solver;
  std::vector<double> values;
};

template <Use use>
void factorisation(benchmark::State& state, const BentBeam& beam) {
  Factored factored(beam, use);
  for (auto _ : state) factored.solver->factor(factored.values.data());
  count(state, beam);
  state.counters["bytes"] = static_cast<double>(factored.solver->factor_bytes());
}

template <Use use>
void solve(benchmark::State& state, const BentBeam& beam) {
  Factored factored(beam, use);
  Vector x(beam.q().size());
  factored.solver->solve(beam.q(), x);  // the first solution in single precision is refined
  for (auto _ : state) factored.solver->solve(beam.q(), x);
  count(state, beam);
}

void analysis(benchmark::State& state, const BentBeam& beam) {
  for (auto _ : state) {
    const auto solver = make_linear_solver("cholesky");
    solver->analyze(beam.model().pattern());
  }
  count(state, beam);
}

// Builds the beam when its first benchmark runs: benchmarks that `--filter` leaves out build nothing.
class LazyBeam {
 public:
  LazyBeam(Beam beam, int across) : beam_(std::move(beam)), across_(across) {}
  const BentBeam& get() {
    if (!body_) body_ = std::make_unique<BentBeam>(beam_, across_);
    return *body_;
  }

 private:
  Beam beam_;
  int across_;
  std::unique_ptr<BentBeam> body_;
};

void add(const std::string& kernel, const std::string& size, const std::shared_ptr<LazyBeam>& beam,
         void (*measure)(benchmark::State&, const BentBeam&)) {
  benchmark::RegisterBenchmark((kernel + "/" + size).c_str(), [beam, measure](benchmark::State& state) {
    measure(state, beam->get());
  })->UseRealTime();
}

// Runs with all threads of the machine.
void add_threaded(const std::string& kernel, const std::string& size, const std::shared_ptr<LazyBeam>& beam,
                  void (*measure)(benchmark::State&, const BentBeam&)) {
  const int count = available_threads();
  if (count == 1) return;
  const std::string name = fmt::format("{}, {} threads/{}", kernel, count, size);
  benchmark::RegisterBenchmark(name.c_str(), [beam, measure, count](benchmark::State& state) {
    const LoopThreads threads(count);
    measure(state, beam->get());
  })->UseRealTime();
}

// Cholesky beside CHOLMOD.
void add_solvers(const std::string& size, const std::shared_ptr<LazyBeam>& beam) {
  add("factorisation", size, beam, factorisation<Use::in_double>);
  add_threaded("factorisation", size, beam, factorisation<Use::in_double>);
  add("factorisation, single precision", size, beam, factorisation<Use::in_single>);
  add_threaded("factorisation, single precision", size, beam, factorisation<Use::in_single>);
  add("factorisation, CHOLMOD", size, beam, factorisation<Use::cholmod>);
  add("solve", size, beam, solve<Use::in_double>);
  add("solve, single precision", size, beam, solve<Use::in_single>);
  add("solve, CHOLMOD", size, beam, solve<Use::cholmod>);
}

struct Size {
  int across;
  const char* name;
};

}  // namespace

void register_memory() { benchmark::RegisterBenchmark("160 bytes from memory", triad)->UseRealTime(); }

void register_kernels(bool large) {
  std::vector<Size> sizes{{5, "2,700"}, {9, "13,500"}};
  if (large) sizes.push_back({15, "57,600"});
  for (const auto& [across, name] : sizes) {
    const auto plain = std::make_shared<LazyBeam>(Beam{}, across),
               damped = std::make_shared<LazyBeam>(Beam{true}, across),
               isotropic = std::make_shared<LazyBeam>(Beam{false, 1, "isotropic"}, across);
    const std::string n = name;
    add("force", n, plain, force);
    add_threaded("force", n, plain, force);
    add("force, damped", n, damped, force);
    add("force, isotropic", n, isotropic, force);
    add("tangent", n, plain, tangent);
    add_threaded("tangent", n, plain, tangent);
    add("tangent, damped", n, damped, tangent);
    add("tangent, isotropic", n, isotropic, tangent);
    add("M + w K", n, plain, combine);
    add_threaded("M + w K", n, plain, combine);
    add("M + w D + w K", n, damped, combine);
    add("elastic energy", n, plain, energy);
    add_threaded("elastic energy", n, plain, energy);
    add_solvers(n, plain);
    add("symbolic analysis", n, plain, analysis);
  }
  add_solvers("4,005 quadratic", std::make_shared<LazyBeam>(Beam{false, 2}, 3));
  const auto quadratic = std::make_shared<LazyBeam>(Beam{false, 2}, 4);
  add("force, quadratic elements", "6,480", quadratic, force);
  add("tangent, quadratic elements", "6,480", quadratic, tangent);
}

void register_growth() {
  const std::vector<Size> sizes{{5, "3,125"},    {7, "8,575"},    {10, "25,000"}, {14, "68,600"},
                                {20, "200,000"}, {27, "492,075"}, {34, "982,600"}};
  for (const auto& [across, elements] : sizes) {
    const auto beam = std::make_shared<LazyBeam>(Beam{}, across);
    const std::string n = std::string(elements) + " elements";
    add("force", n, beam, force);
    add("tangent", n, beam, tangent);
    add("symbolic analysis", n, beam, analysis);
    add("factorisation", n, beam, factorisation<Use::in_double>);
    add("solve", n, beam, solve<Use::in_double>);
  }
}

}  // namespace orthodyn::bench
