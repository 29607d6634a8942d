#include "verification/suite/run_entry.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace verification {
namespace {

class ByteWriter {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  void put(const std::string& text) {
    put(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }
  template <class Row>
  void put(const std::vector<Row>& rows) {
    put(static_cast<std::uint64_t>(rows.size()));
    for (const Row& row : rows) put_row(row);
  }
  std::string take() { return std::move(bytes_); }

 private:
  template <class... T>
  void put_all(const T&... values) {
    (put(values), ...);
  }
  // A structured binding of every member: a record that gains a field does not compile until it is kept here.
  void put_row(double value) { put(value); }
  void put_row(const reports::ProfileRow& row) {
    const auto& [t, location, x, y, u, v, u_exact, v_exact] = row;
    put_all(t, location, x, y, u, v, u_exact, v_exact);
  }
  void put_row(const reports::HistoryRow& row) {
    const auto& [t, probe, probe_exact, mass, mx, my, ix, iy, energy, energy_exact] = row;
    put_all(t, probe, probe_exact, mass, mx, my, ix, iy, energy, energy_exact);
  }
  void put_row(const reports::ShearRow& row) {
    const auto& [t, location, place, rate, ratio] = row;
    put_all(t, location, place, rate, ratio);
  }
  void put_row(const reports::StateRow& row) {
    const auto& [t, location, x, y, density, density_exact, pressure, pressure_exact] = row;
    put_all(t, location, x, y, density, density_exact, pressure, pressure_exact);
  }
  void put_row(const reports::SurfaceRow& row) {
    const auto& [t, front, height, kinetic, potential, elastic] = row;
    put_all(t, front, height, kinetic, potential, elastic);
  }
  void put_row(const mpm::Vec2& x) { put_all(x.x(), x.y()); }
  void put_row(const reports::StabilityRecord& row) {
    const auto& [study, basis, transfer, stepping, waves, motion, lattice, kind, r_predicted, cfl_predicted,
                 r_measured, cfl_measured, r_tested, cfl_tested, theta_x, theta_y, offset_x, offset_y, steps,
                 crossing] = row;
    static_cast<void>(study);  // the one that asks
    put_all(basis, transfer, stepping, waves, motion, lattice, kind, r_predicted, cfl_predicted, r_measured,
            cfl_measured, r_tested, cfl_tested, theta_x, theta_y, offset_x, offset_y, steps, crossing);
  }

  std::string bytes_;
};

/// Reads values off a byte string; after the first that is not there, good() is false.
class ByteReader {
 public:
  explicit ByteReader(const std::string& bytes) : bytes_(bytes) {}

  template <class T>
  void get(T& value) {
    static_assert(std::is_arithmetic_v<T>);
    if (!reserve(sizeof(T))) return;
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
  }
  void get(std::string& text) {
    std::uint64_t size = 0;
    get(size);
    if (!reserve(size)) return;
    text.assign(bytes_, at_, size);
    at_ += size;
  }
  template <class Row>
  void get(std::vector<Row>& rows) {
    std::uint64_t count = 0;
    get(count);
    if (!reserve(count)) return;  // a row has at least one byte
    rows.reserve(count);
    for (std::uint64_t i = 0; good_ && i < count; ++i) get_row(rows.emplace_back());
  }
  /// Whether all that was asked for was there, and nothing is left over.
  [[nodiscard]] bool ended_well() const { return good_ && at_ == bytes_.size(); }

 private:
  bool reserve(std::uint64_t size) {
    if (bytes_.size() - at_ < size) good_ = false;
    return good_;
  }
  template <class... T>
  void get_all(T&... values) {
    (get(values), ...);
  }
  void get_row(double& value) { get(value); }
  void get_row(reports::ProfileRow& row) {
    auto& [t, location, x, y, u, v, u_exact, v_exact] = row;
    get_all(t, location, x, y, u, v, u_exact, v_exact);
  }
  void get_row(reports::HistoryRow& row) {
    auto& [t, probe, probe_exact, mass, mx, my, ix, iy, energy, energy_exact] = row;
    get_all(t, probe, probe_exact, mass, mx, my, ix, iy, energy, energy_exact);
  }
  void get_row(reports::ShearRow& row) {
    auto& [t, location, place, rate, ratio] = row;
    get_all(t, location, place, rate, ratio);
  }
  void get_row(reports::StateRow& row) {
    auto& [t, location, x, y, density, density_exact, pressure, pressure_exact] = row;
    get_all(t, location, x, y, density, density_exact, pressure, pressure_exact);
  }
  void get_row(reports::SurfaceRow& row) {
    auto& [t, front, height, kinetic, potential, elastic] = row;
    get_all(t, front, height, kinetic, potential, elastic);
  }
  void get_row(mpm::Vec2& x) { get_all(x.x(), x.y()); }
  void get_row(reports::StabilityRecord& row) {
    auto& [study, basis, transfer, stepping, waves, motion, lattice, kind, r_predicted, cfl_predicted,
           r_measured, cfl_measured, r_tested, cfl_tested, theta_x, theta_y, offset_x, offset_y, steps,
           crossing] = row;
    static_cast<void>(study);
    get_all(basis, transfer, stepping, waves, motion, lattice, kind, r_predicted, cfl_predicted, r_measured,
            cfl_measured, r_tested, cfl_tested, theta_x, theta_y, offset_x, offset_y, steps, crossing);
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
  bool good_ = true;
};

}  // namespace

std::string encode_run(const RunData& data) {
  // Every member of RunData: one that is new must be kept, or be left out here with a reason.
  const auto& [plan, foreign, record, timing, profile, history, shear, state, surface, start, probe, errors] =
      data;
  static_cast<void>(plan);     // of the study that asks
  static_cast<void>(foreign);  // those are not kept
  static_cast<void>(errors);   // measured anew from the profile
  ByteWriter writer;
  writer.put(static_cast<std::int64_t>(record.particles));
  writer.put(static_cast<std::int64_t>(record.steps));
  writer.put(record.status);
  writer.put(timing.wall_s);
  writer.put(timing.particle_steps_per_s);
  writer.put(static_cast<std::int64_t>(timing.repetitions));
  writer.put(timing.spread);
  writer.put(profile);
  writer.put(history);
  writer.put(shear);
  writer.put(state);
  writer.put(surface);
  writer.put(start);
  writer.put(probe);
  return writer.take();
}

std::optional<RunData> decode_run(const std::string& bytes, const Study& study, const PlannedRun& plan) {
  ByteReader reader(bytes);
  RunData data;
  std::int64_t particles = 0, steps = 0, repetitions = 0;
  std::string status;
  reader.get(particles);
  reader.get(steps);
  reader.get(status);
  reader.get(data.timing.wall_s);
  reader.get(data.timing.particle_steps_per_s);
  reader.get(repetitions);
  reader.get(data.timing.spread);
  reader.get(data.profile);
  reader.get(data.history);
  reader.get(data.shear);
  reader.get(data.state);
  reader.get(data.surface);
  reader.get(data.start);
  reader.get(data.probe);
  if (!reader.ended_well() || particles != plan.scene.particles()) return std::nullopt;
  data.plan = &plan;
  data.record = describe_run(study, plan, static_cast<long>(steps), status);
  data.timing.run = plan.run;
  data.timing.repetitions = static_cast<long>(repetitions);
  data.timing.source = reports::timing_from_cache;
  return data;
}

std::string encode_limits(const MeasuredLimits& limits) {
  ByteWriter writer;
  writer.put(limits.wall_s);
  writer.put(limits.records);
  return writer.take();
}

std::optional<MeasuredLimits> decode_limits(const std::string& bytes, const std::string& study) {
  ByteReader reader(bytes);
  MeasuredLimits limits;
  reader.get(limits.wall_s);
  reader.get(limits.records);
  if (!reader.ended_well()) return std::nullopt;
  for (reports::StabilityRecord& record : limits.records) record.study = study;
  return limits;
}

}  // namespace verification
