// PETSc and MPI in this process: started once, ended at exit, called by one thread at a time, errors as exceptions.
#pragma once

#include <petscksp.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "lib/linear/blas.h"
#include "lib/petsc/handle.h"

namespace orthodyn::petsc {

// PETSc may be called only while a Session exists. The first one starts PETSc; throws RunError if that fails.
class Session {
 public:
  Session();

 private:
  std::unique_lock<std::mutex> one_at_a_time_;
  std::optional<BlasThreadLimit> serial_blas_;  // PETSc's BLAS calls are too short for several threads
};

// Throw RunError with PETSc's message if a call has failed.
void check(PetscErrorCode code);
void check_mpi(int code);

// True if `here` is true on any rank. Collective.
bool any_rank(MPI_Comm ranks, bool here);

// Throws ConfigError unless `options` is a list of options that a scene may give: those that choose and tune a method.
// Other options write or read files (-ksp_view :FILE, -..._monitor, -options_file) or wait for the user (-petsc_sleep);
// they may be given in the environment variable PETSC_OPTIONS.
void require_allowed(const std::string& options);

// A set of options for PETSc objects.
class Options {
 public:
  // `text`: options as on a command line; if an option is given twice, the later one applies. Throws ConfigError if the
  // text is not a list of options.
  explicit Options(const std::string& text);

  bool has(const char* name) const;
  std::vector<std::string> unused() const;  // names, without "-", of options that no object has read
  PetscOptions get() const { return options_; }

 private:
  Handle<PetscOptions, PetscOptionsDestroy> options_;
};

// While an object of this class exists, PETSc objects read its options.
class ActiveOptions {
 public:
  explicit ActiveOptions(const Options& options);
  ~ActiveOptions();
  ActiveOptions(const ActiveOptions&) = delete;
  ActiveOptions& operator=(const ActiveOptions&) = delete;
};

}  // namespace orthodyn::petsc
