#include "verification/runs/pilot/pilot.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "verification/convergence/step_by_error.hpp"
#include "verification/not_a_number.hpp"
#include "verification/runs/pilot/fits.hpp"
#include "verification/runs/pilot/pilot_runs.hpp"

namespace verification {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Solvers agree to 1e-12 of the scale over thousands of steps (studies *-discrete); differences below ten
// times that are no error in time.
constexpr double round_off = 1e-11;
// Where no limit bounds the step: of the interval between outputs.
constexpr long first_parts = 8;
// Halvings of the longest pilot; then the law is trusted. The last costs as much as all before together.
constexpr int most_halvings = 6;
// Noise does not fall with the step: that of a remap grows with the number of them.
constexpr int most_without_order = 3;
constexpr int most_on_second_level = 6;
constexpr double hides_space = 2;  // an error in time of more than twice its share does
// A run that is to be longer wants another scheme, and a pilot that is costs more than it saves.
constexpr double most_steps = 1e6, most_steps_of_pilot = 1e5;

class Pilot {
 public:
  Pilot(const Study& study, const std::vector<const PlannedRun*>& levels, const PilotRunner& run)
      : study_(study),
        levels_(levels),
        runs_(study, levels, run),
        fraction_(coarsest().scene.auto_step->fraction),
        interval_(runs_.dt_of(1)),
        orders_(orders_of_method(coarsest().scene)),
        theory_(study.comparison == Comparison::Finest ? coarsest().theoretical
                                                       : std::min(coarsest().theoretical, orders_.space)) {}

  PilotOutcome outcome() {
    search();
    if (failure_.empty()) measure_space();
    PilotOutcome outcome;
    for (const PlannedRun* level : levels_) outcome.steps.push_back(record_of(*level));
    outcome.runs = runs_.records();
    outcome.timings = runs_.timings();
    return outcome;
  }

 private:
  [[nodiscard]] const PlannedRun& coarsest() const { return *levels_.front(); }
  [[nodiscard]] double dt_of(long parts) const { return runs_.dt_of(parts); }
  [[nodiscard]] static double stable(const PlannedRun& level) { return level.scene.auto_step->stable; }

  const RunData& trial(std::size_t level, long parts) { return runs_.at(level, parts); }
  [[nodiscard]] bool stands(std::size_t level, long parts) { return trial(level, parts).completed(); }

  /// Steps an interval of the first, longest pilot.
  [[nodiscard]] long first() const {
    const double limit = stable(coarsest());
    double wanted = std::min(limit, dt_of(first_parts));
    if (std::isfinite(limit))
      return static_cast<long>(std::ceil(interval_ / std::min(limit, interval_) - 1e-9));
    if (coarsest().scene.incompressible) wanted = std::min(wanted, coarsest().scene.time_step.dt);
    // A power of two can be doubled again and again.
    return std::lround(std::exp2(std::ceil(std::log2(interval_ / wanted) - 1e-9)));
  }

  /// The error in space on the coarsest level, free of the error in time.
  double space_error(const TimeError& time, long parts) {
    const bool has_law = time.kind == TimeError::Kind::Law;
    const RunData limit = has_law ? at_zero_step(trial(0, 2 * parts), trial(0, 4 * parts), time.law.order)
                                  : trial(0, 4 * parts);
    if (study_.comparison != Comparison::Finest) return largest_error(limit);
    const PlannedRun& second = *levels_[1];
    long finer = 4 * parts;
    while (dt_of(finer) > stable(second) * (1 + 1e-9)) finer *= 2;
    const RunData& other = trial(1, finer);
    const double between = difference_to_finer(limit, other);
    const double left = has_law ? time.law.at(dt_of(finer)) : 0;
    const double ratio = second.scene.cell_size() / coarsest().scene.cell_size();
    return (between - left) / (1 - std::pow(ratio, theory_));
  }

  /// On the coarsest level: the law of the error in time, and the error in space.
  void search() {
    long parts = first();
    bool longer = false;
    for (int halvings = 0; failure_.empty();) {
      const std::optional<double> wanted = measured(parts);
      if (longer && !wanted) {
        tried_ = dt_of(2 * parts);
        return;
      }
      const bool is_long_enough = wanted && *wanted >= dt_of(4 * parts);
      if (!is_long_enough && !longer) {
        if (++halvings > (time_ ? most_halvings : most_without_order)) break;
        parts *= 2;
        continue;
      }
      const bool may_be_longer = *wanted > dt_of(parts) && halvings == 0 && parts % 2 == 0 &&
                                 dt_of(parts / 2) <= stable(coarsest()) * (1 + 1e-9);
      if (!may_be_longer) return;
      if (!stands(0, parts / 2)) {
        tried_ = dt_of(parts);
        return;
      }
      parts /= 2;
      longer = true;
    }
    if (!time_ && failure_.empty()) give_up();
  }

  /// What a step, its half and its quarter say: the longest step that would do (infinite: this one does, and
  /// no law says how much longer). None where they say nothing.
  std::optional<double> measured(long parts) {
    if (!stands(0, parts) || !stands(0, 2 * parts) || !stands(0, 4 * parts)) {
      tried_ = dt_of(2 * parts);  // a finer one may not stand either: then it falls again
      return std::nullopt;
    }
    const double first = difference(trial(0, parts), trial(0, 2 * parts)),
                 second = difference(trial(0, 2 * parts), trial(0, 4 * parts));
    TimeError time = time_error_of(dt_of(parts), first, second, orders_.time, round_off);
    double space = space_error(time, parts);
    if (time.kind == TimeError::Kind::NoOrder) {
      // Whatever its law: what no halving shows to be more than its share is not.
      space -= first + second;
      if (!(first + second <= fraction_ * space)) return std::nullopt;
      time.law = {fraction_ * space / std::pow(dt_of(parts), orders_.time), orders_.time};
    }
    if (time.kind != TimeError::Kind::RoundOff) {
      // Against the next level, a large error in time hides that in space: shorter steps show it.
      if (!std::isfinite(space) || space < -round_off) return std::nullopt;
      if (!is_there(space)) return std::nullopt;
    }
    time_ = time;
    space_ = space;
    pilots_ = {dt_of(parts), dt_of(2 * parts), dt_of(4 * parts)};
    return time.kind == TimeError::Kind::Law ? time.law.inverse(fraction_ * space) : infinity;
  }

  /// The error in space must be there for anything to be a fraction of it.
  bool is_there(double space) {
    if (space > round_off) return true;
    failure_ = fmt::format(
        "the error in space on {} cells is {:.3g}, no more than round-off: no step makes the "
        "error in time a fraction of that; give dt in s",
        coarsest().scene.discretisation.cells, space);
    return false;
  }

  void give_up() {
    const std::vector<long> standing = runs_.completed(0);
    failure_ = fmt::format(
        "{}: give dt in s",
        standing.empty()
            ? std::string("every pilot run diverged")
            : fmt::format("on {} cells, steps from {:.3g} to {:.3g} s differ by more than {:g} of "
                          "the error in space and show no order",
                          coarsest().scene.discretisation.cells, dt_of(standing.front()),
                          dt_of(standing.back()), fraction_));
  }

  /// The law of the error in space, from a run on the second level.
  void measure_space() {
    if (levels_.size() == 1) return;
    const double h0 = coarsest().scene.cell_size(), h1 = levels_[1]->scene.cell_size();
    const PowerLaw by_theory{*space_ / std::pow(h0, theory_), theory_};
    if (study_.comparison == Comparison::Finest) {
      space_law_ = by_theory;
      return;
    }
    const double guess = *space_ * std::pow(h1 / h0, orders_.space);
    const double dt = chosen(guess, *levels_[1]).dt;
    long parts = dt > 0 ? std::lround(interval_ / dt) : 1;
    for (int i = 0; i < most_on_second_level; ++i, parts *= 2) {
      if (steps_at(dt_of(parts)) > most_steps_of_pilot) break;
      const auto [rest, time] = space_error_on_second(parts);
      if (!std::isfinite(rest) || (time > 0 && !(time <= hides_space * fraction_ * rest))) continue;
      second_ = rest;
      space_law_ = space_error_of(h0, *space_, h1, rest, theory_);
      return;
    }
    if (theory_ > 0)
      space_law_ = by_theory;
    else
      failure_ = fmt::format(
          "no run on {} cells shows the error in space there, and [ladder] has no "
          "theoretical order: give one, or dt in s",
          levels_[1]->scene.discretisation.cells);
  }

  /// On the second level: the error in space, and that in time of the step. By extrapolation from twice the
  /// step where that may be run, else less the error in time as the law has it; NaN where a run did not
  /// stand.
  std::pair<double, double> space_error_on_second(long& parts) {
    const bool has_law = time_->kind == TimeError::Kind::Law;
    const bool twice = has_law && dt_of(parts / 2 + parts % 2) <= stable(*levels_[1]) && parts > 1;
    if (twice) parts += parts % 2;
    if (!stands(1, parts) || (twice && !stands(1, parts / 2))) return {nan, nan};
    const double time = time_->kind == TimeError::Kind::RoundOff ? 0 : time_->law.at(dt_of(parts));
    if (twice)
      return {largest_error(at_zero_step(trial(1, parts / 2), trial(1, parts), time_->law.order)), time};
    return {largest_error(trial(1, parts)) - time, time};
  }

  [[nodiscard]] double steps_at(double dt) const {
    return (coarsest().scene.outputs.back() - coarsest().scene.start) / dt;
  }

  [[nodiscard]] double tried_on(const PlannedRun& level) const {
    return tried_ * level.scene.cell_size() / coarsest().scene.cell_size();
  }

  [[nodiscard]] ChosenStep chosen(double space, const PlannedRun& level) const {
    if (time_->kind == TimeError::Kind::RoundOff)
      return step_by_bounds(stable(level), tried_on(level), interval_);
    return step_by_error(time_->law, fraction_ * space, stable(level), tried_on(level), interval_);
  }

  reports::TimeStepRecord record_of(const PlannedRun& level) {
    reports::TimeStepRecord record;
    record.run = level.run;
    record.study = study_.name;
    record.variant = level.variant;
    record.h = level.scene.cell_size();
    record.fraction = fraction_;
    record.stable = stable(level);
    record.time_coefficient = record.time_order = record.observed_time_order = nan;
    record.space_coefficient = record.space_order = record.time_error = record.space_error = nan;
    if (failure_.empty()) {
      record.space_error = &level == levels_.front() ? *space_ : space_law_->at(record.h);
      const ChosenStep step = chosen(record.space_error, level);
      if (!(steps_at(step.dt) <= most_steps)) {
        failure_ = fmt::format(
            "an error in time of {:g} of that in space, {:.3g} on {} cells, would take {:.2g} "
            "steps, and {:g} are the most: take a stepping of higher order, or give dt in s",
            fraction_, record.space_error, level.scene.discretisation.cells, steps_at(step.dt), most_steps);
      } else {
        record.dt = step.dt;
        record.bound = name(step.bound);
      }
    }
    if (!failure_.empty()) {
      record.dt = level.scene.segments.front().dt;
      record.bound = reports::no_step;
      record.remark = "no step was chosen: " + failure_;
      return record;
    }
    if (space_law_) {
      record.space_coefficient = space_law_->coefficient;
      record.space_order = space_law_->order;
    }
    if (time_->kind != TimeError::Kind::RoundOff) {
      record.time_coefficient = time_->law.coefficient;
      record.time_order = time_->law.order;
      record.time_error = time_->law.at(record.dt);
    } else {
      record.time_error = 0;
    }
    record.observed_time_order = time_->observed_order;
    record.remark = remark();
    return record;
  }

  [[nodiscard]] std::string remark() const {
    const int cells = coarsest().scene.discretisation.cells;
    std::string text;
    if (time_->kind == TimeError::Kind::RoundOff)
      text =
          fmt::format("the error in time is round-off on {} cells: the limits alone bound the step", cells);
    else if (time_->kind == TimeError::Kind::NoOrder)
      text = fmt::format(
          "no order in time on {} cells from dt = {:.3g} to {:.3g} s, where results differ by the fraction "
          "at "
          "most; shorter as the error in space falls",
          cells, pilots_.front(), pilots_.back());
    else
      text = fmt::format("error in time {:.3g} dt^{:.3g} (order {:.3g} seen, dt = {:.3g} s on {} cells)",
                         time_->law.coefficient, time_->law.order, time_->observed_order,
                         fmt::join(pilots_, ", "), cells);
    if (space_law_)
      text +=
          fmt::format("; in space {:.3g} h^{:.3g}{}", space_law_->coefficient, space_law_->order,
                      second_ ? fmt::format(" ({:.3g} and {:.3g} on {} and {} cells)", *space_, *second_,
                                            cells, levels_[1]->scene.discretisation.cells)
                              : fmt::format(" ({:.3g} on {} cells, the order is theory's)", *space_, cells));
    else
      text += fmt::format("; in space {:.3g}", *space_);
    const auto diverged =
        std::ranges::count_if(runs_.records(), [](const auto& run) { return run.status != "completed"; });
    if (diverged > 0)
      text += fmt::format("; {} of {} pilot runs did not complete", diverged, runs_.records().size());
    return text;
  }

  const Study& study_;
  const std::vector<const PlannedRun*>& levels_;
  PilotRuns runs_;
  double fraction_, interval_;  // [s]: the interval that every step divides
  mpm::FormalOrder orders_;
  double theory_;  // order in space: the ladder's, which stands for every variant, but at most the scheme's
  std::optional<TimeError> time_;
  std::optional<double> space_, second_;
  std::optional<PowerLaw> space_law_;
  std::vector<double> pilots_;  // steps that the law rests on
  double tried_ = infinity;     // on the coarsest level: no longer one
  std::string failure_;
};

}  // namespace

PilotOutcome choose_steps(const Study& study, const std::string& variant, const PilotRunner& run) {
  const std::vector<const PlannedRun*> levels = study.runs_of(variant);
  return Pilot(study, levels, run).outcome();
}

}  // namespace verification
