#include "verification/reading/study_folder.hpp"

#include <algorithm>
#include <cstdlib>
#include <exception>

#include "reports/records/directory/result_files.hpp"
#include "reports/threads/for_each_index.hpp"
#include "verification/config/config_error.hpp"
#include "verification/config/machine.hpp"
#include "verification/reading/study_reader.hpp"

namespace verification {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> study_files(const fs::path& directory) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(directory, error))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  if (files.empty())
    throw ConfigError(directory.string() +
                      ": no studies (*.toml) here; give their directory with --studies DIR or $MPM_STUDIES");
  std::ranges::sort(files);
  return files;
}

/// The first folder between the directory and a file in it; "" where there is none.
std::string topic_of(const fs::path& file, const fs::path& directory) {
  const fs::path inside = file.lexically_relative(directory).parent_path();
  return inside.empty() ? "" : inside.begin()->string();
}

/// What a folder says of its studies as a whole.
struct Guide {
  std::vector<reports::ChapterRecord> chapters;
  std::vector<reports::HeadlineRecord> headlines;
};

/// A folder without chapters.csv or headlines.csv has a chapter for each topic, and no headlines of its own.
Guide guide_of(const fs::path& directory) {
  Guide guide;
  if (fs::exists(directory / "chapters.csv"))
    guide.chapters = reports::read_chapters(directory / "chapters.csv");
  if (fs::exists(directory / "headlines.csv"))
    guide.headlines = reports::read_headlines(directory / "headlines.csv");
  return guide;
}

Study read_in(const fs::path& file, const fs::path& directory, const Guide& guide) {
  Study study = read_study(file, topic_of(file, directory));
  for (std::size_t i = 0; i < guide.chapters.size(); ++i) {
    const auto& chapter = guide.chapters[i];
    if (chapter.topic == reports::scope_topic)
      study.scope = chapter;
    else if (chapter.topic == study.topic)
      study.chapter = {chapter, static_cast<long>(i)};
  }
  for (std::size_t i = 0; i < guide.headlines.size(); ++i)
    if (guide.headlines[i].study == study.name)
      study.headlines.emplace_back(guide.headlines[i], static_cast<long>(i));
  return study;
}

}  // namespace

std::vector<Study> read_studies(const fs::path& directory, int threads) {
  const Guide guide = guide_of(directory);
  const std::vector<fs::path> files = study_files(directory);
  std::vector<Study> studies(files.size());
  std::vector<std::exception_ptr> wrong(files.size());
  reports::for_each_index(files.size(), threads > 0 ? threads : available_cores(), [&](std::size_t i) {
    try {
      studies[i] = read_in(files[i], directory, guide);
    } catch (...) {
      wrong[i] = std::current_exception();
    }
  });
  // The first one in their order, whichever was met first.
  for (const std::exception_ptr& one : wrong)
    if (one) std::rethrow_exception(one);
  // In the order of their names, wherever they lie: moving a file changes no table.
  std::ranges::stable_sort(studies, {}, [](const Study& study) { return study.name + ".toml"; });
  for (std::size_t s = 1; s < studies.size(); ++s)
    if (studies[s].name == studies[s - 1].name)
      throw ConfigError(directory.string() + ": two studies are named '" + studies[s].name + "'; rename one");
  return studies;
}

Study read_study_named(const fs::path& directory, const std::string& name) {
  const Guide guide = guide_of(directory);
  const std::vector<fs::path> files = study_files(directory);
  for (const fs::path& file : files) {
    if (file.stem() != name) continue;
    Study study = read_in(file, directory, guide);
    if (study.name == name) return study;
  }
  // A study may carry a name that its file does not.
  for (Study& study : read_studies(directory))
    if (study.name == name) return std::move(study);
  throw ConfigError("study '" + name + "' is not known in " + directory.string() +
                    "; `mpm-verify list` names them, and a path ending in .toml is read as a file");
}

fs::path studies_directory(const fs::path& source) {
  if (const char* named = std::getenv("MPM_STUDIES"); named && *named) {
    if (!fs::is_directory(named))
      throw ConfigError("MPM_STUDIES: '" + std::string(named) + "' is no directory; unset it, or name one");
    return named;
  }
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path beside = program.parent_path().parent_path() / "share" / "mpm-verify" / "studies";
  for (const fs::path& place : {beside, source})
    if (fs::is_directory(place, error)) return place;
  throw ConfigError("no studies in " + beside.string() + " or " + source.string() +
                    "; give their directory with --studies DIR or $MPM_STUDIES");
}

}  // namespace verification
