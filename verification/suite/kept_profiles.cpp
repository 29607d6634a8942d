#include "verification/suite/kept_profiles.hpp"

#include "reports/figures/figures.hpp"
#include "reports/records/directory/run_files.hpp"
#include "reports/records/surface.hpp"

namespace verification {

KeptProfiles::KeptProfiles(const std::vector<Study>& studies, std::filesystem::path out, Profiles kept)
    : out_(std::move(out)), kept_(kept) {
  static const std::map<std::string, File> file_of = {
      {"profiles", File::Profile}, {"history", File::History}, {"energy", File::History},
      {"shear-rate", File::Shear}, {"viscosity", File::Shear}, {"pressure", File::State},
      {"yielded", File::Profile},  {"occupancy", File::State}};
  for (const Study& study : studies)
    for (const reports::FigureRecord& figure : study.figures) {
      // Drawn from the tables alone.
      if (figure.kind == "convergence" || figure.kind == "work-precision" || figure.kind == "stability-map" ||
          figure.kind == "regularisation" || figure.kind == "validation" ||
          figure.kind == "validation-parts" || figure.kind == "computed-measured")
        continue;
      std::vector<std::string> runs = reports::split_list(figure.runs);
      if (runs.empty())
        for (const PlannedRun& run : study.runs) runs.push_back(run.run);
      // A kind that is not known here may draw anything.
      const auto known = file_of.find(figure.kind);
      for (const std::string& run : runs) {
        if (known != file_of.end())
          drawn_[run].insert(known->second);
        else
          drawn_[run].insert({File::Profile, File::History, File::Shear, File::State});
      }
    }
}

bool KeptProfiles::wanted(const std::string& run, File file) const {
  if (kept_ == Profiles::All) return true;
  const auto drawn = drawn_.find(run);
  return drawn != drawn_.end() && drawn->second.contains(file);
}

void KeptProfiles::write(const RunData& run) const {
  write(run, false);
}

void KeptProfiles::write_all(const RunData& run) const {
  write(run, true);
}

void KeptProfiles::write(const RunData& run, bool all) const {
  const std::string& name = run.plan->run;
  const auto keep = [&](File file, const char* ending, bool any, auto&& writing) {
    if ((all || wanted(name, file)) && any) return writing();
    std::error_code ignored;
    std::filesystem::remove(out_ / "profiles" / (name + ending), ignored);
  };
  keep(File::Profile, ".csv", true, [&] { reports::write_profile(out_, name, run.profile); });
  keep(File::History, ".history.csv", true, [&] { reports::write_history(out_, name, run.history); });
  keep(File::History, ".surface.csv", !run.surface.empty(),
       [&] { reports::write_surface(out_, name, run.surface); });
  // Of a run that failed there is nothing, and its figure says so.
  const auto awaited = [&](File file) {
    const auto drawn = drawn_.find(name);
    return run.record.status.starts_with("failed: ") && drawn != drawn_.end() && drawn->second.contains(file);
  };
  keep(File::Shear, ".shear.csv", !run.shear.empty() || awaited(File::Shear),
       [&] { reports::write_shear(out_, name, run.shear); });
  keep(File::State, ".state.csv", !run.state.empty() || awaited(File::State),
       [&] { reports::write_state(out_, name, run.state); });
}

}  // namespace verification
