#pragma once

#include <filesystem>
#include <string>

#include "reports/records/records.hpp"

/// A small but realistic result directory: two studies of Poiseuille start-up with space and time ladders at
/// two locations and several times, one failing check, one diverged run, every kind of figure, texts with
/// characters that each format must escape.
reports::Results sample_results();

/// Write sample_results() with profiles, histories and provenance into `dir`.
void write_sample(const std::filesystem::path& dir);

/// Sets an environment variable for as long as it lives.
class EnvironmentVariable {
 public:
  EnvironmentVariable(const char* name, const std::string& value);
  ~EnvironmentVariable();
  EnvironmentVariable(const EnvironmentVariable&) = delete;
  EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

 private:
  std::string name_, before_;
  bool was_set_;
};
