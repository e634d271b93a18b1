#!/usr/bin/python3
"""Compare the displacement map that `scree rocks` makes of a photograph with a measured height map.

usage: displacement_against_scan.py COLOUR HEIGHT [--scree PROGRAM] [--sigma 40] [-o PICTURE]

Both pictures show the same ground, pixel on pixel. Prints the correlation of the two height maps after
a Gaussian high-pass (sigma in pixels), which takes away the slow swell that no outline can know, and
beside it that of the grey-scale picture taken as height. With -o, both maps side by side.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

import cv2
import numpy as np


def high_pass(heights, sigma):
    heights = heights.astype(np.float32)
    return heights - cv2.GaussianBlur(heights, (0, 0), sigma)


def correlation(a, b, sigma):
    return float(np.corrcoef(high_pass(a, sigma).ravel(), high_pass(b, sigma).ravel())[0, 1])


def stretched(heights):
    low, high = np.percentile(heights, [1, 99])
    return np.uint8(255 * np.clip((heights - low) / max(high - low, 1e-9), 0, 1))


def main():
    root = pathlib.Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("colour")
    parser.add_argument("height")
    parser.add_argument("--scree", default=str(root / "build/release/apps/scree"))
    parser.add_argument("--sigma", type=float, default=40.0)
    parser.add_argument("-o", "--picture")
    args = parser.parse_args()
    truth = cv2.imread(args.height, cv2.IMREAD_UNCHANGED)
    grey = cv2.imread(args.colour, cv2.IMREAD_GRAYSCALE)
    if truth is None or grey is None:
        sys.exit("cannot read the pictures named")
    truth = truth if truth.ndim == 2 else truth[..., 0]
    with tempfile.TemporaryDirectory() as scratch:
        done = subprocess.run([args.scree, "rocks", args.colour, "-o", scratch, "--quiet"], capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr)
        ours = cv2.imread(f"{scratch}/displacement.png", cv2.IMREAD_UNCHANGED)
    print(f"displacement map      {correlation(ours, truth, args.sigma):+.3f}")
    print(f"grey scale as height  {correlation(grey, truth, args.sigma):+.3f}")
    if args.picture:
        cv2.imwrite(args.picture, np.hstack([stretched(high_pass(m, args.sigma)) for m in (ours, truth)]))


main()
