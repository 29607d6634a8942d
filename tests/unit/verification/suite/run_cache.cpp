#include "verification/suite/run_cache.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "reports/files/atomic_file.hpp"
#include "reports/files/content_hash.hpp"
#include "tests/scratch_directory.hpp"
#include "tests/study_text.hpp"
#include "verification/reading/study_reader.hpp"
#include "verification/runs/run_simulation.hpp"
#include "verification/suite/run_entry.hpp"
#include "verification/suite/schedule.hpp"

using namespace verification;

namespace {

const std::string tiny = study_text(
    "Tiny", "A tiny study", couette_scene("cells = 4", "dt = 5e-3\noutputs = [0.1, 0.2]") + R"([[check]]
kind = "error"
upper = 1.0
reason = "a test of the machinery, not of accuracy"
)");

Study study_of(const ScratchDirectory& scratch, const std::string& name, const std::string& text) {
  return read_study(scratch.write(name + ".toml", text));
}

std::string with(const std::string& from, const std::string& to) {
  return replaced(tiny, from, to);
}

void flip_byte(const std::filesystem::path& file, std::size_t from_end) {
  std::string bytes = content_of(file);
  bytes[bytes.size() - from_end] ^= 1;
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace

TEST_CASE("a hash tells texts apart by every byte, by order and by length") {
  CHECK(reports::content_name("abcdefgh12345678") == reports::content_name("abcdefgh12345678"));
  CHECK(reports::content_name("abcdefgh12345678") != reports::content_name("12345678abcdefgh"));
  CHECK(reports::content_name("abc") != reports::content_name(std::string("abc\0", 4)));
  const std::string base(64, 'x');
  for (std::size_t i = 0; i < base.size(); ++i) {
    std::string other = base;
    other[i] = 'y';
    CHECK(reports::content_hash(other) != reports::content_hash(base));
  }
}

TEST_CASE("a run comes back from its bytes bit by bit, and from no others") {
  const ScratchDirectory scratch;
  const Study study = study_of(scratch, "tiny", tiny);
  const RunData run = run_simulation(study, study.runs.front());
  const std::string bytes = encode_run(run);
  const auto back = decode_run(bytes, study, study.runs.front());
  REQUIRE(back);
  CHECK(encode_run(*back) == bytes);
  CHECK(back->profile.size() == run.profile.size());
  CHECK(back->history.size() == run.history.size());
  CHECK(back->shear.size() == run.shear.size());
  CHECK(back->probe == run.probe);
  CHECK(back->record.status == "completed");
  CHECK(back->record.steps == run.record.steps);
  CHECK(back->timing.wall_s == run.timing.wall_s);
  CHECK(back->timing.source == reports::timing_from_cache);
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, bytes.size() / 2, bytes.size() - 1})
    CHECK_FALSE(decode_run(bytes.substr(0, size), study, study.runs.front()));
  CHECK_FALSE(decode_run(bytes + "x", study, study.runs.front()));
}

TEST_CASE("a finished run is found by what decides it, under any name") {
  const ScratchDirectory scratch;
  const Study study = study_of(scratch, "tiny", tiny);
  RunCache cache(scratch.path() / "cache", CacheUse::Reuse);
  CHECK_FALSE(cache.load(study, study.runs.front()));
  cache.save(study, run_simulation(study, study.runs.front()));
  CHECK(cache.warning().empty());

  const Study same = study_of(scratch, "another-name", "# a comment\n" + tiny);
  const auto found = cache.load(same, same.runs.front());
  REQUIRE(found);
  CHECK(found->record.run == "another-name");
  CHECK(found->plan == &same.runs.front());

  SECTION("any value of the scene, the scheme, the outputs or the comparison makes it another run") {
    for (const auto& [from, to] : {std::pair{"cells = 4", "cells = 5"},
                                   {"dt = 5e-3", "dt = 5.000000000000001e-3"},
                                   {"0.1, 0.2]", "0.1, 0.3]"},
                                   {"[time]", "[scheme]\nstepping = \"musl\"\n[time]"},
                                   {"1e-6", "1.0000000000000002e-6"},
                                   {"[scene]", "compare_with = \"discrete\"\n[scene]"}}) {
      INFO(to);
      const Study other = study_of(scratch, "other", with(from, to));
      CHECK_FALSE(cache.load(other, other.runs.front()));
    }
  }
  SECTION("somebody else's solver is never taken from the cache") {
    const Study external = study_of(scratch, "ext", tiny + "[solver]\ncommand = \"true\"\n");
    CHECK_FALSE(cache.load(external, external.runs.front()));
    CHECK(cache.file(external, external.runs.front()).empty());
  }
  SECTION("a fresh cache reads nothing, an absent one keeps nothing") {
    CHECK_FALSE(RunCache(scratch.path() / "cache", CacheUse::Refresh).load(study, study.runs.front()));
    CHECK_FALSE(RunCache(scratch.path() / "cache", CacheUse::Off).load(study, study.runs.front()));
    CHECK_FALSE(RunCache({}, CacheUse::Reuse).on());
  }
}

TEST_CASE("a damaged file of the cache is no run, and is replaced") {
  const ScratchDirectory scratch;
  const Study study = study_of(scratch, "tiny", tiny);
  RunCache cache(scratch.path() / "cache", CacheUse::Reuse);
  const RunData run = run_simulation(study, study.runs.front());
  cache.save(study, run);
  const auto file = cache.file(study, study.runs.front());
  const auto size = std::filesystem::file_size(file);
  SECTION("cut short") {
    std::filesystem::resize_file(file, size / 2);
  }
  SECTION("empty") {
    std::filesystem::resize_file(file, 0);
  }
  SECTION("a flipped bit in the checksum") {
    flip_byte(file, 3);
  }
  SECTION("a flipped bit in the data") {
    flip_byte(file, 100);
  }
  SECTION("a flipped bit in the key") {
    flip_byte(file, size - 40);
  }
  SECTION("a directory in its place") {
    std::filesystem::remove(file);
    std::filesystem::create_directory(file);
    CHECK_FALSE(cache.load(study, study.runs.front()));
    return;
  }
  CHECK_FALSE(cache.load(study, study.runs.front()));
  cache.save(study, run);
  CHECK(cache.load(study, study.runs.front()));
}

TEST_CASE("a cache that cannot be written costs a warning") {
  const ScratchDirectory scratch;
  const Study study = study_of(scratch, "tiny", tiny);
  RunCache cache(scratch.write("occupied", "a file"), CacheUse::Reuse);
  cache.save(study, run_simulation(study, study.runs.front()));
  CHECK_THAT(cache.warning(), contains("1 finished runs could not be kept"));
}

TEST_CASE("the cache is bounded: other builds go first, oldest first") {
  namespace fs = std::filesystem;
  const ScratchDirectory scratch;
  const Study study = study_of(scratch, "tiny", tiny);
  RunCache cache(scratch.path(), CacheUse::Reuse);
  cache.save(study, run_simulation(study, study.runs.front()));
  const auto file = cache.file(study, study.runs.front());
  const auto size = fs::file_size(file);
  for (const char* build : {"old", "older"}) {
    fs::create_directory(scratch.path() / "runs" / build);
    fs::copy_file(file, scratch.path() / "runs" / build / "x.run");
  }
  const auto now = fs::file_time_type::clock::now();
  fs::last_write_time(scratch.path() / "runs" / "old", now - std::chrono::hours(1));
  fs::last_write_time(scratch.path() / "runs" / "older", now - std::chrono::hours(2));
  cache.prune(3 * size);
  CHECK(fs::exists(scratch.path() / "runs" / "older"));
  cache.prune(2 * size);
  CHECK_FALSE(fs::exists(scratch.path() / "runs" / "older"));
  CHECK(fs::exists(scratch.path() / "runs" / "old"));
  CHECK(fs::exists(file));
  cache.prune(0);
  CHECK_FALSE(fs::exists(scratch.path() / "runs" / "old"));
  CHECK_FALSE(fs::exists(file));
}

TEST_CASE("runs are taken longest first, timed ones alone at the end") {
  const ScratchDirectory scratch;
  std::vector<Study> studies;
  studies.push_back(study_of(scratch, "timed", "repetitions = 3\n" + tiny));
  studies.push_back(study_of(scratch, "short", tiny));
  studies.push_back(study_of(scratch, "long", with("dt = 5e-3", "dt = 1e-3")));
  const Schedule order = schedule(studies);
  REQUIRE(order.shared.size() == 2);
  CHECK(order.shared[0].study == 2);
  CHECK(order.shared[1].study == 1);
  REQUIRE(order.alone.size() == 1);
  CHECK(order.alone[0].study == 0);

  const RunData timed = run_simulation(studies[0], studies[0].runs.front());
  CHECK(timed.timing.repetitions == 3);
  CHECK(timed.timing.spread >= 0);
  CHECK(timed.timing.source == reports::timing_measured);
  CHECK(std::isnan(run_simulation(studies[1], studies[1].runs.front()).timing.spread));
}

TEST_CASE("a long run is its own warm-up, and is timed twice at most") {
  CHECK_FALSE(warms_itself(3, 0.049));
  CHECK(warms_itself(3, 0.05));
  CHECK_FALSE(warms_itself(1, 0.24));
  CHECK(warms_itself(1, 0.25));
  CHECK(wants_repetition(1, {}));
  CHECK_FALSE(wants_repetition(1, {0.001}));
  CHECK(wants_repetition(3, {0.01, 0.01}));
  CHECK_FALSE(wants_repetition(3, {0.01, 0.01, 0.01}));
  CHECK(wants_repetition(5, {3}));
  CHECK_FALSE(wants_repetition(5, {3, 3}));
  CHECK(wants_repetition(5, {0.08, 0.08, 0.08}));
  CHECK_FALSE(wants_repetition(5, {0.09, 0.09, 0.09}));
}

TEST_CASE("a reference that takes long is computed once, before all runs") {
  const ScratchDirectory scratch;
  const std::string cross =
      with("[fluid]", "[fluid]\nmodel = \"cross\"\ninfinite_viscosity_ratio = 2.0\ntime_constant = 1.0");
  std::vector<Study> studies;
  studies.push_back(study_of(scratch, "newtonian", tiny));
  studies.push_back(study_of(scratch, "timed", "repetitions = 3\n" + cross));
  studies.push_back(study_of(scratch, "same", cross));
  const Schedule order = schedule(studies);
  REQUIRE(order.shared.size() == 3);
  CHECK(order.shared[0].kind == Job::Kind::Reference);
  CHECK(order.shared[0].study == 1);
  for (std::size_t k : {1, 2}) CHECK(order.shared[k].kind == Job::Kind::Run);
  REQUIRE(order.alone.size() == 1);
  CHECK(order.alone[0].study == 1);
}

TEST_CASE("of references that share a computation, the one that goes furthest is computed") {
  const ScratchDirectory scratch;
  const auto cross = [](const std::string& outputs) {
    std::string text = with("[fluid]",
                            "[fluid]\nmodel = \"cross\"\ninfinite_viscosity_ratio = 2.0\n"
                            "time_constant = 1.0");
    return text.replace(text.find("[0.1, 0.2]"), 10, outputs);
  };
  std::vector<Study> studies;
  studies.push_back(study_of(scratch, "brief", cross("[0.1, 0.2]")));
  studies.push_back(study_of(scratch, "longest", cross("[0.3, 0.5]")));
  studies.push_back(study_of(scratch, "long", cross("[0.4]")));
  studies.push_back(study_of(scratch, "earlier", cross("[0.05, 0.2]")));  // to be accurate from 0.01 s on
  const Schedule order = schedule(studies);
  std::vector<std::size_t> computed;
  for (const Job& job : order.shared)
    if (job.kind == Job::Kind::Reference) computed.push_back(job.study);
  std::ranges::sort(computed);
  CHECK(computed == std::vector<std::size_t>{1, 3});
}

TEST_CASE("the first exception stops the jobs, whatever the threads") {
  std::vector<Job> jobs(100, Job{0, 0, 1});
  std::atomic<int> performed{0};
  const auto cause = perform_all(jobs, 3, [&](const Job&) {
    if (++performed == 10) throw std::runtime_error("tenth");
    std::this_thread::sleep_for(std::chrono::milliseconds(2));  // long beside an exception's way out
  });
  REQUIRE(cause);
  CHECK_THROWS_WITH(std::rethrow_exception(cause), contains("tenth"));
  CHECK(performed < 100);
  CHECK_FALSE(perform_all(jobs, 1, [](const Job&) {}));
}
