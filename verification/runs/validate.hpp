#pragma once

#include "verification/runs/run_data.hpp"

namespace verification {

/// Compares a study's runs with its tables of measurements, if it has any: fills data.validation and
/// data.joint_validation, and adds to data.checks one a point: |E| against the model error that the study
/// bears (of a prediction, k u_val against the uncertainty that it bears). An inconclusive comparison has no
/// |E| that could pass: NaN.
void validate(StudyData& data);

/// Names the study and the variant in what a comparison has found.
void append_comparison(StudyData& data, const std::string& variant, TableComparison comparison);

/// Bias and scatter of each quantity over all studies, variants and tables; predictions and values that are
/// not positive are left out, and so is a quantity with fewer than two values.
std::vector<reports::ValidationBiasRecord> validation_bias(
    const std::vector<reports::ValidationRecord>& records);
/// For every quantity of the rules a figure of values with their uncertainties, and one of the parts of
/// u_val.
void add_validation_figures(Study& study, const ComparisonRules& rules);
/// A figure computed against measured for each of them.
std::vector<reports::FigureRecord> computed_measured_figures(
    const std::vector<reports::ValidationBiasRecord>& records);

}  // namespace verification
