// Objects of PETSc that end with their owners.
#pragma once

#include <petscksp.h>
#include <petscsf.h>

#include <utility>

namespace orthodyn::petsc {

// Made and destroyed while a Session lives; an empty one needs none.
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
  // Where a function of PETSc's puts the object that it makes.
  Object* receive() {
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
