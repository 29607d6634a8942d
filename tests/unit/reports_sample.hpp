#pragma once

#include <filesystem>
#include <string>

#include "reports/records.hpp"

/// A small but realistic result directory: two studies of Poiseuille start-up with space and time ladders at
/// two locations and several times, one failing check, one diverged run, every kind of figure, texts with
/// characters that each format must escape.
reports::Results sample_results();

/// Write sample_results() with profiles, histories and provenance into `dir`.
void write_sample(const std::filesystem::path& dir);

/// A directory of its own that vanishes with the object.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

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
