#include "reference/transient/transient_cache.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <random>
#include <string_view>
#include <system_error>

namespace reference {
namespace {

// To be raised with any change that changes what a problem's solution is: mesh, start, error, layout.
constexpr const char* kFormat = "mpm-verify transient reference, format 3\n";

std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

template <class T>
void put(std::string& bytes, const T& value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

void put(std::string& bytes, const std::vector<double>& values) {
  for (const double v : values) put(bytes, v);
}

void put(std::string& bytes, const std::vector<GradientHistory::Snapshot>& snapshots) {
  put(bytes, static_cast<std::uint64_t>(snapshots.size()));
  put(bytes, static_cast<std::uint64_t>(snapshots.empty() ? 0 : snapshots.front().w.size()));
  for (const auto& snapshot : snapshots) {
    put(bytes, snapshot.time);
    put(bytes, snapshot.w);
    put(bytes, snapshot.rate);
  }
}

/// Reads values off a byte string; after the first that is not there, `good` is false.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  T get() {
    T value{};
    if (bytes_.size() - at_ < sizeof(T)) {
      good_ = false;
    } else {
      std::memcpy(&value, bytes_.data() + at_, sizeof(T));
      at_ += sizeof(T);
    }
    return value;
  }
  std::vector<double> get(std::size_t count) {
    if ((bytes_.size() - at_) / sizeof(double) < count) good_ = false;
    if (!good_) return {};
    std::vector<double> values(count);
    if (count > 0) std::memcpy(values.data(), bytes_.data() + at_, count * sizeof(double));
    at_ += count * sizeof(double);
    return values;
  }
  std::vector<GradientHistory::Snapshot> snapshots() {
    const auto count = get<std::uint64_t>(), nodes = get<std::uint64_t>();
    std::vector<GradientHistory::Snapshot> snapshots;
    for (std::uint64_t i = 0; good_ && i < count; ++i) {
      const auto time = get<double>();
      std::vector<double> w = get(nodes), rate = get(nodes);
      snapshots.push_back({time, std::move(w), std::move(rate)});
    }
    return snapshots;
  }
  [[nodiscard]] bool good() const { return good_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool good_ = true;
};

std::string header(const std::string& key) {
  return kFormat + key + "\n";
}

}  // namespace

std::filesystem::path transient_file(const std::filesystem::path& directory, const std::string& key) {
  return directory / fmt::format("transient-{:016x}.bin", fnv1a(header(key)));
}

std::optional<StoredTransient> load_transient(const std::filesystem::path& directory,
                                              const std::string& key) {
  if (directory.empty()) return std::nullopt;
  const std::filesystem::path path = transient_file(directory, key);
  std::error_code error;
  // A FIFO or a device would never end.
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path, error))) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  const auto size = std::filesystem::file_size(path, error);
  if (error) return std::nullopt;
  std::string bytes(size, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!file) return std::nullopt;
  const std::string head = header(key);
  if (bytes.size() < head.size() + sizeof(std::uint64_t) || bytes.compare(0, head.size(), head) != 0) {
    return std::nullopt;
  }
  const std::string_view body =
      std::string_view(bytes).substr(head.size(), bytes.size() - head.size() - sizeof(std::uint64_t));
  std::uint64_t checksum = 0;
  std::memcpy(&checksum, bytes.data() + bytes.size() - sizeof checksum, sizeof checksum);
  if (checksum != fnv1a(body)) return std::nullopt;

  Reader reader(body);
  StoredTransient stored;
  stored.fine = reader.snapshots();
  stored.coarse = reader.snapshots();
  if (!reader.good()) return std::nullopt;
  return stored;
}

void save_transient(const std::filesystem::path& directory, const std::string& key,
                    const StoredTransient& stored) {
  if (directory.empty()) return;
  std::string body;
  put(body, stored.fine);
  put(body, stored.coarse);
  std::error_code failed;
  std::filesystem::create_directories(directory, failed);
  const std::filesystem::path target = transient_file(directory, key);
  std::filesystem::path temporary = target;
  temporary += fmt::format(".{:08x}.part", std::random_device{}());
  {
    std::ofstream file(temporary, std::ios::binary);
    std::string checksum;
    put(checksum, fnv1a(body));
    file << header(key) << body << checksum;
    file.close();
    if (!file) {
      std::filesystem::remove(temporary, failed);
      return;
    }
  }
  std::filesystem::rename(temporary, target, failed);
  if (failed) std::filesystem::remove(temporary, failed);
}

}  // namespace reference
