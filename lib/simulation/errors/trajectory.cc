#include "lib/simulation/errors/trajectory.h"

#include <cstdint>
#include <cstring>
#include <fstream>

#include "lib/core/errors.h"
#include "lib/simulation/files.h"

namespace orthodyn {

namespace {

// A file is the mark, N, the number of times, then times, q and v as doubles of this machine.
constexpr char kTrajectoryMark[8] = {'O', 'D', 'T', 'R', 'A', 'J', '0', '1'};
struct Head {
  char mark[8];
  std::int64_t unknowns, times;
};

template <class T>
std::string bytes(const T* data, std::size_t count) {
  return {reinterpret_cast<const char*>(data), count * sizeof(T)};
}

void read_doubles(std::ifstream& in, double* data, Eigen::Index count) {
  in.read(reinterpret_cast<char*>(data), static_cast<std::streamsize>(count) * std::streamsize{sizeof(double)});
}

}  // namespace

void Trajectory::save(const std::filesystem::path& path) const {
  Head head{{}, q.rows(), q.cols()};
  std::memcpy(head.mark, kTrajectoryMark, sizeof kTrajectoryMark);
  write_file(path, {bytes(&head, 1), bytes(times.data(), times.size()),
                    bytes(q.data(), static_cast<std::size_t>(q.size())),
                    bytes(v.data(), static_cast<std::size_t>(v.size()))});
}

bool Trajectory::is_whole(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  Head head{};
  in.read(reinterpret_cast<char*>(&head), sizeof head);
  if (!in || std::memcmp(head.mark, kTrajectoryMark, sizeof kTrajectoryMark) != 0) return false;
  const auto doubles = head.times * (1 + 2 * head.unknowns);
  std::error_code ec;
  return std::filesystem::file_size(path, ec) == sizeof head + static_cast<std::size_t>(doubles) * sizeof(double);
}

Trajectory Trajectory::load(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  Head head{};
  in.read(reinterpret_cast<char*>(&head), sizeof head);
  if (!in || std::memcmp(head.mark, kTrajectoryMark, sizeof kTrajectoryMark) != 0)
    throw RunError(path.string() + ": is no trajectory; start the comparison again");
  Trajectory out;
  out.times.resize(static_cast<std::size_t>(head.times));
  out.q.resize(head.unknowns, head.times);
  out.v.resize(head.unknowns, head.times);
  read_doubles(in, out.times.data(), head.times);
  read_doubles(in, out.q.data(), out.q.size());
  read_doubles(in, out.v.data(), out.v.size());
  if (!in) throw RunError(path.string() + ": is cut short; start the comparison again");
  return out;
}

void TrajectoryRecorder::on_start(const ObservedState& observed) {
  const State& state = observed.state();
  const auto columns = static_cast<Eigen::Index>(outputs_) + 1;
  trajectory_ = {{}, Eigen::MatrixXd::Zero(state.q.size(), columns), Eigen::MatrixXd::Zero(state.v.size(), columns)};
  on_output(observed);
}

void TrajectoryRecorder::on_output(const ObservedState& observed) {
  const State& state = observed.state();
  const auto k = static_cast<Eigen::Index>(trajectory_.times.size());
  trajectory_.times.push_back(state.t);
  trajectory_.q.col(k) = state.q;
  trajectory_.v.col(k) = state.v;
}

}  // namespace orthodyn
