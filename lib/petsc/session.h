// PETSc and MPI, started once and ended with the process; their calls, one thread at a time, with their errors as
// exceptions.
#pragma once

#include <petscksp.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "lib/linear/blas.h"
#include "lib/petsc/handle.h"

namespace orthodyn::petsc {

// PETSc may be called while one of these lives; starts it first. Throws RunError if that fails.
class Session {
 public:
  Session();

 private:
  std::unique_lock<std::mutex> one_at_a_time_;
  std::optional<BlasThreadLimit> serial_blas_;  // its calls are short: a second thread would wait in vain
};

// Throw RunError, with what PETSc says, for what is no success.
void check(PetscErrorCode code);
void check_mpi(int code);

// Whether it is so on one of the ranks. Collective.
bool on_any(MPI_Comm ranks, bool here);

// Options for PETSc's objects.
class Options {
 public:
  // As on a command line; the later of two equal ones holds. Throws ConfigError for what is no list of options.
  explicit Options(const std::string& text);

  bool has(const char* name) const;
  std::vector<std::string> unused() const;  // names, without "-", of those that nobody has asked for
  PetscOptions get() const { return options_; }

 private:
  Handle<PetscOptions, PetscOptionsDestroy> options_;
};

// While it lives, these are the options that objects read.
class InUse {
 public:
  explicit InUse(const Options& options);
  ~InUse();
  InUse(const InUse&) = delete;
  InUse& operator=(const InUse&) = delete;
};

}  // namespace orthodyn::petsc
