// Owning handles of PETSc objects.
#pragma once

#include <petscksp.h>
#include <petscsf.h>

#include <utility>

namespace orthodyn::petsc {

// A non-empty handle must be created and destroyed during a Session.
template <class Object, PetscErrorCode (*kDestroy)(Object*)>
class Handle {
 public:
  Handle() = default;
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : object_(other.object_) { other.object_ = nullptr; }
  Handle& operator=(Handle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }

  void reset() {
    if (object_) static_cast<void>(kDestroy(&object_));
    object_ = nullptr;
  }
  // Destroys the object held, and returns the address at which a PETSc function stores a new one.
  Object* receive() {
    reset();
    return &object_;
  }
  Object get() const { return object_; }
  operator Object() const { return object_; }  // NOLINT: for PETSc's functions

 private:
  Object object_ = nullptr;
};

using OwnedMatrix = Handle<Mat, MatDestroy>;
using OwnedVector = Handle<Vec, VecDestroy>;
using OwnedMethod = Handle<KSP, KSPDestroy>;
using OwnedForest = Handle<PetscSF, PetscSFDestroy>;
using OwnedNullSpace = Handle<MatNullSpace, MatNullSpaceDestroy>;
using OwnedPartitioning = Handle<MatPartitioning, MatPartitioningDestroy>;
using OwnedNumbers = Handle<IS, ISDestroy>;

}  // namespace orthodyn::petsc
