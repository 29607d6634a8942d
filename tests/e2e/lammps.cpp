#include <filesystem>

#include "tests/catch.hpp"
#include "tests/e2e/program.hpp"
#include "tests/study_text.hpp"

namespace {

const std::string adapter = MPM_ADAPTERS "/lammps/solve";

/// Couette flow that has long been steady, judged where the particles of any solver stand.
const std::string study = study_text("LAMMPS", "a steady Couette flow",
                                     couette_scene("cells = 8", "dt = 1e-3\noutputs = [4.0]") + R"(
[solver]
command = ["sh", ")" + adapter + R"(", "{scene}", "{out}"]
version = ["sh", ")" + adapter + R"(", "--version"]
locations = ["particles"]
[solver.options]
sound_speed = 1e-3
[[check]]
kind = "error"
locations = ["particles"]
upper = 1e-9
reason = "the steady solution is what the stand-in writes"
[[figure]]
kind = "profiles"
title = "Theirs"
location = "particles"
)");

/// A program that answers as LAMMPS does: the lattice of the input at the steady velocity, for every dump
/// asked for.
const std::string stand_in = R"(#!/bin/sh
if [ "$1" = -h ]; then
  echo 'Large-scale Atomic/Molecular Massively Parallel Simulator - 29 Aug 2024'
  echo 'sph/idealgas    sph/taitwater/morris'
  exit
fi
grep -q '^pair_style sph/taitwater/morris$' "$2" || exit 9
for dump in $(sed -n 's/^write_dump .* \(dump[.0-9]*\) x y vx vy.*/\1/p' "$2"); do
  awk '/^region box/ { length_x = $5 } /^lattice/ { s = $3 } /^velocity above/ { plate = $4 }
    /^region above/ { height = $6 }
    END {
      for (k = 0; k < 5; ++k) print "ITEM"
      print "0 " length_x; print "-1 1"; print "-1 1"; print "ITEM: ATOMS"
      for (j = 0; j < height / s - 0.5; ++j) for (i = 0; i < length_x / s - 0.5; ++i)
        printf "%.12g %.12g %.12g 0\n", (i + 0.5) * s, (j + 0.5) * s, plate * (j + 0.5) * s / height
    }' "$2" > "$dump"
done
echo "Loop time of 0.25 on 1 procs for 4000 steps with 80 atoms" > "$4"
)";

Ended run_with(const ScratchDirectory& scratch, const std::string& lmp) {
  return run_program("run " + scratch.write("s.toml", study) + " --out " + (scratch / "out").string(),
                     "LMP=" + lmp);
}

}  // namespace

TEST_CASE("the adapter of LAMMPS says so where there is none, or none with SPH") {
  const ScratchDirectory scratch;
  CHECK_THAT(run_with(scratch, "no-such-lmp").output, contains("LAMMPS is not installed"));
  const std::string plain = scratch.write("lmp", "#!/bin/sh\necho 'granular   peri'\n");
  std::filesystem::permissions(plain, std::filesystem::perms::owner_all);
  const Ended ended = run_with(scratch, plain);
  CHECK(ended.code == 3);
  CHECK_THAT(ended.output, contains("has no package SPH, as Debian's has none"));
}

TEST_CASE("the adapter of LAMMPS hands a scene over, and what comes back, with name and version") {
  const ScratchDirectory scratch;
  const std::string lmp = scratch.write("lmp", stand_in);
  std::filesystem::permissions(lmp, std::filesystem::perms::owner_all);
  const Ended ended = run_with(scratch, lmp);
  INFO(ended.output);
  CHECK(ended.code == 0);
  const std::string runs = content_of(scratch / "out" / "runs.csv");
  CHECK_THAT(runs, contains("29 Aug 2024"));
  CHECK_THAT(runs, contains("4000"));
}
