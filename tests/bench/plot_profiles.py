#!/usr/bin/python3
"""Plots cross-sections of tracks from the displacements that scree deform writes.

    plot_profiles.py OUT.png ddh.exr CELL_M WIDTH_M NAME=X_M [NAME=X_M...]

Each line is the mean over WIDTH_M about a column of cells, from one border of the ground to the
other. Needs Debian's python3-numpy and python3-opencv."""
import os
import sys

os.environ["OPENCV_IO_ENABLE_OPENEXR"] = "1"
import cv2
import numpy as np

WIDTH, HEIGHT, LEFT, BOTTOM, TOP = 900, 400, 90, 50, 20
COLOURS = [(60, 140, 200), (40, 60, 100), (140, 110, 60), (140, 40, 140)]
FINE = 2


def profile(heights, cell, width, x):
    first = max(0, round((x - width / 2) / cell))
    last = max(first + 1, round((x + width / 2) / cell))
    if last > heights.shape[1]:
        sys.exit(f"{x} m lies outside the ground of {heights.shape[1] * cell:g} m")
    return 1000.0 * heights[:, first:last].mean(axis=1)


def main(out, path, cell, width, named):
    heights = cv2.imread(path, cv2.IMREAD_UNCHANGED)
    if heights is None:
        sys.exit(f"{path} is no picture that OpenCV reads")
    heights = heights if heights.ndim == 2 else heights[:, :, 0]
    lines = [(name, profile(heights, cell, width, x)) for name, x in named]
    step = 10.0
    low = step * np.floor(min(line.min() for _, line in lines) / step)
    high = step * np.ceil(max(line.max() for _, line in lines) / step)
    span = heights.shape[0] * cell
    image = np.full((HEIGHT * FINE, WIDTH * FINE, 3), 255, np.uint8)

    def at(z, mm):
        x = LEFT + z / span * (WIDTH - LEFT - 20)
        y = TOP + (high - mm) / (high - low) * (HEIGHT - TOP - BOTTOM)
        return round(x * FINE), round(y * FINE)

    def text(words, x, y, colour=(60, 60, 60)):
        cv2.putText(image, words, (round(x * FINE), round(y * FINE)), cv2.FONT_HERSHEY_SIMPLEX,
                    0.5 * FINE, colour, FINE, cv2.LINE_AA)

    for mm in np.arange(low, high + 1e-6, step):
        grey = 120 if mm == 0.0 else 225
        cv2.line(image, at(0, mm), at(span, mm), (grey, grey, grey), FINE)
        text(f"{mm:g} mm", 10, at(0, mm)[1] / FINE + 5)
    for z in np.arange(0.0, span + 1e-9, 0.5):
        text(f"{z:g} m", at(z, low)[0] / FINE - 12, HEIGHT - 20)
    for i, (name, line) in enumerate(lines):
        colour = COLOURS[i % len(COLOURS)]
        points = [at((k + 0.5) * cell, mm) for k, mm in enumerate(line)]
        cv2.polylines(image, [np.array(points, np.int32)], False, colour, 2 * FINE, cv2.LINE_AA)
        text(name, WIDTH - 120, TOP + 20 + 22 * i, colour)
    cv2.imwrite(out, cv2.resize(image, (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA),
                [cv2.IMWRITE_PNG_COMPRESSION, 9])


if __name__ == "__main__":
    if len(sys.argv) < 6 or any("=" not in word for word in sys.argv[5:]):
        sys.exit(__doc__)
    pairs = [word.split("=", 1) for word in sys.argv[5:]]
    main(sys.argv[1], sys.argv[2], float(sys.argv[3]), float(sys.argv[4]),
         [(name, float(x)) for name, x in pairs])
