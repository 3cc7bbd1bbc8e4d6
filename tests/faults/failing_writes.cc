// Replacements of C library functions; linked into the program, they take precedence, also for libstdc++.
#include "tests/faults/failing_writes.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

using orthodyn::WriteFaults;

WriteFaults* open_faults() {
  const char* path = std::getenv("ORTHODYN_FAILING_WRITES");
  if (!path) return nullptr;
  const int file = static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, O_RDWR | O_CLOEXEC));
  if (file < 0) std::abort();
  void* memory = mmap(nullptr, sizeof(WriteFaults), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (memory == MAP_FAILED) std::abort();
  return static_cast<WriteFaults*>(memory);
}

WriteFaults* faults() {
  static WriteFaults* const all = open_faults();
  return all;
}

// Counts a write; true, with errno set, if it must fail.
bool fails(bool needs_room) {
  WriteFaults* all = faults();
  if (!all || (all->kind == WriteFaults::Kind::full && !needs_room)) return false;
  const long k = ++all->counted;
  if (all->kind == WriteFaults::Kind::none) return false;
  if (all->kind == WriteFaults::Kind::killed && k == all->k) std::raise(SIGKILL);
  if (all->kind == WriteFaults::Kind::killed) return false;
  const bool full = all->kind == WriteFaults::Kind::full;
  if (full ? k < all->k : k != all->k) return false;
  errno = full ? ENOSPC : EIO;
  return true;
}

// Pipes and terminals are not on the disk.
bool is_on_disk(int file, struct stat& status) { return fstat(file, &status) == 0 && S_ISREG(status.st_mode); }

bool write_fails(int file, off_t at, std::size_t size) {
  struct stat status;
  return is_on_disk(file, status) && fails(at + static_cast<off_t>(size) > status.st_size);
}

bool creation_fails(const char* path, bool creates) {
  struct stat status;
  if (stat(path, &status) == 0) return S_ISREG(status.st_mode) && creates && fails(false);
  return creates && fails(true);
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* data, size_t size) {
  if (write_fails(file, lseek(file, 0, SEEK_CUR), size)) return -1;
  return syscall(SYS_write, file, data, size);
}

ssize_t writev(int file, const iovec* parts, int count) {
  size_t size = 0;
  for (int i = 0; i < count; ++i) size += parts[i].iov_len;
  if (write_fails(file, lseek(file, 0, SEEK_CUR), size)) return -1;
  return syscall(SYS_writev, file, parts, count);
}

ssize_t pwrite(int file, const void* data, size_t size, off_t at) {
  if (write_fails(file, at, size)) return -1;
  return syscall(SYS_pwrite64, file, data, size, at);
}

ssize_t pwrite64(int file, const void* data, size_t size, off64_t at) { return pwrite(file, data, size, at); }

int fsync(int file) {
  if (fails(false)) return -1;
  return static_cast<int>(syscall(SYS_fsync, file));
}

int mkdir(const char* path, mode_t mode) {
  struct stat status;
  if (stat(path, &status) != 0 && fails(true)) return -1;
  return static_cast<int>(syscall(SYS_mkdirat, AT_FDCWD, path, mode));
}

int rename(const char* from, const char* to) {
  if (fails(false)) return -1;
  return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(more, mode_t) : 0;
  va_end(more);
  if (creation_fails(path, flags & O_CREAT)) return -1;
  return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

FILE* fopen(const char* path, const char* how) {
  if (creation_fails(path, *how != 'r')) return nullptr;
  return next<FILE*(const char*, const char*)>("fopen")(path, how);
}

FILE* fopen64(const char* path, const char* how) {
  if (creation_fails(path, *how != 'r')) return nullptr;
  return next<FILE*(const char*, const char*)>("fopen64")(path, how);
}

}  // extern "C"
