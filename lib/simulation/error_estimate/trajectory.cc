#include "lib/simulation/error_estimate/trajectory.h"

#include <cstdint>
#include <cstring>
#include <fstream>

#include "lib/core/errors.h"
#include "lib/core/fingerprint.h"
#include "lib/simulation/output/files.h"

namespace orthodyn {

namespace {

// File format: mark, N, components of quantities, number of times, fingerprint of the rest, then times, q, v and
// quantities as native doubles.
constexpr char kTrajectoryMark[8] = {'O', 'D', 'T', 'R', 'A', 'J', '0', '3'};
struct Head {
  char mark[8];
  std::int64_t unknowns, components, times;
  char fingerprint[16];
};

template <class T>
std::string bytes(const T* data, std::size_t count) {
  return {reinterpret_cast<const char*>(data), count * sizeof(T)};
}

// Times, q, v and quantities in sequence; empty if the file is damaged.
std::vector<double> numbers_in(const std::filesystem::path& path, Head& head) {
  std::ifstream in(path, std::ios::binary);
  in.read(reinterpret_cast<char*>(&head), sizeof head);
  if (!in || std::memcmp(head.mark, kTrajectoryMark, sizeof kTrajectoryMark) != 0) return {};
  std::error_code ec;
  const auto size = std::filesystem::file_size(path, ec);
  const auto doubles = (size - sizeof head) / sizeof(double);
  const double of_a_time = 1 + 2 * static_cast<double>(head.unknowns) + static_cast<double>(head.components);
  if (ec || head.times < 0 || head.unknowns < 0 || head.components < 0 ||
      static_cast<double>(doubles) != static_cast<double>(head.times) * of_a_time)
    return {};
  std::vector<double> numbers(doubles);
  in.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(doubles * sizeof(double)));
  if (!in || in.peek() != std::char_traits<char>::eof()) return {};
  const std::string found = Fingerprint().add(bytes(numbers.data(), numbers.size())).text();
  return found.compare(0, std::string::npos, head.fingerprint, sizeof head.fingerprint) == 0 ? numbers
                                                                                             : std::vector<double>{};
}

}  // namespace

void Trajectory::save(const std::filesystem::path& path) const {
  const std::string numbers = bytes(times.data(), times.size()) + bytes(q.data(), static_cast<std::size_t>(q.size())) +
                              bytes(v.data(), static_cast<std::size_t>(v.size())) +
                              bytes(quantities.data(), static_cast<std::size_t>(quantities.size()));
  Head head{{}, q.rows(), quantities.rows(), q.cols(), {}};
  std::memcpy(head.mark, kTrajectoryMark, sizeof kTrajectoryMark);
  std::memcpy(head.fingerprint, Fingerprint().add(numbers).text().data(), sizeof head.fingerprint);
  write_file(path, {bytes(&head, 1), numbers});
}

bool Trajectory::is_whole(const std::filesystem::path& path) {
  Head head{};
  return !numbers_in(path, head).empty();
}

Trajectory Trajectory::load(const std::filesystem::path& path) {
  Head head{};
  const std::vector<double> numbers = numbers_in(path, head);
  if (numbers.empty()) throw RunError(path.string() + ": is not a trajectory, or damaged; start the comparison again");
  const auto size = static_cast<std::ptrdiff_t>(head.unknowns * head.times);
  const double* at = numbers.data() + head.times;
  return {{numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(head.times)},
          Eigen::Map<const Eigen::MatrixXd>(at, head.unknowns, head.times),
          Eigen::Map<const Eigen::MatrixXd>(at + size, head.unknowns, head.times),
          Eigen::Map<const Eigen::MatrixXd>(at + 2 * size, head.components, head.times)};
}

}  // namespace orthodyn
