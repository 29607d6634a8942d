#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "verification/commands/elsewhere/new_command.hpp"
#include "verification/commands/elsewhere/shard_commands.hpp"

namespace verification {

/// The verbs for runs elsewhere, and by others, as the command line has them: plan, judge, collect, submit,
/// new.
class ShardApp {
 public:
  explicit ShardApp(CLI::App& app, std::string& studies, const char* studies_help);

  [[nodiscard]] bool needs_studies() const { return *plan_app_ || *submit_app_ || *new_app_; }
  /// Runs the verb that was given; none if it was none of these.
  std::optional<int> run(const std::filesystem::path& studies, const std::string& command_line);

 private:
  CLI::App *plan_app_, *judge_app_, *collect_app_, *submit_app_, *new_app_;
  PlanOptions plan_;
  JudgeOptions judge_;
  CollectOptions collect_;
  SubmitOptions submit_;
  NewOptions new_;
};

}  // namespace verification
