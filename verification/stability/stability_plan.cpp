#include "verification/stability/stability_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "verification/config/config_error.hpp"
#include "verification/not_a_number.hpp"
#include "verification/scene/matrix.hpp"

namespace verification {
namespace {

// Rays are followed up to here: beyond every explicit limit (r <= 4, CFL <= 3) by a factor ten. What is
// stable there is said to have no limit up to it.
constexpr double largest_multiple = 40;
// How far a stream carries the particles from the worst offset while growth is looked for [cells]: little, as
// neighbouring offsets are more stable, by up to 4 times this fraction for the linear basis, whose limit has
// a kink there.
constexpr double local_travel = 0.003;
// The fraction of the predicted limit at which a whole crossing must be stable, and the steps that it takes.
constexpr double crossing_fraction = 0.97;
constexpr int crossing_steps = 1000;

Motion motion_of(Passage passage) {
  if (passage == Passage::Seats) return Motion::Rest;
  return passage == Passage::StreamingX ? Motion::AlongX : Motion::Any;
}

bool streams(Passage passage) {
  return passage == Passage::Streaming || passage == Passage::StreamingX;
}

/// How far a stream carries the particles: `distance` along each axis that it has.
std::array<double, 2> travel(const StabilityCase& one, const std::array<double, 2>& distance) {
  return {one.waves == Waves::Plane ? distance[0] : 0, one.passage == Passage::Streaming ? distance[1] : 0};
}

StabilityProblem problem_of(const StabilityPlan& plan, const StabilityCase& one, double share) {
  StabilityProblem problem{one.scheme, plan.lattice, one.waves, {1 - share, share}};
  // Waves along y do not vary along x: one column of particles holds them.
  if (one.waves != Waves::Plane) problem.lattice.per_cell[0] = 1;
  return problem;
}

MeasuringPlan measuring_plan(const StabilityProblem& problem, const StabilityCase& one,
                             const PredictedLimit& predicted) {
  MeasuringPlan plan;
  plan.problem = problem;
  plan.cells = box_for(predicted.theta, one.waves);
  plan.offset = predicted.offset;
  plan.steps = steps_to_tell(problem, predicted);
  if (streams(one.passage)) plan.travel = travel(one, {local_travel, local_travel});
  return plan;
}

std::string crossing(MeasuringPlan plan, const StabilityCase& one, const PredictedLimit& predicted) {
  plan.travel = travel(one, plan.problem.lattice.period());
  plan.steps = crossing_steps;
  const double multiple = crossing_fraction * predicted.multiple.value_or(largest_multiple);
  return perturbation_grows(plan, multiple) ? "unstable" : "stable";
}

reports::StabilityRecord record_of(const std::string& study, const StabilityProblem& problem,
                                   const StabilityCase& one, const PredictedLimit& predicted) {
  const StepSize limit = predicted.multiple ? problem.at(*predicted.multiple) : StepSize{nan, nan};
  const StepSize tested = problem.at(largest_multiple);
  reports::StabilityRecord record;
  record.study = study;
  record.basis = mpm::name(one.scheme.basis);
  record.transfer = mpm::name(one.scheme.transfer);
  record.stepping = mpm::name(one.scheme.stepping);
  record.waves = name(one.waves);
  record.motion = name(one.passage);
  record.lattice = fmt::format("{} x {} {}", problem.lattice.per_cell[0], problem.lattice.per_cell[1],
                               problem.lattice.gauss ? "gauss" : "even");
  record.r_predicted = limit.r;
  record.cfl_predicted = limit.cfl;
  record.r_measured = record.cfl_measured = nan;
  record.r_tested = tested.r;
  record.cfl_tested = tested.cfl;
  record.theta_x = predicted.theta[0];
  record.theta_y = predicted.theta[1];
  record.offset_x = predicted.offset[0];
  record.offset_y = predicted.offset[1];
  return record;
}

template <class Named>
auto read_named(TomlTable& table, const std::string& key, Named&& named) {
  std::vector<decltype(named(std::string()))> values;
  for (const std::string& text : table.texts(key)) {
    try {
      values.push_back(named(text));
    } catch (const ConfigError& error) {
      table.fail(key, error.what());
    }
  }
  if (values.empty()) table.fail(key, "must not be empty");
  return values;
}

Passage passage_named(const std::string& text) {
  for (const Passage passage : {Passage::Seats, Passage::Offset, Passage::Streaming, Passage::StreamingX})
    if (name(passage) == text) return passage;
  throw ConfigError("'" + text + "' is not known; choose of: rest, offset, streaming, streaming-x");
}

ParticleLattice read_lattice(TomlTable& table) {
  ParticleLattice lattice;
  const int per_cell = table.integer("particles_per_cell", 2);
  if (per_cell < 1 || per_cell > 8)
    table.fail("particles_per_cell", "must lie in [1, 8] (along either axis)");
  lattice.per_cell = {per_cell, per_cell};
  const std::string seeding = table.text("seeding", "even");
  if (seeding != "even" && seeding != "gauss") table.fail("seeding", "must be \"even\" or \"gauss\"");
  lattice.gauss = seeding == "gauss";
  return lattice;
}

mpm::Scheme scheme_of(const MatrixEntry& entry) {
  mpm::Scheme scheme;
  scheme.basis = mpm::basis_named(entry.basis);
  scheme.transfer = mpm::transfer_named(entry.transfer);
  scheme.stepping = mpm::stepping_named(entry.stepping);
  scheme.flip_fraction = entry.flip_fraction;
  return scheme;
}

}  // namespace

std::string name(Passage passage) {
  switch (passage) {
    case Passage::Seats:
      return "rest";
    case Passage::Offset:
      return "offset";
    case Passage::Streaming:
      return "streaming";
    default:
      return "streaming-x";
  }
}

std::string StabilityCase::name() const {
  return variant + "." + verification::name(waves) + "." + verification::name(passage);
}

double StabilityPlan::cost(const StabilityCase& one) const {
  const int width = 2 + static_cast<int>(one.scheme.basis);
  const bool plane = one.waves == Waves::Plane;
  const bool full_mass = one.scheme.transfer == mpm::Scheme::Transfer::FullMass;
  const int particles = (plane ? 64 * lattice.per_cell[0] : 16) * lattice.per_cell[1];
  const double nodes = plane ? width * width / 4.0 : 1;
  return 4000.0 * static_cast<double>(acoustic_shares.size()) * particles * nodes * (full_mass ? 4 : 1);
}

StabilityPlan read_stability(TomlTable table, const std::vector<MatrixEntry>& matrix) {
  StabilityPlan plan;
  for (const MatrixEntry& entry : matrix)
    if (entry.is_sph())
      table.fail("waves",
                 "stability maps are for a [matrix] of material point schemes; the limit of \"sph\" is "
                 "tested by a study with steps on both sides of it");
  plan.lattice = read_lattice(table);
  plan.acoustic_shares = table.numbers("acoustic_shares");
  if (plan.acoustic_shares.empty()) table.fail("acoustic_shares", "must not be empty");
  for (const double share : plan.acoustic_shares)
    if (share < 0 || share > 1) table.fail("acoustic_shares", "must lie in [0, 1]");
  plan.boundary_points = table.integer("boundary_points", 0);
  if (plan.boundary_points < 0 || plan.boundary_points > 200)
    table.fail("boundary_points", "must lie in [0, 200]");
  const std::vector<Waves> waves = read_named(table, "waves", waves_named);
  const std::vector<Passage> passages = read_named(table, "motions", passage_named);
  table.refuse_unknown_keys();
  const bool has_shear = std::ranges::count(waves, Waves::Shear) > 0;
  if (has_shear && plan.acoustic_shares != std::vector<double>{0})
    table.fail("acoustic_shares", "must be [0] for shear waves, which know no sound");
  if (has_shear && std::ranges::count(passages, Passage::Streaming) > 0)
    table.fail("motions",
               "\"streaming\" is no motion for shear waves: round-off of the stream lets longitudinal waves "
               "grow first, their viscosity being 4/3; take \"offset\"");

  if (std::ranges::count(passages, Passage::StreamingX) > 0 && waves != std::vector<Waves>{Waves::Plane})
    table.fail("motions", "\"streaming-x\" is for plane waves: the others do not vary along x");

  for (const MatrixEntry& entry : matrix)
    for (const Waves wave : waves)
      for (const Passage passage : passages)
        plan.cases.push_back({entry.variant, scheme_of(entry), wave, passage});
  return plan;
}

std::vector<reports::StabilityRecord> measure_case(const std::string& study, const StabilityPlan& plan,
                                                   const StabilityCase& one) {
  std::vector<reports::StabilityRecord> records;
  for (const double share : plan.acoustic_shares) {
    const StabilityProblem problem = problem_of(plan, one, share);
    const PredictedLimit predicted = predict_limit(problem, motion_of(one.passage), largest_multiple);
    const MeasuringPlan measuring = measuring_plan(problem, one, predicted);
    reports::StabilityRecord record = record_of(study, problem, one, predicted);
    record.kind = "measured";
    record.steps = measuring.steps;
    if (const auto measured = measure_limit(measuring, largest_multiple, predicted.multiple)) {
      const StepSize limit = problem.at(*measured);
      record.r_measured = limit.r;
      record.cfl_measured = limit.cfl;
    }
    if (streams(one.passage)) record.crossing = crossing(measuring, one, predicted);
    records.push_back(record);
  }
  for (int i = 0; i < plan.boundary_points; ++i) {
    const StabilityProblem problem = problem_of(plan, one, i / std::max(1.0, plan.boundary_points - 1.0));
    const PredictedLimit predicted = predict_limit(problem, motion_of(one.passage), largest_multiple);
    reports::StabilityRecord record = record_of(study, problem, one, predicted);
    record.kind = "boundary";
    records.push_back(record);
  }
  return records;
}

}  // namespace verification
