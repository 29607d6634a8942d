#include "verification/checks/stability_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "verification/checks/check_keys.hpp"

namespace verification {
namespace {

using Records = std::vector<reports::CheckRecord>;
using reports::StabilityRecord;

bool of_variant(const StabilityRecord& record, const std::string& variant) {
  return record.basis + "_" + record.transfer + "_" + record.stepping == variant;
}

/// Along a ray: the length in the (r, CFL) plane stands for dt.
double along_ray(double r, double cfl) {
  return std::hypot(r, cfl);
}

/// "viscous", "acoustic", or "r : CFL = 1 : 2".
std::string ray_of(const StabilityRecord& record) {
  if (record.cfl_tested == 0) return "viscous";
  if (record.r_tested == 0) return "acoustic";
  return fmt::format("r : CFL = 1 : {:.3g}", record.cfl_tested / record.r_tested);
}

std::string described(const StabilityRecord& record) {
  return fmt::format("{} waves, {}, {}", record.waves, record.motion, ray_of(record));
}

// ---- stability-limit

void read_limit(TomlTable& table, const Study& study, CheckSpec&) {
  if (study.stability.cases.empty()) table.fail("kind", "\"stability-limit\" needs a [stability]");
  require_band(table);
}

void judge_crossing(const CheckSpec& spec, const StudyData& data, const StabilityRecord& record,
                    const std::string& what, Records& records) {
  CheckSpec stable = spec;
  stable.lower = stable.upper = 0;
  stable.reason = "just below the limit at the worst offset no offset may be unstable";
  records.push_back(judge(stable, data,
                          what + ": unstable in a whole crossing at 0.97 of the predicted limit",
                          record.crossing == "stable" ? 0 : 1, "truth"));
}

/// A scheme whose measurements failed has no records, and no check would speak of it.
void require_records(const CheckSpec& spec, const StudyData& data, Records& records) {
  for (const std::string& variant : spec.variants)
    for (const StabilityCase& one : data.study->stability.cases)
      if (one.variant == variant && std::ranges::none_of(data.stability, [&](const StabilityRecord& record) {
            return of_variant(record, variant) && record.waves == name(one.waves) &&
                   record.motion == name(one.passage);
          }))
        records.push_back(judge(spec, data, one.name() + ": no limit could be measured", std::nan(""), "1"));
}

void evaluate_limit(const CheckSpec& spec, const StudyData& data, Records& records) {
  require_records(spec, data, records);
  for (const std::string& variant : spec.variants)
    for (const StabilityRecord& record : data.stability) {
      if (record.kind != "measured" || !of_variant(record, variant)) continue;
      const std::string what = label(variant) + described(record);
      const bool predicted = std::isfinite(record.r_predicted), measured = std::isfinite(record.r_measured);
      if (predicted) {
        records.push_back(judge(spec, data, what + ": measured over predicted limit",
                                along_ray(record.r_measured, record.cfl_measured) /
                                    along_ray(record.r_predicted, record.cfl_predicted),
                                "1"));
      } else {
        CheckSpec none = spec;
        none.lower = none.upper = 0;
        none.reason = "no eigenvalue of the amplification matrix exceeds one on this ray";
        records.push_back(judge(
            none, data,
            fmt::format("{}: grows below r = {:.4g}, CFL = {:.4g}", what, record.r_tested, record.cfl_tested),
            measured ? 1 : 0, "truth"));
      }
      if (!record.crossing.empty()) judge_crossing(spec, data, record, what, records);
    }
}

// ---- automatic-step

void read_automatic(TomlTable& table, const Study& study, CheckSpec& spec) {
  if (study.stability.cases.empty()) table.fail("kind", "\"automatic-step\" needs a [stability]");
  if (study.stability.lattice.per_cell[0] < 2)
    for (const StabilityCase& one : study.stability.cases)
      if (one.scheme.transfer == mpm::Scheme::Transfer::FullMass)
        table.fail("kind", "\"automatic-step\": full mass needs two particles a cell");
  if (!table.has("lower")) table.fail_missing("lower", "give the smallest margin");
  if (!(spec.lower >= 1)) table.fail("lower", "must be at least 1");
}

void evaluate_automatic(const CheckSpec& spec, const StudyData& data, Records& records) {
  const StabilityPlan& plan = data.study->stability;
  mpm::Scene scene;
  scene.cells = {8, 8};
  scene.particles_per_cell = plan.lattice.per_cell;
  for (const StabilityCase& one : plan.cases) {
    if (std::ranges::count(spec.variants, one.variant) == 0) continue;
    const mpm::TimeStepRule rule = mpm::automatic_time_step(one.scheme, scene);
    for (const StabilityRecord& record : data.stability) {
      if (record.kind != "measured" || !of_variant(record, one.variant) || record.waves != name(one.waves) ||
          record.motion != name(one.passage))
        continue;
      // The tested step stands for the ray; the rule takes the sharper of its two limits on it.
      const double share =
          std::max(record.r_tested / rule.cfl_viscous, record.cfl_tested / rule.cfl_acoustic);
      const bool limited = std::isfinite(record.r_measured);
      const double reached = limited ? along_ray(record.r_measured, record.cfl_measured) /
                                           along_ray(record.r_tested, record.cfl_tested)
                                     : 1;
      records.push_back(judge(spec, data,
                              label(one.variant) + described(record) + ": measured limit over automatic step",
                              reached * share, "1"));
    }
  }
}

// ---- published-limit

void read_published(TomlTable& table, const Study& study, CheckSpec& spec) {
  if (study.stability.cases.empty()) table.fail("kind", "\"published-limit\" needs a [stability]");
  const bool viscous = table.has("r");
  if (viscous == table.has("cfl")) table.fail("r", "or cfl: give the one that was published");
  spec.quantity = viscous ? "viscous" : "acoustic";
  spec.place = table.positive(viscous ? "r" : "cfl");
  spec.tolerance = table.positive("tolerance");
  spec.level = table.text("waves") + " waves, " + table.text("motion") + ", " + spec.quantity;
  const double share = viscous ? 0 : 1;
  const bool asked = std::ranges::any_of(study.stability.cases, [&](const StabilityCase& one) {
    return std::ranges::count(spec.variants, one.variant) > 0 &&
           spec.level == name(one.waves) + " waves, " + name(one.passage) + ", " + spec.quantity;
  });
  if (!asked || std::ranges::count(study.stability.acoustic_shares, share) == 0)
    table.fail("waves", "or motion, ray or variants: this study measures no such limit");
}

void evaluate_published(const CheckSpec& spec, const StudyData& data, Records& records) {
  for (const std::string& variant : spec.variants)
    for (const StabilityRecord& record : data.stability) {
      if (record.kind != "measured" || !of_variant(record, variant) || described(record) != spec.level)
        continue;
      const bool viscous = spec.quantity == "viscous";
      const std::string what = label(variant) + spec.level;
      CheckSpec band = spec;
      band.lower = spec.place * (1 - spec.tolerance);
      band.upper = spec.place * (1 + spec.tolerance);
      const double predicted = viscous ? record.r_predicted : record.cfl_predicted;
      const double measured = viscous ? record.r_measured : record.cfl_measured;
      const std::string unit = viscous ? "h^2/nu" : "h/c";
      records.push_back(judge(band, data, what + ": predicted", predicted, unit));
      records.push_back(judge(band, data, what + ": measured", measured, unit));
    }
}

}  // namespace

void add_stability_kinds(std::vector<CheckKind>& kinds) {
  kinds.push_back({"stability-limit", read_limit, evaluate_limit});
  kinds.push_back({"automatic-step", read_automatic, evaluate_automatic});
  kinds.push_back({"published-limit", read_published, evaluate_published});
}

bool is_stability_kind(const std::string& kind) {
  return kind == "stability-limit" || kind == "automatic-step" || kind == "published-limit";
}

}  // namespace verification
