// A force evaluation that fails on one of several ranks: all ranks take the same decision.
#include <chrono>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <thread>

#include "integrators/run_checks.h"
#include "tests/contract/integrators.h"

namespace orthodyn::rank_failure_test {
namespace {

// Rendezvous of two ranks, which are threads of this process. A timeout of some seconds means that their calls differ.
class Meeting {
 public:
  template <class Combine>
  void combine(std::span<double> values, Combine&& with) {
    std::unique_lock lock(mutex_);
    if (++here_ == 1) {
      sum_.assign(values.begin(), values.end());
    } else {
      ASSERT_EQ(values.size(), sum_.size());
      for (std::size_t k = 0; k < values.size(); ++k) sum_[k] = with(sum_[k], values[k]);
    }
    if (here_ == 2) {
      result_ = sum_, here_ = 0, ++number_;
      met_.notify_all();
    } else if (const long now = number_;
               !met_.wait_for(lock, std::chrono::seconds(20), [&] { return number_ > now; })) {
      throw std::logic_error("the other rank does something else");
    }
    std::copy(result_.begin(), result_.end(), values.begin());
  }

 private:
  std::mutex mutex_;
  std::condition_variable met_;
  int here_ = 0;
  long number_ = 0;
  std::vector<double> sum_, result_;
};

class ThreadRanks : public Ranks {
 public:
  ThreadRanks(Meeting& meeting, int rank) : meeting_(meeting), rank_(rank) {}
  int rank() const override { return rank_; }
  int size() const override { return 2; }
  void sum(std::span<double> values) const override { meeting_.combine(values, std::plus()); }
  void max(std::span<double> values) const override {
    meeting_.combine(values, [](double a, double b) { return std::max(a, b); });
  }
  void broadcast(std::span<double> values) const override {
    if (rank_ > 0) std::fill(values.begin(), values.end(), 0);
    sum(values);
  }
  // Not needed by these models.
  long sum_before(long) const override { throw std::logic_error("not here"); }
  std::vector<double> gather(std::span<const double>) const override { throw std::logic_error("not here"); }
  void scatter(std::span<const double>, std::span<double>) const override { throw std::logic_error("not here"); }
  std::vector<int> partition(const CellGraph&) const override { throw std::logic_error("not here"); }
  std::unique_ptr<NodeExchange> exchange(int, const std::vector<RemoteNode>&) const override {
    throw std::logic_error("not here");
  }
  bool barrier_within(double) const override { return true; }
  void abort(int) const override { std::abort(); }

 private:
  Meeting& meeting_;
  int rank_;
};

// One of two uncoupled oscillators; the force of the second is not finite in `times` calls after
// t = 0.2.
class Half : public LinearModel {
 public:
  Half(const Ranks& ranks, long times)
      : LinearModel(
            {.mass = scalar(1), .stiffness = scalar(9), .start = Vector::Ones(1), .end = 1, .velocity_scale = 3}),
        ranks_(ranks),
        left_(times) {}

  const Ranks* ranks() const override { return &ranks_; }
  Eigen::Index num_dofs_of_all() const override { return 2; }
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override {
    LinearModel::force(t, q, v, f);
    if (ranks_.rank() == 1 && t > 0.2 && left_-- > 0) f[0] = std::numeric_limits<double>::infinity();
  }

 private:
  const Ranks& ranks_;
  mutable long left_;
};

struct End {
  std::string message;  // of a failure
  State state;
  long steps = 0;
};

End integrate_half(Meeting& meeting, int rank, const std::string& method, long times) {
  const ThreadRanks ranks(meeting, rank);
  const Half model(ranks, times);
  End end;
  try {
    const auto integrator = make_integrator({method, "klu"}, model, {.rtol = 1e-4, .order = variant(method, 0).order});
    integrate(model, *integrator);
    end.steps = integrator->statistics().steps;
    integrator->interpolate(model.end(), end.state);
  } catch (const std::exception& e) {
    end.message = e.what();
  }
  return end;
}

std::array<End, 2> on_two_ranks(const std::string& method, long times) {
  Meeting meeting;
  std::array<End, 2> ends;
  std::thread other([&] { ends[1] = integrate_half(meeting, 1, method, times); });
  ends[0] = integrate_half(meeting, 0, method, times);
  other.join();
  return ends;
}

// All but those of SUNDIALS, whose vectors need MPI.
class OnTwoRanks : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Native, OnTwoRanks,
                         testing::Values("generalized_alpha", "tr_bdf2", "sdirk", "rosenbrock", "bathe", "newmark"));

TEST_P(OnTwoRanks, AForceThatIsNotFiniteOnOneShortensTheStepsOfBoth) {
  const auto [first, second] = on_two_ranks(GetParam(), 2);
  EXPECT_EQ(first.message, "");
  EXPECT_EQ(second.message, "");
  EXPECT_EQ(first.steps, second.steps);
  ASSERT_EQ(first.state.q.size(), 1);
  EXPECT_NEAR(first.state.q[0], std::cos(3.0), 0.05);
  EXPECT_NEAR(second.state.q[0], std::cos(3.0), 0.05);
}

TEST_P(OnTwoRanks, AForceThatIsNeverFiniteOnOneEndsBoth) {
  const auto [first, second] = on_two_ranks(GetParam(), std::numeric_limits<long>::max());
  EXPECT_NE(first.message.find("stopped at t = "), std::string::npos) << first.message;
  EXPECT_EQ(first.message, second.message);
}

TEST(OnTwoRanks, TheyAgreeOnForces) {
  Meeting meeting;
  const auto refuses = [&](int rank) {
    const ThreadRanks ranks(meeting, rank);
    const Half model(ranks, 0);
    try {
      require_finite(model, Vector::Constant(1, rank == 1 ? std::numeric_limits<double>::quiet_NaN() : 1));
      return false;
    } catch (const RecoverableError&) {
      return true;
    }
  };
  bool second = false;
  std::thread other([&] { second = refuses(1); });
  EXPECT_TRUE(refuses(0));
  other.join();
  EXPECT_TRUE(second);
}

}  // namespace
}  // namespace orthodyn::rank_failure_test
