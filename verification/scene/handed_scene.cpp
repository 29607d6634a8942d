#include "verification/scene/handed_scene.hpp"

#include <fmt/format.h>

#include <map>

#include "verification/config/toml_table.hpp"

namespace verification {

std::string start_in_words(const std::string& flow) {
  static const std::map<std::string, std::string> words = {
      {"poiseuille", "at rest; the acceleration body_acceleration acts along the plates from t = 0"},
      {"couette", "at rest; the upper plate moves with plate_velocity from t = 0"},
      {"couette-poiseuille", "at rest; plate_velocity and body_acceleration act from t = 0"},
      {"cessation", "the steady flow under initial_acceleration, which stops at t = 0"},
      {"stress-driven-couette",
       "at rest; the upper side is pulled along itself by the stress traction from t = 0"},
      {"oscillating-plate",
       "the periodic state Re[V0 sinh(l y)/sinh(l H)], l = sqrt(i w/nu), w = 2 pi frequency; the upper plate "
       "moves with plate_velocity cos(w t)"},
      {"womersley",
       "the periodic state Re[F/(i w) (1 - cosh(l (y - H/2))/cosh(l H/2))], l = sqrt(i w/nu), w = 2 pi "
       "frequency; the acceleration is body_acceleration cos(w t)"},
      {"acoustic-wave", "amplitude sin(k s) along the axis, k = 2 pi/wavelength; uniform density"},
      {"shear-wave",
       "varying along y: u = stream[0] + amplitude sin(k y), v = stream[1]; along x: v = stream[1] - "
       "amplitude sin(k x), u = stream[0]; k = 2 pi/wavelength"},
      {"oblique-shear-wave", "stream + amplitude (k_y, -k_x)/|k| sin(k_x x + k_y y), k = 2 pi waves/length"},
      {"translation", "velocity everywhere, density density_ratio times density"},
      {"tait-column", "at rest in the density that balances gravity"},
      {"uniform-dilatation", "rate s along the axis; uniform density"},
      {"taylor-green",
       "u = amplitude sin(k x) cos(k y), v = -amplitude cos(k x) sin(k y), k = 2 pi/period; pressure density "
       "amplitude^2/4 (cos 2kx + cos 2ky)"},
      {"double-shear-layer",
       "u = amplitude tanh((y - L/4)/thickness) below L/2, amplitude tanh((3 L/4 - y)/thickness) above, L = "
       "period; v = disturbance amplitude sin(2 pi x/L)"},
      {"walled-vortex",
       "u = amplitude sin(s x)^2 sin(2 s y), v = -amplitude sin(2 s x) sin(s y)^2, s = pi/side, between "
       "walls at "
       "rest, under the acceleration that makes exp(-decay_rate t) times it a solution"},
      {"lid-driven-cavity",
       "at rest; the lid at the top moves with lid_velocity along x from t = 0; a regularised one with "
       "16 lid_velocity s^2 (1 - s)^2, s = x/side"},
      {"manufactured",
       "u = V0 y/H + a sin(2 pi y/H) sin(k x), v = -a k H/pi sin(pi y/H)^2 cos(k x), k = 2 pi/L, under the "
       "acceleration that makes th = k x - w t in place of k x a solution at all times"},
      {"gravity-current",
       "at rest, filled up to y = h(x) = front/aspect_ratio (1 - (x/front)^(n+1))^(1/(n+2)); gravity is that "
       "under which the thin-layer similarity solution has this shape after the time age"},
      {"standing-wave",
       "filled up to y = depth, moving as the linear viscous wave whose surface is level and rises with "
       "amplitude cos(k x), k = 2 pi/wavelength"},
      {"box", "initial_velocity everywhere"},
  };
  const auto found = words.find(flow);
  return found == words.end() ? "" : found->second;
}

std::string handed_scene(const SceneConfig& scene, const std::string& options) {
  TomlTable text = TomlTable::from_text(scene.resolved, "scene");
  text.set("protocol.version", protocol_version);
  text.set("coordinates.origin", std::string("lower left corner of the domain; x to the right, y upwards"));
  text.set("coordinates.width", scene.scene.size.x());
  text.set("coordinates.height", scene.scene.size.y());
  text.set("coordinates.across", std::string(scene.flow->across() == 0 ? "x" : "y"));
  if (scene.scene.periodic(0)) text.set("coordinates.period_x", scene.scene.size.x());
  if (scene.scene.periodic(1)) text.set("coordinates.period_y", scene.scene.size.y());
  std::vector<double> points_x, points_y;
  for (const Vec2& point : scene.flow->tabulated_points()) {
    bool there = false;  // once, though both components are tabulated at it
    for (std::size_t k = 0; k < points_x.size(); ++k)
      there = there || (points_x[k] == point.x() && points_y[k] == point.y());
    if (there) continue;
    points_x.push_back(point.x());
    points_y.push_back(point.y());
  }
  if (!points_x.empty()) {
    text.set("coordinates.points_x", points_x);
    text.set("coordinates.points_y", points_y);
  }
  std::string start = start_in_words(scene.flow_name);
  if (scene.start > 0)
    start =
        fmt::format("the exact solution at t = {} s of the flow that is, at t = 0: {}", scene.start, start);
  text.set("coordinates.start", start);
  return text.print() + (options.empty() ? "" : "\n" + options);
}

}  // namespace verification
