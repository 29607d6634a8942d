#!/bin/sh
# @NAME@ for mpm-verify: sh solver.sh SCENE OUT. Replace what is between the lines by a call of your own solver.
set -eu
scene=$1 out=$2
# One number of the scene: value TABLE KEY. Every default is written out; SI units.
value() { awk -v table="[$1]" -v key="$2" '/^\[/ { here = $0 } here == table && $1 == key { print $3 }' "$scene"; }
outputs=$(awk '$1 == "outputs" { gsub(/.*\[|\]|,/, " "); print }' "$scene")
# ---- explicit central differences at the nodes
awk -v H="$(value scene height)" -v V="$(value scene plate_velocity)" -v nu="$(value fluid kinematic_viscosity)" \
  -v n="$(value discretisation cells)" -v safety="$(value solver.options safety)" -v outputs="$outputs" -v out="$out" 'BEGIN {
  h = H / n
  for (j = 0; j < n; ++j) u[j] = 0
  u[n] = V  # at rest; the upper plate starts to move
  print "t,location,x,y,u" > (out "/profile.csv")
  last = split(outputs, times, " ")
  for (k = 1; k <= last; ++k) {
    count = int((times[k] - t) * nu / (safety * 0.5 * h * h) + 0.5); if (count < 1) count = 1
    r = nu * (times[k] - t) / count / (h * h)
    for (s = 0; s < count; ++s) {
      for (j = 1; j < n; ++j) w[j] = u[j] + r * (u[j + 1] - 2 * u[j] + u[j - 1])
      for (j = 1; j < n; ++j) u[j] = w[j]
    }
    t = times[k]; steps += count
    for (j = 0; j <= n; ++j) printf "%s,grid,0,%.17g,%.17g\n", t, H * j / n, u[j] > (out "/profile.csv")
  }
  printf "{\"version\": \"0.1\", \"status\": \"completed\", \"steps\": %d, \"cells\": %d}\n", steps, n > (out "/run.json")
}'
# ----
