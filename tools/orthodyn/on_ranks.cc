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
#include "tools/orthodyn/notice.h"

namespace orthodyn {

namespace {

constexpr int kInputAtFault = 2, kCouldNotGoOn = 3;

// Rethrows what all ranks have thrown on the first one.
int after_failure(const Ranks& ranks, const std::string& message, int exit_code) {
  if (failed_alone(&ranks)) end_all_ranks(ranks, message);
  if (ranks.is_first()) std::rethrow_exception(std::current_exception());
  return exit_code;
}

}  // namespace

void require_one_rank_unless(bool on_ranks, const std::string& command) {
  if (!on_ranks && is_one_of_several_ranks())
    throw ConfigError(
        fmt::format("`orthodyn {}` is for one process; mpirun starts several of `orthodyn run` only, and "
                    "studies take --ranks",
                    command));
}

void let_first_rank_tell() {
  constexpr unsigned kSeconds = 2;
  if (is_a_later_rank()) sleep(kSeconds);
}

int on_world_ranks(const std::function<int(const Ranks*)>& work) {
  const Ranks* ranks = mpi_world();
  if (!ranks) return work(nullptr);
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // when mpirun is killed
  if (!ranks->is_first()) leave_files_to_others();
  try {
    return work(ranks);
  } catch (const ConfigError& e) {
    return after_failure(*ranks, e.what(), kInputAtFault);
  } catch (const std::exception& e) {
    return after_failure(*ranks, e.what(), kCouldNotGoOn);
  }
}

void end_all_ranks(const Ranks& ranks, const std::string& message) {
  print_notice(fmt::format("error: rank {} of {}: {}\n", ranks.rank(), ranks.size(), message));
  ranks.abort(kCouldNotGoOn);
  std::abort();  // which is not reached, but the compiler does not know
}

}  // namespace orthodyn
