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

// The fields of one frame: displacement, velocity, and two that are recovered at the nodes.
void outputs(benchmark::State& state, const BentBeam& beam) {
  for (auto _ : state) {
    const auto view = beam.model().view({0, beam.q(), beam.v()});
    for (const char* field : {"displacement", "velocity", "nodal_stress", "von_mises"})
      benchmark::DoNotOptimize(view->evaluate(field));
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

using Measure = void (*)(benchmark::State&, const BentBeam&);

// Registers benchmarks; with `calls` > 0 each makes this number of calls, otherwise as many as a precise time needs.
class Registration {
 public:
  explicit Registration(int calls) : calls_(calls) {}

  void add(const std::string& kernel, const std::string& size, const std::shared_ptr<LazyBeam>& beam, Measure measure) {
    add(kernel + "/" + size, [beam, measure](benchmark::State& state) { measure(state, beam->get()); });
  }

  // Runs with all threads of the machine.
  void add_threaded(const std::string& kernel, const std::string& size, const std::shared_ptr<LazyBeam>& beam,
                    Measure measure) {
    const int count = available_threads();
    if (count == 1) return;
    add(fmt::format("{}, {} threads/{}", kernel, count, size), [beam, measure, count](benchmark::State& state) {
      const LoopThreads threads(count);
      measure(state, beam->get());
    });
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

 private:
  template <class Run>
  void add(const std::string& name, Run&& run) {
    auto* const added = benchmark::RegisterBenchmark(name.c_str(), std::forward<Run>(run))->UseRealTime();
    if (calls_ > 0) added->Iterations(calls_);
  }

  int calls_;
};

struct Size {
  int across;
  const char* name;
};

}  // namespace

void register_memory() { benchmark::RegisterBenchmark("160 bytes from memory", triad)->UseRealTime(); }

void register_kernels(bool large, int calls) {
  Registration all(calls);
  std::vector<Size> sizes{{5, "2,700"}, {9, "13,500"}};
  if (large) sizes.push_back({15, "57,600"});
  for (const auto& [across, name] : sizes) {
    const auto plain = std::make_shared<LazyBeam>(Beam{}, across),
               damped = std::make_shared<LazyBeam>(Beam{true}, across),
               isotropic = std::make_shared<LazyBeam>(Beam{false, 1, "isotropic"}, across);
    const std::string n = name;
    all.add("force", n, plain, force);
    all.add_threaded("force", n, plain, force);
    all.add("force, damped", n, damped, force);
    all.add("force, isotropic", n, isotropic, force);
    all.add("tangent", n, plain, tangent);
    all.add_threaded("tangent", n, plain, tangent);
    all.add("tangent, damped", n, damped, tangent);
    all.add("tangent, isotropic", n, isotropic, tangent);
    all.add("M + w K", n, plain, combine);
    all.add_threaded("M + w K", n, plain, combine);
    all.add("M + w D + w K", n, damped, combine);
    all.add("elastic energy", n, plain, energy);
    all.add_threaded("elastic energy", n, plain, energy);
    all.add("outputs", n, plain, outputs);
    all.add_solvers(n, plain);
    all.add("symbolic analysis", n, plain, analysis);
  }
  all.add_solvers("4,005 quadratic", std::make_shared<LazyBeam>(Beam{false, 2}, 3));
  const auto quadratic = std::make_shared<LazyBeam>(Beam{false, 2}, 4);
  all.add("force, quadratic elements", "6,480", quadratic, force);
  all.add("tangent, quadratic elements", "6,480", quadratic, tangent);
  all.add("outputs, quadratic elements", "6,480", quadratic, outputs);
  for (const char* kind : {"hexahedra", "hexahedra_27", "wedges"})
    for (const char* formulation : {"displacement", "mixed"}) {
      const auto beam = std::make_shared<LazyBeam>(Beam{false, 2, "orthotropic_stable", kind, formulation}, 4);
      all.add(fmt::format("force, {} {}", formulation, kind), "4 across", beam, force);
      all.add(fmt::format("tangent, {} {}", formulation, kind), "4 across", beam, tangent);
    }
}

void register_growth() {
  Registration all(0);
  const std::vector<Size> sizes{{5, "3,125"},    {7, "8,575"},    {10, "25,000"}, {14, "68,600"},
                                {20, "200,000"}, {27, "492,075"}, {34, "982,600"}};
  for (const auto& [across, elements] : sizes) {
    const auto beam = std::make_shared<LazyBeam>(Beam{}, across);
    const std::string n = std::string(elements) + " elements";
    all.add("force", n, beam, force);
    all.add("tangent", n, beam, tangent);
    all.add("symbolic analysis", n, beam, analysis);
    all.add("factorisation", n, beam, factorisation<Use::in_double>);
    all.add("solve", n, beam, solve<Use::in_double>);
  }
}

}  // namespace orthodyn::bench
