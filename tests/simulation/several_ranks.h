// Common parts of the tests on several ranks.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lib/linear/solver.h"
#include "tests/simulation/resume_fixture.h"

namespace orthodyn {

class SeveralRanks : public Resume {
 protected:
  void SetUp() override {
    if (!solver_registry().at("petsc").unavailable.empty()) GTEST_SKIP() << "built without MPI";
  }

  // Permits root, and more ranks than cores.
  static std::string for_any_user() {
    return "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
           "PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe OMPI_MCA_mpi_yield_when_idle=1 ";
  }
  static std::string mpirun(int ranks) {
    return for_any_user() + "mpirun -n " + std::to_string(ranks) + " " + program() + " ";
  }
  CommandResult orthodyn_on(int ranks, const std::string& arguments) const {
    return shell("cd " + folder_.string() + " && " + mpirun(ranks) + arguments);
  }

  // `tolerance`: relative to the largest value of each column.
  void expect_alike(const std::string& name, const std::string& expected, double tolerance,
                    const std::vector<std::string>& files = {"energy.csv", "probes.csv"}) const {
    for (const std::string& file : files) {
      const auto found = read_rows(folder_ / name / file), rows = read_rows(folder_ / expected / file);
      ASSERT_EQ(found.size(), rows.size()) << file;
      for (std::size_t column = 0; column < rows.front().size(); ++column) {
        double largest = 0, worst = 0;
        for (std::size_t row = 0; row < rows.size(); ++row) {
          if (std::isnan(found[row][column]) && std::isnan(rows[row][column])) continue;
          largest = std::max(largest, std::abs(rows[row][column]));
          const double off = std::abs(found[row][column] - rows[row][column]);
          if (!(off <= worst)) worst = off;  // NaN stays
        }
        EXPECT_LE(worst, tolerance * std::max(largest, 1e-6)) << file << " column " << column;
      }
    }
  }

  static int count(const std::string& text, const std::string& word) {
    int found = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
    return found;
  }
};

}  // namespace orthodyn
