#include "lib/simulation/checkpoint/checkpoint.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "lib/core/errors.h"
#include "lib/core/fingerprint.h"
#include "lib/core/versions.h"
#include "lib/core/write_file.h"

namespace orthodyn {

namespace {

using SortedJson = nlohmann::json;
namespace fs = std::filesystem;

constexpr int kVersion = 8;
constexpr const char* kCheckpointMark = "orthodyn checkpoint ";
constexpr std::size_t kHeadSize = 2 + 20 + 3 + 1 + 16;  // bytes: CBOR header, mark, version, space, fingerprint

std::string cbor(const SortedJson& json) {
  std::string bytes;
  SortedJson::to_cbor(json, bytes);
  return bytes;
}

std::string head(const std::string& content) {
  return cbor(fmt::format("{}{:03} {}", kCheckpointMark, kVersion, Fingerprint().add(content).text()));
}

std::vector<double> numbers(const Vector& x) { return {x.begin(), x.end()}; }

Vector vector(const SortedJson& json) {
  const auto values = json.get<std::vector<double>>();
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Archive archive(const SortedJson& json) {
  Archive out;
  for (const auto& [name, values] : json.items()) out.put(name, values.get<std::vector<double>>());
  return out;
}

SortedJson restarts_json(const std::vector<Restart>& restarts) {
  SortedJson out = SortedJson::array();
  for (const auto& r : restarts)
    out.push_back({{"time", r.time}, {"at", r.at}, {"after", r.after}, {"changed", r.changed}});
  return out;
}

std::vector<Restart> restarts_from(const SortedJson& json) {
  std::vector<Restart> out;
  for (const auto& r : json) out.push_back({r.at("time"), r.at("at"), r.at("after"), r.at("changed")});
  return out;
}

SortedJson to_json(const Checkpoint& c) {
  SortedJson observers = SortedJson::object();
  for (const auto& [name, saved] : c.observers) observers[name] = saved.entries();
  return {{"program", orthodyn_version()},
          {"scene", c.scene},
          {"mesh", c.mesh},
          {"files", c.files},
          {"begun", c.begun},
          {"t", c.state.t},
          {"q", numbers(c.state.q)},
          {"v", numbers(c.state.v)},
          {"z", numbers(c.state.z)},
          {"lambda", numbers(c.state.lambda)},
          {"angles", numbers(c.state.angles)},
          {"last_output", c.last_output},
          {"last_history", c.last_history},
          {"rhythm", {c.schedule.start, c.schedule.end, c.schedule.interval}},
          {"effort", c.cost.archive().entries()},
          {"restarts", restarts_json(c.restarts)},
          {"observers", observers}};
}

Checkpoint from_json(const SortedJson& json) {
  Checkpoint c;
  c.scene = json.at("scene");
  c.mesh = json.at("mesh");
  c.files = json.at("files").get<std::map<std::string, std::string>>();
  c.begun = json.at("begun");
  c.state = {json.at("t"),         vector(json.at("q")),      vector(json.at("v")),     1,
             vector(json.at("z")), vector(json.at("lambda")), vector(json.at("angles"))};
  c.last_output = json.at("last_output");
  c.last_history = json.at("last_history");
  const auto& rhythm = json.at("rhythm");
  c.schedule = {rhythm.at(0), rhythm.at(1), rhythm.at(2)};
  c.cost = TotalCost::from(archive(json.at("effort")));
  c.restarts = restarts_from(json.at("restarts"));
  for (const auto& [name, saved] : json.at("observers").items()) c.observers[name] = archive(saved);
  return c;
}

[[noreturn]] void refuse(const fs::path& path, const std::string& message) {
  throw ConfigError(
      path.string(),
      fmt::format("{}; the run cannot resume from it: start anew with --force instead of --resume", message));
}

std::string content_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) refuse(path, "cannot be read");
  return text.str();
}

// The version in the head of a file; -1 if the file is not a checkpoint.
int version_of(const std::string& file) {
  int version = -1;
  const std::string expected = head("");
  const auto digits = 2 + std::string(kCheckpointMark).size();
  if (file.compare(0, digits, expected, 0, digits) != 0) return -1;
  const auto [end, error] = std::from_chars(file.data() + digits, file.data() + digits + 3, version);
  return error == std::errc{} && end == file.data() + digits + 3 ? version : -1;
}

}  // namespace

void Checkpoint::save(const fs::path& path) const {
  const std::string content = cbor(to_json(*this));
  write_durable_file(path, {head(content), content});
}

Checkpoint Checkpoint::load(const fs::path& path) {
  const std::string file = content_of(path);
  if (file.size() < kHeadSize) refuse(path, "is truncated");
  const int version = version_of(file);
  if (version < 0) refuse(path, "is not a checkpoint of orthodyn");
  if (version != kVersion)
    refuse(path,
           fmt::format("has format version {}; orthodyn {} reads version {}", version, orthodyn_version(), kVersion));
  const std::string content = file.substr(kHeadSize);
  if (file.compare(0, kHeadSize, head(content)) != 0) refuse(path, "is damaged or truncated");
  try {
    return from_json(SortedJson::from_cbor(content));
  } catch (const SortedJson::exception& e) {
    refuse(path, std::string("is incomplete: ") + e.what());
  } catch (const ConfigError& e) {
    refuse(path, e.what());
  }
}

}  // namespace orthodyn
