// @NAME@ for mpm-verify: solver SCENE OUT. Build it with
//   g++ -std=c++17 -O2 -o solver solver.cpp
// and replace what is between the lines by your own solver.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

// Numbers of the scene by "table.key"; a list keeps its text. Every default is written out; SI units.
std::map<std::string, std::string> read_scene(const char* file) {
  std::map<std::string, std::string> values;
  std::ifstream in(file);
  std::string line, table;
  while (std::getline(in, line)) {
    if (line.rfind("[", 0) == 0) {
      table = line.substr(1, line.find(']') - 1) + ".";
    } else if (const std::size_t at = line.find(" = "); at != std::string::npos) {
      values[table + line.substr(0, at)] = line.substr(at + 3);
    }
  }
  return values;
}

int main(int argc, char** argv) {
  if (argc != 3) return std::cerr << "solver SCENE OUT\n", 2;
  auto scene = read_scene(argv[1]);
  const std::string out = argv[2];
  if (scene["scene.flow"] != "\"couette\"") return std::cerr << "this solver knows couette only\n", 1;
  const auto number = [&](const char* key) { return std::atof(scene.at(key).c_str()); };
  const double H = number("scene.height"), V = number("scene.plate_velocity");
  const double nu = number("fluid.kinematic_viscosity"), safety = number("solver.options.safety");
  const int n = static_cast<int>(number("discretisation.cells"));
  std::string list = scene.at("time.outputs");
  std::replace_if(
      list.begin(), list.end(), [](char c) { return c == '[' || c == ']' || c == ','; }, ' ');
  std::istringstream outputs(list);

  std::ofstream profile(out + "/profile.csv");
  profile.precision(17);
  profile << "t,location,x,y,u\n";
  // ---- explicit central differences at the nodes
  const double h = H / n;
  std::vector<double> u(n + 1, 0.0), w;
  u[n] = V;  // at rest; the upper plate starts to move
  double t = 0;
  long steps = 0;
  for (double output; outputs >> output;) {
    const long count = std::max(1L, std::lround((output - t) * nu / (safety * 0.5 * h * h)));
    const double r = nu * (output - t) / count / (h * h);
    for (long s = 0; s < count; ++s) {
      w = u;
      for (int j = 1; j < n; ++j) w[j] = u[j] + r * (u[j + 1] - 2 * u[j] + u[j - 1]);
      u.swap(w);
    }
    t = output;
    steps += count;
    for (int j = 0; j <= n; ++j) profile << t << ",grid,0," << H * j / n << ',' << u[j] << '\n';
  }
  // ----
  std::ofstream(out + "/run.json") << "{\"version\": \"0.1\", \"status\": \"completed\", \"steps\": " << steps
                                   << ", \"cells\": " << n << "}\n";
}
