#!/usr/bin/python3
"""Plots time against size from Google Benchmark files, both axes logarithmic.

    plot_costs.py [--cpu] OUT.png FILE.json NAME [NAME...]

takes the runs called NAME/SIZE (medians where there are some) and draws a line for each NAME. With
--cpu it takes the main thread's processor time, which other programs disturb less: for benchmarks that
run on one thread (`taskset -c 0`).
Needs Debian's python3-numpy and python3-opencv."""
import json
import math
import sys

import cv2
import numpy as np

WIDTH, HEIGHT, LEFT, BOTTOM = 900, 560, 90, 60
COLOURS = [(160, 60, 20), (20, 90, 200), (40, 140, 40), (140, 40, 140)]


def series(path, name, clock):
    points = {}
    with open(path) as file:
        runs = json.load(file)["benchmarks"]
    for run in runs:
        parts = run.get("run_name", run["name"]).split("/")
        if "/".join(parts[:-1]) != name or run.get("aggregate_name", "median") != "median":
            continue
        scale = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}[run["time_unit"]]
        points[int(parts[-1])] = run[clock] * scale
    return sorted(points.items())


def main(out, path, names, clock):
    lines = [(name, series(path, name, clock)) for name in names]
    sizes = [size for _, points in lines for size, _ in points]
    times = [time for _, points in lines for _, time in points]
    if not sizes:
        sys.exit(f"{path} holds no run of {', '.join(names)}")
    low_x, high_x = math.floor(math.log2(min(sizes))), math.ceil(math.log2(max(sizes)))
    low_y, high_y = math.floor(math.log10(min(times))), math.ceil(math.log10(max(times)))

    def place(size, time):
        x = LEFT + (math.log2(size) - low_x) / (high_x - low_x) * (WIDTH - LEFT - 50)
        y = HEIGHT - BOTTOM - (math.log10(time) - low_y) / (high_y - low_y) * (HEIGHT - BOTTOM - 30)
        return round(x), round(y)

    def write(text, x, y, colour=(60, 60, 60)):
        cv2.putText(image, text, (x, y), cv2.FONT_HERSHEY_SIMPLEX, 0.5, colour, 1, cv2.LINE_AA)

    image = np.full((HEIGHT, WIDTH, 3), 255, np.uint8)
    for k in range(low_y, high_y + 1):
        a, b = place(2**low_x, 10**k), place(2**high_x, 10**k)
        cv2.line(image, a, b, (225, 225, 225))
        write(f"{10**k:g} ms", 8, a[1] + 5)
    for k in range(low_x, high_x + 1):
        a, b = place(2**k, 10**low_y), place(2**k, 10**high_y)
        cv2.line(image, a, b, (225, 225, 225))
        write(f"{2**k}", a[0] - 4 * len(str(2**k)), HEIGHT - BOTTOM + 24)
    write("size", WIDTH // 2, HEIGHT - 10)
    for index, (name, points) in enumerate(lines):
        colour = COLOURS[index % len(COLOURS)]
        path_points = [place(size, time) for size, time in points]
        for a, b in zip(path_points, path_points[1:]):
            cv2.line(image, a, b, colour, 2, cv2.LINE_AA)
        for point in path_points:
            cv2.circle(image, point, 4, colour, -1, cv2.LINE_AA)
        write(name, LEFT + 20, 40 + 24 * index, colour)
    cv2.imwrite(out, image)


if __name__ == "__main__":
    words = [word for word in sys.argv[1:] if word != "--cpu"]
    if len(words) < 3:
        sys.exit(__doc__)
    main(words[0], words[1], words[2:], "cpu_time" if "--cpu" in sys.argv else "real_time")
