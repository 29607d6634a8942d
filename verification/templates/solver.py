# @NAME@ for mpm-verify: python3 solver.py SCENE OUT. Replace what is between the lines by your own solver.
import json
import sys
import tomllib  # Python 3.11 or later

scene_file, out = sys.argv[1:]
with open(scene_file, "rb") as file:
    scene = tomllib.load(file)  # every default is written out; SI units
if scene["scene"]["flow"] != "couette":
    sys.exit("this solver knows couette only")
H, V = scene["scene"]["height"], scene["scene"]["plate_velocity"]
nu = scene["fluid"]["kinematic_viscosity"]
n = scene["discretisation"]["cells"]
safety = scene["solver"]["options"]["safety"]
# ---- explicit central differences at the nodes
h = H / n
u = [0.0] * n + [V]  # at rest; the upper plate starts to move
t, steps, rows = 0.0, 0, []
for output in scene["time"]["outputs"]:
    count = max(1, round((output - t) * nu / (safety * 0.5 * h * h)))
    r = nu * (output - t) / count / (h * h)
    for _ in range(count):
        u = [0.0] + [u[j] + r * (u[j + 1] - 2 * u[j] + u[j - 1]) for j in range(1, n)] + [V]
    t, steps = output, steps + count
    rows += [f"{t!r},grid,0,{min(j * h, H)!r},{u[j]!r}" for j in range(n + 1)]
# ----
with open(out + "/profile.csv", "w") as file:
    file.write("t,location,x,y,u\n" + "\n".join(rows) + "\n")
with open(out + "/run.json", "w") as file:  # what it says of itself; all of it may be left out
    json.dump({"version": "0.1", "status": "completed", "steps": steps, "cells": n}, file)
