// Dynamic analysis of a scene: integration from the start or a checkpoint to the end, and output files.
#include <fmt/format.h>

#include <algorithm>

#include "lib/config/registry.h"
#include "lib/config/values.h"
#include "lib/core/spelling.h"
#include "lib/fem/joint_start.h"
#include "lib/simulation/checkpoint/resume.h"
#include "lib/simulation/checkpoint/scene_changes.h"
#include "lib/simulation/error_estimate/estimated_error.h"
#include "lib/simulation/output/run_observers.h"
#include "lib/simulation/run/model_summary.h"
#include "lib/simulation/run/run_context.h"
#include "lib/simulation/run/run_record.h"
#include "lib/simulation/run/several_ranks.h"

namespace orthodyn {

namespace {

CheckpointTimes checkpoint_times(const Scene& scene) {
  if (!scene.checkpoint) return {.never = true};
  return {scene.checkpoint->every, scene.checkpoint->frames.value_or(0), false};
}

// A run that ended early, also by an event, can always be resumed; a completed run can be extended if the scene has
// `checkpoint`. An existing checkpoint is updated.
bool needs_last_checkpoint(const Scene& scene, const Outcome& outcome, bool resumed) {
  return scene.checkpoint || resumed || outcome.status != Outcome::Status::completed || !outcome.remark.empty();
}

void require_whole_run(const Setup& setup) {
  for (const auto& event : setup.events)
    if (event.stops)
      throw ConfigError(fmt::format(
          "--estimate-error compares two complete runs, but the event '{}' stops them: remove one of the two",
          event.name));
}

std::size_t outputs_left(const Plan& plan) {
  const auto is_left = [&](double t) { return !plan.delivered || t > *plan.delivered; };
  return static_cast<std::size_t>(std::count_if(plan.output_times.begin(), plan.output_times.end(), is_left));
}

FailurePlace failure_place(const FemModel& model, const State& last) {
  const auto speed = model.evaluate("speed.largest", last);
  const auto det_f = model.evaluate("det_f.smallest", last);
  return {det_f[0], speed[0], static_cast<long>(det_f[1]), static_cast<long>(speed[1])};
}

class DynamicAnalysis {
 public:
  explicit DynamicAnalysis(RunContext context)
      : context_(std::move(context)), setup_(context_.setup), folder_(context_.folder) {}

  RunResult run() {
    if (folder_.is_completed_without_checkpoint()) return accept_completed();
    const bool resumes = context_.earlier && context_.earlier->begun;
    Checkpoint begin = resumes ? resumed_checkpoint(std::move(*context_.earlier), setup_, context_.resolved, folder_)
                               : first_checkpoint(setup_, context_.resolved, folder_);
    begin.cost = begin.cost + TotalCost{{}, setup_.wall_seconds, setup_.cpu_seconds};
    // A run killed after its last step is not "completed": it still lacks its record.
    if (resumes && is_complete(begin, setup_.scene) && begin.restarts.back().after == "completed")
      return nothing_to_do(begin.state.t);
    if (context_.request.estimate_error) {
      require_whole_run(setup_);
      estimator_.emplace(setup_, plan_of(setup_.scene, begin.schedule));
    }
    RunObservers observers(setup_, folder_.path());
    resumes ? resume(begin, observers) : prepare_anew();
    const RunRecord record(folder_.path(), context_.scene, context_.set, begin.restarts, setup_.config);
    write_file(folder_.path() / "scene.yaml", {begin.scene});
    // From here on, a killed run can be resumed.
    if (!resumes && setup_.scene.checkpoint) begin.save(folder_.checkpoint());
    return compute(begin, observers, record);
  }

 private:
  void prepare_anew() {
    if (context_.request.resume)
      context_.listener.on_notice(
          fmt::format("nothing to resume in {}: the run starts at the beginning", folder_.path().string()));
    folder_.prepare();
  }

  void resume(const Checkpoint& begin, RunObservers& observers) {
    observers.restore(begin);
    context_.listener.on_notice(fmt::format(
        "resumes at t = {:.6g} s; the integrator restarts there (multistep methods at order 1)", begin.state.t));
    if (const auto& changed = begin.restarts.back().changed; !changed.empty())
      context_.listener.on_notice("changed since the checkpoint: " + join(changed));
  }

  RunResult compute(const Checkpoint& begin, RunObservers& observers, const RunRecord& record) {
    RunResult result{.scene = context_.scene, .folder = folder_.path()};
    result.ranks = num_ranks(context_.request.ranks);
    result.outcome = integrate(begin, observers, result.resumable);
    result.only_this_rank_failed = only_this_rank_failed_;
    if (setup_.linearity) setup_.linearity->finish();
    result.model = summarize(setup_);
    if (setup_.linearity && result.outcome.status != Outcome::Status::interrupted)
      result.kinematics_restart = setup_.linearity->kinematics_restart();
    if (result.kinematics_restart) return result;
    result.motion = motion_result(result.outcome, begin.cost, observers);
    if (observers.extremes) result.extremes = observers.extremes->found();
    if (observers.strains) result.exceeded_strain = observers.strains->worst();
    record.finish(result);
    if (segments_ && result.outcome.status == Outcome::Status::completed) {
      result.motion->segment_error = segment_error(result.outcome.last.t);
      record.finish(result);
    }
    context_.listener.on_result(result);
    if (!estimator_ || result.outcome.status != Outcome::Status::completed) return result;
    result.motion->error = repeat();
    record.finish(result);
    return result;
  }

  Outcome integrate(const Checkpoint& begin, RunObservers& observers, bool& resumable) {
    Checkpointer checkpointer(folder_.checkpoint(), begin, checkpoint_times(setup_.scene), observers.checkpointed(),
                              *setup_.built.model, *setup_.integrator);
    Plan plan = plan_of(setup_.scene, begin.schedule);
    const State state = setup_.built.model->part(begin.state);
    plan.events = observers.events();
    if (begin.begun) plan.delivered = begin.last_output, plan.history_delivered = begin.last_history;
    const auto progress = context_.listener.on_begin(setup_);
    auto all = observers.all(progress.get(), checkpointer);
    if (estimator_) all.push_back(&estimator_->recorder());
    if (setup_.scene.output.accumulated_error) all.push_back(&segments_.emplace(*setup_.built.model));
    const FemModel& model = *setup_.built.model;
    if (setup_.scene.output.mesh_error)
      all.push_back(&mesh_error_.emplace(outputs_left(plan), allows_finer_elements(model) ? &model : nullptr));
    DiskReserve reserve(folder_.path(), bytes_of_checkpoint());
    Outcome outcome = orthodyn::run(*setup_.built.model, *setup_.integrator, state, plan, all, context_.interrupt);
    reserve.release();
    if (outcome.status == Outcome::Status::failed) explain_by_joints(outcome);
    only_this_rank_failed_ =
        outcome.status == Outcome::Status::failed && only_this_rank_failed(setup_.built.model->ranks());
    if (!only_this_rank_failed_) outcome.cpu_seconds = setup_.built.model->space().sum(outcome.cpu_seconds);
    const bool is_written = write_last_checkpoint(outcome, begin.begun, checkpointer);
    resumable = is_written || setup_.scene.checkpoint;
    return outcome;
  }

  // Solvers fail at the end of the range of a mechanism; their advice does not help there.
  void explain_by_joints(Outcome& outcome) const {
    if (outcome.reason == Reason::disk || outcome.reason == Reason::out_of_memory) return;
    std::vector<std::string> joints;
    try {
      joints = joints_at_their_end(*setup_.built.model, outcome.last);
    } catch (const RecoverableError&) {
      return;
    }
    if (joints.empty()) return;
    outcome.message = fmt::format(
        "at t = {:.6g} s the mechanism cannot move on: the constraints of its joints {} depend on each other there, as "
        "at the end of the range of a linkage or where links are in line; change lengths, motors or stops ({})",
        outcome.last.t, join(joints), outcome.message.substr(0, outcome.message.find(';')));
  }

  // Upper bound of the checkpoint's size: displacements and velocities, three vectors of LinearityWatch, internal
  // variables, and small parts.
  std::size_t bytes_of_checkpoint() const {
    constexpr std::size_t kSmallParts = 64 << 10;
    constexpr std::size_t kCborNumber = 9;  // bytes
    return kCborNumber * (5 * static_cast<std::size_t>(setup_.built.model->num_dofs_of_all()) +
                          static_cast<std::size_t>(setup_.built.initial.z.size())) +
           kSmallParts + 2 * context_.resolved.size();
  }

  // False if the checkpoint cannot be written, which must not hide the failure of a run.
  bool write_last_checkpoint(const Outcome& outcome, bool resumed, Checkpointer& checkpointer) {
    try {
      if (only_this_rank_failed_ || !outcome.between_steps)
        return outcome.reason == Reason::disk && checkpointer.write_remembered();
      if (!needs_last_checkpoint(setup_.scene, outcome, resumed)) return false;
      checkpointer.write(outcome.last);
      return true;
    } catch (const RunError& e) {
      context_.listener.on_warning(fmt::format("the last state could not be saved as a checkpoint: {}", e.what()));
      return false;
    }
  }

  MotionResult motion_result(const Outcome& outcome, const TotalCost& before, const RunObservers& observers) const {
    const Integrator& integrator = *setup_.integrator;
    const InversionWatch& inversion = observers.inversion;
    Statistics statistics = integrator.statistics();
    statistics.observation = outcome.observation;
    MotionResult out{.integrator = setup_.config.at("integrator").at("type").text(),
                     .decisions = integrator.decisions(),
                     .warnings = integrator.result_warnings(),
                     .cost = before + TotalCost{statistics, outcome.wall_seconds, outcome.cpu_seconds},
                     .factor_bytes = integrator.factor_bytes(),
                     .det_f = {inversion.smallest(), inversion.element(), inversion.time()}};
    if (const auto& e = observers.energy)
      out.energy = {e->last(), e->time(), e->drift(), e->scale(), e->relative_drift(), e->times(), e->states()};
    if (const auto& m = observers.momentum) out.momentum = {m->angular_drift(), m->angular_scale()};
    if (const auto& j = observers.joints) {
      out.joints = j->largest();
      out.joints_extent = bounding_box(setup_.built.model->parts().mesh).size().maxCoeff();
    }
    if (const auto& c = observers.contacts) out.contacts = c->record();
    out.events_not_found = observers.events_not_found();
    if (mesh_error_) out.mesh_error = mesh_error_->found();
    if (out.mesh_error && outcome.status == Outcome::Status::completed)
      out.mesh_error =
          estimate_mesh_error(setup_.scene, *setup_.built.model, *mesh_error_->most_deformed(), true, *out.mesh_error)
              .error;
    out.rtol = Registry<IntegratorChoice>::read(setup_.config.at("integrator"))->settings().rtol;
    if (outcome.status == Outcome::Status::failed && !only_this_rank_failed_)
      out.failure = failure_place(*setup_.built.model, outcome.last);
    return out;
  }

  // Empty if the estimate fails, which must not fail a completed run.
  std::optional<SegmentErrorEstimate> segment_error(double end) {
    try {
      return segment_error_estimate(setup_, *setup_.integrator, *segments_, end, context_.interrupt);
    } catch (const std::exception& e) {
      context_.listener.on_warning(
          fmt::format("the accumulated integration error could not be estimated: {}", e.what()));
      return std::nullopt;
    }
  }

  // Repeats the run for the error estimate.
  ErrorEstimate repeat() {
    context_.listener.on_notice(
        fmt::format("repeats the run with {} to estimate the error", join(estimator_->refinement())));
    const auto progress = context_.listener.on_begin(setup_);
    return estimator_->estimate(progress ? std::vector{progress.get()} : std::vector<Observer*>{}, context_.interrupt);
  }

  RunResult nothing_to_do(double end) const {
    RunResult result{.scene = context_.scene, .folder = folder_.path(), .was_complete = true};
    result.outcome.last.t = end;
    return result;
  }

  // Result for a completed run without a checkpoint. There is nothing to do, unless the scene has changed.
  RunResult accept_completed() const {
    const auto earlier = with_defaults(Config::from_file((folder_.path() / "scene.yaml").string()));
    const auto changed = changed_keys(earlier, Config::from_text(context_.resolved));
    const bool longer = std::find(changed.begin(), changed.end(), "time.end") != changed.end();
    if (!longer && refused_changes(changed).empty())
      return nothing_to_do(read_number(earlier.at("time").at("end"), {.unit = "s"}));
    throw ConfigError(folder_.path().string(),
                      fmt::format("holds a completed run without a checkpoint, which cannot resume with other values "
                                  "({}); start anew with --force instead of --resume",
                                  join(changed)));
  }

  RunContext context_;
  const Setup& setup_;
  ResultFolder& folder_;
  std::optional<ErrorEstimator> estimator_;
  std::optional<SegmentRecorder> segments_;
  std::optional<MeshErrorRecorder> mesh_error_;
  bool only_this_rank_failed_ = false;  // the other ranks are waiting for this one
};

}  // namespace

RunResult run_dynamic_analysis(RunContext context) { return DynamicAnalysis(std::move(context)).run(); }

}  // namespace orthodyn
