#include "lib/run/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace orthodyn {

void PowerIntegral::start(const State& state) {
  t_ = state.t;
  last_ = model_.evaluate(power_, state)[0];
}

double PowerIntegral::advance(const State& to, const Integrator& integrator) {
  if (!(to.t > t_)) return sum_;
  State middle;
  integrator.interpolate(0.5 * (t_ + to.t), middle);
  const double end = model_.evaluate(power_, to)[0];
  sum_ += (to.t - t_) / 6 * (last_ + 4 * model_.evaluate(power_, middle)[0] + end);
  t_ = to.t;
  last_ = end;
  return sum_;
}

EnergyWriter::EnergyWriter(const std::filesystem::path& path, const Model& model, const Integrator& integrator,
                           bool dissipates, bool loaded)
    : model_(model), integrator_(integrator),
      file_(path, {"t [s]", "kinetic [J]", "elastic [J]", "gravitational [J]", "dissipated [J]", "loads [J]",
                   "balance [J]"}),
      dissipates_(dissipates), loaded_(loaded), dissipation_(model, "power.dissipated"),
      load_work_(model, "power.loads") {}

void EnergyWriter::on_start(const State& state) {
  if (dissipates_) dissipation_.start(state);
  if (loaded_) load_work_.start(state);
  look(state);
  first_ = last_;
  drift_ = 0;
  write(state.t);
}

void EnergyWriter::on_output(const State& state) {
  look(state);
  write(state.t);
}

void EnergyWriter::on_step(const StepInfo&, const State& state, const Integrator&) { look(state); }

void EnergyWriter::look(const State& state) {
  if (dissipates_) dissipation_.advance(state, integrator_);
  if (loaded_) load_work_.advance(state, integrator_);
  const auto energy = [&](const char* name) { return model_.evaluate(name, state)[0]; };
  last_ = {energy("energy.kinetic"), energy("energy.elastic"), energy("energy.gravitational"),
           dissipation_.value(), load_work_.value()};
  drift_ = std::max(drift_, std::abs(last_.balance() - first_.balance()));
  scale_ = std::max({scale_, last_.kinetic, last_.elastic});
}

void EnergyWriter::write(double t) {
  file_.row({t, last_.kinetic, last_.elastic, last_.gravitational, last_.dissipated, last_.loads,
             last_.balance() - first_.balance()});
}

MomentumWriter::MomentumWriter(const std::filesystem::path& path, const Model& model)
    : model_(model),
      file_(path, {"t [s]", "linear.x [kg m/s]", "linear.y [kg m/s]", "linear.z [kg m/s]",
                   "angular.x [kg m^2/s]", "angular.y [kg m^2/s]", "angular.z [kg m^2/s]"}) {}

void MomentumWriter::on_start(const State& state) {
  first_ = look(state);
  drift_ = 0;
  write(state);
}

void MomentumWriter::on_output(const State& state) {
  look(state);
  write(state);
}

Vec3 MomentumWriter::look(const State& state) {
  const auto l = model_.evaluate("momentum.angular", state);
  const Vec3 angular(l[0], l[1], l[2]);
  drift_ = std::max(drift_, (angular - first_).norm());
  return angular;
}

void MomentumWriter::write(const State& state) {
  const auto p = model_.evaluate("momentum.linear", state);
  const auto l = model_.evaluate("momentum.angular", state);
  file_.row({state.t, p[0], p[1], p[2], l[0], l[1], l[2]});
}

StepWriter::StepWriter(const std::filesystem::path& path)
    : file_(path, {"t [s]", "h [s]", "order", "newton_iterations", "rejected"}) {}

void StepWriter::on_step(const StepInfo& info, const State&, const Integrator& integrator) {
  const Statistics now = integrator.statistics();
  file_.row({info.t, info.h, static_cast<double>(info.order),
             static_cast<double>(now.newton_iterations - before_.newton_iterations),
             static_cast<double>(now.rejected_steps - before_.rejected_steps)});
  before_ = now;
}

namespace {

OutputInfo info_of(const Model& model, const std::string& field) {
  const auto all = model.outputs();
  return *std::find_if(all.begin(), all.end(), [&](const auto& info) { return info.name == field; });
}

std::vector<ProbeColumn> with_components(const Model& model, std::vector<ProbeColumn> columns) {
  for (auto& column : columns) column.components = info_of(model, column.field).components;
  return columns;
}

std::vector<std::string> probe_header(const Model& model, const std::vector<ProbeColumn>& columns) {
  constexpr const char* axis[] = {".x", ".y", ".z"};
  std::vector<std::string> header{"t [s]"};
  for (const auto& column : columns) {
    const auto info = info_of(model, column.field);
    for (int c = 0; c < info.components; ++c)
      header.push_back(fmt::format("{}.{}{} [{}]", column.name, column.field,
                                   info.components == 3 ? axis[c] : "", info.unit));
  }
  return header;
}

}  // namespace

ProbeWriter::ProbeWriter(const std::filesystem::path& path, const Model& model, std::vector<ProbeColumn> columns)
    : model_(model), columns_(with_components(model, std::move(columns))), file_(path, probe_header(model, columns_)) {}

void ProbeWriter::record(const State& state) {
  std::map<std::string, std::vector<double>> fields;
  std::vector<double> row{state.t};
  for (const auto& column : columns_) {
    auto [it, missing] = fields.try_emplace(column.field);
    if (missing) it->second = model_.evaluate(column.field, state);
    const auto first = it->second.begin() + std::ptrdiff_t{column.components} * column.node;
    row.insert(row.end(), first, first + column.components);
  }
  file_.row(row);
}

}  // namespace orthodyn
