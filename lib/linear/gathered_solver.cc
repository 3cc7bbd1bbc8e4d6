#include "lib/linear/gathered_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <functional>

namespace orthodyn {

namespace {

// The global matrix, assembled by the first rank from the entries of all ranks.
class WholeMatrix {
 public:
  WholeMatrix() = default;

  // `row_of_unknown`: global row of each unknown, in the order of the vectors. `rows`, `columns`: position of each
  // entry, in either triangle if `symmetric`.
  WholeMatrix(const std::vector<double>& row_of_unknown, const std::vector<double>& rows,
              const std::vector<double>& columns, bool symmetric) {
    const Numbers number(row_of_unknown);
    std::vector<std::pair<int, int>> entries;  // column, row
    entries.reserve(rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      int i = number.of(rows[k]), j = number.of(columns[k]);
      if (symmetric && i < j) std::swap(i, j);
      entries.emplace_back(j, i);
    }
    auto all = entries;
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (const auto& entry : entries) place_.push_back(std::lower_bound(all.begin(), all.end(), entry) - all.begin());

    pattern_.n = static_cast<int>(row_of_unknown.size());
    pattern_.symmetric = symmetric;
    pattern_.column_start.assign(row_of_unknown.size() + 1, 0);
    for (const auto& [column, row] : all) {
      ++pattern_.column_start[static_cast<std::size_t>(column) + 1];
      pattern_.row.push_back(row);
    }
    for (std::size_t j = 0; j < row_of_unknown.size(); ++j) pattern_.column_start[j + 1] += pattern_.column_start[j];
    values_.resize(all.size());
  }

  const Pattern& pattern() const { return pattern_; }

  // `of_entries`: values in the order of the constructor's entries; values at the same position are added.
  const double* values(const std::vector<double>& of_entries) {
    std::fill(values_.begin(), values_.end(), 0.0);
    for (std::size_t k = 0; k < of_entries.size(); ++k) values_[static_cast<std::size_t>(place_[k])] += of_entries[k];
    return values_.data();
  }

 private:
  // Maps a global row to the index of its unknown.
  class Numbers {
   public:
    explicit Numbers(const std::vector<double>& row_of_unknown) {
      for (const double row : row_of_unknown) pairs_.emplace_back(row, static_cast<int>(pairs_.size()));
      std::sort(pairs_.begin(), pairs_.end());
    }
    int of(double row) const { return std::lower_bound(pairs_.begin(), pairs_.end(), std::pair(row, 0))->second; }

   private:
    std::vector<std::pair<double, int>> pairs_;
  };

  Pattern pattern_;
  std::vector<std::ptrdiff_t> place_;  // index of each entry in values_
  std::vector<double> values_;
};

enum class Failure { none, recoverable, input, run };

class GatheredSolver : public LinearSolver {
 public:
  explicit GatheredSolver(std::unique_ptr<LinearSolver> solver) : solver_(std::move(solver)) {}

  void analyze(const Pattern& pattern) override {
    share_ = pattern.share;
    num_entries_ = pattern.row.size();
    const auto& row = share_->row;
    const std::vector<double> unknowns(row.begin(), row.begin() + share_->owned);  // doubles are exact up to 2^53
    std::vector<double> rows, columns;
    for (int j = 0; j < pattern.n; ++j)
      for (int k = pattern.column_start[at(j)]; k < pattern.column_start[at(j) + 1]; ++k) {
        rows.push_back(static_cast<double>(row[at(pattern.row[at(k)])]));
        columns.push_back(static_cast<double>(row[at(j)]));
      }
    const auto all_unknowns = ranks().gather(unknowns), all_rows = ranks().gather(rows),
               all_columns = ranks().gather(columns);
    on_first([&] {
      whole_ = WholeMatrix(all_unknowns, all_rows, all_columns, pattern.symmetric);
      solver_->analyze(whole_.pattern());
    });
    if (ranks().broadcast_flag(ranks().is_first() && solver_->is_iterative()))
      throw ConfigError(
          "an iterative linear solver of one process does not run on several ranks; use petsc, or a direct solver");
    checks_definiteness_ = ranks().broadcast_flag(ranks().is_first() && solver_->checks_definiteness());
  }

  FactorStatus factor(const double* values) override {
    const auto all = ranks().gather({values, num_entries_});
    std::array<double, 3> result{};  // status, number of negative eigenvalues, sign of the determinant
    on_first([&] {
      const FactorStatus status = solver_->factor(whole_.values(all));
      result = {static_cast<double>(status), static_cast<double>(solver_->negative_eigenvalues()), 0};
      if (const auto negative = status == FactorStatus::ok ? solver_->has_negative_determinant() : std::nullopt)
        result[2] = *negative ? -1 : 1;
    });
    ranks().broadcast(result);
    negative_ = static_cast<int>(result[1]);
    sign_ = result[2];
    return static_cast<FactorStatus>(result[0]);
  }

  bool checks_definiteness() const override { return checks_definiteness_; }
  int negative_eigenvalues() const override { return negative_; }
  std::optional<bool> has_negative_determinant() const override {
    return sign_ == 0 ? std::nullopt : std::optional(sign_ < 0);
  }

  void solve(const ConstVectorRef& b, VectorRef x) override {
    std::vector<double> all = ranks().gather({b.data(), static_cast<std::size_t>(b.size())});
    on_first([&] {
      Eigen::Map<Vector> of_all(all.data(), static_cast<Eigen::Index>(all.size()));
      solver_->solve(of_all, of_all);
    });
    ranks().scatter(all, {x.data(), static_cast<std::size_t>(x.size())});
  }

  void set_tolerance(const SolveTolerance& tolerance) override {
    if (ranks().is_first()) solver_->set_tolerance(tolerance);
  }

  std::size_t factor_bytes() const override { return ranks().is_first() ? solver_->factor_bytes() : 0; }
  std::string description() const override {
    return fmt::format("{}, on the first of {} ranks", solver_->description(), ranks().size());
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const Ranks& ranks() const { return *share_->ranks; }

  // Runs `work` on the first rank; the others wait. If it throws, all ranks throw an exception of the same kind.
  void on_first(const std::function<void()>& work) {
    std::exception_ptr failure;
    std::array<double, 2> result{static_cast<double>(Failure::none), 0};
    const auto record = [&](Failure kind, Reason reason = Reason::other) {
      failure = std::current_exception();
      result = {static_cast<double>(kind), static_cast<double>(reason)};
    };
    try {
      try {
        if (ranks().is_first()) work();
      } catch (const std::bad_alloc&) {
        throw RunError("out of memory on the first rank; use linear_solver: petsc, or a coarser mesh",
                       Reason::out_of_memory);
      }
    } catch (const RunError& e) {
      record(Failure::run, e.reason());
    } catch (const RecoverableError&) {
      record(Failure::recoverable);
    } catch (const ConfigError&) {
      record(Failure::input);
    } catch (...) {
      record(Failure::run);
    }
    ranks().broadcast(result);
    if (failure) std::rethrow_exception(failure);
    static constexpr const char* kMessage = "the first rank cannot solve the linear system";
    switch (static_cast<Failure>(result[0])) {
      case Failure::none: return;
      case Failure::recoverable: throw RecoverableError(kMessage);
      case Failure::input: throw ConfigError(kMessage);
      case Failure::run: throw RunError(kMessage, static_cast<Reason>(result[1]));
    }
  }

  std::shared_ptr<const PatternShare> share_;
  std::size_t num_entries_ = 0;
  WholeMatrix whole_;  // must outlive solver_, which uses its pattern
  std::unique_ptr<LinearSolver> solver_;
  bool checks_definiteness_ = false;
  int negative_ = 0;
  double sign_ = 0;  // sign of the determinant; 0 if unknown
};

}  // namespace

std::unique_ptr<LinearSolver> prepare(std::unique_ptr<LinearSolver> solver, const Pattern& pattern) {
  if (pattern.share) solver = std::make_unique<GatheredSolver>(std::move(solver));
  solver->analyze(pattern);
  return solver;
}

}  // namespace orthodyn
