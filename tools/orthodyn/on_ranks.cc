#include "tools/orthodyn/on_ranks.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <exception>

#include "lib/core/errors.h"
#include "lib/core/write_file.h"
#include "lib/linear/mpi_world.h"
#include "lib/simulation/run/several_ranks.h"
#include "tools/orthodyn/print_nothrow.h"

namespace orthodyn {

namespace {

constexpr int kInputError = 2, kRunError = 3;

// Ends all ranks if only this one failed; else rethrows on the first rank.
int after_failure(const Ranks& ranks, const std::string& message, int exit_code) {
  if (only_this_rank_failed(&ranks)) end_all_ranks(ranks, message);
  if (ranks.is_first()) std::rethrow_exception(std::current_exception());
  return exit_code;
}

}  // namespace

void require_one_rank_unless(bool on_ranks, const std::string& command) {
  if (!on_ranks && is_one_of_several_ranks())
    throw ConfigError(fmt::format(
        "`orthodyn {}` runs as one process only: use mpirun with `orthodyn run`, and --ranks with studies", command));
}

void let_first_rank_report() {
  constexpr unsigned kSeconds = 2;
  if (is_a_later_rank()) sleep(kSeconds);
}

int run_on_world_ranks(const std::function<int(const Ranks*)>& work) {
  const Ranks* ranks = mpi_world();
  if (!ranks) return work(nullptr);
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // the rank dies with mpirun
  if (!ranks->is_first()) disable_file_writing();
  try {
    return work(ranks);
  } catch (const ConfigError& e) {
    return after_failure(*ranks, e.what(), kInputError);
  } catch (const std::exception& e) {
    return after_failure(*ranks, e.what(), kRunError);
  }
}

void end_all_ranks(const Ranks& ranks, const std::string& message) {
  print_nothrow(fmt::format("error: rank {} of {}: {}\n", ranks.rank(), ranks.size(), message));
  ranks.abort(kRunError);
  std::abort();  // not reached
}

}  // namespace orthodyn
