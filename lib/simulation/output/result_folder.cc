#include "lib/simulation/output/result_folder.h"

#include <fmt/format.h>

#include <fstream>

#include "lib/core/errors.h"
#include "lib/core/write_file.h"
#include "lib/simulation/output/json.h"
#include "lib/simulation/output/setup_file.h"
#include "lib/simulation/run/outcome.h"
#include "lib/simulation/run/run_record.h"
#include "lib/simulation/sensitivity/event_sensitivity.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

constexpr const char* kResultFiles[] = {
    "frames",          "frames.pvd",   "probes.csv",     "energy.csv",        "momentum.csv",
    "steps.csv",       "events.csv",   "load_steps.csv", "pictures",          "scene.yaml",
    "checkpoint.cbor", "response.csv", "modes.csv",      "modes.pvd",         "modes",
    "modes.png",       "taps",         "buckling.csv",   "sensitivities.csv", kEventSensitivities,
    kSetupFile,        kRunRecordFile};

constexpr const char* kCheckpoint = "checkpoint.cbor";
constexpr const char* kLock = ".orthodyn-run";  // not run.json, which is replaced by renaming

// True if only leftovers of refused or killed runs are there: a lock file, or a partial run.json.
bool is_unused(const fs::path& folder) {
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(folder, ec)) {
    const std::string name = entry.path().filename().string();
    const bool is_part = name.starts_with(std::string(kRunRecordFile) + ".") && name.ends_with(".part");
    if (name != kLock && !is_part) return false;
  }
  return true;
}

// True if an earlier run was killed before it computed anything.
bool has_just_begun(const fs::path& folder) {
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(folder, ec)) {
    const auto name = entry.path().filename();
    if (name != kRunRecordFile && name != kLock && name != "scene.yaml" && name.extension() != ".part") return false;
  }
  return true;
}

}  // namespace

ResultFolder::ResultFolder(fs::path path, EarlierResult earlier, std::function<void(const std::string&)> warn)
    : path_(std::move(path)), earlier_(earlier), warn_(std::move(warn)) {
  std::error_code ec;
  if (!fs::exists(path_, ec)) return;
  if (!fs::is_directory(path_, ec))
    throw ConfigError(path_.string(), "is a file, expected a folder for the results; use --out");
  if (!is_unused(path_) && !fs::exists(path_ / kRunRecordFile, ec))
    throw ConfigError(path_.string(), "holds files that are no result of a run; use --out with another folder");
  lock();
  if (is_unused(path_)) return;
  if (earlier_ == EarlierResult::resume) {
    remove_partial_files(path_);
    find_checkpoint();
  }
  if (earlier_ == EarlierResult::keep) refuse_earlier_result();
}

void ResultFolder::lock() {
  if (!writes_files()) return;
  lock_.emplace(path_, kLock, "run");
  if (!lock_->warning().empty()) warn_(lock_->warning());
}

void ResultFolder::refuse_earlier_result() const {
  throw ConfigError(path_.string(),
                    "holds an earlier result; use --force to replace it, --resume to continue from its checkpoint, or "
                    "--out with another folder");
}

void ResultFolder::find_checkpoint() {
  std::error_code ec;
  resumes_ = fs::exists(checkpoint(), ec);
  if (resumes_ || has_just_begun(path_)) return;
  completed_ = earlier_status() == "completed";
  if (!completed_)
    throw ConfigError(path_.string(),
                      "holds a result without a checkpoint: nothing can be resumed; start anew with --force instead of "
                      "--resume, and with 'checkpoint: {every: 60}' in the scene");
}

fs::path ResultFolder::checkpoint() const { return path_ / kCheckpoint; }

std::string ResultFolder::earlier_status() const {
  std::ifstream in(path_ / kRunRecordFile);
  const auto json = Json::parse(in, nullptr, false);
  const std::string status = json.is_object() && json.contains("status") && json["status"].is_string()
                                 ? json["status"].get<std::string>()
                                 : "";
  for (const auto known : {Outcome::Status::completed, Outcome::Status::interrupted, Outcome::Status::failed})
    if (status == status_word(known)) return status;
  return "killed";
}

void ResultFolder::prepare() {
  if (!writes_files()) return;
  std::error_code ec;
  if (!lock_) {
    lock();
    if (earlier_ != EarlierResult::replace && !is_unused(path_)) refuse_earlier_result();  // another run came first
  }
  remove_partial_files(path_);
  for (const char* name : kResultFiles)
    if (!ec) fs::remove_all(path_ / name, ec);
  if (ec) throw RunError(fmt::format("cannot prepare the folder {}: {}", path_.string(), ec.message()));
}

}  // namespace orthodyn
