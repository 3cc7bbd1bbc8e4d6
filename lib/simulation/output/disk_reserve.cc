#include "lib/simulation/output/disk_reserve.h"

#include <fcntl.h>
#include <unistd.h>

#include <string>

#include "lib/core/write_file.h"

namespace orthodyn {

DiskReserve::DiskReserve(const std::filesystem::path& folder, std::size_t bytes) {
  if (!writes_files()) return;
  std::string name = (folder / "reserve.XXXXXX").string();
  file_ = mkostemp(name.data(), O_CLOEXEC);
  if (file_ < 0) return;
  unlink(name.c_str());
  if (posix_fallocate(file_, 0, static_cast<off_t>(bytes)) != 0) release();
}

void DiskReserve::release() {
  if (file_ >= 0) close(file_);
  file_ = -1;
}

}  // namespace orthodyn
