// Objects of PETSc that end with their owners.
#pragma once

#include <petscksp.h>
#include <petscsf.h>

namespace orthodyn::petsc {

// Where PETSc may be called, also when it ends (Session); an empty one ends anywhere.
template <class Object, PetscErrorCode (*kDestroy)(Object*)>
class Handle {
 public:
  Handle() = default;
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : object_(other.object_) { other.object_ = nullptr; }
  Handle& operator=(Handle&&) = delete;

  void reset() {
    if (object_) static_cast<void>(kDestroy(&object_));
    object_ = nullptr;
  }
  // For a function that makes one.
  Object* put() {
    reset();
    return &object_;
  }
  Object get() const { return object_; }
  operator Object() const { return object_; }  // as PETSc's functions take it

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
