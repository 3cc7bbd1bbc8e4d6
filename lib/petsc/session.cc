#include "lib/petsc/session.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

#include "lib/core/errors.h"
#include "lib/core/versions.h"

namespace orthodyn::petsc {

namespace {

// Without mpirun, adds settings to the environment during its lifetime, with which Open MPI starts without a daemon and
// a search for networks (0.07 s instead of 0.5 s). Open MPI reads these settings only from the environment; other MPIs
// ignore them.
//
// Other threads may be reading the environment, so it is not modified: `environ` points to a new list with the same
// entries and the settings. The list is never freed, since a thread may still use it.
class SingletonEnvironment {
 public:
  SingletonEnvironment() : original_(environ) {
    if (std::getenv("OMPI_COMM_WORLD_SIZE") || std::getenv("PMI_SIZE") || std::getenv("PMIX_RANK")) return;
    static std::vector<char*> list;
    for (char** entry = original_; entry && *entry; ++entry) list.push_back(*entry);
    for (std::string& setting : settings())
      if (const std::string name = setting.substr(0, setting.find('=')); !std::getenv(name.c_str())) {
        list.push_back(setting.data());
        names_.push_back(name);
      }
    list.push_back(nullptr);
    environ = extended_ = list.data();
  }
  ~SingletonEnvironment() {  // child processes must not inherit the settings
    if (!extended_) return;
    if (environ == extended_) environ = original_;
    else
      for (const std::string& name : names_) unsetenv(name.c_str());  // MPI has replaced the list itself
  }
  SingletonEnvironment(const SingletonEnvironment&) = delete;
  SingletonEnvironment& operator=(const SingletonEnvironment&) = delete;

 private:
  static std::vector<std::string>& settings() {
    static std::vector<std::string> all{"OMPI_MCA_ess_singleton_isolated=1", "OMPI_MCA_pml=ob1", "OMPI_MCA_btl=self"};
    return all;
  }

  char** original_;
  char** extended_ = nullptr;
  std::vector<std::string> names_;
};

struct Process {
  Process() {
    const SingletonEnvironment alone;
    // PETSc installs no signal handlers and reads no options file.
    static char name[] = "orthodyn", no_handler[] = "-no_signal_handler", no_file[] = "-skip_petscrc",
                no_report[] = "-options_left", no[] = "no";
    static char* words[] = {name, no_handler, no_file, no_report, no, nullptr};
    int count = 5;
    PETSC_MPI_THREAD_REQUIRED = MPI_THREAD_SERIALIZED;
    char** arguments = words;
    if (const PetscErrorCode code = PetscInitialize(&count, &arguments, nullptr, nullptr); code != 0)
      throw RunError(fmt::format("PETSc could not be started (error {})", static_cast<int>(code)));
    check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
    library_versions().emplace(
        "PETSc", fmt::format("{}.{}.{}", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR));
    std::atexit([] {
      PetscBool ended = PETSC_FALSE;
      if (PetscFinalized(&ended) == 0 && !ended) static_cast<void>(PetscFinalize());
    });
  }
};

}  // namespace

Session::Session() {
  static std::mutex mutex;
  one_at_a_time_ = std::unique_lock(mutex);
  static const Process process;
  serial_blas_.emplace(1);
}

void check(PetscErrorCode code) {
  if (code == 0) return;
  if (code == PETSC_ERR_MEM) throw RunError("PETSc: out of memory", Reason::out_of_memory);
  const char* words = nullptr;
  char* detail = nullptr;
  static_cast<void>(PetscErrorMessage(code, &words, &detail));
  throw RunError(fmt::format("PETSc: {} (error {}){}{}", words ? words : "unknown error", static_cast<int>(code),
                             detail && *detail ? ": " : "", detail ? detail : ""));
}

void check_mpi(int code) {
  if (code != MPI_SUCCESS) throw RunError("MPI: a call has failed (error " + std::to_string(code) + ")");
}

bool any_rank(MPI_Comm ranks, bool here) {
  int any = here ? 1 : 0;
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, ranks));
  return any != 0;
}

Options::Options(const std::string& text) {
  check(PetscOptionsCreate(options_.receive()));
  const auto first = text.find_first_not_of(' ');
  const bool is_list = first == std::string::npos || text[first] == '-';
  if (is_list && PetscOptionsInsertString(options_, text.c_str()) == 0) return;
  throw ConfigError("linear solver 'petsc': '" + text +
                    "' is not a list of options such as -ksp_type cg -pc_type gamg");
}

bool Options::has(const char* name) const {
  PetscBool found = PETSC_FALSE;
  check(PetscOptionsHasName(options_, nullptr, name, &found));
  return found == PETSC_TRUE;
}

std::vector<std::string> Options::unused() const {
  PetscInt count = 0;
  char **names = nullptr, **values = nullptr;
  check(PetscOptionsLeftGet(options_, &count, &names, &values));
  const std::vector<std::string> all(names, names + count);
  check(PetscOptionsLeftRestore(options_, &count, &names, &values));
  return all;
}

ActiveOptions::ActiveOptions(const Options& options) { check(PetscOptionsPush(options.get())); }

ActiveOptions::~ActiveOptions() { static_cast<void>(PetscOptionsPop()); }

}  // namespace orthodyn::petsc
