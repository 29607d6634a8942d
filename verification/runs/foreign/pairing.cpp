#include "verification/runs/foreign/pairing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace verification {
namespace {

using RowOfProfile = const reports::ProfileRow*;
using Bucket = std::pair<std::int64_t, std::int64_t>;

Bucket bucket_of(RowOfProfile row, double size) {
  return {static_cast<std::int64_t>(std::floor(row->x / size)),
          static_cast<std::int64_t>(std::floor(row->y / size))};
}

}  // namespace

double pairing_distance(const SceneConfig& scene, Location location) {
  const double cell = scene.scene.smallest_cell_size();
  return location == Location::Grid ? 1e-6 * cell : 0.25 * cell / scene.discretisation.particles_across;
}

std::vector<RowOfProfile> paired_by_place(const std::vector<RowOfProfile>& rows,
                                          const std::vector<RowOfProfile>& others, double distance) {
  if (rows.size() != others.size()) return {};
  std::map<Bucket, std::vector<std::size_t>> buckets;
  const double size = 2 * distance;
  for (std::size_t k = 0; k < others.size(); ++k) buckets[bucket_of(others[k], size)].push_back(k);
  std::vector<char> taken(others.size(), 0);
  std::vector<RowOfProfile> paired;
  for (const RowOfProfile row : rows) {
    const Bucket home = bucket_of(row, size);
    std::size_t nearest = others.size();
    double least = distance;
    for (std::int64_t i = home.first - 1; i <= home.first + 1; ++i)
      for (std::int64_t j = home.second - 1; j <= home.second + 1; ++j)
        if (const auto found = buckets.find({i, j}); found != buckets.end())
          for (const std::size_t k : found->second) {
            const double apart = std::hypot(others[k]->x - row->x, others[k]->y - row->y);
            if (apart <= least) {
              least = apart;
              nearest = k;
            }
          }
    if (nearest == others.size() || taken[nearest] != 0) return {};
    taken[nearest] = 1;
    paired.push_back(others[nearest]);
  }
  return paired;
}

}  // namespace verification
