#include "tests/bench/derived.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tests/bench/count/work_count.hpp"

namespace bench {
namespace {

constexpr const char* counter = "particle-steps";

/// Least-squares slope of log cost over log number.
double growth_exponent(const std::vector<double>& particles, const std::vector<double>& seconds) {
  double x_mean = 0, y_mean = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    x_mean += std::log(particles[i]) / n;
    y_mean += std::log(seconds[i]) / n;
  }
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double x = std::log(particles[i]) - x_mean;
    xx += x * x;
    xy += x * (std::log(seconds[i]) - y_mean);
  }
  return xy / xx;
}

class Derivation {
 public:
  explicit Derivation(const Collector& rates) : rates_(rates) {}

  void over_general_solver() {
    for (const std::string scheme : {"cubic_full_mass_leapfrog", "quadratic_apic"})
      ratio("vortex/" + scheme + "/64/1", "general_vortex/" + scheme + "/64",
            "speed over the general solver, particle by particle");
  }

  void over_plain_vortices() {
    for (const std::string scheme : {"cubic_full_mass_leapfrog", "quadratic_apic"})
      ratio("vortex/" + scheme + "/64/1", "plain_vortex/" + scheme + "/64", "speed over the plain loop");
  }

  /// Of what a step costs, in the number of cells.
  void growth_with_cells() {
    for (const auto& [scheme, all_cells] :
         {std::pair{"vortex/cubic_full_mass_leapfrog", std::vector{16L, 32L, 64L, 128L, 256L}},
          std::pair{"vortex/quadratic_apic", std::vector{16L, 32L, 64L, 128L, 256L}},
          std::pair{"incompressible_vortex/k3", std::vector{32L, 64L, 128L}}}) {
      std::vector<double> cells, seconds;
      for (const long n : all_cells) {
        const std::string name = scheme + ("/" + std::to_string(n)) + "/1";
        if (!rates_.has(name)) break;
        const Rate rate = rates_.rate(name, "steps");
        records_.push_back({name, "time of a step", 1e3 / rate.value, "ms", rate.spread});
        cells.push_back(static_cast<double>(n * n));
        seconds.push_back(1 / rate.value);
      }
      if (cells.size() < all_cells.size()) continue;
      records_.push_back(
          {scheme,
           fmt::format("exponent of cost in cells, {} to {} a side", all_cells.front(), all_cells.back()),
           growth_exponent(cells, seconds), "1", 0});
    }
  }

  void over_plain_loop() {
    for (const std::string fluid : {"newtonian", "cross", "power_law"})
      ratio("step/linear_" + fluid + "/800/1", "plain_step/" + fluid + "/800", "speed over the plain loop");
  }

  void growth() {
    std::vector<double> particles, seconds;
    for (const long n : {10'000L, 100'000L, 1'000'000L}) {
      const std::string name = "step/linear_newtonian/" + std::to_string(n) + "/1";
      if (!rates_.has(name)) return;
      particles.push_back(static_cast<double>(n));
      seconds.push_back(static_cast<double>(n) / rates_.rate(name, counter).value);
    }
    records_.push_back({"step/linear_newtonian", "exponent of cost in particles, 1e4 to 1e6",
                        growth_exponent(particles, seconds), "1",
                        rates_.rate("step/linear_newtonian/1000000/1", counter).spread});
    ratio("step/linear_newtonian/800/1", "step/linear_newtonian/1000000/1",
          "cost of a particle-step among 1e6 over that among 800");
  }

  void threads() {
    ratio("step/linear_threads/1000000/2/real_time", "step/linear_threads/1000000/1/real_time",
          "speed over one thread");
    for (const std::string scheme : {"cubic_full_mass_leapfrog", "quadratic_apic"})
      ratio("vortex/" + scheme + "_threads/128/2/real_time", "vortex/" + scheme + "_threads/128/1/real_time",
            "speed over one thread");
  }

  void peaks() {
    if (!rates_.has("peak/arithmetic") || !rates_.has("peak/bandwidth/72")) return;
    const Rate arithmetic = rates_.rate("peak/arithmetic", "operations");
    const Rate bandwidth = rates_.rate("peak/bandwidth/72", "bytes");
    const double operations = kernel_operations_per_particle_step();
    records_.push_back({"step/linear_newtonian", "operations a particle-step", operations, "1", 0});
    records_.push_back(
        {"plain_step/newtonian", "operations a particle-step", plain_operations_per_particle_step(), "1", 0});
    records_.push_back({"step/linear_newtonian", "bytes a particle-step", bytes_per_particle_step, "B", 0});
    for (const std::string size : {"800", "1000000"}) {
      const std::string name = "step/linear_newtonian/" + size + "/1";
      if (!rates_.has(name)) continue;
      const Rate rate = rates_.rate(name, counter);
      records_.push_back({name, "part of peak arithmetic", rate.value * operations / arithmetic.value, "1",
                          std::hypot(rate.spread, arithmetic.spread)});
      if (size == "800") continue;  // in the cache
      records_.push_back({name, "part of peak bandwidth",
                          rate.value * bytes_per_particle_step / bandwidth.value, "1",
                          std::hypot(rate.spread, bandwidth.spread)});
    }
  }

  /// The same of the schemes that are accurate in two dimensions.
  void peaks_of_vortices() {
    if (!rates_.has("peak/arithmetic") || !rates_.has("peak/bandwidth/72")) return;
    const Rate arithmetic = rates_.rate("peak/arithmetic", "operations");
    const Rate bandwidth = rates_.rate("peak/bandwidth/72", "bytes");
    const auto part = [&](const std::string& name, const std::string& of, double work, const Rate& peak) {
      if (!rates_.has(name)) return;
      const Rate rate = rates_.rate(name, counter);
      records_.push_back({name, "part of peak " + of, rate.value * work / peak.value, "1",
                          std::hypot(rate.spread, peak.spread)});
    };
    const FullMassCount full_mass = full_mass_count();
    const std::string apic = "vortex/quadratic_apic", leapfrog = "vortex/cubic_full_mass_leapfrog";
    records_.push_back({leapfrog, "iterations a solve", full_mass.iterations_a_solve, "1", 0});
    const auto roofline = [&](const std::string& scheme, double operations, double bytes) {
      records_.push_back({scheme, "operations a particle-step", operations, "1", 0});
      part(scheme + "/64/1", "arithmetic", operations, arithmetic);
      records_.push_back({scheme, "bytes a particle-step", bytes, "B", 0});
      part(scheme + "/256/1", "bandwidth", bytes, bandwidth);
    };
    roofline(apic, apic_operations_per_particle_step(), bytes_per_affine_particle_step);
    roofline(leapfrog, full_mass.operations, bytes_per_full_mass_particle_step(full_mass.iterations_a_solve));
  }

  [[nodiscard]] std::vector<reports::BenchRecord> records() const { return records_; }

 private:
  void ratio(const std::string& name, const std::string& over, const std::string& quantity) {
    if (!rates_.has(name) || !rates_.has(over)) return;
    const Rate a = rates_.rate(name, counter), b = rates_.rate(over, counter);
    records_.push_back({name, quantity, a.value / b.value, "1", std::hypot(a.spread, b.spread)});
  }

  const Collector& rates_;
  std::vector<reports::BenchRecord> records_;
};

}  // namespace

std::vector<reports::BenchRecord> derived(const Collector& rates) {
  Derivation derivation(rates);
  derivation.over_plain_loop();
  derivation.over_general_solver();
  derivation.over_plain_vortices();
  derivation.growth_with_cells();
  derivation.growth();
  derivation.threads();
  derivation.peaks();
  derivation.peaks_of_vortices();
  return derivation.records();
}

}  // namespace bench
