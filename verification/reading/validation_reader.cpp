#include "verification/reading/validation_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "verification/config/config_error.hpp"
#include "verification/not_a_number.hpp"

namespace verification {
namespace {

UncertainInput read_input(TomlTable& table) {
  UncertainInput input;
  input.key = table.text("key");
  input.source = table.text("source");
  if (input.source.find_first_not_of(" \n\t") == std::string::npos)
    table.fail("source", "must say where value and uncertainty come from");
  input.relative = table.has("relative_uncertainty");
  if (table.has("uncertainty") == input.relative)
    table.fail("uncertainty", "give uncertainty (one standard deviation) or relative_uncertainty, not both");
  input.uncertainty = table.positive(input.relative ? "relative_uncertainty" : "uncertainty");
  try {
    input.shape = shape_named(table.text("distribution", "normal"));
  } catch (const std::invalid_argument& error) {
    table.fail("distribution", error.what());
  }
  table.refuse_unknown_keys();
  return input;
}

/// The input as it lies about its value in a scene.
InputDistribution distribution_in(const UncertainInput& input, const TomlTable& scene) {
  const std::size_t dot = input.key.find('.');
  TomlTable copy = scene.overlaid_with(TomlTable::from_text("", ""), "");
  const std::string part = input.key.substr(0, dot),
                    key = dot == std::string::npos ? "" : input.key.substr(dot + 1);
  if (key.empty() || !copy.has(part) || !copy.table(part).has(key))
    scene.fail("validation.input",
               "'" + input.key + "' is no number of the scene; write it as \"fluid.kinematic_viscosity\"");
  InputDistribution distribution{input.shape, copy.table(part).number(key), input.uncertainty};
  if (input.relative) distribution.uncertainty *= std::abs(distribution.value);
  if (input.shape == InputDistribution::Shape::LogNormal && !(distribution.value > 0))
    scene.fail("validation.input", "'" + input.key + "': \"log-normal\" is for positive values");
  if (!(distribution.uncertainty > 0))
    scene.fail("validation.input",
               "'" + input.key + "': a relative uncertainty of zero is none; give uncertainty");
  return distribution;
}

/// A quantity: what is borne, and times at which it is predicted although nobody has measured it.
void read_quantity(TomlTable& table, ValidationSpec& spec, MeasurementTable& predictions) {
  const std::string name = table.text("name");
  const ValidatedQuantity* quantity = find_validated_quantity(name);
  if (!quantity)
    table.fail("name", "'" + name + "' is not known; choose one of: " + validated_quantity_names());
  BorneError borne{table.positive("largest_error"), table.text("reason")};
  if (borne.reason.find_first_not_of(" \n\t") == std::string::npos)
    table.fail("reason", "must say why this much is borne");
  if (!spec.rules.bears.emplace(name, borne).second) table.fail("name", "'" + name + "' stands twice");
  if (table.has("predict_at")) {
    const double y = quantity->at_a_place ? table.number("y") : nan;
    for (const double t : table.numbers("predict_at"))
      predictions.rows.push_back({name, t, nan, y, nan, nan, 0, quantity->unit, "", 0});
  }
  table.refuse_unknown_keys();
}

}  // namespace

ValidationSpec read_validation(TomlTable table, const std::filesystem::path& file, const Study& study) {
  ValidationSpec spec;
  if (study.matrix) table.fail("variants", "[validation] is for variants, not for a [matrix]");
  if (table.has("data"))
    for (const std::string& name : table.texts("data"))
      spec.tables.push_back(read_measurements((file.parent_path() / name).lexically_normal()));
  spec.rules.coverage = table.positive("coverage", 2);
  const bool scaled = std::ranges::any_of(spec.tables, &MeasurementTable::scaled);
  if (scaled || table.has("velocity")) spec.rules.velocity = table.positive("velocity");
  if (scaled || table.has("length")) spec.rules.length = table.positive("length");
  MeasurementTable predictions;
  predictions.source = "none: a prediction";
  for (TomlTable& quantity : table.tables("quantity")) read_quantity(quantity, spec, predictions);
  if (!predictions.rows.empty()) spec.tables.push_back(predictions);
  if (spec.tables.empty())
    table.fail("data", "is missing: name tables of measurements, or predict_at in a [[validation.quantity]]");
  for (const MeasurementTable& one : spec.tables)
    for (const Measurement& row : one.rows)
      if (!spec.rules.bears.contains(row.quantity))
        table.fail("quantity",
                   fmt::format("'{}' is measured in {}; add a [[validation.quantity]] that states the "
                               "largest model error that the study bears, and why",
                               row.quantity, one.file.string()));
  for (TomlTable& input : table.tables("input")) spec.inputs.push_back(read_input(input));
  const std::string method = table.text("inputs_by", "sensitivities");
  if (method == "latin-hypercube") {
    spec.samples = table.integer("samples");
    if (spec.samples < 10 || spec.samples > 999) table.fail("samples", "must lie in [10, 999]");
  } else if (method != "sensitivities") {
    table.fail("inputs_by", "must be \"sensitivities\" or \"latin-hypercube\"");
  }
  if (study.ladder.axis == Axis::None)
    table.fail("data", "needs a [ladder]: u_num comes from three levels or more");
  if (table.has("variants")) spec.variants = table.texts("variants");
  table.refuse_unknown_keys();
  return spec;
}

std::vector<TomlTable> input_scenes(const ValidationSpec& spec, const TomlTable& scene) {
  const auto copy = [&] { return scene.overlaid_with(TomlTable::from_text("", ""), ""); };
  std::vector<TomlTable> scenes;
  if (spec.inputs.empty()) return scenes;
  if (spec.samples > 0) {
    std::vector<InputDistribution> distributions;
    for (const UncertainInput& input : spec.inputs) distributions.push_back(distribution_in(input, scene));
    constexpr std::uint64_t seed = 20092009;  // any; one for all studies, so that a run repeats
    for (const std::vector<double>& sample : latin_hypercube(distributions, spec.samples, seed)) {
      scenes.push_back(copy());
      for (std::size_t i = 0; i < sample.size(); ++i) scenes.back().set(spec.inputs[i].key, sample[i]);
    }
    return scenes;
  }
  for (const UncertainInput& input : spec.inputs) {
    const InputDistribution distribution = distribution_in(input, scene);
    for (const double sign : {-1.0, 1.0}) {
      scenes.push_back(copy());
      scenes.back().set(input.key, distribution.value + sign * distribution.uncertainty);
    }
  }
  return scenes;
}

void require_places(const Study& study) {
  const ValidationSpec& spec = *study.validation;
  for (const std::string& variant : spec.variants)
    if (std::ranges::count(study.variants, variant) == 0)
      throw ConfigError(study.name + ": [validation] variants: '" + variant +
                        "' is no variant of this study");
  for (const std::string& variant : study.variants)
    for (const PlannedRun* run : study.runs_of(variant))
      for (const MeasurementTable& table : spec.tables)
        for (const Measurement& row : table.rows) {
          const double V = table.scaled ? spec.rules.velocity : 1, L = table.scaled ? spec.rules.length : 1;
          const double t = row.t * L / V;
          const auto& outputs = run->scene.outputs;
          const bool is_reached =
              find_validated_quantity(row.quantity)->between_outputs
                  ? t <= outputs.back() * (1 + 1e-9)
                  : std::ranges::any_of(outputs, [&](double o) { return std::abs(o - t) <= 1e-9 * t; });
          if (!is_reached)
            table.fail(row, fmt::format("t = {:g} s is no output of run {} (the last is {:g} s); add it to "
                                        "time.outputs: nothing is interpolated or extrapolated in time",
                                        t, run->run, outputs.back()));
          for (const auto& [name, place, size] : {std::tuple{"x", row.x * L, run->scene.scene.size.x()},
                                                  std::tuple{"y", row.y * L, run->scene.scene.size.y()}})
            if (place < 0 || place > size * (1 + 1e-9))
              table.fail(row, fmt::format("{} = {:g} m lies outside of run {} (0 to {:g} m): nothing is "
                                          "extrapolated; correct the place or its scale, or take the row out",
                                          name, place, run->run, size));
        }
}

}  // namespace verification
